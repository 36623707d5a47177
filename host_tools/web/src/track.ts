// Rows of signals over time: a whole run, or the last rows of a live one in a ring that never grows.
import type { Entry } from './protocol';

export class Track {
  readonly width: number;
  private readonly entries = new Map<string, Entry>();
  private readonly t: Float64Array;
  private readonly data: Float32Array;
  private head = 0; // place of the oldest row
  count = 0;
  version = 0; // grows with each change

  constructor(
    layout: Entry[],
    readonly capacity: number,
  ) {
    for (const entry of layout) this.entries.set(entry.name, entry);
    this.width = layout.reduce((sum, entry) => sum + entry.count, 0);
    this.t = new Float64Array(capacity);
    this.data = new Float32Array(capacity * this.width);
  }

  static of(layout: Entry[], t: Float64Array, rows: Float32Array): Track {
    const track = new Track(layout, Math.max(1, t.length));
    track.append(t, rows);
    return track;
  }

  clear(): void {
    this.head = 0;
    this.count = 0;
    this.version++;
  }

  append(t: Float64Array, rows: Float32Array): void {
    for (let i = 0; i < t.length; i++) {
      if (this.count > 0 && t[i] <= this.last) {
        if (t[i] < this.last - 0.5)
          this.clear(); // the run is played again from an earlier time
        else continue;
      }
      const at = (this.head + this.count) % this.capacity;
      this.t[at] = t[i];
      this.data.set(rows.subarray(i * this.width, (i + 1) * this.width), at * this.width);
      if (this.count < this.capacity) this.count++;
      else this.head = (this.head + 1) % this.capacity;
    }
    this.version++;
  }

  get first(): number {
    return this.count ? this.time(0) : 0;
  }

  get last(): number {
    return this.count ? this.time(this.count - 1) : 0;
  }

  time(row: number): number {
    return this.t[(this.head + row) % this.capacity];
  }

  // Last row not after t; 0 before the first.
  find(t: number): number {
    let low = 0;
    let high = this.count - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.time(middle) <= t) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  entry(name: string): Entry {
    const entry = this.entries.get(name);
    if (!entry) throw new Error(`no signal ${name}`);
    return entry;
  }

  value(row: number, name: string, element = 0): number {
    return this.data[((this.head + row) % this.capacity) * this.width + this.entry(name).first + element];
  }

  // All elements of a signal at a row (a view).
  values(row: number, name: string): Float32Array {
    const entry = this.entry(name);
    const at = ((this.head + row) % this.capacity) * this.width + entry.first;
    return this.data.subarray(at, at + entry.count);
  }

  // One element over rows from..to - 1, every `stride`-th, times scale.
  series(name: string, element: number, from: number, to: number, stride: number, scale: number): number[] {
    const column = this.entry(name).first + element;
    const out: number[] = [];
    for (let row = from; row < to; row += stride) {
      out.push(this.data[((this.head + row) % this.capacity) * this.width + column] * scale);
    }
    return out;
  }

  times(from: number, to: number, stride: number): number[] {
    const out: number[] = [];
    for (let row = from; row < to; row += stride) out.push(this.time(row));
    return out;
  }
}
