// Which track is shown, and at what time of it.
import type { Track } from './track';

const LIVE_CHASE_1_S = 14; // how fast the shown time follows the newest row
const LIVE_JUMP_S = 0.6;

export class Player {
  track: Track;
  live = true;
  time = 0;
  playing = true; // live: follows the newest row
  speed = 1;
  looping = false;

  constructor(track: Track) {
    this.track = track;
  }

  show(track: Track, live: boolean): void {
    this.track = track;
    this.live = live;
    this.playing = true;
    this.speed = 1;
    this.time = live ? track.last : track.first;
  }

  seek(t: number): void {
    this.time = Math.min(Math.max(t, this.track.first), this.track.last);
    if (this.live) this.playing = false;
  }

  toggle(): void {
    if (!this.live && !this.playing && this.time >= this.track.last - 1e-6) this.time = this.track.first;
    this.playing = !this.playing;
    if (this.live && this.playing) this.time = this.track.last;
  }

  // One row ahead or back.
  nudge(rows: number): void {
    this.playing = false;
    const row = this.track.find(this.time + 1e-9) + rows;
    this.seek(this.track.time(Math.min(Math.max(row, 0), Math.max(0, this.track.count - 1))));
  }

  tick(dt_s: number): void {
    const { track } = this;
    if (track.count === 0) return;
    if (this.live && this.playing) {
      const behind = track.last - this.time;
      this.time =
        behind > LIVE_JUMP_S || behind < 0 ? track.last : this.time + behind * Math.min(1, dt_s * LIVE_CHASE_1_S);
    } else if (this.playing) {
      this.time += dt_s * this.speed;
      if (this.time >= track.last) {
        this.time = this.looping ? track.first : track.last;
        this.playing = this.looping;
      }
    }
    this.time = Math.min(Math.max(this.time, track.first), track.last);
  }
}
