// Floor with its tilt and blocks, and the pool of soil.
import * as THREE from 'three';
import type { Block, SoilGrid, Terrain } from '../protocol';
import { soilColour } from './colours';

const HALF_M = 7;
const TILE_M = 0.5;
const RIM_M = 0.012;
const SHADE_M = 1.3;

function gridTexture(anisotropy: number): THREE.CanvasTexture {
  const size = 512;
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = size;
  const context = canvas.getContext('2d')!;
  context.fillStyle = '#27303a';
  context.fillRect(0, 0, size, size);
  for (let i = 0; i < 10; i++) {
    context.fillStyle = i === 0 ? '#4a5767' : '#333d49';
    const thick = i === 0 ? 4 : 2;
    const at = (i * size) / 10;
    context.fillRect(at, 0, thick, size);
    context.fillRect(0, at, size, thick);
  }
  const texture = new THREE.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.repeat.set(1 / TILE_M, 1 / TILE_M);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = anisotropy;
  return texture;
}

export class Ground {
  readonly group = new THREE.Group();
  private readonly material: THREE.MeshBasicMaterial;
  private readonly shade = new THREE.Mesh(
    new THREE.PlaneGeometry(SHADE_M, SHADE_M),
    new THREE.ShadowMaterial({ opacity: 0.45 }),
  );
  private readonly blockMaterial = new THREE.MeshLambertMaterial({ color: 0x8a7a5e });
  private terrain: Terrain | null = null;

  constructor(anisotropy: number) {
    this.material = new THREE.MeshBasicMaterial({ map: gridTexture(anisotropy) });
    this.shade.receiveShadow = true;
    this.shade.renderOrder = 3;
    this.build(null, null);
  }

  build(terrain: Terrain | null, soil: SoilGrid | null): void {
    this.terrain = terrain;
    for (const child of [...this.group.children]) {
      if (child !== this.shade) (child as THREE.Mesh).geometry.dispose();
      this.group.remove(child);
    }
    const shape = new THREE.Shape();
    shape.moveTo(-HALF_M, -HALF_M).lineTo(HALF_M, -HALF_M).lineTo(HALF_M, HALF_M).lineTo(-HALF_M, HALF_M);
    if (soil) shape.holes.push(poolOutline(soil));
    const floor = new THREE.Mesh(new THREE.ShapeGeometry(shape), this.material);
    floor.renderOrder = 2; // what hides it comes first
    if (soil) {
      floor.position.set(...soil.origin_W_m);
      floor.quaternion.setFromRotationMatrix(axesMatrix(soil));
    } else if (terrain) {
      floor.position.set(terrain.start_W_m[0], terrain.start_W_m[1], 0);
      floor.rotation.set(terrain.tilt_rad[0], terrain.tilt_rad[1], 0, 'XYZ');
    }
    this.group.add(floor);
    if (!soil) {
      this.shade.quaternion.copy(floor.quaternion);
      this.group.add(this.shade);
    }
    for (const block of terrain?.blocks ?? []) {
      const mesh = new THREE.Mesh(new THREE.BoxGeometry(...block.size), this.blockMaterial);
      mesh.position.set(...block.centre);
      mesh.rotation.z = block.yaw;
      mesh.receiveShadow = mesh.castShadow = true;
      this.group.add(mesh);
    }
  }

  // Where the shadow can fall: the floor itself is too large to look for it everywhere.
  follow(x: number, y: number): void {
    this.shade.position.set(x, y, this.height(x, y) + 0.0003);
  }

  // Of the tilted floor (Rx Ry through the start point).
  height(x: number, y: number): number {
    if (!this.terrain) return 0;
    const [about_x, about_y] = this.terrain.tilt_rad;
    const [x0, y0] = this.terrain.start_W_m;
    return (Math.sin(about_x) * (y - y0) - Math.tan(about_y) * (x - x0)) / Math.cos(about_x);
  }
}

