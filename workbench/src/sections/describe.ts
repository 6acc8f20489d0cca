// Structure of a canopy: area, angles, gaps.

import type { Section } from "../book";
import { describe as read, type Describe } from "../data";
import { jsonTree } from "../dom";
import { deWit, perDegree } from "../figures/dewit";
import { errorLine } from "../figures/errorbars";
import { area, fixed, length, percent, significant } from "../format";
import { accent, alpha, colour, ink } from "../palette";
import { axisTitle, mark, type Trace } from "../plot";
import { defineSection } from "./section";

const degrees = Array.from({ length: 91 }, (_, i) => i);

function leafAngles(r: Describe, s: Section): void {
  const bins = r.leaf_angle.bins.filter((b) => b.from_deg !== null && b.to_deg !== null && b.density_per_deg !== null);
  if (bins.length === 0) return;
  const bars: Trace = {
    type: "bar",
    name: "this canopy",
    x: bins.map((b) => ((b.from_deg ?? 0) + (b.to_deg ?? 0)) / 2),
    y: bins.map((b) => b.density_per_deg),
    width: bins.map((b) => (b.to_deg ?? 0) - (b.from_deg ?? 0)),
    marker: { color: alpha(accent, 0.35), line: { color: accent, width: 1 } },
    hovertemplate: "%{x}°: %{y:.4f} per degree<extra></extra>",
  };
  const curves = deWit.map((d, i): Trace => ({
    type: "scatter",
    mode: "lines",
    name: d.name,
    x: degrees,
    y: degrees.map((t) => perDegree(d.density, t)),
    line: { color: d.name === "spherical" ? ink : colour(i + 1), width: 1.6, dash: d.name === "spherical" ? "solid" : "dot" },
    visible: ["spherical", "planophile", "erectophile"].includes(d.name) ? true : "legendonly",
    hoverinfo: "name",
  }));
  const mean = r.leaf_angle.mean_deg;
  const line = mean === null ? null : mark(mean, `mean ${fixed(mean, 1)}°`);
  s.plot(
    "angles",
    {
      height: 420,
      data: [bars, ...curves],
      layout: {
        xaxis: { title: axisTitle("leaf inclination from the horizontal (°)"), range: [0, 90], dtick: 15 },
        yaxis: { title: axisTitle("density (per degree)"), rangemode: "tozero" },
        shapes: line ? [line.shape] : [],
        annotations: line ? [line.annotation] : [],
        showlegend: true,
      },
    },
    "Distribution of leaf inclination, weighted by area, with the distributions of de Wit. Names in the legend switch curves on and off.",
  );
}

function angular(r: Describe, s: Section): void {
  const hinge = mark(57.5, "57.5°");
  const layout = (title: string, range?: [number, number]): Record<string, unknown> => ({
    xaxis: { title: axisTitle("zenith angle (°)"), range: [-2, 92], dtick: 15 },
    yaxis: { title: axisTitle(title), rangemode: "tozero", ...(range ? { range } : {}) },
    shapes: [hinge.shape],
    annotations: [hinge.annotation],
    showlegend: false,
  });
  const g = r.g_function.filter((p) => p.zenith_deg !== null && p.g !== null);
  if (g.length > 0) {
    const trace = errorLine({ x: g.map((p) => p.zenith_deg), y: g.map((p) => p.g) }, colour(2));
    const half: Trace = { type: "scatter", mode: "lines", x: [0, 90], y: [0.5, 0.5], line: { color: "#9aa3ad", width: 1, dash: "dot" }, hoverinfo: "skip" };
    s.plot(
      "g",
      { height: 360, data: [half, trace], layout: layout("G(θ)", [0, Math.max(1, ...g.map((p) => (p.g ?? 0) * 1.05))]) },
      "G(θ), the mean projection of a unit of leaf area towards the zenith angle θ. The dotted line is the value of a spherical distribution, 0.5; near 57.5° all distributions come close to it.",
    );
  }
  const gaps = r.gap_fraction.filter((p) => p.zenith_deg !== null && p.p !== null);
  if (gaps.length > 0) {
    const random = randomGaps(r);
    const samples = { x: gaps.map((p) => p.zenith_deg), y: gaps.map((p) => p.p), se: gaps.map((p) => p.standard_error) };
    s.plot(
      "gap",
      { height: 360, data: [...random, errorLine(samples, colour(0), { name: "this canopy" })], layout: { ...layout("gap fraction P(θ)"), showlegend: random.length > 0 } },
      "Gap fraction: the share of rays from the zenith angle θ that reach the ground. Bars are ±1.96 standard errors." +
        (random.length > 0 ? " The dotted line is exp(−G(θ) LAI / cos θ), the gap fraction of the same area scattered at random." : ""),
    );
  }
}

