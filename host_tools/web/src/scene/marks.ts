// What is drawn into the scene besides bodies: CoM, CoP, capture point, footprints, forces, the CoM's way.
import * as THREE from 'three';
import type { Footprint, Model } from '../protocol';
import { COM, COP, CP, LEFT, PUSH, RIGHT } from './colours';

const MAX_PRINTS = 400;
const TRAIL = 600;
const LIFT_M = 0.0008;
const M_PER_N = 0.0016;
export const PUSH_M_PER_N = 0.012;
const PUSH_LEAST_M = 0.13; // long enough to stand out of the trunk
const CORNER_M = 0.012;
const OUTLINE_M = 0.0022;

function solePath(path: THREE.Path, feet: Model['feet'], shrink: number): THREE.Path {
  const [x0, x1] = [-feet.ankle_to_heel_m + shrink, feet.ankle_to_toe_m - shrink];
  const y = feet.half_width_m - shrink;
  const r = CORNER_M - shrink;
  path
    .moveTo(x0 + r, -y)
    .lineTo(x1 - r, -y)
    .absarc(x1 - r, -y + r, r, -Math.PI / 2, 0, false);
  path.lineTo(x1, y - r).absarc(x1 - r, y - r, r, 0, Math.PI / 2, false);
  path.lineTo(x0 + r, y).absarc(x0 + r, y - r, r, Math.PI / 2, Math.PI, false);
  path.lineTo(x0, -y + r).absarc(x0 + r, -y + r, r, Math.PI, 1.5 * Math.PI, false);
  return path;
}

// through: seen through the feet that stand on it
function flat(colour: string, opacity = 1, through = false): THREE.MeshBasicMaterial {
  return new THREE.MeshBasicMaterial({
    color: colour,
    transparent: opacity < 1 || through,
    opacity,
    fog: false,
    depthWrite: false,
    depthTest: !through,
    polygonOffset: true,
    polygonOffsetFactor: -4,
    polygonOffsetUnits: -8,
    side: THREE.DoubleSide,
  });
}

class Prints {
  readonly group = new THREE.Group();
  private readonly outline: THREE.InstancedMesh;
  private readonly fill: THREE.InstancedMesh;
  private readonly place = new THREE.Matrix4();

  constructor(feet: Model['feet'], colour: string) {
    const shape = solePath(new THREE.Shape(), feet, 0) as THREE.Shape;
    const inner = new THREE.Shape(solePath(new THREE.Path(), feet, OUTLINE_M).getPoints(5));
    const ring = new THREE.Shape(shape.getPoints(5));
    ring.holes.push(new THREE.Path(solePath(new THREE.Path(), feet, OUTLINE_M).getPoints(5)));
    this.outline = new THREE.InstancedMesh(new THREE.ShapeGeometry(ring), flat(colour, 0.6), MAX_PRINTS);
    this.fill = new THREE.InstancedMesh(new THREE.ShapeGeometry(inner), flat(colour, 0.2), 1);
    for (const mesh of [this.outline, this.fill]) {
      mesh.frustumCulled = false;
      this.group.add(mesh);
    }
  }

  set(prints: Footprint[], height: (x: number, y: number) => number): void {
    const shown = prints.slice(-MAX_PRINTS);
    shown.forEach((print, i) => {
      this.place.makeRotationZ(print.yaw);
      this.place.setPosition(print.x, print.y, height(print.x, print.y) + LIFT_M);
      this.outline.setMatrixAt(i, this.place);
    });
    this.outline.count = shown.length;
    this.fill.count = Math.min(1, shown.length); // the last one: where the foot is, or is going to be
    this.fill.setMatrixAt(0, this.place);
    for (const mesh of [this.outline, this.fill]) mesh.instanceMatrix.needsUpdate = true;
  }
}

// An arrow along z of length 1, to be turned and stretched.
export class Arrow {
  readonly group = new THREE.Group();
  private readonly shaft: THREE.Mesh;
  private readonly tip: THREE.Mesh;
  private static readonly up = new THREE.Vector3(0, 0, 1);

  // through: seen through the robot
  constructor(colour: string, radius_m: number, through = false) {
    const material = new THREE.MeshLambertMaterial({
      color: colour,
      emissive: colour,
      emissiveIntensity: 0.45,
      depthTest: !through,
      transparent: through,
    });
    this.shaft = new THREE.Mesh(new THREE.CylinderGeometry(radius_m, radius_m, 1, 10).rotateX(Math.PI / 2), material);
    this.tip = new THREE.Mesh(
      new THREE.ConeGeometry(2.6 * radius_m, 6.5 * radius_m, 14).rotateX(Math.PI / 2),
      material,
    );
    this.group.add(this.shaft, this.tip);
    this.tipLength = 6.5 * radius_m;
    this.shaft.renderOrder = this.tip.renderOrder = through ? 9 : 0;
    this.group.visible = false;
  }

  private readonly tipLength: number;

  // From a point along a vector; hidden when the vector is short.
  set(from: THREE.Vector3, along: THREE.Vector3): void {
    const length = along.length();
    this.group.visible = length > 0.004;
    if (!this.group.visible) return;
    const shaft = Math.max(1e-4, length - this.tipLength);
    this.group.position.copy(from);
    this.group.quaternion.setFromUnitVectors(Arrow.up, along.clone().divideScalar(length));
    this.shaft.scale.set(1, 1, shaft);
    this.shaft.position.z = shaft / 2;
    this.tip.position.z = shaft + this.tipLength / 2;
  }

