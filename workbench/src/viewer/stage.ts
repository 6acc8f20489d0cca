// The picture: cameras, light, section plane, drawing when something has changed. z is up.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Content, Pick } from "./content";

export type Axis = "x" | "y" | "z";
export interface Section {
  axis: Axis;
  place: number; // from 0 to 1 over the scene's extent along the axis
  upper: boolean; // what lies above the plane is shown, else what lies below
}

export const directions: Record<string, [number, number, number]> = {
  oblique: [-0.5736 * 0.866, -0.8192 * 0.866, 0.5],
  front: [0, -1, 0],
  side: [1, 0, 0],
  top: [0, -1e-4, 1],
};

const shadowTriangles = 3e6; // beyond, shadows cost too much
const fov = 30;

export class Stage {
  private readonly scene = new THREE.Scene();
  private readonly perspective = new THREE.PerspectiveCamera(fov, 1, 0.01, 100);
  private readonly orthographic = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.01, 100);
  camera: THREE.PerspectiveCamera | THREE.OrthographicCamera = this.perspective;
  readonly controls: OrbitControls;
  section: Section | null = null;
  private readonly plane = new THREE.Plane();
  private readonly sun = new THREE.DirectionalLight("#fffaf0", 2.3);
  private readonly points: THREE.Vector3[];
  private waiting = false;
  onDraw: () => void = () => undefined;

  constructor(
    private readonly view: HTMLElement,
    readonly renderer: THREE.WebGLRenderer,
    readonly content: Content,
  ) {
    for (const camera of [this.perspective, this.orthographic]) camera.up.set(0, 0, 1);
    this.scene.add(content.object, new THREE.HemisphereLight("#ffffff", "#a79f8f", 1.7));
    this.points = content.framePoints();
    this.light();
    this.controls = new OrbitControls(this.camera, renderer.domElement);
    this.controls.addEventListener("change", () => this.changed());
    new ResizeObserver(() => this.resize()).observe(view);
    this.resize();
    this.look(new THREE.Vector3(...(directions.oblique ?? [0, -1, 1])));
  }

  private radius(): number {
    return Math.max(1e-6, this.content.box.getSize(new THREE.Vector3()).length() / 2);
  }

  private light(): void {
    const radius = this.radius();
    const centre = this.content.box.getCenter(new THREE.Vector3());
    this.sun.position.copy(centre).addScaledVector(new THREE.Vector3(-0.75, -0.35, 1.1).normalize(), 3 * radius);
    this.sun.target.position.copy(centre);
    this.scene.add(this.sun, this.sun.target);
    this.renderer.shadowMap.enabled = this.content.counts.triangles <= shadowTriangles;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.shadowMap.needsUpdate = true;
    this.sun.castShadow = this.renderer.shadowMap.enabled;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.normalBias = 0.003 * radius;
    this.sun.shadow.bias = -0.0005;
    Object.assign(this.sun.shadow.camera, { left: -radius, right: radius, top: radius, bottom: -radius, near: radius, far: 5 * radius });
  }

  // Fits the picture to the scene, seen from this direction.
  look(direction: THREE.Vector3): void {
    const back = direction.clone().normalize();
    const right = new THREE.Vector3().crossVectors(this.camera.up, back).normalize();
    const over = new THREE.Vector3().crossVectors(back, right);
    const centre = new THREE.Vector3();
    for (const axis of [right, over, back]) {
      let [low, high] = [Infinity, -Infinity];
      for (const p of this.points) [low, high] = [Math.min(low, p.dot(axis)), Math.max(high, p.dot(axis))];
      centre.addScaledVector(axis, (low + high) / 2);
    }
    const tanY = Math.tan(THREE.MathUtils.degToRad(fov / 2));
    const aspect = this.perspective.aspect;
    const flat = this.camera === this.orthographic;
    let distance = 0;
    for (const p of this.points) {
      const q = p.clone().sub(centre);
      const across = Math.max(Math.abs(q.dot(right)) / (tanY * aspect), Math.abs(q.dot(over)) / tanY);
      distance = Math.max(distance, across + (flat ? 0 : q.dot(back)));
    }
    distance = Math.max(1.06 * distance, 1e-6);
    this.camera.position.copy(centre).addScaledVector(back, distance);
    this.controls.target.copy(centre);
    if (flat) this.orthographic.zoom = 1;
    this.reach(distance);
    this.controls.update();
    this.changed();
  }

  // Depths that are drawn; an orthographic camera's width follows its distance.
  private reach(distance: number): void {
    const far = distance + 4 * this.radius();
    Object.assign(this.perspective, { near: distance / 200, far: 4 * far });
    const half = distance * Math.tan(THREE.MathUtils.degToRad(fov / 2));
    Object.assign(this.orthographic, { left: -half * this.perspective.aspect, right: half * this.perspective.aspect, top: half, bottom: -half, near: -far, far: 2 * far });
    this.perspective.updateProjectionMatrix();
    this.orthographic.updateProjectionMatrix();
  }

  isOrthographic(): boolean {
    return this.camera === this.orthographic;
  }

  project(flat: boolean): void {
    if (flat === this.isOrthographic()) return;
    const from = this.camera;
    const offset = from.position.clone().sub(this.controls.target);
    // What is seen keeps its size in the plane of the target.
    if (!flat) offset.divideScalar(this.orthographic.zoom);
    this.camera = flat ? this.orthographic : this.perspective;
    this.camera.position.copy(this.controls.target).add(offset);
    this.orthographic.zoom = 1;
    this.reach(offset.length());
    this.controls.object = this.camera;
    this.controls.update();
    this.changed();
  }

  cut(section: Section | null): void {
    this.section = section;
    if (section) {
      const { min, max } = this.content.box;
      const at = min[section.axis] + section.place * (max[section.axis] - min[section.axis]);
      const normal = new THREE.Vector3();
      normal[section.axis] = section.upper ? 1 : -1;
      this.plane.setFromNormalAndCoplanarPoint(normal, new THREE.Vector3(at, at, at));
    }
    this.renderer.clippingPlanes = section ? [this.plane] : [];
    this.changed();
  }

  pick(x: number, y: number): Pick | null {
    const { clientWidth: width, clientHeight: height } = this.view;
    const caster = new THREE.Raycaster();
    this.camera.updateMatrixWorld();
    caster.setFromCamera(new THREE.Vector2((2 * x) / width - 1, 1 - (2 * y) / height), this.camera);
    return this.content.pick(caster, this.section ? this.plane : null);
  }

  // Where a point of the scene is on the picture, in pixels from its upper left corner.
  screenOf(point: readonly [number, number, number]): [number, number] {
    this.camera.updateMatrixWorld();
    const p = new THREE.Vector3(...point).project(this.camera);
    return [((p.x + 1) / 2) * this.view.clientWidth, ((1 - p.y) / 2) * this.view.clientHeight];
  }

  metresPerPixel(): number {
    if (this.isOrthographic()) return (this.orthographic.top - this.orthographic.bottom) / this.orthographic.zoom / this.view.clientHeight;
    const distance = this.camera.position.distanceTo(this.controls.target);
    return (2 * distance * Math.tan(THREE.MathUtils.degToRad(fov / 2))) / this.view.clientHeight;
  }

  private resize(): void {
    const width = Math.max(1, this.view.clientWidth);
    const height = Math.max(1, this.view.clientHeight);
    this.renderer.setSize(width, height);
    this.perspective.aspect = width / height;
    this.reach(Math.max(1e-6, this.camera.position.distanceTo(this.controls?.target ?? new THREE.Vector3())));
    this.draw();
  }

  changed(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => this.draw());
  }

  draw(): void {
    this.waiting = false;
    this.renderer.render(this.scene, this.camera);
    this.onDraw();
  }
}
