// A plot over time: the last seconds of a live run, or a stretch of a finished one with a line at the shown time.
import uPlot from 'uplot';
import { el, setText } from '../dom';
import type { Player } from '../player';
import type { Track } from '../track';

const MAX_POINTS = 700;

export interface Line {
  label: string;
  colour: string;
  width?: number;
  dash?: number[];
  signal: string;
  element?: number;
  scale?: number;
}

export interface ChartOptions {
  title: string;
  unit: string;
  digits: number;
  least: number; // of the range of values that is shown at least
  floor?: number; // lowest value shown
  limits?: (lines: Line[]) => number[]; // drawn as thin lines
}

const AXIS = {
  stroke: '#7f8c9d',
  font: '10.5px system-ui, sans-serif',
  grid: { stroke: '#ffffff10', width: 1 },
  ticks: { stroke: '#ffffff18', width: 1, size: 3 },
};

export class Chart {
  readonly element: HTMLElement;
  private readonly plot: HTMLElement;
  private readonly legend: HTMLElement;
  private readonly head: HTMLElement = el('div', { class: 'playhead' });
  private uplot: uPlot | null = null;
  private lines: Line[] = [];
  private values: HTMLElement[] = [];
  private drawn = '';
  updates = 0;

  constructor(
    private readonly options: ChartOptions,
    private readonly player: Player,
    extra?: HTMLElement,
  ) {
    this.legend = el('div', { class: 'chart-legend' });
    this.plot = el('div', { class: 'chart-plot' });
    const title = el('div', { class: 'panel-title' }, options.title, el('span', { class: 'unit' }, options.unit));
    this.element = el(
      'section',
      { class: 'panel chart' },
      el('div', { class: 'chart-head' }, title, this.legend, extra),
      this.plot,
    );
    new ResizeObserver(() => this.resize()).observe(this.plot);
  }

  setLines(lines: Line[]): void {
    this.lines = lines;
    this.legend.replaceChildren();
    this.values = lines.map((line) => {
      const value = el('b', {}, '–');
      const key = el('i', { style: `border-color:${line.colour};border-top-style:${line.dash ? 'dashed' : 'solid'}` });
      this.legend.append(el('span', {}, key, line.label, value));
      return value;
    });
    this.uplot?.destroy();
    this.uplot = null;
    this.drawn = '';
  }

  private make(): void {
    const { clientWidth: width, clientHeight: height } = this.plot;
    if (width < 20 || height < 20) return;
    const { options } = this;
    const low = options.floor;
    const range = (_u: uPlot, from: number | null, to: number | null): [number, number] => {
      if (from === null || to === null || !Number.isFinite(from + to)) return [0, options.least];
      const middle = (from + to) / 2;
      const half = Math.max(options.least / 2, 0.54 * (to - from));
      return [low !== undefined ? Math.max(low, middle - half) : middle - half, middle + half];
    };
    this.uplot = new uPlot(
      {
        width,
        height,
        padding: [6, 8, 0, 0],
        legend: { show: false },
        cursor: { show: false },
        select: { show: false, left: 0, top: 0, width: 0, height: 0 },
        scales: { x: { time: false, auto: false }, y: { range } },
        axes: [
          { ...AXIS, size: 20, gap: 2 },
          { ...AXIS, size: 36, gap: 3, space: 17 },
        ],
        series: [
          {},
          ...this.lines.map((line) => ({
            stroke: line.colour,
            width: line.width ?? 1.4,
            dash: line.dash,
            points: { show: false },
          })),
        ],
        hooks: { draw: [(u: uPlot) => this.drawLimits(u)] },
      },
      [[0], ...this.lines.map(() => [null])] as uPlot.AlignedData,
      this.plot,
    );
    this.uplot.over.append(this.head);
    this.uplot.over.addEventListener('pointerdown', (event) => this.seek(event));
    this.uplot.over.addEventListener('pointermove', (event) => event.buttons & 1 && this.seek(event));
  }

  private drawLimits(u: uPlot): void {
    for (const limit of this.options.limits?.(this.lines) ?? []) {
      const y = u.valToPos(limit, 'y', true);
      if (y < u.bbox.top || y > u.bbox.top + u.bbox.height) continue;
      u.ctx.save();
      u.ctx.strokeStyle = '#ff5a5f88';
      u.ctx.setLineDash([6, 5]);
      u.ctx.beginPath();
      u.ctx.moveTo(u.bbox.left, y);
      u.ctx.lineTo(u.bbox.left + u.bbox.width, y);
      u.ctx.stroke();
      u.ctx.restore();
    }
  }

  private seek(event: PointerEvent): void {
    const box = this.uplot!.over.getBoundingClientRect();
    const time = this.uplot!.posToVal(event.clientX - box.left, 'x');
    if (Number.isFinite(time)) this.player.seek(time);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.plot;
    if (width < 20 || height < 20) return;
    this.uplot?.setSize({ width, height });
    this.drawn = '';
  }

  // Show [from_s, to_s] of the track with the play head at the player's time.
  update(track: Track, from_s: number, to_s: number): void {
    if (!this.uplot && this.lines.length) this.make();
    if (!this.uplot) return;
    const key = `${track.version} ${from_s.toFixed(3)} ${to_s.toFixed(3)}`;
    if (key !== this.drawn) {
      this.drawn = key;
      this.fill(track, from_s, to_s);
    }
    const x = this.uplot.valToPos(this.player.time, 'x');
    const following = this.player.live && this.player.playing;
    this.head.hidden = following || track.count === 0 || x < 0 || x > this.uplot.over.clientWidth;
    this.head.style.transform = `translateX(${x.toFixed(1)}px)`;
    if (track.count === 0) return;
    const row = track.find(this.player.time + 1e-9);
    this.lines.forEach((line, i) => {
      const value = track.value(row, line.signal, line.element ?? 0) * (line.scale ?? 1);
      setText(this.values[i], Number.isFinite(value) ? value.toFixed(this.options.digits) : '–');
    });
  }

  private fill(track: Track, from_s: number, to_s: number): void {
    let from = track.count ? track.find(from_s) : 0;
    const to = track.count ? Math.min(track.count, track.find(to_s) + 2) : 0;
    const stride = Math.max(1, Math.floor((to - from) / MAX_POINTS));
    from -= from % stride; // the same rows each time, so that lines do not shimmer
    const data = [
      track.times(from, to, stride),
      ...this.lines.map((line) =>
        track
          .series(line.signal, line.element ?? 0, from, to, stride, line.scale ?? 1)
          .map((value) => (Number.isFinite(value) ? value : null)),
      ),
    ];
    this.uplot!.setData(data as uPlot.AlignedData, false);
    this.uplot!.setScale('x', { min: from_s, max: Math.max(from_s + 0.1, to_s) });
    this.updates++;
  }
}
