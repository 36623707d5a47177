// The robot: the surface of the pictures on the tree of hoap2.json, moved by the base and the joint angles.
import * as THREE from 'three';
import type { Block, Model } from '../protocol';

const SHININESS = 42;

// Phong whose highlight is scaled by the gloss of each vertex.
function lacquer(): THREE.MeshPhongMaterial {
  const material = new THREE.MeshPhongMaterial({ vertexColors: true, shininess: SHININESS, specular: 0x9aa4b4 });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader.replace(
      'void main() {',
      'attribute float gloss;\nvarying float vGloss;\nvoid main() {\n  vGloss = gloss;',
    );
    shader.fragmentShader = shader.fragmentShader
      .replace('void main() {', 'varying float vGloss;\nvoid main() {')
      .replace('#include <specularmap_fragment>', '#include <specularmap_fragment>\n  specularStrength = vGloss;');
  };
  return material;
}

// The part of a mesh that belongs to one link.
function geometryOf(block: Block, link: number): THREE.BufferGeometry | null {
  const vertex = block.arrays.vertex as Float32Array;
  const index = block.arrays.index as Uint32Array;
  const stride = block.header.stride as number;
  const place = new Map<number, number>();
  const corners: number[] = [];
  for (let i = 0; i < index.length; i += 3) {
    if (vertex[index[i] * stride + stride - 1] !== link) continue;
    for (let k = 0; k < 3; k++) {
      const v = index[i + k];
      if (!place.has(v)) place.set(v, place.size);
      corners.push(place.get(v)!);
    }
  }
  if (corners.length === 0) return null;
  const pick = (from: number, size: number): THREE.BufferAttribute => {
    const data = new Float32Array(place.size * size);
    for (const [v, at] of place) data.set(vertex.subarray(v * stride + from, v * stride + from + size), at * size);
    return new THREE.BufferAttribute(data, size);
  };
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', pick(0, 3));
  geometry.setAttribute('normal', pick(3, 3));
  geometry.setAttribute('color', pick(6, 3));
  geometry.setAttribute('gloss', pick(9, 1));
  geometry.setIndex(corners);
  return geometry;
}

export class Robot {
  readonly root = new THREE.Group();
  readonly chest: THREE.Object3D;
  readonly grip: THREE.Mesh; // what the mouse takes hold of: the chest's bounding box, not drawn
  private readonly links: THREE.Group[];
  private readonly axes: THREE.Vector3[];
  private readonly fine: THREE.Mesh[] = [];
  private readonly coarse: THREE.Mesh[] = [];

  constructor(
    private readonly model: Model,
    fine: Block,
    coarse: Block,
  ) {
    this.links = model.links.map(() => new THREE.Group());
    this.axes = model.joints.map((joint) => new THREE.Vector3(...joint.axis));
    for (const joint of model.joints) {
      this.links[joint.child].position.set(...joint.origin_parent_m);
      this.links[joint.parent].add(this.links[joint.child]);
    }
    this.root.add(this.links[model.base_link]);
    const material = lacquer();
    this.links.forEach((group, link) => {
      this.attach(group, geometryOf(fine, link), material, this.fine);
      this.attach(group, geometryOf(coarse, link), material, this.coarse);
    });
    this.chest = this.links[model.chest];
    this.grip = this.makeGrip();
    this.setDetail(true);
  }

  private attach(
    group: THREE.Group,
    geometry: THREE.BufferGeometry | null,
    material: THREE.Material,
    into: THREE.Mesh[],
  ): void {
    if (!geometry) return;
    const mesh = new THREE.Mesh(geometry, material);
    mesh.castShadow = mesh.receiveShadow = true;
    group.add(mesh);
    into.push(mesh);
  }

  private makeGrip(): THREE.Mesh {
    const [low, high] = this.model.links[this.model.chest].box.map((corner) => new THREE.Vector3(...corner));
    const box = new THREE.BoxGeometry(high.x - low.x, high.y - low.y, high.z - low.z);
    box.translate((low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2);
    const grip = new THREE.Mesh(box, new THREE.MeshBasicMaterial());
    grip.material.visible = false;
    this.chest.add(grip);
    return grip;
  }

  // The fine surface needs four times the triangles.
  setDetail(fine: boolean): void {
    for (const mesh of this.fine) mesh.visible = fine;
    for (const mesh of this.coarse) mesh.visible = !fine;
  }

  pose(pos_W_m: ArrayLike<number>, quat_W: ArrayLike<number>, q_rad: ArrayLike<number>): void {
    this.root.position.set(pos_W_m[0], pos_W_m[1], pos_W_m[2]);
    this.root.quaternion.set(quat_W[1], quat_W[2], quat_W[3], quat_W[0]).normalize();
    this.model.joints.forEach((joint, i) => {
      this.links[joint.child].quaternion.setFromAxisAngle(this.axes[i], q_rad[i]);
    });
    this.root.updateMatrixWorld(true);
  }

  // A point of a link in the world.
  point(link: number, point_L_m: [number, number, number], out: THREE.Vector3): THREE.Vector3 {
    return out.set(...point_L_m).applyMatrix4(this.links[link].matrixWorld);
  }
}
