// The time line: play, pause, speed, scrub; steps and events along it.
import { el, find, fixed, setText } from '../dom';
import type { Player } from '../player';
import { LEFT, RIGHT } from '../scene/colours';
import type { RunEvent, Step } from '../protocol';

const SPEEDS = [0.05, 0.1, 0.25, 0.5, 1, 2, 4];
const MARKED: Record<string, string> = {
  fall: '#ff5a5f',
  fault: '#ff5a5f',
  push: '#e25bc9',
  command_refused: '#ffb454',
};

export class Timeline {
  private readonly play = el(
    'button',
    { id: 'play', class: 'icon', title: 'play or hold (space)', onclick: () => this.player.toggle() },
    '❚❚',
  );
  private readonly speed = el('select', { id: 'speed', title: 'speed' });
  private readonly follow = el('button', { id: 'go-live', onclick: () => this.goLive() }, 'LIVE');
  private readonly canvas = el('canvas', { id: 'scrub' });
  private readonly head = el('div', { class: 'scrub-head' });
  private readonly bar = el(
    'div',
    { class: 'scrub', id: 'scrub-bar', role: 'slider', tabindex: 0, 'aria-label': 'time' },
    this.canvas,
    this.head,
  );
  private readonly clock = el('span', { class: 'clock', id: 'clock' }, '0.00');
  private readonly length = el('span', { class: 'clock dim' }, '');
  private drawn = '';

  constructor(private readonly player: Player) {
    for (const speed of SPEEDS) this.speed.append(el('option', { value: speed }, `${speed}×`));
    this.speed.addEventListener('change', () => (this.player.speed = Number(this.speed.value)));
    const step = (rows: number, label: string, hint: string): HTMLElement =>
      el('button', { class: 'icon', title: hint, onclick: () => this.player.nudge(rows) }, label);
    find('timeline').append(
      step(-1, '‹', 'one row back (←)'),
      this.play,
      step(1, '›', 'one row ahead (→)'),
      this.clock,
      this.bar,
      this.length,
      this.speed,
      this.follow,
    );
    const seek = (event: PointerEvent): void => {
      const box = this.bar.getBoundingClientRect();
      const share = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
      this.player.seek(this.player.track.first + share * (this.player.track.last - this.player.track.first));
    };
    this.bar.addEventListener('pointerdown', (event) => {
      this.bar.setPointerCapture(event.pointerId);
      seek(event);
    });
    this.bar.addEventListener('pointermove', (event) => event.buttons & 1 && seek(event));
    window.addEventListener('keydown', (event) => this.key(event));
  }

  private key(event: KeyboardEvent): void {
    if (event.target instanceof HTMLInputElement || event.target instanceof HTMLSelectElement) return;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const jump: Record<string, number> = { ArrowLeft: -1, ArrowRight: 1 };
    if (event.key === ' ') this.player.toggle();
    else if (event.key in jump) this.player.nudge(jump[event.key] * (event.shiftKey ? 20 : 1));
    else if (event.key === 'Home') this.player.seek(this.player.track.first);
    else if (event.key === 'End') this.player.seek(this.player.track.last);
    else return;
    event.preventDefault();
  }

  private goLive(): void {
    if (!this.player.playing) this.player.toggle();
  }

  update(steps: Step[], events: RunEvent[]): void {
    const { player } = this;
    const { track } = player;
    setText(this.play, player.playing ? '❚❚' : '▶');
    setText(this.clock, fixed(player.time, 2));
    setText(this.length, `${fixed(track.last, 2)} s`);
    this.speed.hidden = player.live;
    this.follow.hidden = !player.live;
    this.follow.classList.toggle('on', player.playing);
    if (!player.live && document.activeElement !== this.speed) this.speed.value = String(player.speed);
    const span = track.last - track.first;
    const share = span > 0 ? (player.time - track.first) / span : 0;
    this.head.style.left = `${(100 * share).toFixed(2)}%`;
    this.bar.setAttribute('aria-valuenow', player.time.toFixed(2));
    const key = `${track.first.toFixed(1)} ${track.last.toFixed(1)} ${steps.length} ${events.length} ${this.bar.clientWidth}`;
    if (key !== this.drawn) {
      this.drawn = key;
      this.draw(steps, events);
    }
  }

  private draw(steps: Step[], events: RunEvent[]): void {
    const { first, last } = this.player.track;
    const ratio = Math.min(2, devicePixelRatio);
    const [width, height] = [Math.round(this.bar.clientWidth * ratio), Math.round(this.bar.clientHeight * ratio)];
    this.canvas.width = width;
    this.canvas.height = height;
    const context = this.canvas.getContext('2d')!;
    const at = (t: number): number => ((t - first) / Math.max(1e-6, last - first)) * width;
    for (const step of steps) {
      context.fillStyle = step.left ? LEFT : RIGHT;
      context.globalAlpha = 0.55;
      const top = step.left ? 0.26 : 0.54;
      context.fillRect(
        at(step.first_s),
        top * height,
        Math.max(1, at(step.last_s) - at(step.first_s) - ratio),
        0.2 * height,
      );
    }
    context.globalAlpha = 1;
    for (const event of events) {
      if (!(event.event in MARKED)) continue;
      context.fillStyle = MARKED[event.event];
      context.fillRect(at(event.t_s) - ratio, 0, 2 * ratio, height);
    }
  }
}
