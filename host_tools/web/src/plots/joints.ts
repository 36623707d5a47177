// All joints at a glance, each with its place between its limits and its torque; a click picks one for the plots.
import { DEG, el, fixed, setText } from '../dom';
import type { Joint, Model } from '../protocol';
import type { Track } from '../track';

export const PICK_COLOURS = ['#5cc8ff', '#ffb454', '#b7e36a', '#ff7ac6'];
const AT_FIRST = ['r_knee', 'l_knee'];

function shortName(name: string): string {
  return name.replace('shoulder', 'sh.').replaceAll('_', ' ');
}

interface Cell {
  cell: HTMLElement;
  angle: HTMLElement;
  torque: HTMLElement;
  needle: HTMLElement;
  load: HTMLElement;
}

export class JointTable {
  readonly element: HTMLElement;
  private readonly cells: Cell[];
  picked: number[];

  constructor(
    private readonly model: Model,
    private readonly onPick: (picked: number[]) => void,
  ) {
    this.picked = AT_FIRST.map((name) => model.joints.findIndex((joint) => joint.name === name));
    this.cells = model.joints.map((joint, i) => this.cell(joint, i));
    this.element = el(
      'section',
      { class: 'panel joints' },
      el(
        'div',
        { class: 'chart-head' },
        el(
          'div',
          { class: 'panel-title' },
          'Joints',
          el('span', { class: 'unit' }, 'deg, N m — click to plot (up to 4)'),
        ),
      ),
      el('div', { class: 'joint-grid' }, ...this.cells.map((cell) => cell.cell)),
    );
    this.mark();
  }

  private cell(joint: Joint, index: number): Cell {
    const angle = el('b', {}, '–');
    const torque = el('em', {}, '–');
    const needle = el('i');
    const load = el('u');
    const [low, high] = joint.limit_rad;
    const cell = el(
      'button',
      {
        class: 'joint',
        'data-joint': joint.name,
        title: `${joint.name}: ${fixed(low * DEG, 0)} to ${fixed(high * DEG, 0)} deg, peak ${joint.torque_peak_Nm} N m`,
        onclick: () => this.toggle(index),
      },
      el('span', {}, shortName(joint.name)),
      angle,
      torque,
      el('div', { class: 'joint-bar' }, needle, load),
    );
    return { cell, angle, torque, needle, load };
  }

  private toggle(index: number): void {
    if (this.picked.includes(index)) this.picked = this.picked.filter((i) => i !== index);
    else this.picked = [...this.picked, index].slice(-PICK_COLOURS.length);
    this.mark();
    this.onPick(this.picked);
  }

  private mark(): void {
    this.cells.forEach(({ cell }, i) => {
      const at = this.picked.indexOf(i);
      cell.classList.toggle('picked', at >= 0);
      cell.style.setProperty('--pick', at >= 0 ? PICK_COLOURS[at] : 'transparent');
    });
  }

  update(track: Track, row: number): void {
    if (track.count === 0) return;
    const [q, tau] = [track.values(row, 'true_q_rad'), track.values(row, 'true_tau_Nm')];
    this.model.joints.forEach((joint, i) => {
      const [low, high] = joint.limit_rad;
      const { angle, torque, needle, load, cell } = this.cells[i];
      setText(angle, fixed(q[i] * DEG, 1));
      setText(torque, fixed(tau[i], 2));
      const place = Math.min(1, Math.max(0, (q[i] - low) / (high - low)));
      needle.style.left = `${(100 * place).toFixed(1)}%`;
      const share = Math.min(1, Math.abs(tau[i]) / joint.torque_peak_Nm);
      load.style.width = `${(100 * share).toFixed(0)}%`;
      cell.classList.toggle('hot', share > 0.85 || place < 0.01 || place > 0.99);
    });
  }
}
