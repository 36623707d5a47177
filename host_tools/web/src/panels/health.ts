// How the run is doing on its machine, faults, and what the listener has counted; or a finished run's verdict.
import * as api from '../api';
import { el, fixed, setText } from '../dom';
import type { Model, Status } from '../protocol';

type Row = [label: string, value: string, bad?: boolean];

export class HealthPanel {
  readonly element: HTMLElement;
  private readonly title = el('div', { class: 'panel-title' }, 'Health');
  private readonly rows = el('div', { class: 'facts', id: 'health' });
  private readonly below = el('div', { class: 'below' });
  private cells: [HTMLElement, HTMLElement][] = [];
  private shape = '';

  constructor(private readonly model: Model) {
    this.element = el(
      'section',
      { class: 'panel health' },
      el('div', { class: 'chart-head' }, this.title),
      this.rows,
      this.below,
    );
  }

  private show(rows: Row[]): void {
    const shape = rows.map(([label]) => label).join();
    if (shape !== this.shape) {
      this.shape = shape;
      this.cells = rows.map(([label]) => [el('span', {}, label), el('b', {})]);
      this.rows.replaceChildren(...this.cells.flat());
    }
    rows.forEach(([, value, bad], i) => {
      setText(this.cells[i][1], value);
      this.cells[i][1].classList.toggle('bad', bad === true);
    });
  }

  faults(word: number): string {
    const names = this.model.faults.filter((fault) => word & fault.bit).map((fault) => fault.name.replaceAll('_', ' '));
    return names.length ? names.join(', ') : 'none';
  }

  live(status: Status | null): void {
    setText(this.title, 'Health');
    const health = status?.health;
    const rows: Row[] = health
      ? [
          ['controller tick', `${fixed(health.controller_us, 1)} µs, max ${fixed(health.controller_max_us, 0)}`],
          ['plant tick', `${fixed(health.plant_us, 1)} µs, max ${fixed(health.plant_max_us, 0)}`],
          ['telemetry', `${fixed(health.telemetry_us, 1)} µs a tick`],
          ['pace', health.paced ? `paced, ${fixed(health.lag_us / 1000, 1)} ms late` : 'as fast as it goes'],
          ['overruns', String(health.overruns), health.overruns > 0],
          ['faults', this.faults(health.fault), health.fault !== 0],
          ['sent, dropped', `${health.published}, ${health.dropped}`, health.dropped > 0],
        ]
      : [];
    const counters = Object.entries(status?.counters ?? {});
    if (counters.length)
      rows.push(['received', String(counters.reduce((sum, [, counter]) => sum + counter.received, 0))]);
    for (const [name, counter] of counters) {
      const parts = (['lost', 'replayed', 'malformed', 'foreign'] as const)
        .filter((kind) => counter[kind])
        .map((kind) => `${counter[kind]} ${kind}`);
      if (parts.length) rows.push([name.replace('HOAP2_', '').toLowerCase(), parts.join(', '), true]);
    }
    if (rows.length === 0) rows.push(['run', 'none yet']);
    if (status?.url && !health) rows.push(['from', status.url.replace(/^udpm:\/\/|\?.*/g, '')]);
    this.show(rows);
    if (this.below.childElementCount) this.below.replaceChildren();
  }

  finished(id: string, summary: Record<string, unknown>, fault: number): void {
    setText(this.title, 'Verdict');
    const at = (name: string): number => {
      const value = name
        .split('.')
        .reduce<unknown>((node, key) => (node as Record<string, unknown> | undefined)?.[key], summary);
      return typeof value === 'number' ? value : NaN;
    };
    const rows: Row[] = [
      ['bounds', summary.ok === true ? 'all met' : summary.ok === false ? 'missed' : '–', summary.ok === false],
      ['steps', `${fixed(at('steps_taken'), 0)} of ${fixed(at('steps_planned'), 0)}`],
      [
        'fell',
        summary.fell ? `${summary.fall_direction ?? ''} at ${fixed(at('fall_time_s'), 2)} s` : 'no',
        Boolean(summary.fell),
      ],
      ['roll, pitch max', `${fixed(at('roll_deg.max'), 2)}°, ${fixed(at('pitch_deg.max'), 2)}°`],
      ['roll, pitch rms', `${fixed(at('roll_deg.rms'), 2)}°, ${fixed(at('pitch_deg.rms'), 2)}°`],
      ['controller tick', `${fixed(at('controller_us.median'), 1)} µs, p99 ${fixed(at('controller_us.p99'), 1)}`],
      ['plant tick', `${fixed(at('plant_us.median'), 1)} µs, p99 ${fixed(at('plant_us.p99'), 1)}`],
      ['speed', `${fixed(at('real_time_factor'), 0)}× real time`],
      ['faults now', this.faults(fault), fault !== 0],
    ];
    this.show(rows);
    if (this.below.dataset.run !== id || !this.below.childElementCount) {
      this.below.dataset.run = id;
      const link = (file: string, label: string): HTMLElement =>
        el('a', { href: api.file(id, file), target: '_blank', rel: 'noopener' }, label);
      this.below.replaceChildren(
        link('report.html', 'report'),
        link('summary.json', 'summary'),
        link('run.toml', 'parameters'),
      );
    }
  }
}
