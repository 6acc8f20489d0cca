// Cameras and targets in space: frusta, boards of the frames, points of what stands, the path of a rig that moves.
// In the rig's frame where the rig stands, else in the world's.

import type { Section } from "../book";
import type { Calibrate } from "../data";
import { median, plural, significant } from "../format";
import { colour, ink, orderColour, quiet } from "../palette";
import { frameNames, rmsOf } from "./residual_statistics";
import { scene3d, type SceneSpec } from "./scene3d";
import type { CurveSpec, MeshSpec, Part, Point3 } from "./scene3d_content";

export interface Pose {
  r: number[][];
  t: Point3;
}

const identity: Pose = { r: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], t: [0, 0, 0] }; // prettier-ignore
const mostBoards = 150;
const mostFrusta = 40; // of each camera of a rig that moves

export function poseOf(rows: readonly (readonly (number | null)[])[] | undefined): Pose | null {
  if (!rows || rows.length !== 3 || !rows.every((row) => row.length === 4 && row.every((v) => v !== null))) return null;
  return { r: rows.map((row) => row.slice(0, 3) as number[]), t: rows.map((row) => row[3]) as Point3 };
}

export function apply({ r, t }: Pose, x: Point3): Point3 {
  return t.map((ti, i) => ti + x.reduce((sum, xj, j) => sum + (r[i]?.[j] ?? 0) * xj, 0)) as Point3;
}

// Where a point of the pose's target frame is in its source frame: R'(x - t).
export function applyInverse({ r, t }: Pose, x: Point3): Point3 {
  const d = x.map((xi, i) => xi - t[i as 0 | 1 | 2]);
  return [0, 1, 2].map((j) => d.reduce((sum, di, i) => sum + (r[i]?.[j] ?? 0) * di, 0)) as Point3;
}

function spread<T>(all: readonly T[], most: number): T[] {
  return all.length <= most ? [...all] : Array.from({ length: most }, (_, i) => all[Math.floor((i * all.length) / most)] as T);
}

type Camera = Calibrate["cameras"][number];

interface Eye {
  camera: Camera;
  colour: string;
  toScene: (x: Point3) => Point3;
  frame: string | null;
}

// Every camera, in every frame shown where the rig moves.
function eyes(r: Calibrate, moves: boolean, seen: ReadonlySet<string>): Eye[] {
  const frames = r.poses?.frames ?? [];
  const known = frames.flatMap((f, i) => (f !== null && seen.has(f) ? [i] : []));
  const rigs = moves ? spread(known, mostFrusta) : [null];
  return r.cameras.flatMap((camera, k) =>
    rigs.flatMap((i): Eye[] => {
      const own = poseOf(camera.cam_from_rig);
      const rig = i === null ? identity : poseOf(r.poses?.rig_from_world[i]);
      if (!own || !rig) return [];
      return [{ camera, colour: colour(k + 2), toScene: (x) => applyInverse(rig, applyInverse(own, x)), frame: i === null ? null : (frames[i] ?? null) }];
    }),
  );
}

function frustum({ camera, colour: c, toScene, frame }: Eye, depth: number): CurveSpec[] {
  const tangents = (size: number | null, centre: number | null, focal: number | null): [number, number] => {
    const [s, f] = [size ?? 4, Math.abs(focal ?? 4) || 4];
    const limit = (x: number): number => Math.max(-1.5, Math.min(1.5, x));
    return [limit((-0.5 - (centre ?? s / 2)) / f), limit((s - 0.5 - (centre ?? s / 2)) / f)];
  };
  const [left, right] = tangents(camera.width, camera.cx, camera.fx);
  const [top, bottom] = tangents(camera.height, camera.cy, camera.fy);
  const at = (x: number, y: number): Point3 => toScene([depth * x, depth * y, depth]);
  const [a, b, d, e] = [at(left, top), at(right, top), at(right, bottom), at(left, bottom)];
  const eye = toScene([0, 0, 0]);
  const label = [`camera ${camera.name ?? "?"}`, frame === null ? null : `frame ${frame}`].filter((x) => x !== null).join(", ");
  const width = frame === null ? 2.2 : 1.2;
  return [
    { label, colour: c, width, points: [eye, a, b, eye, d, e, eye] },
    { label, colour: c, width, points: [b, d] },
    { label, colour: c, width, points: [e, a, at((left + right) / 2, top - 0.25 * (bottom - top)), b] }, // the roof shows what is up
  ];
}

type Target = Calibrate["targets"][number];

