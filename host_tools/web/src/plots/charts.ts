// The plots over time, side by side in time.
import { DEG, el } from '../dom';
import type { Player } from '../player';
import type { Model } from '../protocol';
import { LEFT, RIGHT } from '../scene/colours';
import { Chart } from './chart';
import { PICK_COLOURS } from './joints';

const SPANS: [string, number][] = [
  ['4 s', 4],
  ['10 s', 10],
  ['30 s', 30],
  ['all', 0],
];
const LEAST_S = 0.5;
const AHEAD = 0.15; // of a stretch of a finished run, behind the shown time
const FAINT = '99';

export class Charts {
  private readonly charts: Chart[];
  private readonly spans = el('select', { id: 'span', title: 'stretch of time in the plots' });
  private readonly spanOf = { live: 10, replay: 0 };

  constructor(
    private readonly player: Player,
    private readonly model: Model,
    private readonly picked: () => number[],
  ) {
    for (const [label, value] of SPANS) this.spans.append(el('option', { value }, label));
    this.spans.addEventListener('change', () => (this.spanOf[this.kind] = Number(this.spans.value)));
    const peak = (i: number): number => model.joints[i].torque_peak_Nm;
    const limits = (): number[] => picked().flatMap((i) => [-peak(i), peak(i)]);
    this.charts = [
      new Chart({ title: 'Attitude', unit: 'deg', digits: 2, least: 1 }, player, this.spans),
      new Chart({ title: 'Foot load', unit: 'N', digits: 0, least: 40, floor: 0 }, player),
      new Chart({ title: 'Joint angle', unit: 'deg', digits: 1, least: 4 }, player),
      new Chart({ title: 'Joint torque', unit: 'N m', digits: 2, least: 0.5, limits }, player),
    ];
    this.charts[0].setLines([
      { label: 'roll', colour: '#5cc8ff', signal: 'true_chest_rpy_rad', element: 0, scale: DEG, width: 1.7 },
      { label: 'pitch', colour: '#ffb454', signal: 'true_chest_rpy_rad', element: 1, scale: DEG, width: 1.7 },
      { label: 'roll est.', colour: '#5cc8ff99', signal: 'roll_est_rad', scale: DEG, dash: [4, 3], width: 1 },
      { label: 'pitch est.', colour: '#ffb45499', signal: 'pitch_est_rad', scale: DEG, dash: [4, 3], width: 1 },
    ]);
    this.charts[1].setLines([
      { label: 'right', colour: RIGHT, signal: 'true_foot_force_W_N', element: 2 },
      { label: 'left', colour: LEFT, signal: 'true_foot_force_W_N', element: 5 },
    ]);
    queueMicrotask(() => this.pickJoints());
  }

  get elements(): HTMLElement[] {
    return this.charts.map((chart) => chart.element);
  }

  get count(): number {
    return this.charts.length;
  }

  get updates(): number[] {
    return this.charts.map((chart) => chart.updates);
  }

  private get kind(): 'live' | 'replay' {
    return this.player.live ? 'live' : 'replay';
  }

  pickJoints(): void {
    const [, , angle, torque] = this.charts;
    const name = (i: number): string => this.model.joints[i].name.replaceAll('_', ' ');
    angle.setLines(
      this.picked().flatMap((i, k) => [
        { label: name(i), colour: PICK_COLOURS[k], signal: 'true_q_rad', element: i, scale: DEG, width: 1.6 },
        {
          label: 'ref',
          colour: PICK_COLOURS[k] + FAINT,
          signal: 'q_ref_rad',
          element: i,
          scale: DEG,
          dash: [4, 3],
          width: 1,
        },
      ]),
    );
    torque.setLines(
      this.picked().map((i, k) => ({ label: name(i), colour: PICK_COLOURS[k], signal: 'true_tau_Nm', element: i })),
    );
  }

  // One of the plots, brought up to the shown time.
  update(number: number): void {
    const { track, time, live } = this.player;
    const span = this.spanOf[this.kind];
    if (document.activeElement !== this.spans) this.spans.value = String(span);
    // a stretch of a finished run ends a little after the shown time
    const end = live ? Math.max(time, track.first + span) : Math.min(track.last, time + AHEAD * span);
    const to = span === 0 ? track.last : end;
    const from = span === 0 ? track.first : to - span;
    this.charts[number].update(track, from, Math.max(to, from + LEAST_S));
  }
}
