// The line at the top: what is shown, how the connection is, where the walk is.
import { el, find, fixed, setClass, setText } from '../dom';
import type { Model, Status } from '../protocol';
import type { Track } from '../track';

const FALLEN_CONTACTS = 0;

export interface Shown {
  live: boolean;
  connected: boolean;
  title: string;
  status: Status | null;
  speed: number;
  playing: boolean;
  fps: number;
}

export class TopBar {
  private readonly pill = el('span', { class: 'pill', id: 'state' }, '…');
  private readonly title = el('span', { class: 'run-title', id: 'run-title' });
  private readonly fields: Record<string, HTMLElement> = {};
  private readonly banner = find('banner');

  constructor(private readonly model: Model) {
    const bar = find('topbar');
    bar.append(this.pill, this.title, el('span', { class: 'space' }));
    for (const [name, label] of [
      ['time', 'time'],
      ['mode', 'mode'],
      ['step', 'step'],
      ['rate', 'speed'],
      ['lag', 'lag'],
      ['lost', 'lost'],
      ['fps', 'view'],
    ]) {
      this.fields[name] = el('b', { id: `top-${name}` }, '–');
      bar.append(el('span', { class: `field field-${name}` }, el('i', {}, label), this.fields[name]));
    }
  }

  update(shown: Shown, track: Track, row: number, time: number): void {
    const { status } = shown;
    const state = !shown.connected && shown.live ? 'gone' : shown.live ? (status?.state ?? 'waiting') : 'replay';
    const names: Record<string, string> = {
      gone: 'NO SERVER',
      off: 'NO LCM',
      waiting: 'WAITING',
      live: 'LIVE',
      silent: 'SILENT',
      ended: 'ENDED',
      replay: 'REPLAY',
    };
    setText(this.pill, state === 'live' && !shown.playing ? 'LIVE · held' : names[state]);
    setClass(this.pill, `pill pill-${state}`);
    setText(this.title, shown.title);
    this.banner.hidden = !this.tell(shown, state);
    this.walk(track, row, time);
    const health = status?.health;
    setText(
      this.fields.rate,
      shown.live ? (health ? `${fixed(health.real_time_factor, 2)}×` : '–') : `${shown.speed}×`,
    );
    setText(this.fields.lag, shown.live && health?.paced ? `${fixed(health.lag_us / 1000, 1)} ms` : '–');
    const lost = Object.values(status?.counters ?? {}).reduce((sum, counter) => sum + counter.lost, 0);
    setText(this.fields.lost, shown.live && status ? String(lost) : '–');
    this.fields.lost.classList.toggle('bad', shown.live && lost > 0);
    setText(this.fields.fps, shown.fps ? `${fixed(shown.fps, 0)} fps` : '–');
  }

  private walk(track: Track, row: number, time: number): void {
    if (track.count === 0) {
      for (const name of ['time', 'mode', 'step']) setText(this.fields[name], '–');
      return;
    }
    setText(this.fields.time, `${fixed(time, 2)} s`);
    const { enums } = this.model;
    const mode = enums.mode[track.value(row, 'mode')] ?? '–';
    const phase = enums.phase[track.value(row, 'phase')] ?? '';
    const fallen = track.value(row, 'other_contacts') > FALLEN_CONTACTS;
    setText(
      this.fields.mode,
      fallen ? 'on the ground' : mode === 'walk' ? phase.replace('_', ' ') : mode.replace('_', '-'),
    );
    this.fields.mode.classList.toggle('bad', fallen || mode === 'safe' || mode === 'crouch');
    setText(this.fields.step, fixed(track.value(row, 'step_index'), 0));
  }

  // What must be said across the page; false when there is nothing.
  private tell(shown: Shown, state: string): boolean {
    const { status } = shown;
    let text = '';
    if (!shown.connected)
      text = 'The monitor does not answer. Trying again … (is ./hoap2 monitor --web still running?)';
    else if (state === 'off') text = `No LCM: ${status?.problem ?? ''}`;
    else if (state === 'silent')
      text = `Nothing has come from the run for ${fixed(status?.silent_s ?? 0, 0)} s. It may have been stopped, or the machine is busy.`;
    else if (state === 'waiting') text = 'Waiting for a run: ./hoap2 run floor-walk --realtime --accept-commands';
    setText(this.banner, text);
    setClass(this.banner, `banner banner-${shown.connected ? state : 'gone'}`);
    return text !== '';
  }
}
