// Tables of a calibration: parameters, pairs, lenses to choose from, targets, views, what was left out.

import type { Section } from "../book";
import type { Calibrate } from "../data";
import { poseOf } from "../figures/calibration_scene";
import { count, fileNames, fixed, length, missing, significant, withSigma } from "../format";

type Camera = Calibrate["cameras"][number];

const distortionNames = ["k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"];
const fisheyeNames = ["k1", "k2", "k3", "k4"];
const mostParameters = 40; // of one camera; splined lenses have hundreds

interface Parameter {
  name: string;
  value: number | null;
  unit: string;
}

// The rotation vector of a matrix, for anything but half a turn.
export function rotationVector(r: readonly (readonly number[])[]): [number, number, number] {
  const at = (i: number, j: number): number => r[i]?.[j] ?? 0;
  const w = [at(2, 1) - at(1, 2), at(0, 2) - at(2, 0), at(1, 0) - at(0, 1)] as const;
  const sine = Math.hypot(...w) / 2;
  const angle = Math.atan2(sine, (at(0, 0) + at(1, 1) + at(2, 2) - 1) / 2);
  const factor = sine > 1e-9 ? angle / (2 * sine) : 0.5;
  return [w[0] * factor, w[1] * factor, w[2] * factor];
}

// Angles in degrees, lengths in millimetres; of the camera that carries the rig's frame there is nothing.
function poseParameters(c: Camera): Parameter[] {
  const pose = poseOf(c.cam_from_rig);
  if (!pose || c.sigma["rx"] === undefined) return [];
  const w = rotationVector(pose.r).map((v) => (v * 180) / Math.PI);
  return ["x", "y", "z"].flatMap((axis, i) => [{ name: `r${axis}`, value: w[i] ?? null, unit: "°" }])
    .concat(["x", "y", "z"].map((axis, i) => ({ name: `t${axis}`, value: 1000 * (pose.t[i as 0] ?? 0), unit: "mm" }))); // prettier-ignore
}

export function parameters(c: Camera): Parameter[] {
  const fallback = ["fx", "fy", "cx", "cy", ...(c.model?.includes("fisheye") ? fisheyeNames : distortionNames)];
  const values = [c.fx, c.fy, c.cx, c.cy, ...c.distortion];
  const named = values.map((value, i): Parameter => ({ name: c.parameter_names[i] ?? fallback[i] ?? `d${i - 3}`, value, unit: i < 4 ? "px" : "" }));
  return [...named.filter((p) => p.value !== null).slice(0, mostParameters), ...poseParameters(c)];
}

// Sigmas are in the unit of their value.
const unitScale = (p: Parameter): number => (p.unit === "°" ? 180 / Math.PI : p.unit === "mm" ? 1000 : 1);
function sigma(of: Record<string, number | null>, p: Parameter): number | null {
  const s = of[p.name] ?? null;
  return s === null ? null : s * unitScale(p);
}

export function bestSigma(p: Calibrate["pairs"][number]): number | null {
  return p.baseline_sigma_clustered_m ?? p.baseline_sigma_m;
}

export function parameterTable(r: Calibrate, s: Section): void {
  const rows = r.cameras.flatMap((c) => parameters(c).map((p) => ({ c, ...p })));
  const more = r.cameras.some((c) => 4 + c.distortion.length > mostParameters);
  s.table(
    [
      { head: "camera", text: true, cell: (p) => p.c.name },
      { head: "parameter", text: true, cell: (p) => p.name },
      { head: "value ± σ", cell: (p) => withSigma(p.value, sigma(p.c.sigma_clustered, p) ?? sigma(p.c.sigma, p), p.unit) },
      { head: "σ iid", cell: (p) => significant(sigma(p.c.sigma, p), 2) },
      { head: "σ clustered", cell: (p) => significant(sigma(p.c.sigma_clustered, p), 2) },
      {
        head: "ratio",
        cell: (p) => {
          const iid = p.c.sigma[p.name];
          const clustered = p.c.sigma_clustered[p.name];
          return iid && clustered ? significant(clustered / iid, 2) : missing;
        },
      },
    ],
    rows,
    "Parameters of each camera. The iid σ takes every corner as independent; the clustered one lets the corners of a view err together and is the one to use. " +
      "Poses (rotation vector, translation) are of the camera from the rig; their σ are of small turns about the camera's axes." +
      (more ? ` Of a lens with more than ${mostParameters} parameters the first are shown.` : ""),
  );
}

export function pairTable(r: Calibrate, s: Section): void {
  const vector = (v: readonly (number | null)[], scale: number, decimals: number): string =>
    v.length === 0 ? missing : v.map((x) => fixed(x === null ? null : x * scale, decimals)).join(", ");
  s.table(
    [
      { head: "pair", text: true, cell: (p) => `${p.a ?? "?"} – ${p.b ?? "?"}` },
      { head: "baseline", cell: (p) => length(p.baseline_m, bestSigma(p)) },
      { head: "rotation vector", unit: "°", cell: (p) => vector(p.rotation_deg, 1, 4) },
      { head: "translation", unit: "mm", cell: (p) => vector(p.translation_m, 1000, 2) },
    ],
    r.pairs,
    "Stereo pairs: pose of the second camera as seen from the first.",
  );
  const h = r.half_sets;
  if (!h || !h.odd_baseline_m || !h.even_baseline_m || !h.sigma_clustered_m) return;
  const ratio = Math.abs((h.difference_m ?? h.odd_baseline_m - h.even_baseline_m) / h.sigma_clustered_m);
  s.paragraph(
    `The first, third, … frames and the others alone give a first baseline of ${length(h.odd_baseline_m, null, 5)} and ${length(h.even_baseline_m, null, 5)}: ` +
      `${significant(ratio, 2)} of their combined clustered σ (${length(h.sigma_clustered_m, null, 2)}) apart.`,
  );
}

