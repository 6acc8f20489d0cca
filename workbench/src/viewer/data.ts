// The viewer's document, as scene/pictures/viewer_document.cpp writes it, with its arrays unpacked.

export interface PartInfo {
  label: string;
  kind: string;
  material: string;
  length_m: number | null;
  area_m2: number | null;
  height_m: number | null;
  inclination_deg: number | null;
  properties?: Record<string, string>;
  parameters?: Record<string, string>;
}

export interface PrototypeData {
  name: string;
  positions: Float32Array; // metres, three a vertex
  indices: Uint32Array;
  firstTriangle: Uint32Array; // of each part, and the end
  firstVertex: Uint32Array;
  parts: PartInfo[];
  isGround: boolean;
}

export interface InstanceGroup {
  prototype: number;
  count: number;
  poses: Float32Array; // x, y, z, quaternion x, y, z, w, scale
  plants: Uint32Array;
}

export interface Scale {
  low: number;
  high: number;
  colours: string[];
  no_value?: string;
}

export interface Colouring {
  name: string;
  title: string;
  entries: { label: string; colour: string }[];
  scale: Scale | null;
  colourOfPart: Uint8Array[]; // of each prototype: three bytes a part, sRGB
}

export interface ViewerDocument {
  title: string;
  version: string;
  command: string;
  prototypes: PrototypeData[];
  instances: InstanceGroup[];
  colourings: Colouring[];
  colour: string;
  notes: string[];
}

export function bytes(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) out[i] = text.charCodeAt(i);
  return out;
}

type Raw = Record<string, unknown>;

function record(value: unknown, what: string): Raw {
  if (typeof value !== "object" || value === null || Array.isArray(value)) throw new Error(`${what} is not an object`);
  return value as Raw;
}
function list(value: unknown, what: string): unknown[] {
  if (!Array.isArray(value)) throw new Error(`${what} is not a list`);
  return value;
}
function text(value: unknown): string {
  return typeof value === "string" ? value : "";
}
function floats(value: unknown): Float32Array {
  return new Float32Array(bytes(text(value)).buffer);
}
function counts(value: unknown): Uint32Array {
  return new Uint32Array(bytes(text(value)).buffer);
}

// Coordinates are steps of 1/65535 of the prototype's box.
function positions(raw: Raw): Float32Array {
  const steps = new Uint16Array(bytes(text(raw.positions_u16)).buffer);
  const low = raw.low as number[];
  const high = raw.high as number[];
  const out = new Float32Array(steps.length);
  for (let i = 0; i < steps.length; ++i) {
    const from = low[i % 3] ?? 0;
    out[i] = from + (((high[i % 3] ?? 0) - from) * (steps[i] ?? 0)) / 65535;
  }
  return out;
}

function prototype(value: unknown): PrototypeData {
  const raw = record(value, "a prototype");
  const parts = list(raw.parts, "parts") as PartInfo[];
  const narrow = raw.indices_u16;
  return {
    name: text(raw.name),
    positions: positions(raw),
    indices: narrow === undefined ? counts(raw.indices_u32) : Uint32Array.from(new Uint16Array(bytes(text(narrow)).buffer)),
    firstTriangle: counts(raw.first_triangle_u32),
    firstVertex: counts(raw.first_vertex_u32),
    parts,
    isGround: text(raw.name) === "ground" && parts.length === 1 && parts[0]?.kind === "ground",
  };
}

function instanceGroup(value: unknown): InstanceGroup {
  const raw = record(value, "instances");
  return { prototype: Number(raw.prototype), count: Number(raw.count), poses: floats(raw.poses_f32), plants: counts(raw.plants_u32) };
}

function colouring(value: unknown): Colouring {
  const raw = record(value, "a colouring");
  return {
    name: text(raw.name),
    title: text(raw.title),
    entries: list(raw.entries, "entries") as Colouring["entries"],
    scale: raw.scale as Scale | null,
    colourOfPart: list(raw.colour_of_part_rgb8, "colours").map((c) => bytes(text(c))),
  };
}

export function parseViewer(json: string): ViewerDocument {
  const raw = record(JSON.parse(json), "the document");
  return {
    title: text(raw.title),
    version: text(raw.version),
    command: text((raw.provenance as Raw | undefined)?.command),
    prototypes: list(raw.prototypes, "prototypes").map(prototype),
    instances: list(raw.instances, "instances").map(instanceGroup),
    colourings: list(raw.colourings, "colourings").map(colouring),
    colour: text(raw.colour),
    notes: list(raw.notes ?? [], "notes").map(text),
  };
}

// The part of a prototype that a triangle belongs to: the last that begins at or before it, empty ones passed over.
export function partOfTriangle(of: PrototypeData, triangle: number): number {
  let low = 0;
  let high = of.parts.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if ((of.firstTriangle[middle] ?? 0) <= triangle) low = middle;
    else high = middle;
  }
  return low;
}
