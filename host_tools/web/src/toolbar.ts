// Buttons over the 3D view: where to look from, what to draw.
import { el } from './dom';
import { VIEWS } from './scene/camera';
import { COM, COP, CP, LEFT, RIGHT } from './scene/colours';
import type { View3D } from './scene/view';

export function toolbar(view: View3D, yaw: () => number): HTMLElement {
  const looks = Object.keys(VIEWS).map((name) =>
    el(
      'button',
      {
        'data-view': name,
        onclick: () => {
          view.look(name, yaw());
          mark();
        },
      },
      name,
    ),
  );
  const mark = (): void =>
    looks.forEach((button) => button.classList.toggle('on', button.dataset.view === view.camera.view));
  view.camera.controls.addEventListener('start', () => setTimeout(mark));
  mark();
  const toggle = (label: string, hint: string, on: boolean, set: (on: boolean) => void): HTMLElement => {
    const button = el(
      'button',
      {
        title: hint,
        class: on ? 'on' : '',
        onclick: () => {
          const now = button.classList.toggle('on');
          set(now);
          view.invalidate();
        },
      },
      label,
    );
    return button;
  };
  const { layers } = view.marks;
  const group = (...buttons: HTMLElement[]): HTMLElement => el('div', { class: 'button-group' }, ...buttons);
  return el(
    'div',
    { class: 'view-tools' },
    group(
      ...looks,
      toggle('follow', 'the camera follows the robot', true, (on) => (view.camera.follow = on)),
    ),
    group(
      toggle('marks', 'CoM, CoP, capture point', true, (on) => (layers.com.visible = on)),
      toggle('prints', 'footprints', true, (on) => (layers.prints.visible = on)),
      toggle('way', 'the way of the CoM', true, (on) => (layers.trail.visible = on)),
      toggle('forces', 'contact forces of the feet', false, (on) => (layers.forces.visible = on)),
    ),
  );
}

export function legend(): HTMLElement {
  const key = (kind: string, colour: string, label: string): HTMLElement =>
    el('span', {}, el('i', { class: `key-${kind}`, style: `--c:${colour}` }), label);
  return el(
    'div',
    { class: 'view-legend' },
    key('dot', COM, 'CoM'),
    key('dot', COP, 'CoP'),
    key('ring', CP, 'capture point'),
    key('box', RIGHT, 'right'),
    key('box', LEFT, 'left'),
  );
}
