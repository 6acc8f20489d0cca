// A 3-D picture that one can turn. z is up on the page; `up` says which way that is in the data.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { h } from "../dom";
import { colourMesh, curveObject, dotObject, ground, meshObject, partOf, textSprite } from "./scene3d_content";
import type { CurveSpec, MeshSpec, Part, Point3 } from "./scene3d_content";

export interface SceneSpec {
  mesh?: MeshSpec;
  curves?: CurveSpec[];
  dots?: { points: Point3[]; colour: string; size: number }[];
  labels?: { text: string; at: Point3 }[];
  colourings?: string[]; // names of the colourings of the mesh's parts
  up?: Point3;
  viewFrom?: Point3; // direction from the scene to the viewer, in the data's frame
  height?: number;
}

const noWebgl = "This browser cannot draw 3-D pictures (WebGL is missing or switched off).";

// Enough points of the scene to fit a view to it.
function samplePoints(spec: SceneSpec): THREE.Vector3[] {
  const flat = spec.mesh?.positions ?? [];
  const step = 3 * Math.max(1, Math.floor(flat.length / 9000));
  const out = (spec.curves ?? []).flatMap((c) => c.points.map((p) => new THREE.Vector3(...p)));
  for (let i = 0; i + 2 < flat.length; i += step) out.push(new THREE.Vector3(flat[i] ?? 0, flat[i + 1] ?? 0, flat[i + 2] ?? 0));
  return out;
}

class Scene3d {
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(30, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private readonly content = new THREE.Group();
  private readonly box = new THREE.Box3();
  private readonly mesh: THREE.Mesh | null;
  private readonly start: THREE.Vector3;
  private colouring = 0;
  private lit: Part | null = null;
  private readonly frame: THREE.Vector3[]; // what a view must hold

  constructor(
    private readonly view: HTMLElement,
    private readonly tip: HTMLElement,
    private readonly renderer: THREE.WebGLRenderer,
    spec: SceneSpec,
  ) {
    this.camera.up.set(0, 0, 1);
    const up = new THREE.Vector3(...(spec.up ?? [0, 0, 1])).normalize();
    this.content.quaternion.setFromUnitVectors(up, new THREE.Vector3(0, 0, 1));
    this.start = new THREE.Vector3(...(spec.viewFrom ?? [0.55, -1, 0.5])).applyQuaternion(this.content.quaternion).normalize();
    this.mesh = spec.mesh ? meshObject(spec.mesh) : null;
    if (this.mesh) {
      colourMesh(this.mesh, 0);
      this.content.add(this.mesh);
    }
    for (const c of spec.curves ?? []) {
      const object = curveObject(c);
      if (object) this.content.add(object);
    }
    for (const d of spec.dots ?? []) if (d.points.length > 0) this.content.add(dotObject(d.points, d.colour, d.size));
    this.scene.add(this.content);
    this.content.updateMatrixWorld(true);
    this.box.setFromObject(this.content); // before the labels, whose size is one on the screen
    for (const l of spec.labels ?? []) {
      const sprite = textSprite(l.text);
      sprite.position.set(...l.at);
      this.content.add(sprite);
    }
    const floor = ground(this.box);
    this.scene.add(floor.object);
    const points = [...samplePoints(spec)].map((p) => p.applyQuaternion(this.content.quaternion));
    this.frame = [...points, ...floor.corners];
    this.lights();
    this.controls = new OrbitControls(this.camera, renderer.domElement);
    this.controls.enableZoom = true;
    this.controls.addEventListener("change", () => this.render());
    renderer.domElement.addEventListener("pointermove", (e) => this.point(e));
    renderer.domElement.addEventListener("pointerleave", () => this.light(null));
    new ResizeObserver(() => this.resize()).observe(view);
    this.resize();
    this.look(this.start);
  }

  private lights(): void {
    const radius = this.radius();
    const sun = new THREE.DirectionalLight("#fffaf0", 2.2);
    const centre = this.box.getCenter(new THREE.Vector3());
    sun.position.copy(centre).addScaledVector(new THREE.Vector3(0.45, -0.55, 1.3).normalize(), 4 * radius);
    sun.target.position.copy(centre);
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    sun.shadow.normalBias = 0.004 * radius;
    sun.shadow.bias = -0.0006;
    Object.assign(sun.shadow.camera, { left: -1.6 * radius, right: 1.6 * radius, top: 1.6 * radius, bottom: -1.6 * radius, near: 0.5 * radius, far: 9 * radius });
    this.scene.add(sun, sun.target, new THREE.HemisphereLight("#ffffff", "#b9b2a4", 1.9));
  }

  private radius(): number {
    return Math.max(1e-6, this.box.getSize(new THREE.Vector3()).length() / 2);
  }

  reset(): void {
    this.look(this.start);
  }

  look(direction: THREE.Vector3): void {
    const back = direction.clone().normalize();
    const right = new THREE.Vector3().crossVectors(this.camera.up, back).normalize();
    const over = new THREE.Vector3().crossVectors(back, right);
    const middle = (axis: THREE.Vector3): number => {
      const along = this.frame.map((p) => p.dot(axis));
      return (Math.min(...along) + Math.max(...along)) / 2;
    };
    const centre = new THREE.Vector3();
    for (const axis of [right, over, back]) centre.addScaledVector(axis, middle(axis));
    const tanY = Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2));
    const need = this.frame.map((p) => {
      const q = p.clone().sub(centre);
      return q.dot(back) + Math.max(Math.abs(q.dot(right)) / (tanY * this.camera.aspect), Math.abs(q.dot(over)) / tanY);
    });
    const distance = 1.06 * Math.max(...need);
    this.camera.position.copy(centre).addScaledVector(direction.clone().normalize(), distance);
    this.camera.near = distance / 100;
    this.camera.far = distance * 10;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(centre);
    this.controls.update();
    this.render();
  }

  colourBy(i: number): void {
    this.colouring = i;
    if (this.mesh) colourMesh(this.mesh, i, this.lit);
    this.render();
  }

  private resize(): void {
    const width = Math.max(1, this.view.clientWidth);
    const height = Math.max(1, this.view.clientHeight);
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.render();
  }

  private point(event: PointerEvent): void {
    const frame = this.renderer.domElement.getBoundingClientRect();
    const x = event.clientX - frame.left;
    const y = event.clientY - frame.top;
    const caster = new THREE.Raycaster();
    caster.params.Line2 = { threshold: 6 };
    caster.setFromCamera(new THREE.Vector2((2 * x) / frame.width - 1, 1 - (2 * y) / frame.height), this.camera);
    const hit = caster.intersectObjects(this.content.children.filter((o) => !(o instanceof THREE.Points || o instanceof THREE.Sprite)), false)[0];
    const part = hit && typeof hit.faceIndex === "number" ? partOf(hit.object, hit.faceIndex) : null;
    const label = part?.label ?? (hit?.object.userData as { label?: string } | undefined)?.label ?? null;
    this.light(part);
    this.tip.hidden = label === null;
    this.tip.textContent = label;
    this.tip.style.left = `${Math.min(x + 12, frame.width - this.tip.offsetWidth - 4)}px`;
    this.tip.style.top = `${y + 14}px`;
  }

  private light(part: Part | null): void {
    if (part === null) this.tip.hidden = true;
    if (part === this.lit) return;
    this.lit = part;
    if (this.mesh) colourMesh(this.mesh, this.colouring, part);
    this.render();
  }

  private render(): void {
    this.renderer.render(this.scene, this.camera);
  }
}