  hide(): void {
    this.group.visible = false;
  }
}

export interface MarkValues {
  com: ArrayLike<number>;
  cop: ArrayLike<number>;
  cp: ArrayLike<number>;
  feet: ArrayLike<number>; // sole points, right then left
  forces: ArrayLike<number>;
  push: ArrayLike<number>;
  pushPoint: THREE.Vector3;
}

export class Marks {
  readonly group = new THREE.Group();
  readonly layers: Record<'com' | 'prints' | 'forces' | 'trail', THREE.Group> = {
    com: new THREE.Group(),
    prints: new THREE.Group(),
    forces: new THREE.Group(),
    trail: new THREE.Group(),
  };
  private readonly com = new THREE.Mesh(
    new THREE.SphereGeometry(0.0085, 18, 12),
    new THREE.MeshLambertMaterial({
      color: COM,
      emissive: COM,
      emissiveIntensity: 0.35,
      depthTest: false,
    }),
  );
  private readonly plumb = new THREE.Mesh(
    new THREE.CylinderGeometry(0.001, 0.001, 1, 6).rotateX(Math.PI / 2),
    new THREE.MeshBasicMaterial({ color: COM, fog: false }),
  );
  private readonly comDot = new THREE.Mesh(new THREE.CircleGeometry(0.0052, 20), flat(COM, 1, true));
  private readonly cop = new THREE.Mesh(new THREE.CircleGeometry(0.0072, 24), flat(COP, 1, true));
  private readonly cp = new THREE.Group();
  private readonly right: Prints;
  private readonly left: Prints;
  private readonly footForce = [new Arrow(RIGHT, 0.0022), new Arrow(LEFT, 0.0022)];
  private readonly push = new Arrow(PUSH, 0.0042, true);
  private readonly trail = new THREE.Line(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ color: COM, transparent: true, opacity: 0.75, fog: false }),
  );
  private readonly a = new THREE.Vector3();
  private readonly b = new THREE.Vector3();

  constructor(model: Model) {
    this.right = new Prints(model.feet, RIGHT);
    this.left = new Prints(model.feet, LEFT);
    const ring = new THREE.Mesh(new THREE.RingGeometry(0.0086, 0.0118, 32), flat(CP, 1, true));
    const dot = new THREE.Mesh(new THREE.CircleGeometry(0.0034, 16), flat(CP, 1, true));
    this.cp.add(ring, dot);
    this.com.renderOrder = 8;
    for (const mark of [this.comDot, this.cop, ring, dot]) mark.renderOrder = 7;
    this.trail.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * TRAIL), 3));
    this.trail.frustumCulled = false;
    const { layers } = this;
    layers.com.add(this.com, this.plumb, this.comDot, this.cop, this.cp);
    layers.prints.add(this.right.group, this.left.group);
    layers.forces.add(...this.footForce.map((arrow) => arrow.group));
    layers.trail.add(this.trail);
    layers.forces.visible = false;
    this.group.add(...Object.values(layers), this.push.group);
  }

  set(values: MarkValues, height: (x: number, y: number) => number): void {
    const { com, cop, cp } = values;
    this.group.visible = true;
    const ground = (mark: THREE.Object3D, x: number, y: number, lift: number): void => {
      mark.visible = Number.isFinite(x) && Number.isFinite(y);
      if (mark.visible) mark.position.set(x, y, height(x, y) + lift);
    };
    this.com.position.set(com[0], com[1], com[2]);
    const floor = height(com[0], com[1]);
    this.plumb.position.set(com[0], com[1], (com[2] + floor) / 2);
    this.plumb.scale.z = Math.max(1e-3, com[2] - floor);
    ground(this.comDot, com[0], com[1], 2 * LIFT_M);
    ground(this.cop, cop[0], cop[1], 3 * LIFT_M);
    ground(this.cp, cp[0], cp[1], 4 * LIFT_M);
    for (const foot of [0, 1]) {
      this.a.set(values.feet[3 * foot], values.feet[3 * foot + 1], values.feet[3 * foot + 2]);
      this.b.set(values.forces[3 * foot], values.forces[3 * foot + 1], values.forces[3 * foot + 2]);
      this.footForce[foot].set(this.a, this.b.multiplyScalar(M_PER_N));
    }
    this.b.set(values.push[0], values.push[1], values.push[2]).multiplyScalar(PUSH_M_PER_N);
    if (this.b.length() > 1e-4) this.b.setLength(Math.max(PUSH_LEAST_M, this.b.length()));
    // the arrow ends where it pushes
    this.push.set(this.a.copy(values.pushPoint).sub(this.b), this.b);
  }

  setPrints(prints: Footprint[], height: (x: number, y: number) => number): void {
    this.right.set(
      prints.filter((print) => !print.left),
      height,
    );
    this.left.set(
      prints.filter((print) => print.left),
      height,
    );
  }

  // Where the CoM came from: x and y of points, oldest first.
  setTrail(points: number[], height: (x: number, y: number) => number): void {
    const attribute = this.trail.geometry.getAttribute('position') as THREE.BufferAttribute;
    const count = Math.min(TRAIL, points.length / 2);
    const skip = points.length / 2 - count;
    for (let i = 0; i < count; i++) {
      const [x, y] = [points[2 * (skip + i)], points[2 * (skip + i) + 1]];
      attribute.setXYZ(i, x, y, height(x, y) + 2 * LIFT_M);
    }
    attribute.needsUpdate = true;
    this.trail.geometry.setDrawRange(0, count);
  }
}
