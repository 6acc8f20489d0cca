// Points in space from digitised image points.

import type { Section } from "../book";
import { reconstruct as read, type Reconstruct } from "../data";
import { histogram } from "../figures/histogram";
import { photoOverlay } from "../figures/photo_overlay";
import { scene3d } from "../figures/scene3d";
import type { Point3 } from "../figures/scene3d_content";
import { count, length, median, missing, plural, sentenceCase, significant, withSigma } from "../format";
import { organs, type Organs } from "../organs";
import { colour, rejected } from "../palette";
import { axisTitle, mark } from "../plot";
import { defineSection } from "./section";

type Curve = Reconstruct["curves"][number];

function position(p: Curve["points"][number]): Point3 | null {
  return p.x_m === null || p.y_m === null || p.z_m === null ? null : [p.x_m, p.y_m, p.z_m];
}

function triple(of: readonly (number | null)[]): Point3 | null {
  const [x, y, z] = of;
  return typeof x === "number" && typeof y === "number" && typeof z === "number" ? [x, y, z] : null;
}

function photographs(r: Reconstruct, names: Organs, s: Section): void {
  if (r.photographs.length === 0) return;
  s.figure(
    "photographs",
    photoOverlay(r.photographs, r.curves, names),
    "The photographs with the reconstruction projected back into them (lines) and the digitised points (circles); midribs are thick, outlines thin. " +
      "Rejected points are red with a cross and take no part in the lines. Point at a circle to read its name.",
  );
}

function space(r: Reconstruct, names: Organs, s: Section): void {
  const used = r.curves.map((c) => ({ c, points: c.points.filter((p) => !p.rejected).flatMap((p) => [position(p)]).filter((p) => p !== null) }));
  if (!used.some((u) => u.points.length > 1)) return;
  const vertical = triple(r.vertical_m);
  const up: Point3 = vertical ?? [0, -1, 0];
  const towards: Point3 = triple(r.towards_cameras) ?? [0, 0, -1];
  const scene = scene3d({
    curves: used.map(({ c, points }) => ({ label: names.full(c), colour: names.colour(c), points, width: /midrib|axis/.test(c.feature ?? "axis") ? 3 : 1.3 })),
    dots: used.map(({ c, points }) => ({ points, colour: names.colour(c), size: 5 })),
    up,
    viewFrom: [towards[0] + 0.35 * up[0] + 0.1, towards[1] + 0.35 * up[1], towards[2] + 0.35 * up[2]],
    height: 540,
  });
  s.figure("curves", scene.element, `The curves in space, seen from the side of the cameras${vertical ? "; the vertical is the measured one" : "; up is the first camera's up"}.`, scene.start);
}

function checkFigure(r: Reconstruct, s: Section): void {
  const points = r.check?.points.filter((p) => p.ratio !== null) ?? [];
  if (!r.check || points.length === 0) return;
  const top = Math.min(12, Math.max(4, Math.ceil(Math.max(...points.map((p) => p.ratio ?? 0)))));
  const bars = (rejectedOnes: boolean) =>
    histogram(points.filter((p) => (p.rejected ?? false) === rejectedOnes).map((p) => Math.abs(p.ratio ?? 0)), 0, top, top * 4);
  const good = bars(false);
  const bad = bars(true);
  const middle = r.check.median_ratio ?? median(points.map((p) => p.ratio));
  const line = middle === null ? null : mark(middle, `median ${significant(middle, 3)}`);
  s.plot(
    "check",
    {
      height: 360,
      data: [
        { type: "bar", name: "used", x: good.centres, y: good.counts, marker: { color: colour(2) } },
        ...(bad.counts.some((n) => n > 0) ? [{ type: "bar" as const, name: "rejected", x: bad.centres, y: bad.counts, marker: { color: rejected } }] : []),
      ],
      layout: {
        barmode: "stack",
        bargap: 0.04,
        xaxis: { title: axisTitle("|ΔZ| / σ"), range: [0, top], ...(top === 12 ? { tickvals: [0, 2, 4, 6, 8, 10, 12], ticktext: ["0", "2", "4", "6", "8", "10", "≥ 12"] } : {}) },
        yaxis: { title: axisTitle("points"), range: [0, 1.18 * Math.max(...good.counts.map((n, i) => n + (bad.counts[i] ?? 0)))] },
        shapes: line ? [line.shape] : [],
        annotations: line ? [line.annotation] : [],
        legend: { x: 1, xanchor: "right", y: 1, yanchor: "top", orientation: "v" },
        showlegend: true,
      },
    },
    `Check by ${r.check.name ?? "an independent measurement"}: distances in depth in units of their σ` +
      `${top === 12 ? " (values above 12 in the last bar)" : ""}. If the σ are right, half of the points lie below 0.674.`,
  );
}