function extents(target: Target): { low: Point3; high: Point3 } | null {
  const points = target.nominal_points_m.filter((p) => p.length === 3 && p.every((v) => v !== null)) as Point3[];
  if (points.length === 0) return null;
  const bound = (f: (...v: number[]) => number): Point3 => [0, 1, 2].map((i) => f(...points.map((p) => p[i as 0 | 1 | 2]))) as Point3;
  return { low: bound(Math.min), high: bound(Math.max) };
}

interface Board {
  target: number;
  frame: string | null; // null: it stands
  pose: Pose;
}

function boards(r: Calibrate, seen: ReadonlySet<string>): Board[] {
  const frames = r.poses?.frames ?? [];
  return r.targets.flatMap((target, t) => {
    const slots = r.poses?.world_from_target[t] ?? [];
    const all = slots.flatMap((rows, i): Board[] => {
      const frame = target.stands ? null : (frames[i] ?? null);
      const pose = poseOf(rows);
      const known = target.stands ? i === 0 : frame !== null && seen.has(`${frame} ${t}`);
      return pose && known ? [{ target: t, frame, pose }] : [];
    });
    return spread(all, mostBoards);
  });
}

// Coloured by frame, and by the rms of the frame's residuals.
function boardParts(r: Calibrate, all: readonly Board[]): Part[] {
  const frames = frameNames(r);
  const rms = all.map((b) => rmsOf(r.views.filter((v) => !v.outlier && (v.target ?? 0) === b.target && (b.frame === null || v.frame === b.frame))));
  const largest = Math.max(...rms.map((v) => v ?? 0));
  return all.map((b, id) => {
    const value = rms[id] ?? null;
    const name = [r.targets.length > 1 || b.frame === null ? r.targets[b.target]?.name : null, b.frame === null ? null : `frame ${b.frame}`, value === null ? null : `rms ${significant(value, 3)} px`];
    const byFrame = b.frame === null ? colour(b.target) : orderColour(frames.indexOf(b.frame), frames.length);
    return { id, label: name.filter(Boolean).join(", "), colours: [byFrame, value === null || largest === 0 ? "#9aa3ad" : orderColour(Math.round((100 * value) / largest), 116)] };
  });
}

function boardMesh(r: Calibrate, all: readonly Board[], parts: readonly Part[]): { mesh: MeshSpec; outlines: CurveSpec[]; dots: NonNullable<SceneSpec["dots"]> } {
  const mesh = { positions: [] as number[], indices: [] as number[], partIds: [] as number[], parts, opacity: 0.55 };
  const outlines: CurveSpec[] = [];
  const dots: NonNullable<SceneSpec["dots"]> = [];
  all.forEach((b, id) => {
    const target = r.targets[b.target];
    const box = target ? extents(target) : null;
    if (!target || !box) return;
    const { low, high } = box;
    const c = parts[id]?.colours[0] ?? ink;
    const points = (target.points_m.length > 0 ? target.points_m : target.nominal_points_m).filter((p) => p.length === 3 && p.every((v) => v !== null)) as Point3[];
    if (b.frame === null) dots.push({ points: points.map((p) => apply(b.pose, p)), colour: c, size: 5 });
    if (high[2] - low[2] > 0.02 * Math.max(high[0] - low[0], high[1] - low[1])) {
      if (b.frame !== null) dots.push({ points: points.map((p) => apply(b.pose, p)), colour: c, size: 3 });
      return;
    }
    const edge = target.square_m ?? 0;
    const [x0, x1, y0, y1] = [low[0] - edge, high[0] + edge, low[1] - edge, high[1] + edge];
    const corners = ([[x0, y0], [x1, y0], [x1, y1], [x0, y1]] as const).map(([x, y]) => apply(b.pose, [x, y, low[2]])); // prettier-ignore
    const first = mesh.positions.length / 3;
    mesh.positions.push(...corners.flat());
    mesh.indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
    mesh.partIds.push(id, id);
    outlines.push({ label: parts[id]?.label ?? "", colour: c, width: 1.2, points: [...corners, corners[0] ?? [0, 0, 0]] });
  });
  return { mesh, outlines, dots };
}

function axes(length: number): { curves: CurveSpec[]; labels: NonNullable<SceneSpec["labels"]> } {
  const ends: [string, Point3, string][] = [["x", [length, 0, 0], "#c2542f"], ["y", [0, length, 0], "#3f8f4f"], ["z", [0, 0, length], "#3b6fb6"]]; // prettier-ignore
  return {
    curves: ends.map(([name, at, c]) => ({ label: `${name} axis`, colour: c, width: 3, points: [[0, 0, 0], at] })),
    labels: ends.map(([text, at]) => ({ text, at })),
  };
}