function axesMatrix(soil: SoilGrid): THREE.Matrix4 {
  const a = soil.axes_W;
  return new THREE.Matrix4().set(a[0], a[1], a[2], 0, a[3], a[4], a[5], 0, a[6], a[7], a[8], 0, 0, 0, 0, 1);
}

function poolOutline(soil: SoilGrid): THREE.Path {
  const [x0, y0] = [soil.low_x_m, soil.low_y_m];
  const [x1, y1] = [x0 + soil.nx * soil.cell_m, y0 + soil.ny * soil.cell_m];
  return new THREE.Path().moveTo(x0, y0).lineTo(x0, y1).lineTo(x1, y1).lineTo(x1, y0) as THREE.Path;
}

// The surface of the pool; a vertex a cell.
export class Soil {
  readonly group = new THREE.Group();
  readonly grid: SoilGrid;
  private readonly base: Float32Array;
  private readonly height: Float32Array;
  private readonly positions: THREE.BufferAttribute;
  private readonly normals: THREE.BufferAttribute;
  private readonly colours: THREE.BufferAttribute;
  private readonly geometry = new THREE.BufferGeometry();
  private corners: THREE.BufferAttribute[] = [];

  constructor(block: Block) {
    this.grid = block.header.grid as SoilGrid;
    this.base = (block.arrays.base as Float32Array).slice();
    this.height = this.base.slice();
    const count = this.base.length;
    this.positions = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
    this.normals = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
    this.colours = new THREE.BufferAttribute(new Uint8Array(3 * count), 3, true);
    this.makeGeometry();
    const material = new THREE.MeshLambertMaterial({ vertexColors: true });
    // the colours are those of a screen, not linear light
    material.onBeforeCompile = (shader) => {
      shader.fragmentShader = shader.fragmentShader.replace(
        '#include <color_fragment>',
        'diffuseColor.rgb *= pow(vColor.rgb, vec3(2.2));',
      );
    };
    const surface = new THREE.Mesh(this.geometry, material);
    surface.receiveShadow = true;
    surface.frustumCulled = false;
    surface.renderOrder = 1;
    this.group.add(surface, ...this.rim());
    this.group.position.set(...this.grid.origin_W_m);
    this.group.quaternion.setFromRotationMatrix(axesMatrix(this.grid));
    this.refresh();
  }

  private makeGeometry(): void {
    const { nx, ny, cell_m, low_x_m, low_y_m } = this.grid;
    for (let row = 0; row < ny; row++) {
      for (let column = 0; column < nx; column++) {
        const k = row * nx + column;
        // the outermost cells reach to the wall
        const x = column === 0 ? 0 : column === nx - 1 ? nx : column + 0.5;
        const y = row === 0 ? 0 : row === ny - 1 ? ny : row + 0.5;
        this.positions.setXYZ(k, low_x_m + x * cell_m, low_y_m + y * cell_m, this.base[k]);
      }
    }
    this.corners = [this.triangles(1), this.triangles(2)];
    this.geometry.setAttribute('position', this.positions);
    this.geometry.setAttribute('normal', this.normals);
    this.geometry.setAttribute('color', this.colours);
    this.setDetail(true);
  }

  // Two triangles a square of `stride` cells; the last row and column always take part.
  private triangles(stride: number): THREE.BufferAttribute {
    const { nx, ny } = this.grid;
    const lines = (count: number): number[] => {
      const found: number[] = [];
      for (let i = 0; i < count - 1; i += stride) found.push(i);
      return [...found, count - 1];
    };
    const [columns, rows] = [lines(nx), lines(ny)];
    const corners: number[] = [];
    for (let r = 0; r + 1 < rows.length; r++) {
      for (let c = 0; c + 1 < columns.length; c++) {
        const [a, b] = [rows[r] * nx + columns[c], rows[r] * nx + columns[c + 1]];
        const [d, e] = [rows[r + 1] * nx + columns[c], rows[r + 1] * nx + columns[c + 1]];
        corners.push(a, b, e, a, e, d);
      }
    }
    return new THREE.BufferAttribute(new Uint32Array(corners), 1);
  }

