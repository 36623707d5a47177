// The live run and the finished ones; a click shows one.
import * as api from '../api';
import { el, fixed } from '../dom';
import type { RunEntry, Status } from '../protocol';

const PERIOD_MS = 5000;

export class RunList {
  readonly element: HTMLElement;
  private readonly list = el('div', { class: 'run-list', id: 'runs' });
  private readonly live = el('button', { class: 'run live', id: 'run-live', onclick: () => this.onLive() });
  private readonly filter = el('input', {
    class: 'filter',
    type: 'search',
    placeholder: 'filter',
    'aria-label': 'filter runs',
    oninput: () => this.draw(),
  });
  private entries: RunEntry[] = [];
  private told = '';
  selected = 'live';

  constructor(
    private readonly onLive: () => void,
    private readonly onRun: (entry: RunEntry) => void,
  ) {
    this.element = el(
      'section',
      { class: 'panel runs' },
      el('div', { class: 'chart-head' }, el('div', { class: 'panel-title' }, 'Runs'), this.filter),
      this.live,
      this.list,
    );
    void this.refresh();
    setInterval(() => document.hidden || void this.refresh(), PERIOD_MS);
  }

  async refresh(): Promise<void> {
    try {
      const { runs } = await api.runs();
      const text = JSON.stringify(runs);
      if (text === this.told) return;
      this.told = text;
      this.entries = runs;
      this.draw();
    } catch {
      // the server is away: the list stays as it is, the top of the page says why
    }
  }

  setLive(status: Status | null, scenario: string): void {
    const state = status?.state ?? 'waiting';
    const running = state === 'live' || state === 'silent' || state === 'ended';
    this.live.className = `run live state-${state}${this.selected === 'live' ? ' selected' : ''}`;
    const text = running ? scenario || 'a run' : 'no run yet';
    if (this.live.dataset.text === `${state} ${text}`) return;
    this.live.dataset.text = `${state} ${text}`;
    this.live.replaceChildren(
      el('i', { class: 'dot' }),
      el('span', { class: 'run-name' }, text),
      el('span', { class: 'run-note' }, state === 'live' ? 'live' : state === 'ended' ? 'ended' : state),
    );
  }

  private draw(): void {
    const wanted = this.filter.value.trim().toLowerCase();
    const shown = this.entries.filter((entry) =>
      `${entry.scenario} ${entry.name} ${entry.title}`.toLowerCase().includes(wanted),
    );
    this.list.replaceChildren(...shown.map((entry) => this.row(entry)));
    if (shown.length === 0) {
      this.list.append(
        el('p', { class: 'empty' }, wanted ? 'none fits' : 'No finished run yet: ./hoap2 run sand-walk-lpc'),
      );
    }
  }

  select(id: string): void {
    this.selected = id;
    this.draw();
  }

  private row(entry: RunEntry): HTMLElement {
    const made = new Date(entry.made_s * 1000);
    const today = made.toDateString() === new Date().toDateString();
    const when = made.toLocaleString(
      'en-GB',
      today
        ? { hour: '2-digit', minute: '2-digit' }
        : { day: 'numeric', month: 'short', hour: '2-digit', minute: '2-digit' },
    );
    const verdict = entry.interrupted
      ? 'stopped'
      : entry.fell
        ? 'fell'
        : entry.ok === false
          ? 'missed'
          : entry.ok
            ? 'ok'
            : '';
    const detail = [
      entry.seed ? `seed ${entry.seed}` : '',
      entry.duration_s ? `${fixed(entry.duration_s, 1)} s` : '',
      entry.steps_taken ? `${entry.steps_taken} steps` : '',
    ]
      .filter(Boolean)
      .join(' · ');
    return el(
      'button',
      {
        class: `run${this.selected === entry.id ? ' selected' : ''}`,
        'data-run': entry.id,
        title: `${entry.title}\n${entry.id}`,
        onclick: () => this.onRun(entry),
      },
      el('span', { class: 'run-name' }, entry.scenario),
      el('span', { class: `run-note verdict-${verdict}` }, verdict),
      el('span', { class: 'run-detail' }, `${when} · ${detail}`),
    );
  }
}
