// Commands to a live run: walking, steps, pushes, tunable parameters; and what the run answered.
import { DEG, el, fixed, setText } from '../dom';
import type { Answer, Model, Parameter } from '../protocol';

const MAX_ANSWERS = 60;
export const MAX_PUSH_N = 40;
const DIRECTIONS: [string, string, number][] = [
  // label, name, heading (deg, left positive)
  ['↖', 'ahead left', 45],
  ['↑', 'ahead', 0],
  ['↗', 'ahead right', -45],
  ['←', 'left', 90],
  ['', '', NaN],
  ['→', 'right', -90],
  ['↙', 'back left', 135],
  ['↓', 'back', 180],
  ['↘', 'back right', -135],
];

export type Send = (command: string, name: string, value: number[]) => void;

interface Slider {
  row: HTMLElement;
  set: (value: number) => void;
}

export class Commands {
  readonly element: HTMLElement;
  private readonly why = el('p', { class: 'why', id: 'commands-why' });
  private readonly body = el('div', { class: 'command-body' });
  private readonly answers = el('div', { class: 'answers', id: 'answers' });
  private readonly force = el('input', {
    type: 'number',
    id: 'push-force',
    value: '8',
    min: '0.5',
    max: MAX_PUSH_N,
    step: '0.5',
  });
  private readonly duration = el('input', {
    type: 'number',
    id: 'push-duration',
    value: '0.1',
    min: '0.02',
    max: '2',
    step: '0.02',
  });
  private readonly sliders = new Map<string, Slider>();
  private yaw = 0;
  enabled = false;

  constructor(
    model: Model,
    private readonly send: Send,
  ) {
    this.body.append(this.walking(model), this.pushing(), this.tuning(model));
    this.element = el(
      'section',
      { class: 'panel commands', id: 'commands' },
      el('div', { class: 'chart-head' }, el('div', { class: 'panel-title' }, 'Commands')),
      this.why,
      this.body,
      el('div', { class: 'sub-title' }, 'Answers'),
      this.answers,
    );
    this.enable(false, '');
  }

  get push_s(): number {
    return Math.min(2, Math.max(0.02, Number(this.duration.value) || 0.1));
  }

  setHeading(yaw_rad: number): void {
    this.yaw = yaw_rad;
  }

  enable(enabled: boolean, why: string): void {
    this.enabled = enabled;
    this.body.classList.toggle('off', !enabled);
    for (const control of this.body.querySelectorAll<HTMLInputElement>('button, input')) control.disabled = !enabled;
    setText(this.why, why);
    this.why.hidden = !why;
  }

  // What the run starts from.
  setValues(controller: Record<string, unknown>): void {
    for (const [name, slider] of this.sliders) {
      const value = controller[name];
      if (typeof value === 'number') slider.set(value);
    }
  }

  private walking(model: Model): HTMLElement {
    const start = el(
      'button',
      { id: 'walk-start', class: 'go', onclick: () => this.send('walk', 'start', []) },
      'Start walking',
    );
    const stop = el('button', { id: 'walk-stop', onclick: () => this.send('walk', 'stop', []) }, 'Stop');
    const { length_m, sideways_m, turn_rad } = model.step;
    return el(
      'div',
      { class: 'group' },
      el('div', { class: 'two' }, start, stop),
      el('div', { class: 'sub-title' }, 'Each step'),
      this.slider('length', length_m, 1000, 'mm', 1, (value) => this.send('step', 'length_m', [value])),
      this.slider('sideways', sideways_m, 1000, 'mm', 1, (value) => this.send('step', 'sideways_m', [value])),
      this.slider('turn', turn_rad, DEG, 'deg', 1, (value) => this.send('step', 'turn_rad', [value])),
    );
  }

  private pushing(): HTMLElement {
    const pad = el(
      'div',
      { class: 'pad' },
      ...DIRECTIONS.map(([label, name, heading]) =>
        label
          ? el('button', { title: `push ${name}`, 'data-push': name, onclick: () => this.push(heading) }, label)
          : el('span', {}, '✛'),
      ),
    );
    return el(
      'div',
      { class: 'group' },
      el('div', { class: 'sub-title' }, 'Push the trunk'),
      el(
        'div',
        { class: 'push' },
        pad,
        el(
          'div',
          { class: 'push-values' },
          el('label', {}, 'force', this.force, 'N'),
          el('label', {}, 'for', this.duration, 's'),
          el('p', { class: 'hint' }, 'or drag the trunk in the view'),
        ),
      ),
    );
  }

  private push(heading_deg: number): void {
    const force = Math.min(MAX_PUSH_N, Math.max(0, Number(this.force.value) || 0));
    const angle = this.yaw + heading_deg / DEG;
    this.pushBy([force * Math.cos(angle), force * Math.sin(angle)]);
  }

  pushBy(force_W_N: [number, number]): void {
    this.send('push', 'chest', [force_W_N[0], force_W_N[1], 0, this.push_s]);
  }

  private tuning(model: Model): HTMLElement {
    const rows = model.tunable
      .filter((parameter) => parameter.count === 1)
      .map((parameter) => {
        const name = parameter.name.replace(/_(1_s2|1_s|m|s|rad|N|Nm)$/, '').replaceAll('_', ' ');
        const unit = parameter.unit === '1' ? '' : parameter.unit.replace('s2', 's²');
        return this.slider(name, parameter, 1, unit, parameter.high > 10 ? 1 : 3, (value) =>
          this.send('set', parameter.name, [value]),
        );
      });
    return el(
      'details',
      { class: 'group', open: true },
      el('summary', { class: 'sub-title' }, 'Tunable parameters'),
      ...rows,
    );
  }

  private slider(
    label: string,
    parameter: Parameter,
    scale: number,
    unit: string,
    digits: number,
    send: (value: number) => void,
  ): HTMLElement {
    const shown = el('b', {});
    const input = el('input', {
      type: 'range',
      min: parameter.low * scale,
      max: parameter.high * scale,
      step: 10 ** -digits,
      value: parameter.default[0] * scale,
      'data-parameter': parameter.name,
    });
    const tell = (): void => setText(shown, `${fixed(Number(input.value), digits)} ${unit}`);
    input.addEventListener('input', tell);
    input.addEventListener('change', () => {
      send(Math.min(parameter.high, Math.max(parameter.low, Number(input.value) / scale)));
    });
    tell();
    const range = `${fixed(parameter.low * scale, digits)} to ${fixed(parameter.high * scale, digits)} ${unit}`;
    const row = el(
      'label',
      { class: 'slider', title: `${parameter.text}; ${range}` },
      el('span', {}, label),
      input,
      shown,
    );
    this.sliders.set(parameter.name, {
      row,
      set: (value) => {
        if (document.activeElement !== input) input.value = String(value * scale);
        tell();
      },
    });
    return row;
  }

  answer(answer: Answer): void {
    const value = answer.value.map((v) => Number(v.toFixed(4))).join(', ');
    const what = [answer.command, answer.name, value].filter(Boolean).join(' ');
    const line = el(
      'div',
      { class: `answer ${answer.accepted ? 'accepted' : 'refused'}` },
      el('i', {}, answer.accepted ? '✓' : '✕'),
      el('span', {}, what + (answer.own ? '' : ' (not from here)')),
      answer.t_s !== undefined ? el('em', {}, `${fixed(answer.t_s, 2)} s`) : null,
      answer.accepted ? null : el('p', {}, answer.reason),
    );
    this.answers.prepend(line);
    while (this.answers.childElementCount > MAX_ANSWERS) this.answers.lastElementChild!.remove();
  }
}
