// What happened, newest last; a click goes there.
import { el, fixed } from '../dom';
import type { RunEvent, Step } from '../protocol';

const MAX_EVENTS = 300;

export class EventList {
  readonly element: HTMLElement;
  private readonly list = el('div', { class: 'event-list', id: 'events' });
  private events: RunEvent[] = [];
  private shown = -1;

  constructor(private readonly onSeek: (t: number) => void) {
    this.element = el(
      'section',
      { class: 'panel events' },
      el('div', { class: 'chart-head' }, el('div', { class: 'panel-title' }, 'Events')),
      this.list,
    );
  }

  get all(): RunEvent[] {
    return this.events;
  }

  reset(events: RunEvent[]): void {
    this.shown = -1;
    this.events = events.slice(-MAX_EVENTS);
    this.list.replaceChildren(...this.events.map((event) => this.row(event)));
    this.list.scrollTop = this.list.scrollHeight;
  }

  add(event: RunEvent): void {
    const atEnd = this.list.scrollHeight - this.list.scrollTop - this.list.clientHeight < 40;
    this.events.push(event);
    this.list.append(this.row(event));
    while (this.events.length > MAX_EVENTS) {
      this.events.shift();
      this.list.firstElementChild!.remove();
    }
    if (atEnd) this.list.scrollTop = this.list.scrollHeight;
  }

  // Marks where the shown time is, and keeps it in sight; NaN: nowhere.
  at(t: number): void {
    const now = this.events.findLastIndex((event) => event.t_s <= t + 1e-6);
    if (now === this.shown) return;
    this.shown = now;
    [...this.list.children].forEach((row, i) => row.classList.toggle('now', i === now));
    const row = this.list.children[now] as HTMLElement | undefined;
    if (row) this.list.scrollTop = row.offsetTop - this.list.offsetTop - this.list.clientHeight / 2;
  }

  private row(event: RunEvent): HTMLElement {
    return el(
      'button',
      { class: `event event-${event.event}`, onclick: () => this.onSeek(event.t_s) },
      el('em', {}, `${fixed(event.t_s, 2)}`),
      el('i', {}, event.event.replaceAll('_', ' ')),
      el('span', {}, event.text.replace(`${event.event} `, '')),
    );
  }
}

// The events of a finished run, from what its folder tells.
export function eventsOf(
  steps: Step[],
  pushes: { start_s: number; force_W_N: number[] }[],
  summary: Record<string, unknown>,
  duration_s: number,
): RunEvent[] {
  const events: RunEvent[] = [{ t_s: 0, event: 'run_started', text: String(summary.title ?? '') }];
  for (const step of steps) {
    events.push({ t_s: step.first_s, event: 'step', text: `${step.number} ${step.left ? 'left' : 'right'}` });
  }
  for (const push of pushes) {
    events.push({ t_s: push.start_s, event: 'push', text: `${push.force_W_N.map((v) => fixed(v, 1)).join(', ')} N` });
  }
  if (summary.fell && typeof summary.fall_time_s === 'number') {
    events.push({ t_s: summary.fall_time_s, event: 'fall', text: String(summary.fall_direction ?? '') });
  }
  if (summary.error) events.push({ t_s: duration_s, event: 'fault', text: String(summary.error) });
  events.push({ t_s: duration_s, event: 'run_ended', text: summary.interrupted ? 'stopped' : '' });
  return events.sort((a, b) => a.t_s - b.t_s);
}
