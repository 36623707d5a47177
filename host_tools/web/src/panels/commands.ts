// Commands to a live run: walking, steps, pushes, tunable parameters; and what the run answered.
import { DEG, el, fixed, setText } from '../dom';
import type { Answer, Model, Parameter } from '../protocol';
import { Slider } from './slider';

const MAX_ANSWERS = 60;
const DRAG_MOST_N = 60;
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

export class Commands {
  readonly element: HTMLElement;
  private readonly why = el('p', { class: 'why', id: 'commands-why' });
  private readonly body = el('div', { class: 'command-body' });
  private readonly answers = el('div', { class: 'answers', id: 'answers' });
  private readonly force: HTMLInputElement;
  private readonly duration: HTMLInputElement;
  private readonly limits: Model['push'];
  private readonly told = new Set<string>(); // answers shown
  private readonly sliders = new Map<string, Slider>();
  private yaw = 0;
  enabled = false;

  constructor(
    model: Model,
    private readonly send: Send,
  ) {
    const { most_N, longest_s } = (this.limits = model.push);
    const number = (id: string, value: number, min: number, max: number): HTMLInputElement =>
      el('input', { type: 'number', id, value, min, max, step: min });
    this.force = number('push-force', 8, 0.5, most_N);
    this.duration = number('push-duration', 0.1, 0.02, longest_s);
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
    return Math.min(this.limits.longest_s, Math.max(0.02, Number(this.duration.value) || 0.1));
  }

  get drag_N(): number {
    return Math.min(DRAG_MOST_N, this.limits.most_N);
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
    const numbers = new Map<string, unknown>();
    for (const [name, value] of Object.entries(controller)) {
      if (!Array.isArray(value)) numbers.set(name, value);
      else value.forEach((element, i) => numbers.set(`${name}.${'xyz'[i]}`, element));
    }
    for (const [key, slider] of this.sliders) {
      const [kind, name] = key.split(' ');
      const value = numbers.get(kind === 'step' ? `step_${name}` : name);
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
      this.slider('step', 'length_m', length_m, 'length'),
      this.slider('step', 'sideways_m', sideways_m, 'sideways'),
      this.slider('step', 'turn_rad', turn_rad, 'turn'),
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
    const force = Math.min(this.limits.most_N, Math.max(0, Number(this.force.value) || 0));
    const angle = this.yaw + heading_deg / DEG;
    this.pushBy([force * Math.cos(angle), force * Math.sin(angle)]);
  }

  pushBy(force_W_N: [number, number]): void {
    this.send('push', 'chest', [force_W_N[0], force_W_N[1], 0, this.push_s]);
  }

  private tuning(model: Model): HTMLElement {
    const rows = model.tunable.map((parameter) => this.slider('set', parameter.name, parameter));
    return el(
      'details',
      { class: 'group', open: true },
      el('summary', { class: 'sub-title' }, 'Tunable parameters'),
      ...rows,
    );
  }

  private slider(kind: string, name: string, parameter: Parameter, label?: string): HTMLElement {
    const slider = new Slider(parameter, (value) => this.send(kind, name, [value]), label);
    this.sliders.set(`${kind} ${name}`, slider);
    return slider.element;
  }

  answer(answer: Answer): void {
    if (answer.command_id !== undefined) {
      if (this.told.has(answer.command_id)) return; // told again after the connection was lost
      this.told.add(answer.command_id);
      if (this.told.size > 4 * MAX_ANSWERS) this.told.delete(this.told.values().next().value!);
    }
    const slider = this.sliders.get(`${answer.command} ${answer.name}`);
    if (answer.accepted && answer.value.length === 1) slider?.set(answer.value[0]);
    else if (answer.own) slider?.back();
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
