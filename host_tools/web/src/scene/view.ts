// The 3D view: light, camera, and a picture whenever something has changed.
import * as THREE from 'three';
import type { Block, Model } from '../protocol';
import { Camera, VIEWS } from './camera';
import { Ground, Soil } from './ground';
import { Marks } from './marks';
import { Quality, TIERS } from './quality';
import { Robot } from './robot';

const BACKGROUND = 0x161c25;
const LAMP_FROM = new THREE.Vector3(1.1, -0.9, 2.2);

export class View3D {
  readonly scene = new THREE.Scene();
  readonly camera: Camera;
  readonly ground: Ground;
  readonly marks: Marks;
  readonly robot: Robot;
  readonly hips = new THREE.Vector3(0, 0, 0.22);
  readonly quality: Quality;
  soil: Soil | null = null;
  pictures = 0; // drawn so far
  private readonly renderer: THREE.WebGLRenderer;
  private readonly lamp = new THREE.DirectionalLight(0xfff3e2, 2.6);
  private dirty = true;
  private last_ms = 0;
  private inARow = false;

  constructor(
    private readonly holder: HTMLElement,
    model: Model,
    fine: Block,
    coarse: Block,
  ) {
    const held = Number(new URLSearchParams(location.search).get('quality') ?? NaN);
    const software = isSoftware() && !(held < 2);
    this.renderer = new THREE.WebGLRenderer({ antialias: !software, powerPreference: 'high-performance' });
    this.quality = new Quality(devicePixelRatio, software, held);
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = software ? THREE.BasicShadowMap : THREE.PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.domElement.tabIndex = 0;
    holder.prepend(this.renderer.domElement);
    this.scene.background = new THREE.Color(BACKGROUND);
    this.scene.fog = new THREE.Fog(BACKGROUND, 1.6, 4.6);
    this.camera = new Camera(this.renderer.domElement, () => this.invalidate());
    this.ground = new Ground(software ? 1 : this.renderer.capabilities.getMaxAnisotropy());
    this.robot = new Robot(model, fine, coarse);
    this.marks = new Marks(model);
    // until something is known
    this.robot.pose([0, 0, model.rest.hip_height_m], [1, 0, 0, 0], model.rest.q_rad);
    this.marks.group.visible = false;
    this.scene.add(this.ground.group, this.robot.root, this.marks.group, ...this.lights(software));
    this.applyTier();
    new ResizeObserver(() => this.resize()).observe(holder);
    this.resize();
  }

  get canvas(): HTMLCanvasElement {
    return this.renderer.domElement;
  }

  private lights(software: boolean): THREE.Object3D[] {
    const sky = new THREE.HemisphereLight(0xb9cbe4, 0x3c352c, 1.35);
    sky.position.set(0, 0, 1);
    const back = new THREE.DirectionalLight(0x9db8ff, 0.75);
    back.position.set(-1.5, 1.2, 0.8);
    const { shadow } = this.lamp;
    this.lamp.castShadow = true;
    shadow.mapSize.set(1024, 1024);
    shadow.camera.left = shadow.camera.bottom = -0.55;
    shadow.camera.right = shadow.camera.top = 0.55;
    shadow.camera.near = 0.5;
    shadow.camera.far = 5;
    shadow.bias = -0.0006;
    shadow.normalBias = 0.004;
    shadow.radius = 3;
    return [sky, this.lamp, this.lamp.target, ...(software ? [] : [back])];
  }

  invalidate(): void {
    this.dirty = true;
  }

  setSoil(soil: Soil | null): void {
    if (this.soil) {
      this.scene.remove(this.soil.group);
      this.soil.dispose();
    }
    this.soil = soil;
    soil?.setDetail(TIERS[this.quality.tier].fineSoil);
    if (soil) this.scene.add(soil.group);
    this.invalidate();
  }

  look(name: string, yaw_rad: number): void {
    if (VIEWS[name]) this.camera.set(name, this.hips, yaw_rad);
  }

  private applyTier(): void {
    const tier = TIERS[this.quality.tier];
    this.robot.setDetail(tier.fine);
    this.soil?.setDetail(tier.fineSoil);
    this.renderer.setPixelRatio(Math.min(tier.scale, Math.max(1, devicePixelRatio)));
    this.lamp.castShadow = tier.shadowEvery > 0;
    this.invalidate();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (width < 2 || height < 2) return;
    this.renderer.setSize(width, height);
    this.camera.resize(width / height);
    this.invalidate();
  }

  // Draw if something has changed; true when a picture was made.
  draw(now_ms: number, dt_s: number): boolean {
    this.camera.track(this.hips, dt_s);
    if (!this.dirty) {
      this.inARow = false;
      return false;
    }
    if (this.inARow && this.quality.note(now_ms - this.last_ms)) this.applyTier();
    this.inARow = true;
    this.last_ms = now_ms;
    this.dirty = false;
    this.lamp.position.copy(this.hips).add(LAMP_FROM);
    this.ground.follow(this.hips.x, this.hips.y);
    this.lamp.target.position.set(this.hips.x, this.hips.y, 0.1);
    const every = TIERS[this.quality.tier].shadowEvery;
    this.renderer.shadowMap.needsUpdate = every > 0 && this.pictures % every === 0;
    this.renderer.render(this.scene, this.camera.camera);
    this.pictures++;
    return true;
  }

  // The picture as it is, for tests: how many colours are in it, and every so many pixels' red.
  pixels(): { distinct: number; sample: number[] } {
    this.renderer.render(this.scene, this.camera.camera);
    const gl = this.renderer.getContext();
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const data = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
    const seen = new Set<number>();
    const sample: number[] = [];
    for (let i = 0; i < data.length; i += 4) {
      seen.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
      if (i % 244 === 0) sample.push(data[i]);
    }
    return { distinct: seen.size, sample };
  }
}

// Whether WebGL is computed by the processor: then every pixel counts.
function isSoftware(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = gl && info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}