function newRenderer(): THREE.WebGLRenderer | null {
  if (!document.createElement("canvas").getContext("webgl2")) return null;
  try {
    // What is drawn stays in the buffer, so that printing and saving see it.
    return new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  } catch {
    return null;
  }
}

// The element, and what starts the drawing once it is on the page.
export function scene3d(spec: SceneSpec): { element: HTMLElement; start: () => void } {
  const view = h("div", { class: "scene" });
  view.style.height = `${spec.height ?? 560}px`;
  const tip = h("div", { class: "tip", hidden: true });
  const bar = h("div", { class: "scenebar" });
  const element = h("div", { class: "sceneframe" }, view, tip, bar);
  const start = (): void => {
    const renderer = newRenderer();
    if (!renderer) {
      view.style.height = "auto";
      view.append(h("p", { class: "absent" }, noWebgl));
      return;
    }
    renderer.setPixelRatio(Math.min(2, Math.max(1.5, window.devicePixelRatio)));
    renderer.setClearColor("#fbfbfa");
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    view.append(renderer.domElement);
    const picture = new Scene3d(view, tip, renderer, spec);
    const button = (label: string, act: () => void): void => {
      const b = h("button", { type: "button" }, label);
      b.addEventListener("click", act);
      bar.append(b);
    };
    button("reset", () => picture.reset());
    button("top", () => picture.look(new THREE.Vector3(0, -1e-4, 1)));
    button("front", () => picture.look(new THREE.Vector3(0, -1, 0.03)));
    button("side", () => picture.look(new THREE.Vector3(1, 0, 0.03)));
    if ((spec.colourings?.length ?? 0) > 1) {
      const select = h("select", {}, ...(spec.colourings ?? []).map((name, i) => h("option", { value: i }, name)));
      select.addEventListener("change", () => picture.colourBy(Number(select.value)));
      bar.append(h("label", {}, "colour by ", select));
    }
    bar.append(h("span", { class: "hint" }, "drag to turn, wheel to zoom, right button to move"));
  };
  return { element, start };
}
