// What can be shown: the live run, or a finished one. Each has a track, footprints, ground, events.
import * as api from './api';
import { eventsOf } from './panels/events';
import type { Block, Entry, Footprint, Push, RunDocument, RunEntry, RunEvent, Step, Terrain } from './protocol';
import { Soil, SoilTimeline } from './scene/ground';
import { Track } from './track';

const LIVE_ROWS = 6000; // at 100 Hz a minute
const MAX_STEPS = 400;
const MAX_EVENTS = 300;

export interface Source {
  readonly live: boolean;
  readonly id: string;
  title: string;
  track: Track;
  steps: Step[];
  startFeet: Footprint[];
  terrain: Terrain | null;
  pushes: Push[];
  events: RunEvent[];
  soil: Soil | null;
  showSoil(t: number): void;
}

// The soles' outlines at a row: both start soles, each step done, the target of the one under way.
export function footprints(source: Source, row: number): Footprint[] {
  const { track, steps } = source;
  if (track.count === 0) return source.startFeet;
  const t = track.time(row);
  const prints: Footprint[] = [...source.startFeet, ...steps.filter((step) => step.last_s < t)];
  const index = track.value(row, 'step_index');
  const [x, y, yaw] = track.values(row, 'footprint_W_m_rad');
  if (index > 0 && Number.isFinite(x)) {
    const known = steps.find((step) => step.number === index);
    const stance = track.value(row, 'stance_foot');
    const left = known ? known.left : stance === 0;
    if (known || stance < 2) prints.push({ x, y, yaw, left });
  }
  return prints;
}

export class FinishedRun implements Source {
  readonly live = false;
  readonly id: string;
  title: string;
  track: Track;
  steps: Step[];
  startFeet: Footprint[];
  terrain: Terrain;
  pushes: Push[];
  events: RunEvent[];
  summary: Record<string, unknown>;
  soil: Soil | null = null;
  private timeline: SoilTimeline | null = null;

  constructor(entry: RunEntry, block: Block) {
    const header = block.header as unknown as {
      layout: Entry[];
      steps: Step[];
      start_feet: Footprint[];
      terrain: Terrain;
      pushes: Push[];
      summary: Record<string, unknown>;
      duration_s: number;
    };
    this.id = entry.id;
    this.title = `${entry.scenario} / ${entry.name}${entry.seed ? ` · seed ${entry.seed}` : ''}`;
    this.track = Track.of(header.layout, block.arrays.t_s as Float64Array, block.arrays.rows as Float32Array);
    this.steps = header.steps;
    this.startFeet = header.start_feet;
    this.terrain = header.terrain;
    this.pushes = header.pushes;
    this.summary = header.summary;
    this.events = eventsOf(header.steps, header.pushes, header.summary, header.duration_s);
  }

  static async load(entry: RunEntry): Promise<FinishedRun> {
    const block = await api.track(entry.id);
    const run = new FinishedRun(entry, block);
    if (block.header.soil) {
      const told = await api.soil(entry.id);
      run.soil = new Soil(told);
      run.timeline = new SoilTimeline(run.soil, told);
    }
    return run;
  }

  showSoil(t: number): void {
    this.timeline?.show(t);
  }
}

export class LiveRun implements Source {
  readonly live = true;
  readonly id = 'live';
  title = '';
  track: Track;
  steps: Step[] = [];
  startFeet: Footprint[] = [];
  terrain: Terrain | null = null;
  pushes: Push[] = [];
  events: RunEvent[] = [];
  soil: Soil | null = null;
  document: RunDocument | null = null;
  runId: string | null = null;

  constructor(layout: Entry[]) {
    this.track = new Track(layout, LIVE_ROWS);
  }

  // A run was told of; true when it is another one than before.
  begin(told: {
    run_id: string;
    document: RunDocument | null;
    steps: Step[];
    start_feet: Footprint[];
    events: RunEvent[];
  }): boolean {
    const other = told.run_id !== this.runId;
    if (other) {
      this.track.clear();
      this.soil = null;
    }
    this.runId = told.run_id;
    this.document = told.document;
    this.steps = told.steps.slice(-MAX_STEPS);
    this.startFeet = told.start_feet;
    this.events = told.events;
    const { document } = told;
    this.terrain = document?.terrain ?? null;
    this.pushes = document?.pushes ?? [];
    this.title = document ? `${document.scenario}${document.seed ? ` · seed ${document.seed}` : ''}` : 'a run';
    return other;
  }

  step(step: Step): void {
    this.steps.push(step);
    if (this.steps.length > MAX_STEPS) this.steps.shift();
  }

  event(event: RunEvent): void {
    this.events.push(event);
    if (this.events.length > MAX_EVENTS) this.events.shift();
  }

  rows(block: Block): void {
    if (block.header.run_id === this.runId) {
      this.track.append(block.arrays.t_s as Float64Array, block.arrays.rows as Float32Array);
    }
  }

  // The pool told anew, or what changed in it; true when there is another pool to draw.
  soilTold(block: Block): boolean {
    const fresh = block.header.kind === 'soil';
    if (fresh) this.soil = new Soil(block);
    const cells = block.arrays.cells as Uint32Array;
    this.soil?.change(cells, block.arrays.heights as Float32Array, 0, cells.length);
    this.soil?.refresh();
    return fresh;
  }

  showSoil(): void {
    // as it is now, also while an earlier moment is looked at
  }
}
