// What stands in a 3-D picture: meshes coloured by part, curves, marks, the ground with its scale bar.

import * as THREE from "three";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { niceBelow, significant } from "../format";
import { ink } from "../palette";

export type Point3 = [number, number, number];

export interface Part {
  id: number;
  label: string;
  colours: string[]; // one for each colouring of the scene
}

export interface MeshSpec {
  positions: readonly (number | null)[];
  indices: readonly (number | null)[];
  partIds: readonly (number | null)[]; // of each triangle
  parts: readonly Part[];
  opacity?: number; // below 1 the mesh casts no shadow
}

export interface CurveSpec {
  label: string;
  colour: string;
  points: Point3[];
  width?: number; // pixels
}

const unknownColour = "#9aa3ad";

// Smooth normals are computed on the shared vertices, then triangles get vertices of their own for their colours.
export function meshObject(spec: MeshSpec): THREE.Mesh | null {
  const n = Math.floor(spec.positions.length / 3);
  const triangles = Math.floor(spec.indices.length / 3);
  const indices: number[] = [];
  const kept: number[] = [];
  for (let t = 0; t < triangles; ++t) {
    const corners = [spec.indices[3 * t], spec.indices[3 * t + 1], spec.indices[3 * t + 2]];
    if (!corners.every((i) => typeof i === "number" && i >= 0 && i < n)) continue;
    indices.push(...(corners as number[]));
    kept.push(t);
  }
  if (indices.length === 0) return null;
  const shared = new THREE.BufferGeometry();
  shared.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(spec.positions.slice(0, 3 * n), (x) => x ?? 0), 3));
  shared.setIndex(indices);
  shared.computeVertexNormals();
  const geometry = shared.toNonIndexed();
  geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(indices.length * 3), 3));
  const opacity = spec.opacity ?? 1;
  const clear = opacity < 1 ? { transparent: true, opacity, depthWrite: false } : {};
  const material = new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide, ...clear });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.castShadow = opacity === 1;
  const parts = new Map(spec.parts.map((p) => [p.id, p]));
  mesh.userData = { parts: kept.map((t) => parts.get(spec.partIds[t] ?? -1) ?? null) };
  return mesh;
}

export function partOf(mesh: THREE.Object3D, face: number): Part | null {
  return (mesh.userData as { parts?: (Part | null)[] }).parts?.[face] ?? null;
}

// Colours every triangle by its part; `lit` is the part under the pointer.
export function colourMesh(mesh: THREE.Mesh, colouring: number, lit: Part | null = null): void {
  const parts = (mesh.userData as { parts: (Part | null)[] }).parts;
  const attribute = mesh.geometry.getAttribute("color");
  const cache = new Map<string, THREE.Color>();
  parts.forEach((part, t) => {
    const name = part?.colours[colouring] ?? part?.colours[0] ?? unknownColour;
    const key = part !== null && part === lit ? `${name}+` : name;
    let c = cache.get(key);
    if (!c) {
      c = new THREE.Color(name);
      if (key !== name) c.lerp(new THREE.Color("#ffffff"), 0.45);
      cache.set(key, c);
    }
    for (let k = 0; k < 3; ++k) attribute.setXYZ(3 * t + k, c.r, c.g, c.b);
  });
  attribute.needsUpdate = true;
}

function segments(positions: number[], colour: string, width: number): LineSegments2 {
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(positions);
  return new LineSegments2(geometry, new LineMaterial({ color: new THREE.Color(colour).getHex(), linewidth: width }));
}

export function curveObject(c: CurveSpec): THREE.Object3D | null {
  if (c.points.length < 2) return null;
  const object = segments(c.points.slice(1).flatMap((p, i) => [...(c.points[i] ?? p), ...p]), c.colour, c.width ?? 3);
  object.userData = { label: c.label };
  return object;
}

function disc(): THREE.Texture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 32;
  const context = canvas.getContext("2d");
  if (context) {
    context.fillStyle = "#ffffff";
    context.arc(16, 16, 15, 0, 2 * Math.PI);
    context.fill();
  }
  return new THREE.CanvasTexture(canvas);
}

export function dotObject(points: readonly Point3[], colour: string, size: number): THREE.Object3D {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points.flat(), 3));
  return new THREE.Points(geometry, new THREE.PointsMaterial({ color: colour, size, sizeAttenuation: false, map: disc(), alphaTest: 0.5 }));
}

// A label of one size on the screen, hanging from its position.
export function textSprite(text: string): THREE.Sprite {
  const canvas = document.createElement("canvas");
  canvas.width = 512;
  canvas.height = 128;
  const context = canvas.getContext("2d");
  if (context) {
    context.font = '76px system-ui, "DejaVu Sans", sans-serif';
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillStyle = ink;
    context.fillText(text, 256, 64);
  }
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map: texture, depthTest: false, sizeAttenuation: false }));
  sprite.scale.set(0.092, 0.023, 1);
  sprite.center.set(0.5, 1);
  return sprite;
}

export function lengthLabel(metres: number): string {
  if (metres >= 1) return `${significant(metres, 3).replace(/\.0+$/, "")} m`;
  if (metres >= 0.01) return `${Math.round(metres * 100)} cm`;
  return `${significant(metres * 1000, 2).replace(/\.0+$/, "")} mm`;
}

// A grid on the ground under the box, one cell of it marked as scale bar.
export function ground(box: THREE.Box3): { object: THREE.Object3D; corners: THREE.Vector3[] } {
  const size = box.getSize(new THREE.Vector3());
  const extent = Math.max(size.x, size.y, 0.3 * size.z, 1e-6);
  const cell = niceBelow(extent / 4);
  const z = box.min.z;
  const span = (low: number, high: number): [number, number] => {
    const pad = Math.max(0, 0.4 * extent - (high - low)) / 2;
    return [Math.floor((low - pad) / cell + 1e-6) * cell, Math.ceil((high + pad) / cell - 1e-6) * cell];
  };
  const [x0, x1] = span(box.min.x, box.max.x);
  const [y0, y1] = span(box.min.y, box.max.y);
  const lines: number[] = [];
  for (let x = x0; x < x1 + cell / 2; x += cell) lines.push(x, y0, z, x, y1, z);
  for (let y = y0; y < y1 + cell / 2; y += cell) lines.push(x0, y, z, x1, y, z);
  const object = new THREE.Group();
  const shade = new THREE.Mesh(new THREE.PlaneGeometry(x1 - x0, y1 - y0), new THREE.ShadowMaterial({ opacity: 0.18 }));
  shade.position.set((x0 + x1) / 2, (y0 + y1) / 2, z - 1e-3 * cell);
  shade.receiveShadow = true;
  const y = y0 - 0.05 * extent;
  const tick = 0.015 * extent;
  const ends = [x0, x0 + cell].flatMap((x) => [x, y - tick, z, x, y + tick, z]);
  const text = textSprite(lengthLabel(cell));
  text.position.set(x0 + cell / 2, y - tick, z);
  object.add(shade, segments(lines, "#c9ced4", 1), segments([x0, y, z, x0 + cell, y, z, ...ends], ink, 2.5), text);
  const corners = [x0, x1].flatMap((x) => [y - 2 * tick, y1].map((w) => new THREE.Vector3(x, w, z)));
  return { object, corners };
}
