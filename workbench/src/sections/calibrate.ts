// Cameras from photographs of a target: parameters, residuals, stereo pairs.

import type { Section } from "../book";
import { calibrate as read, type Calibrate } from "../data";
import { errorsByView, quiverByCamera, residualScatter } from "../figures/calibration";
import { count, fixed, length, missing, percent, plural, significant, withSigma } from "../format";
import { defineSection } from "./section";

type Camera = Calibrate["cameras"][number];

const distortionNames = ["k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"];
const fisheyeNames = ["k1", "k2", "k3", "k4"];

function parameters(c: Camera): { name: string; value: number | null; unit: string }[] {
  const names = c.model?.includes("fisheye") ? fisheyeNames : distortionNames;
  return [
    { name: "fx", value: c.fx, unit: "px" },
    { name: "fy", value: c.fy, unit: "px" },
    { name: "cx", value: c.cx, unit: "px" },
    { name: "cy", value: c.cy, unit: "px" },
    ...c.distortion.map((value, i) => ({ name: names[i] ?? `d${i + 1}`, value, unit: "" })),
  ].filter((p) => p.value !== null);
}

function sigmaOf(c: Camera, name: string): number | null {
  return c.sigma_clustered[name] ?? c.sigma[name] ?? null;
}

function bestSigma(p: Calibrate["pairs"][number]): number | null {
  return p.baseline_sigma_clustered_m ?? p.baseline_sigma_m;
}

function parameterTable(r: Calibrate, s: Section): void {
  const rows = r.cameras.flatMap((c) => parameters(c).map((p) => ({ c, ...p })));
  s.table(
    [
      { head: "camera", text: true, cell: (p) => p.c.name },
      { head: "parameter", text: true, cell: (p) => p.name },
      { head: "value ± σ", unit: "px for f and c", cell: (p) => withSigma(p.value, sigmaOf(p.c, p.name), p.unit) },
      { head: "σ iid", cell: (p) => significant(p.c.sigma[p.name] ?? null, 2) },
      { head: "σ clustered", cell: (p) => significant(p.c.sigma_clustered[p.name] ?? null, 2) },
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
    "Parameters of each camera. The iid σ takes every corner as independent; the clustered one lets the corners of a view err together and is the one to use.",
  );
}

function pairTable(r: Calibrate, s: Section): void {
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
}

function viewTables(r: Calibrate, s: Section): void {
  const left = r.views.filter((v) => v.outlier);
  s.table(
    [
      { head: "view left out", text: true, cell: (v) => v.image },
      { head: "camera", text: true, cell: (v) => v.camera },
      { head: "rms", unit: "px", cell: (v) => significant(v.rms_px, 3) },
      { head: "reason", text: true, cell: (v) => v.reason ?? missing },
    ],
    left,
    "Views that the robust pass left out of the final solution.",
  );
  s.table(
    [
      { head: "image", text: true, cell: (o) => o.image },
      { head: "corner", text: true, cell: (o) => o.corner },
      { head: "residual", unit: "px", cell: (o) => significant(o.residual_px, 3) },
    ],
    r.outliers,
    "Single corners left out.",
  );
}

export const calibrate = defineSection({
  kind: "calibrate",
  step: "calibrate",
  title: "Calibration of the cameras",
  explanation:
    "Photographs of a target of known size give each camera's lens model and the pose of the cameras to each other. " +
    "Image coordinates are in pixels with pixel centres at integers, u to the right and v down; a residual is the detected corner minus the predicted one.",
  read,
  summarise: (r) => {
    const pair = r.pairs.find((p) => p.baseline_m !== null);
    const rms = r.residual_rms_px === null ? "" : ` to ${significant(r.residual_rms_px, 3)} px rms per axis`;
    const used = r.corners_used === null ? "" : ` from ${count(r.corners_used)} corners`;
    return {
      sentence: r.cameras.length > 0 ? `${plural(r.cameras.length, "camera")} calibrated${used}${rms}.` : null,
      cards: [
        ...(r.residual_rms_px === null ? [] : [{ label: "Calibration residual", value: `${significant(r.residual_rms_px, 3)} px`, note: "rms per axis" }]),
        ...(pair ? [{ label: `Baseline ${pair.a ?? ""} – ${pair.b ?? ""}`, value: length(pair.baseline_m, bestSigma(pair)) }] : []),
      ],
    };
  },
  render: (r, s) => {
    if (r.converged === false) s.note("The solution did not converge: read the figures below with care.");
    const share = r.corners_used !== null && r.corners_total ? ` (${percent(r.corners_used / r.corners_total, 3)})` : "";
    const warp = r.board_warp_m.filter((w): w is number => w !== null);
    s.cards([
      ...(r.residual_rms_px === null ? [] : [{ label: "Residual, rms per axis", value: `${significant(r.residual_rms_px, 3)} px` }]),
      ...(r.residual_sigma_px === null ? [] : [{ label: "Residual σ", value: `${significant(r.residual_sigma_px, 3)} px`, note: "with degrees of freedom" }]),
      ...(r.corners_used === null ? [] : [{ label: "Corners used", value: count(r.corners_used), note: `of ${count(r.corners_total)}${share}` }]),
      ...(r.views.length === 0 ? [] : [{ label: "Views", value: count(r.views.length), note: `${count(r.views.filter((v) => v.outlier).length)} left out` }]),
      ...(warp.length === 0 ? [] : [{ label: "Warp of the board", value: `${warp.map((w) => significant(w * 1000, 2)).join(", ")} mm` }]),
    ]);
    parameterTable(r, s);
    pairTable(r, s);
    errorsByView(r, s);
    quiverByCamera(r, s);
    residualScatter(r, s);
    viewTables(r, s);
  },
});