  setDetail(fine: boolean): void {
    this.geometry.setIndex(this.corners[fine ? 0 : 1]);
  }

  private rim(): THREE.Mesh[] {
    const { nx, ny, cell_m, low_x_m, low_y_m } = this.grid;
    const [length, width] = [nx * cell_m, ny * cell_m];
    const material = new THREE.MeshLambertMaterial({ color: 0x20262e });
    const bar = (x: number, y: number, along: number, across: number): THREE.Mesh => {
      const mesh = new THREE.Mesh(new THREE.BoxGeometry(along, across, 0.006), material);
      mesh.position.set(low_x_m + x, low_y_m + y, 0);
      return mesh;
    };
    return [
      bar(length / 2, -RIM_M / 2, length + 2 * RIM_M, RIM_M),
      bar(length / 2, width + RIM_M / 2, length + 2 * RIM_M, RIM_M),
      bar(-RIM_M / 2, width / 2, RIM_M, width),
      bar(length + RIM_M / 2, width / 2, RIM_M, width),
    ];
  }

  reset(): void {
    this.height.set(this.base);
  }

  change(cells: Uint32Array, heights: Float32Array, from: number, to: number): void {
    for (let i = from; i < to; i++) this.height[cells[i]] = heights[i];
  }

  // Bring the mesh up to date with the heights.
  refresh(): void {
    const { nx, ny, cell_m, full_scale_m } = this.grid;
    const { height, base } = this;
    const z = this.positions.array as Float32Array;
    const n = this.normals.array as Float32Array;
    const c = this.colours.array as Uint8Array;
    const rgb: [number, number, number] = [0, 0, 0];
    for (let row = 0, k = 0; row < ny; row++) {
      for (let column = 0; column < nx; column++, k++) {
        z[3 * k + 2] = height[k];
        const left = height[column > 0 ? k - 1 : k];
        const right = height[column + 1 < nx ? k + 1 : k];
        const below = height[row > 0 ? k - nx : k];
        const above = height[row + 1 < ny ? k + nx : k];
        const [sx, sy] = [(left - right) / (2 * cell_m), (below - above) / (2 * cell_m)];
        const size = Math.hypot(sx, sy, 1);
        n[3 * k] = sx / size;
        n[3 * k + 1] = sy / size;
        n[3 * k + 2] = 1 / size;
        soilColour(height[k] - base[k], full_scale_m, rgb);
        c.set(rgb, 3 * k);
      }
    }
    this.positions.needsUpdate = this.normals.needsUpdate = this.colours.needsUpdate = true;
  }

  dispose(): void {
    this.geometry.dispose();
  }
}

// The soil of a finished run at any of its times.
export class SoilTimeline {
  private readonly t: Float64Array;
  private readonly ends: number[] = []; // of the changes up to and with each moment
  private readonly cells: Uint32Array;
  private readonly heights: Float32Array;
  private done = 0; // moments applied

  constructor(
    readonly soil: Soil,
    block: Block,
  ) {
    this.t = block.arrays.t_s as Float64Array;
    this.cells = block.arrays.cells as Uint32Array;
    this.heights = block.arrays.heights as Float32Array;
    let sum = 0;
    for (const count of block.arrays.count as Uint32Array) this.ends.push((sum += count));
  }

  show(t: number): boolean {
    let wanted = 0;
    while (wanted < this.t.length && this.t[wanted] <= t + 1e-9) wanted++;
    if (wanted === this.done) return false;
    if (wanted < this.done) {
      this.soil.reset();
      this.done = 0;
    }
    const from = this.done ? this.ends[this.done - 1] : 0;
    this.soil.change(this.cells, this.heights, from, wanted ? this.ends[wanted - 1] : 0);
    this.done = wanted;
    this.soil.refresh();
    return true;
  }
}
