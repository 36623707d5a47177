// The ground from above: soles, CoM, CoP, capture point and the ways they took. Ahead is up, left is left.
import { el, fixed, setText } from '../dom';
import type { Footprint, Model } from '../protocol';
import { COM, COP, CP, LEFT, REFERENCE, RIGHT } from '../scene/colours';
import type { Track } from '../track';

const TAIL_S = 1.6;
const HALF_M = 0.135; // of the picture's shorter side, at first
const SPANS_M = [0.07, 0.1, 0.135, 0.2, 0.3, 0.5];

const PATHS = [
  { signal: 'cp_est_W_m', colour: CP, label: 'capture point' },
  { signal: 'true_cop_W_m', colour: COP, label: 'CoP' },
  { signal: 'true_com_W_m', colour: COM, label: 'CoM' },
];

export class Plane {
  readonly element: HTMLElement;
  private readonly canvas = el('canvas', { class: 'plane-canvas' });
  private readonly read = el('span', { class: 'readout' });
  private half_m = HALF_M;
  private centre: [number, number] | null = null;
  private scale = 1;
  private yaw = 0;
  updates = 0;

  constructor(private readonly model: Model) {
    const keys = el(
      'div',
      { class: 'chart-legend' },
      ...PATHS.map((path) => el('span', {}, el('i', { style: `border-color:${path.colour}` }), path.label)),
      el('span', {}, el('i', { style: `border-color:${REFERENCE};border-top-style:dashed` }), 'desired'),
    );
    this.element = el(
      'section',
      { class: 'panel plane' },
      el('div', { class: 'chart-head' }, el('div', { class: 'panel-title' }, 'Ground plane'), keys),
      el('div', { class: 'plane-holder' }, this.canvas, this.read),
    );
    this.canvas.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        const at = SPANS_M.findIndex((span) => span >= this.half_m - 1e-9);
        this.half_m = SPANS_M[Math.min(Math.max(at + Math.sign(event.deltaY), 0), SPANS_M.length - 1)];
      },
      { passive: false },
    );
  }

  private place(x: number, y: number): [number, number] {
    const [dx, dy] = [x - this.centre![0], y - this.centre![1]];
    const ahead = Math.cos(this.yaw) * dx + Math.sin(this.yaw) * dy;
    const left = -Math.sin(this.yaw) * dx + Math.cos(this.yaw) * dy;
    return [this.canvas.width / 2 - left * this.scale, this.canvas.height / 2 - ahead * this.scale];
  }

  update(track: Track, t: number, prints: Footprint[], yaw_rad: number): void {
    const ratio = Math.min(2, devicePixelRatio);
    const holder = this.canvas.parentElement!;
    const [width, height] = [Math.round(holder.clientWidth * ratio), Math.round(holder.clientHeight * ratio)];
    if (width < 20 || height < 20) return;
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    const context = this.canvas.getContext('2d')!;
    context.clearRect(0, 0, width, height);
    if (track.count === 0) return;
    const row = track.find(t + 1e-9);
    this.yaw = yaw_rad;
    this.scale = Math.min(width, height) / (2 * this.half_m);
    this.follow(track.values(row, 'true_com_W_m'));
    this.grid(context, ratio);
    for (const print of prints) this.sole(context, print, 0.55, ratio, false);
    this.feet(context, track, row, ratio);
    this.ways(context, track, row, t, ratio);
    this.wanted(context, track, row, ratio);
    this.points(context, track, row, ratio);
    this.readout(track, row);
    this.updates++;
  }

  // The CoM stays near the middle; the ground stands still as long as it can.
  private follow(com: Float32Array): void {
    if (!Number.isFinite(com[0])) {
      this.centre ??= [0, 0];
      return;
    }
    this.centre ??= [com[0], com[1]];
    const reach = 0.22 * this.half_m;
    for (const i of [0, 1]) {
      const off = com[i] - this.centre[i];
      if (Math.abs(off) > reach) this.centre[i] += off - Math.sign(off) * reach;
    }
  }

  private grid(context: CanvasRenderingContext2D, ratio: number): void {
    const step = this.half_m > 0.25 ? 0.1 : 0.05;
    const reach = this.half_m * 3.2;
    context.lineWidth = ratio;
    const first = (i: number): number => Math.ceil((this.centre![i] - reach) / step) * step;
    context.fillStyle = '#64707f';
    context.font = `${10 * ratio}px system-ui, sans-serif`;
    for (const axis of [0, 1]) {
      for (let at = first(axis); at < this.centre![axis] + reach; at += step) {
        const [c0, c1] = this.centre!;
        const [a, b] =
          axis === 0
            ? [this.place(at, c1 - reach), this.place(at, c1 + reach)]
            : [this.place(c0 - reach, at), this.place(c0 + reach, at)];
        context.strokeStyle = Math.abs(at) < 1e-6 ? '#ffffff2a' : '#ffffff10';
        context.beginPath();
        context.moveTo(...a);
        context.lineTo(...b);
        context.stroke();
        const label = `${Math.round(1000 * at)}`;
        if (axis === 0 && this.yaw === 0) context.fillText(label, 4 * ratio, a[1] - 3 * ratio);
        else if (this.yaw === 0) context.fillText(label, a[0] + 3 * ratio, this.canvas.height - 4 * ratio);
      }
    }
  }

  private sole(
    context: CanvasRenderingContext2D,
    print: Footprint,
    alpha: number,
    ratio: number,
    solid: boolean,
  ): void {
    const { ankle_to_toe_m: toe, ankle_to_heel_m: heel, half_width_m: half } = this.model.feet;
    const colour = print.left ? LEFT : RIGHT;
    const [c, s] = [Math.cos(print.yaw), Math.sin(print.yaw)];
    context.save();
    context.globalAlpha = alpha;
    context.beginPath();
    for (const [x, y] of [
      [toe, half],
      [-heel, half],
      [-heel, -half],
      [toe, -half],
    ]) {
      const [px, py] = this.place(print.x + c * x - s * y, print.y + s * x + c * y);
      context.lineTo(px, py);
    }
    context.closePath();
    context.strokeStyle = context.fillStyle = colour;
    context.lineJoin = 'round';
    context.lineWidth = (solid ? 2.5 : 1) * ratio;
    context.stroke();
    if (solid) {
      context.globalAlpha = 0.22 * alpha;
      context.fill();
    }
    context.restore();
  }

  // Where the soles are now; bright as the load they carry.
  private feet(context: CanvasRenderingContext2D, track: Track, row: number, ratio: number): void {
    const [at, yaw] = [track.values(row, 'true_foot_pos_W_m'), track.values(row, 'true_foot_yaw_W_rad')];
    const force = track.values(row, 'true_foot_force_W_N');
    for (const foot of [0, 1]) {
      const load = Math.min(1, Math.max(0, force[3 * foot + 2] / (this.model.mass_kg * 9.81)));
      const print = { x: at[3 * foot], y: at[3 * foot + 1], yaw: yaw[foot], left: foot === 1 };
      this.sole(context, print, 0.35 + 0.65 * load, ratio, true);
    }
  }

  private ways(context: CanvasRenderingContext2D, track: Track, row: number, t: number, ratio: number): void {
    const first = track.find(t - TAIL_S);
    const stride = Math.max(1, Math.floor((row - first) / 160));
    context.lineWidth = 1.6 * ratio;
    context.lineJoin = 'round';
    for (const path of PATHS) {
      context.strokeStyle = path.colour;
      for (const [from, to, alpha] of [
        [first, first + (row - first) / 2, 0.25],
        [first + (row - first) / 2, row, 0.7],
      ]) {
        context.globalAlpha = alpha;
        context.beginPath();
        for (let i = Math.floor(from); i <= to; i += stride) {
          const value = track.values(i, path.signal);
          if (Number.isFinite(value[0])) context.lineTo(...this.place(value[0], value[1]));
        }
        context.stroke();
      }
    }
    context.globalAlpha = 1;
  }

  // Desired capture point and CoP.
  private wanted(context: CanvasRenderingContext2D, track: Track, row: number, ratio: number): void {
    context.setLineDash([3 * ratio, 2.5 * ratio]);
    context.lineWidth = 1.4 * ratio;
    for (const [signal, colour] of [
      ['cp_ref_W_m', CP],
      ['cop_ref_W_m', COP],
    ]) {
      const value = track.values(row, signal);
      if (!Number.isFinite(value[0])) continue;
      context.strokeStyle = colour;
      context.beginPath();
      context.arc(...this.place(value[0], value[1]), 7.5 * ratio, 0, 2 * Math.PI);
      context.stroke();
    }
    context.setLineDash([]);
  }

  private points(context: CanvasRenderingContext2D, track: Track, row: number, ratio: number): void {
    for (const path of PATHS) {
      const value = track.values(row, path.signal);
      if (!Number.isFinite(value[0])) continue;
      context.beginPath();
      context.arc(...this.place(value[0], value[1]), 4.4 * ratio, 0, 2 * Math.PI);
      context.fillStyle = path.colour;
      context.fill();
      context.strokeStyle = '#0b0e12';
      context.lineWidth = 1.2 * ratio;
      context.stroke();
    }
  }

  private readout(track: Track, row: number): void {
    const [cp, ref] = [track.values(row, 'cp_est_W_m'), track.values(row, 'cp_ref_W_m')];
    const shift = track.values(row, 'landing_shift_W_m');
    const mm = (value: number): string => fixed(1000 * value, 1);
    setText(
      this.read,
      `CP error ${mm(cp[0] - ref[0])}, ${mm(cp[1] - ref[1])} mm\nlanding shift ${mm(shift[0])}, ${mm(shift[1])} mm`,
    );
  }
}