export function lensTable(r: Calibrate, s: Section): void {
  s.table(
    [
      { head: "lens", text: true, cell: (l) => l.choice },
      { head: "parameters", cell: (l) => count(l.parameters) },
      { head: "rms of the fit", unit: "px", cell: (l) => significant(l.rms_px, 4) },
      { head: "rms of frames left out", unit: "px", cell: (l) => withSigma(l.cross_validated_px, l.se_px) },
      { head: "", text: true, cell: (l) => (l.chosen ? "chosen" : (l.refused ?? "")) },
    ],
    r.lens_selection,
    "Lens models tried. The rms of the fit falls with every parameter; that of frames left out of the fit does so only while the parameters tell something of the lens. " +
      "Chosen is the shortest one whose rms of frames left out is within one standard error of the best.",
    (l) => (l.chosen ? "chosen" : null),
  );
}

export function targetTables(r: Calibrate, s: Section): void {
  const mm = (v: readonly (number | null)[]): string => v.map((w) => significant(w === null ? null : w * 1000, 2)).join(", ");
  s.table(
    [
      { head: "target", text: true, cell: (t) => t.name },
      { head: "kind", text: true, cell: (t) => t.kind },
      { head: "points", cell: (t) => count(t.nominal_points_m.length) },
      { head: "views", cell: (t) => count(t.views) },
      { head: "", text: true, cell: (t) => (t.stands ? "stands" : "held") },
      { head: "bending", unit: "mm", cell: (t) => mm(t.warp_m) },
      { head: "points estimated", text: true, cell: (t) => (t.points_m.length > 0 ? "yes" : "no") },
    ],
    r.targets,
    "Targets. The bending is that of the middle above the ends, along and across the board.",
  );
  const bars = r.targets.flatMap((t) => t.scale_bars.map((b) => ({ ...b, target: t.name })));
  s.table(
    [
      { head: "scale bar", text: true, cell: (b) => `${b.target ?? ""} ${b.a ?? "?"} – ${b.b ?? "?"}` },
      { head: "as measured", cell: (b) => length(b.length_m, b.sigma_m, 6) },
      { head: "found", cell: (b) => length(b.found_m, null, 6) },
      { head: "difference / σ", cell: (b) => significant(b.found_m !== null && b.length_m !== null && b.sigma_m ? (b.found_m - b.length_m) / b.sigma_m : null, 2) },
    ],
    bars,
    "Scale bars: lengths as they were measured, and as they come out.",
  );
}

export function viewTables(r: Calibrate, s: Section): void {
  const short = fileNames(r.views.map((v) => v.image ?? "?"));
  const sharp = r.views.some((v) => v.sharpness !== null);
  s.table(
    [
      { head: "view", text: true, cell: (v) => short(v.image ?? "?"), sort: (v) => short(v.image ?? "?") },
      { head: "camera", text: true, cell: (v) => v.camera, sort: (v) => v.camera },
      { head: "frame", cell: (v) => v.frame, sort: (v) => v.frame },
      ...(r.targets.length > 1 ? [{ head: "target", text: true, cell: (v: Calibrate["views"][number]) => r.targets[v.target ?? 0]?.name ?? missing, sort: (v: Calibrate["views"][number]) => r.targets[v.target ?? 0]?.name ?? null }] : []),
      { head: "rms", unit: "px", cell: (v) => significant(v.rms_px, 3), sort: (v) => v.rms_px },
      { head: "corners used", cell: (v) => count(v.residuals.length), sort: (v) => v.residuals.length },
      ...(sharp ? [{ head: "sharpness", cell: (v: Calibrate["views"][number]) => significant(v.sharpness, 3), sort: (v: Calibrate["views"][number]) => v.sharpness }] : []),
      { head: "left out because", text: true, cell: (v) => (v.outlier ? (v.reason ?? "yes") : ""), sort: (v) => (v.outlier ? (v.reason ?? "yes") : null) },
    ],
    r.views,
    "Views; a click on the head of a column sorts by it. The rms is per axis over all corners that were found. Views left out of the final solution are red.",
    (v) => (v.outlier ? "out" : null),
  );
  s.table(
    [
      { head: "image", text: true, cell: (o) => short(o.image ?? "?") },
      { head: "corner", text: true, cell: (o) => o.corner },
      { head: "residual", unit: "px", cell: (o) => significant(o.residual_px, 3), sort: (o) => o.residual_px },
    ],
    r.outliers,
    "Single corners left out.",
  );
  s.table(
    [
      { head: "image skipped", text: true, cell: (o) => o.image },
      { head: "because", text: true, cell: (o) => o.reason },
    ],
    r.skipped,
    "Images from which no view came.",
  );
}
