// What the server sends: JSON texts, and blocks of bytes (a JSON header, then arrays).

export type Numbers = Float32Array | Float64Array | Uint32Array | Int32Array;

export interface Block {
  header: { kind: string; [key: string]: unknown };
  arrays: Record<string, Numbers>;
}

const KINDS = { float32: Float32Array, float64: Float64Array, uint32: Uint32Array, int32: Int32Array };

export function unpack(data: ArrayBuffer): Block {
  const length = new DataView(data).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
  const arrays: Record<string, Numbers> = {};
  let at = 4 + length;
  for (const [name, kind, count] of header.arrays as [string, keyof typeof KINDS, number][]) {
    const Kind = KINDS[kind];
    arrays[name] = new Kind(data, at, count);
    at += count * Kind.BYTES_PER_ELEMENT;
  }
  return { header, arrays };
}

export interface Entry {
  name: string;
  product: string;
  unit: string;
  first: number;
  count: number;
  text: string;
}

export interface Joint {
  name: string;
  parent: number;
  child: number;
  axis: [number, number, number];
  origin_parent_m: [number, number, number];
  limit_rad: [number, number];
  velocity_limit_rad_s: number;
  torque_peak_Nm: number;
  torque_continuous_Nm: number;
}

export interface Parameter {
  name: string;
  unit: string;
  low: number;
  high: number;
  default: number;
  text: string;
}

export interface Model {
  robot: string;
  mass_kg: number;
  base_link: number;
  chest: number;
  links: {
    name: string;
    com_L_m: [number, number, number];
    box: [[number, number, number], [number, number, number]];
  }[];
  joints: Joint[];
  feet: { ankle_to_toe_m: number; ankle_to_heel_m: number; half_width_m: number };
  rest: { hip_height_m: number; q_rad: number[] };
  layout: Entry[];
  enums: Record<string, string[]>;
  faults: { name: string; bit: number; text: string }[];
  tunable: Parameter[];
  push: { most_N: number; longest_s: number };
  step: Record<'length_m' | 'sideways_m' | 'turn_rad', Parameter>;
}

export interface Footprint {
  x: number;
  y: number;
  yaw: number;
  left: boolean;
}

export interface Step extends Footprint {
  number: number;
  first_s: number;
  last_s: number;
}

export interface Terrain {
  tilt_rad: [number, number];
  start_W_m: [number, number];
  start_yaw_W_rad: number;
  blocks: { centre: [number, number, number]; size: [number, number, number]; yaw: number }[];
}

export interface Push {
  link: number;
  start_s: number;
  duration_s: number;
  point_L_m: [number, number, number];
  force_W_N: [number, number, number];
}

export interface SoilGrid {
  origin_W_m: [number, number, number];
  axes_W: number[];
  low_x_m: number;
  low_y_m: number;
  cell_m: number;
  depth_m: number;
  nx: number;
  ny: number;
  full_scale_m: number;
}

export interface RunEntry {
  id: string;
  scenario: string;
  name: string;
  title: string;
  seed: number;
  ok: boolean | null;
  fell: boolean;
  interrupted: boolean;
  duration_s: number | null;
  steps_taken: number | null;
  made_s: number;
}

export interface RunDocument {
  scenario: string;
  title: string;
  seed: number;
  sensors: string;
  version: string;
  duration_s: number;
  folder: string;
  accepts_commands: boolean;
  same_schema: boolean;
  terrain: Terrain;
  pushes: Push[];
  soil: boolean;
  controller: Record<string, unknown>;
}

export interface Health {
  tick: number;
  controller_us: number;
  controller_max_us: number;
  plant_us: number;
  plant_max_us: number;
  telemetry_us: number;
  lag_us: number;
  real_time_factor: number;
  overruns: number;
  published: number;
  dropped: number;
  decimated: number;
  fault: number;
  paced: number;
  state: number;
}

export interface Counter {
  received: number;
  lost: number;
  replayed: number;
  malformed: number;
  foreign: number;
}

export type LiveState = 'off' | 'waiting' | 'live' | 'silent' | 'ended';

export interface Status {
  kind: 'status';
  state: LiveState;
  problem: string;
  silent_s: number | null;
  url: string | null;
  health: Health | null;
  counters: Record<string, Counter>;
  run_id: string | null;
}

export interface RunEvent {
  t_s: number;
  event: string;
  text: string;
}

export interface Answer {
  kind: 'answer';
  command_id?: string;
  accepted: boolean;
  reason: string;
  command: string;
  name: string;
  value: number[];
  own: boolean;
  t_s?: number;
}