// The axis of a turntable, given in the rig's frame.
function turntableAxis(r: Calibrate, reach: number): CurveSpec[] {
  const [d, p] = [r.turntable?.direction ?? [], r.turntable?.point_m ?? []];
  if (d.length !== 3 || p.length !== 3 || [...d, ...p].some((v) => v === null)) return [];
  // Drawn about the place nearest to the middle of what the cameras look at.
  const along = (d[2] ?? 0) * reach;
  const at = (t: number): Point3 => [0, 1, 2].map((i) => (p[i] ?? 0) + (along + t) * (d[i] ?? 0)) as Point3;
  return [{ label: "axis of the turntable", colour: ink, width: 2.5, points: [at(-0.5 * reach), at(0.5 * reach)] }];
}

// Small enough that neighbours do not run into each other, large enough to be seen.
function frustumDepth(all: readonly Eye[], reach: number): number {
  const centres = all.filter((e) => e.frame === all[0]?.frame).map((e) => e.toScene([0, 0, 0]));
  const gaps = centres.flatMap((a, i) => centres.slice(i + 1).map((b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]))).filter((d) => d > 0);
  return Math.max(0.06 * reach, Math.min(0.22 * reach, 0.7 * Math.min(Infinity, ...gaps)));
}

export function sceneSpec(r: Calibrate): SceneSpec | null {
  const moves = (r.poses?.rig_from_world.length ?? 0) > 0;
  const used = r.views.filter((v) => !v.outlier && v.frame !== null);
  const seen = new Set(used.flatMap((v) => [v.frame ?? "", `${v.frame ?? ""} ${v.target ?? 0}`]));
  const all = eyes(r, moves, seen);
  const held = boards(r, seen);
  if (all.length === 0) return null;
  const reach = median(r.cameras.map((c) => (c.projection_sigma?.range_m ? c.projection_sigma.range_m : null))) ?? 1;
  const depth = frustumDepth(all, reach);
  const { mesh, outlines, dots } = boardMesh(r, held, boardParts(r, held));
  const cross = axes(moves ? 0.25 * reach : 0.5 * depth);
  const first = all.filter((e) => e.camera === all[0]?.camera);
  const path: CurveSpec[] = moves ? [{ label: "path of the rig", colour: quiet, width: 1.6, points: first.map((e) => e.toScene([0, 0, 0])) }] : [];
  const directions = all.map(({ toScene }) => [toScene([0, 0, 0]), toScene([0, -1, 0]), toScene([0, 0, 1])] as const);
  const mean = (k: 1 | 2): Point3 => [0, 1, 2].map((i) => directions.reduce((sum, d) => sum + d[k][i as 0] - d[0][i as 0], 0) / directions.length) as Point3;
  const [up, ahead] = [mean(1), mean(2)];
  const side: Point3 = [up[1] * ahead[2] - up[2] * ahead[1], up[2] * ahead[0] - up[0] * ahead[2], up[0] * ahead[1] - up[1] * ahead[0]];
  const viewFrom = [0, 1, 2].map((i) => -0.75 * ahead[i as 0] + 0.8 * side[i as 0] + 0.5 * up[i as 0]) as Point3;
  const sound = (v: Point3): boolean => Math.hypot(...v) > 0.1;
  const labels = moves ? [] : all.map((e) => ({ text: e.camera.name ?? "?", at: e.toScene([0, -1.1 * depth, 0.6 * depth]) }));
  return {
    ...(mesh.indices.length > 0 ? { mesh } : {}),
    curves: [...all.flatMap((e) => frustum(e, depth)), ...outlines, ...path, ...(moves ? [] : turntableAxis(r, reach)), ...cross.curves],
    dots,
    labels: [...labels, ...cross.labels],
    colourings: ["frame", "rms residual"],
    ...(sound(up) ? { up } : {}),
    ...(sound(viewFrom) ? { viewFrom } : {}),
    height: 560,
  };
}

export function calibrationScene(r: Calibrate, s: Section): void {
  const spec = sceneSpec(r);
  if (!spec) return;
  const moves = (r.poses?.rig_from_world.length ?? 0) > 0;
  const shown = spec.mesh?.parts.length ?? 0;
  const { element, start } = scene3d(spec);
  s.figure(
    "scene",
    element,
    `The cameras as pyramids through the edges of their images, the roof at the top of the image${shown > 0 ? `, and ${plural(shown, "board")} as the solution places them` : ""}, ` +
      (moves ? "in the frame of what stands; the line is the path of the first camera." : "in the frame of the rig, which the first camera carries: x right, y down, z forward.") +
      " Boards should fill the space that will be measured, tilted in different directions. The grid is one of the picture, not of the ground.",
    start,
  );
}
