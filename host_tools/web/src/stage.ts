// Moves what the 3D view shows to the shown time.
import * as THREE from 'three';
import type { Player } from './player';
import type { Model } from './protocol';
import type { View3D } from './scene/view';
import { footprints, type Source } from './sources';

const TRAIL_S = 4;

type Height = (x: number, y: number) => number;

export class Stage {
  private shownTime = NaN;
  private shownVersion = -1;
  private shownPrints = '';
  private readonly point = new THREE.Vector3();

  constructor(
    private readonly view: View3D,
    private readonly model: Model,
    private readonly player: Player,
  ) {}

  // There is something else to show.
  reset(): void {
    this.shownVersion = -1;
    this.shownTime = NaN;
    this.shownPrints = '';
  }

  update(source: Source): void {
    const { track, time, playing } = this.player;
    if (time !== this.shownTime || (track.version !== this.shownVersion && playing)) this.pose(source);
  }

  private pose(source: Source): void {
    const { view } = this;
    const { track, time } = this.player;
    this.shownTime = time;
    this.shownVersion = track.version;
    if (track.count === 0) return;
    const row = track.find(time + 1e-9);
    const next = Math.min(row + 1, track.count - 1);
    const gap = track.time(next) - track.time(row);
    const share = gap > 0 && gap < 0.1 ? Math.min(1, Math.max(0, (time - track.time(row)) / gap)) : 0;
    const mix = (name: string): Float32Array => blend(track.values(row, name), track.values(next, name), share);
    const base = mix('true_base_pos_W_m');
    view.robot.root.visible = Number.isFinite(base[0]);
    if (!view.robot.root.visible) return;
    view.robot.pose(base, mix('true_base_quat_W'), mix('true_q_rad'));
    view.hips.set(base[0], base[1], base[2]);
    source.showSoil(time);
    const height: Height = (x, y) => view.ground.height(x, y);
    view.marks.set(
      {
        com: mix('true_com_W_m'),
        cop: mix('true_cop_W_m'),
        cp: mix('cp_est_W_m'),
        feet: mix('true_foot_pos_W_m'),
        forces: mix('true_foot_force_W_N'),
        push: track.values(row, 'true_push_force_W_N'),
        pushPoint: this.pushPoint(source, time),
      },
      height,
    );
    const prints = footprints(source, row);
    const key = `${prints.length} ${prints.at(-1)?.x.toFixed(4)} ${prints.at(-1)?.y.toFixed(4)}`;
    if (key !== this.shownPrints) view.marks.setPrints(prints, height);
    this.shownPrints = key;
    this.trail(row, time, height);
    view.invalidate();
  }

  private pushPoint(source: Source, time: number): THREE.Vector3 {
    const planned = source.pushes.find((push) => time >= push.start_s && time <= push.start_s + push.duration_s);
    if (planned) return this.view.robot.point(planned.link, planned.point_L_m, this.point);
    return this.view.robot.point(this.model.chest, this.model.links[this.model.chest].com_L_m, this.point);
  }

  private trail(row: number, time: number, height: Height): void {
    const { view } = this;
    if (!view.marks.layers.trail.visible) return;
    const { track } = this.player;
    const first = track.find(time - TRAIL_S);
    const stride = Math.max(1, Math.ceil((row - first) / 200));
    const points: number[] = [];
    for (let i = first - (first % stride); i <= row; i += stride) {
      const com = track.values(i, 'true_com_W_m');
      points.push(com[0], com[1]);
    }
    view.marks.setTrail(points, height);
  }
}

function blend(a: Float32Array, b: Float32Array, share: number): Float32Array {
  if (share <= 0) return a;
  const out = new Float32Array(a.length);
  for (let i = 0; i < a.length; i++) out[i] = Number.isFinite(b[i]) ? a[i] + share * (b[i] - a[i]) : a[i];
  return out;
}

// Yaw of a quaternion (w, x, y, z).
export function heading(quat: ArrayLike<number>): number {
  const [w, x, y, z] = [quat[0], quat[1], quat[2], quat[3]];
  const yaw = Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
  return Number.isFinite(yaw) ? yaw : 0;
}
