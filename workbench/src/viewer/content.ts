// Instances of the prototypes as three.js draws them: one InstancedMesh a prototype, coloured by part.

import * as THREE from "three";
import { partOfTriangle, type Colouring, type InstanceGroup, type PrototypeData, type ViewerDocument } from "./data";

// Which part of which instance.
export interface Pick {
  group: number;
  instance: number;
  part: number;
  point: THREE.Vector3;
}

function geometryOf(prototype: PrototypeData): THREE.BufferGeometry {
  const out = new THREE.BufferGeometry();
  out.setAttribute("position", new THREE.BufferAttribute(prototype.positions, 3));
  out.setAttribute("color", new THREE.BufferAttribute(new Float32Array(prototype.positions.length), 3));
  out.setIndex(new THREE.BufferAttribute(prototype.indices, 1));
  out.computeVertexNormals();
  return out;
}

function matrices(group: InstanceGroup, mesh: THREE.InstancedMesh): void {
  const matrix = new THREE.Matrix4();
  const position = new THREE.Vector3();
  const turn = new THREE.Quaternion();
  const scale = new THREE.Vector3();
  for (let k = 0; k < group.count; ++k) {
    const [x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 1, s = 1] = group.poses.subarray(8 * k, 8 * k + 8);
    matrix.compose(position.set(x, y, z), turn.set(qx, qy, qz, qw), scale.set(s, s, s));
    mesh.setMatrixAt(k, matrix);
  }
}

export class Content {
  readonly object = new THREE.Group();
  readonly box = new THREE.Box3();
  readonly meshes: THREE.InstancedMesh[] = [];
  readonly counts = { instances: 0, prototypes: 0, parts: 0, triangles: 0 };
  private readonly lit: THREE.Mesh;

  constructor(readonly data: ViewerDocument) {
    const geometries = data.prototypes.map(geometryOf);
    for (const group of data.instances) {
      const prototype = data.prototypes[group.prototype];
      const geometry = geometries[group.prototype];
      if (!prototype || !geometry) throw new Error(`there is no prototype ${group.prototype}`);
      const mesh = new THREE.InstancedMesh(geometry, new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide }), group.count);
      matrices(group, mesh);
      mesh.castShadow = !prototype.isGround;
      mesh.receiveShadow = true;
      mesh.computeBoundingBox();
      mesh.computeBoundingSphere();
      if (mesh.boundingBox && prototype.indices.length > 0) this.box.union(mesh.boundingBox);
      this.meshes.push(mesh);
      this.object.add(mesh);
      this.counts.triangles += (group.count * prototype.indices.length) / 3;
      this.counts.parts += group.count * prototype.parts.length;
      if (!prototype.isGround) this.counts.instances += group.count;
    }
    this.counts.prototypes = data.prototypes.filter((p) => !p.isGround).length;
    this.lit = new THREE.Mesh(
      new THREE.BufferGeometry(),
      new THREE.MeshBasicMaterial({ color: "#ff2d6f", side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2 }),
    );
    this.lit.matrixAutoUpdate = false;
    this.lit.visible = false;
    this.object.add(this.lit);
  }

  prototypeOf(group: number): PrototypeData | undefined {
    return this.data.prototypes[this.data.instances[group]?.prototype ?? -1];
  }

  colourBy(colouring: Colouring): void {
    const done = new Set<number>();
    const colour = new THREE.Color();
    this.data.instances.forEach(({ prototype: number }, k) => {
      const prototype = this.data.prototypes[number];
      const colours = colouring.colourOfPart[number];
      const attribute = this.meshes[k]?.geometry.getAttribute("color");
      if (done.has(number) || !prototype || !colours || !attribute) return;
      done.add(number);
      prototype.parts.forEach((_, part) => {
        colour.setRGB((colours[3 * part] ?? 0) / 255, (colours[3 * part + 1] ?? 0) / 255, (colours[3 * part + 2] ?? 0) / 255, THREE.SRGBColorSpace);
        const end = prototype.firstVertex[part + 1] ?? 0;
        for (let v = prototype.firstVertex[part] ?? 0; v < end; ++v) attribute.setXYZ(v, colour.r, colour.g, colour.b);
      });
      attribute.needsUpdate = true;
    });
  }

  showGround(shown: boolean): void {
    this.meshes.forEach((mesh, k) => {
      if (this.prototypeOf(k)?.isGround) mesh.visible = shown;
    });
  }
  hasGround(): boolean {
    return this.data.prototypes.some((p) => p.isGround);
  }

  // What a ray meets first on the side of the section plane that is shown.
  pick(caster: THREE.Raycaster, section: THREE.Plane | null): Pick | null {
    const hits = caster.intersectObjects(this.meshes.filter((mesh) => mesh.visible), false);
    for (const hit of hits) {
      if (section && section.distanceToPoint(hit.point) < 0) continue;
      const group = this.meshes.indexOf(hit.object as THREE.InstancedMesh);
      const prototype = this.prototypeOf(group);
      if (!prototype || hit.instanceId === undefined || typeof hit.faceIndex !== "number") continue;
      return { group, instance: hit.instanceId, part: partOfTriangle(prototype, hit.faceIndex), point: hit.point };
    }
    return null;
  }

  light(pick: Pick | null): void {
    this.lit.visible = pick !== null;
    const prototype = pick ? this.prototypeOf(pick.group) : undefined;
    const mesh = pick ? this.meshes[pick.group] : undefined;
    if (!pick || !prototype || !mesh) return;
    this.lit.geometry.dispose();
    this.lit.geometry = new THREE.BufferGeometry();
    this.lit.geometry.setAttribute("position", mesh.geometry.getAttribute("position"));
    const [first = 0, end = 0] = [prototype.firstTriangle[pick.part], prototype.firstTriangle[pick.part + 1]];
    this.lit.geometry.setIndex(new THREE.BufferAttribute(prototype.indices.slice(3 * first, 3 * end), 1));
    mesh.getMatrixAt(pick.instance, this.lit.matrix);
    this.lit.matrixWorldNeedsUpdate = true;
  }

  // What encloses all: corners of the prototypes' boxes where they stand.
  framePoints(): THREE.Vector3[] {
    const out: THREE.Vector3[] = [];
    const matrix = new THREE.Matrix4();
    const most = 20_000;
    this.meshes.forEach((mesh) => {
      mesh.geometry.computeBoundingBox();
      const box = mesh.geometry.boundingBox;
      if (!box || box.isEmpty()) return;
      const step = Math.max(1, Math.ceil((8 * mesh.count) / most));
      for (let k = 0; k < mesh.count; k += step) {
        mesh.getMatrixAt(k, matrix);
        for (let c = 0; c < 8; ++c)
          out.push(new THREE.Vector3(c & 1 ? box.max.x : box.min.x, c & 2 ? box.max.y : box.min.y, c & 4 ? box.max.z : box.min.z).applyMatrix4(matrix));
      }
    });
    return out;
  }
}