// Beer's law with the report's own G and leaf area index.
function randomGaps(r: Describe): Trace[] {
  const lai = r.lai;
  const g = r.g_function.filter((p) => p.g !== null && p.zenith_deg !== null && p.zenith_deg < 89.9);
  if (lai === null || g.length < 3) return [];
  const y = g.map((p) => Math.exp((-(p.g ?? 0) * lai) / Math.cos(((p.zenith_deg ?? 0) * Math.PI) / 180)));
  return [{ type: "scatter", mode: "lines", name: "random positions", x: g.map((p) => p.zenith_deg), y, line: { color: "#6b7280", width: 1.3, dash: "dot" }, hoverinfo: "skip" }];
}

function tables(r: Describe, s: Section): void {
  const materials = Object.entries(r.materials).map(([name, m]) => ({ name, area_m2: m.area_m2 }));
  const total = materials.reduce((sum, m) => sum + (m.area_m2 ?? 0), 0);
  s.table(
    [
      { head: "material", text: true, cell: (m) => m.name },
      { head: "area", cell: (m) => area(m.area_m2) },
      { head: "share", cell: (m) => percent(total > 0 && m.area_m2 !== null ? m.area_m2 / total : null, 3) },
      { head: "per ground area", cell: (m) => significant(m.area_m2 !== null && r.ground_area_m2 ? m.area_m2 / r.ground_area_m2 : null, 3) },
    ],
    materials,
    "Area by material.",
  );
  s.table(
    [
      { head: "organ", text: true, cell: (o) => o.label ?? o.id },
      { head: "material", text: true, cell: (o) => o.material },
      { head: "length", cell: (o) => length(o.length_m) },
      { head: "area", cell: (o) => area(o.area_m2) },
    ],
    r.organs,
    "Organs.",
  );
}

export const describe = defineSection({
  kind: "describe",
  step: "describe",
  title: "Structure",
  explanation:
    "What the geometry amounts to as a canopy. Areas are one-sided, angles in degrees; inclination is that of the blade from the horizontal, zenith angles are counted from the vertical.",
  read,
  summarise: (r) => ({
    sentence:
      r.lai === null && r.height_m === null && r.leaf_area_m2 === null
        ? null
        : [
            r.lai !== null ? `Leaf area index ${significant(r.lai, 3)}` : r.leaf_area_m2 !== null ? `Leaf area ${area(r.leaf_area_m2)}` : null,
            r.height_m === null ? null : `height ${length(r.height_m, null, 3)}`,
            r.leaf_angle.mean_deg === null ? null : `mean leaf inclination ${fixed(r.leaf_angle.mean_deg, 1)}°`,
          ]
            .filter((x) => x !== null)
            .join(", ") + ".",
    cards: [
      ...(r.lai === null ? [] : [{ label: "Leaf area index", value: significant(r.lai, 3) }]),
      ...(r.height_m === null ? [] : [{ label: "Height", value: length(r.height_m, null, 3) }]),
    ],
  }),
  render: (r, s) => {
    s.cards([
      ...(r.leaf_area_m2 === null ? [] : [{ label: "Leaf area", value: area(r.leaf_area_m2) }]),
      ...(r.ground_area_m2 === null ? [] : [{ label: "Ground area", value: area(r.ground_area_m2) }]),
      ...(r.lai === null ? [] : [{ label: "Leaf area index", value: significant(r.lai, 3) }]),
      ...(r.height_m === null ? [] : [{ label: "Height", value: length(r.height_m, null, 3) }]),
      ...(r.cover === null ? [] : [{ label: "Cover", value: percent(r.cover, 3), note: "seen from above" }]),
      ...(r.leaf_angle.mean_deg === null ? [] : [{ label: "Mean inclination", value: `${fixed(r.leaf_angle.mean_deg, 1)}°` }]),
    ]);
    leafAngles(r, s);
    angular(r, s);
    tables(r, s);
    if (r.profile !== undefined && r.profile !== null) s.add(jsonTree(r.profile, "profile"));
    if (r.overlap !== undefined && r.overlap !== null) s.add(jsonTree(r.overlap, "overlap"));
  },
});
