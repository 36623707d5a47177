// A push by the mouse: take hold of the trunk, draw, let go. The force lies along the ground.
import * as THREE from 'three';
import { PUSH } from './colours';
import { Arrow, PUSH_M_PER_N } from './marks';

const N_PER_PX = 0.12;
const LEAST_PX = 8;

export interface DragTarget {
  canvas: HTMLElement;
  camera: THREE.PerspectiveCamera;
  grip: () => THREE.Mesh | null;
  allowed: () => boolean;
  limit_N: () => number;
  hold: (held: boolean) => void; // the camera stands still meanwhile
  redraw: () => void;
  push: (force_W_N: [number, number]) => void;
}

export class Drag {
  readonly arrow = new Arrow(PUSH, 0.0042, true);
  private from: { x: number; y: number; pointer: number } | null = null;
  private readonly force = new THREE.Vector3();
  private readonly caster = new THREE.Raycaster();
  private readonly label = document.createElement('div');

  constructor(private readonly target: DragTarget) {
    this.label.className = 'drag-label';
    target.canvas.parentElement!.append(this.label);
    const { canvas } = target;
    // before the camera's own listener
    canvas.addEventListener('pointerdown', (event) => this.down(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => this.move(event), { capture: true });
    canvas.addEventListener('pointerup', (event) => this.up(event), { capture: true });
    canvas.addEventListener('pointercancel', () => this.end(), { capture: true });
    window.addEventListener('keydown', (event) => event.key === 'Escape' && this.end());
  }

  private over(event: PointerEvent): boolean {
    const grip = this.target.grip();
    if (!grip || !this.target.allowed()) return false;
    const box = this.target.canvas.getBoundingClientRect();
    const place = new THREE.Vector2(
      ((event.clientX - box.left) / box.width) * 2 - 1,
      1 - ((event.clientY - box.top) / box.height) * 2,
    );
    this.caster.setFromCamera(place, this.target.camera);
    return this.caster.intersectObject(grip, false).length > 0;
  }

  private down(event: PointerEvent): void {
    if (event.button !== 0 || !this.over(event)) return;
    event.stopImmediatePropagation();
    this.from = { x: event.clientX, y: event.clientY, pointer: event.pointerId };
    this.target.canvas.setPointerCapture(event.pointerId);
    this.target.hold(true);
    this.show(event);
  }

  private move(event: PointerEvent): void {
    if (!this.from) {
      this.target.canvas.style.cursor = event.buttons === 0 && this.over(event) ? 'grab' : '';
      return;
    }
    event.stopImmediatePropagation();
    this.show(event);
  }

  private up(event: PointerEvent): void {
    if (!this.from) return;
    event.stopImmediatePropagation();
    const far = Math.hypot(event.clientX - this.from.x, event.clientY - this.from.y);
    if (far >= LEAST_PX) this.target.push([this.force.x, this.force.y]);
    this.end();
  }

  private end(): void {
    if (!this.from) return;
    if (this.target.canvas.hasPointerCapture(this.from.pointer)) {
      this.target.canvas.releasePointerCapture(this.from.pointer);
    }
    this.from = null;
    this.arrow.hide();
    this.label.style.display = 'none';
    this.target.canvas.style.cursor = '';
    this.target.hold(false);
    this.target.redraw();
  }

  // Right on the screen is right along the ground, up is away from the eye.
  private show(event: PointerEvent): void {
    const [dx, dy] = [event.clientX - this.from!.x, event.clientY - this.from!.y];
    const away = this.target.camera.getWorldDirection(new THREE.Vector3()).setZ(0).normalize();
    this.force.set(away.y * dx - away.x * dy, -away.x * dx - away.y * dy, 0).multiplyScalar(N_PER_PX);
    this.force.clampLength(0, this.target.limit_N());
    const at = this.target
      .grip()!
      .getWorldPosition(new THREE.Vector3())
      .add(new THREE.Vector3(0, 0, 0.07));
    this.arrow.set(at, this.force.clone().multiplyScalar(PUSH_M_PER_N));
    const box = this.target.canvas.getBoundingClientRect();
    this.label.textContent = `${this.force.length().toFixed(1)} N · Esc cancels`;
    this.label.style.display = 'block';
    this.label.style.left = `${event.clientX - box.left + 16}px`;
    this.label.style.top = `${event.clientY - box.top + 12}px`;
    this.target.canvas.style.cursor = 'grabbing';
    this.target.redraw();
  }
}