function rejectedTable(r: Reconstruct, names: Organs, s: Section): void {
  s.table(
    [
      { head: "organ", text: true, cell: (p) => names.name(p) },
      { head: "feature", text: true, cell: (p) => p.feature?.replace(/_/g, " ") },
      { head: "point", cell: (p) => p.point },
      { head: "χ²", cell: (p) => significant(p.chi2, 3) },
      { head: "reason", text: true, cell: (p) => p.reason ?? missing },
    ],
    r.rejected,
    "Rejected points by name.",
  );
}

function measured(f: Reconstruct["figures"][number]): string {
  return f.unit === "m" ? length(f.value, f.sigma) : withSigma(f.value, f.sigma, f.unit === "deg" ? "°" : (f.unit ?? ""));
}

function figuresTable(r: Reconstruct, s: Section): void {
  s.table(
    [
      { head: "quantity", text: true, cell: (f) => sentenceCase(f.name ?? "") },
      { head: "value ± σ", cell: measured },
      { head: "remark", text: true, cell: (f) => f.note },
    ],
    r.figures,
    "Figures measured on the reconstruction.",
  );
}

export const reconstruct = defineSection({
  kind: "reconstruct",
  step: "reconstruct",
  title: "Reconstruction in space",
  explanation:
    "Points digitised in several photographs are intersected to points in space, each with its covariance; points whose rays do not meet are rejected by name. " +
    "Image coordinates are pixels with centres at integers, positions are in metres.",
  read,
  summarise: (r) => ({
    sentence:
      r.points === null && r.curves.length === 0
        ? null
        : `${plural(r.points ?? r.curves.reduce((n, c) => n + c.points.length, 0), "point")} reconstructed, ${count(r.rejected.length)} rejected` +
          `${r.reprojection_rms_px === null ? "" : `, reprojected to ${significant(r.reprojection_rms_px, 3)} px rms`}.`,
    cards: [
      ...r.figures.slice(0, 1).map((f) => ({ label: sentenceCase(f.name ?? ""), value: measured(f) })),
      ...(r.reprojection_rms_px === null ? [] : [{ label: "Reprojection", value: `${significant(r.reprojection_rms_px, 3)} px`, note: "rms" }]),
    ],
  }),
  render: (r, s) => {
    const names = organs(r.curves.length > 0 ? r.curves : r.rejected);
    const sigma = median(r.curves.flatMap((c) => c.points.map((p) => p.sigma_m[2] ?? null)));
    s.cards([
      ...(r.points === null ? [] : [{ label: "Points", value: count(r.points) }]),
      { label: "Rejected", value: count(r.rejected.length) },
      ...(r.reprojection_rms_px === null ? [] : [{ label: "Reprojection, rms", value: `${significant(r.reprojection_rms_px, 3)} px` }]),
      ...(sigma === null ? [] : [{ label: "σ in depth, median", value: length(sigma, null, 2) }]),
      ...(typeof r.check?.median_ratio !== "number" ? [] : [{ label: "Median |ΔZ| / σ", value: significant(r.check.median_ratio, 3), note: "0.674 expected" }]),
    ]);
    photographs(r, names, s);
    figuresTable(r, s);
    rejectedTable(r, names, s);
    checkFigure(r, s);
    space(r, names, s);
  },
});

