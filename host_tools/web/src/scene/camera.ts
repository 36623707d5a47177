// The camera: fixed views that follow the robot, or wherever the mouse turns it.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

const FOV_DEG = 28.6;
const FOLLOW_1_S = 2.5;
const OVER_HIPS_M = 0.02;

interface View {
  azimuth: number; // deg; 0 from the front, -90 from the right
  elevation: number;
  distance_m: number;
  low?: boolean; // looks at the feet
}

export const VIEWS: Record<string, View> = {
  quarter: { azimuth: -48, elevation: 14, distance_m: 1.35 },
  side: { azimuth: -90, elevation: 6, distance_m: 1.35 },
  front: { azimuth: 0, elevation: 7, distance_m: 1.35 },
  back: { azimuth: 155, elevation: 15, distance_m: 1.4 },
  top: { azimuth: -90, elevation: 85, distance_m: 1.5 },
  feet: { azimuth: -56, elevation: 24, distance_m: 0.72, low: true },
};

export class Camera {
  readonly camera = new THREE.PerspectiveCamera(FOV_DEG, 1, 0.05, 40);
  readonly controls: OrbitControls;
  follow = true;
  view = 'quarter';
  private readonly shown = new THREE.Vector3();
  private readonly step = new THREE.Vector3();
  private low = false;

  constructor(
    canvas: HTMLElement,
    private readonly changed: () => void,
  ) {
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.minDistance = 0.25;
    this.controls.maxDistance = 6;
    this.controls.maxPolarAngle = 0.52 * Math.PI;
    this.controls.addEventListener('change', changed);
    this.controls.addEventListener('start', () => (this.view = ''));
    this.set('quarter', new THREE.Vector3(0, 0, 0.24), 0);
  }

  set(name: string, hips: THREE.Vector3, yaw_rad: number): void {
    const view = VIEWS[name];
    const azimuth = (view.azimuth * Math.PI) / 180 + yaw_rad;
    const elevation = (view.elevation * Math.PI) / 180;
    this.low = view.low === true;
    this.view = name;
    this.aim(hips, this.shown);
    this.controls.target.copy(this.shown);
    this.camera.position.set(
      this.shown.x + view.distance_m * Math.cos(elevation) * Math.cos(azimuth),
      this.shown.y + view.distance_m * Math.cos(elevation) * Math.sin(azimuth),
      this.shown.z + view.distance_m * Math.sin(elevation),
    );
    this.controls.update();
    this.changed();
  }

  private aim(hips: THREE.Vector3, out: THREE.Vector3): void {
    out.set(hips.x, hips.y, this.low ? 0.03 : hips.z + OVER_HIPS_M);
  }

  // Go after the robot; jump when it is somewhere else altogether.
  track(hips: THREE.Vector3, dt_s: number): void {
    if (!this.follow) return;
    this.aim(hips, this.step);
    this.step.sub(this.shown);
    const far = this.step.length();
    if (far < 1e-5) return;
    if (far < 0.5) this.step.multiplyScalar(Math.min(1, dt_s * FOLLOW_1_S));
    this.shown.add(this.step);
    this.camera.position.add(this.step);
    this.controls.target.add(this.step);
    this.controls.update();
  }

  resize(aspect: number): void {
    // a narrow picture keeps its width
    this.camera.fov = aspect < 1.1 ? Math.min(60, (FOV_DEG * 1.1) / Math.max(0.3, aspect)) : FOV_DEG;
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }
}
