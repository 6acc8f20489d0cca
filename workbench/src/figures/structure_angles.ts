// Leaf angles, azimuths and G of a canopy beside the curves of theory.

import type { Section } from "../book";
import type { Describe } from "../data";
import { fixed, significant } from "../format";
import { accent, alpha, colour, ink } from "../palette";
import { axisTitle, mark, type Trace } from "../plot";
import { deWit, perDegree } from "./dewit";
import { errorLine } from "./errorbars";
import { betaDensity, deWitG, ellipsoidalDensity } from "./leaf_angle_models";

const degrees = Array.from({ length: 91 }, (_, i) => i);
const radians = (deg: number): number => (deg * Math.PI) / 180;
const shown = ["spherical", "planophile", "erectophile"];

function bars(bins: Describe["leaf_azimuth"]): Trace {
  const known = bins.filter((b) => b.from_deg !== null && b.to_deg !== null && b.density_per_deg !== null);
  return {
    type: "bar",
    name: "this canopy",
    x: known.map((b) => ((b.from_deg ?? 0) + (b.to_deg ?? 0)) / 2),
    y: known.map((b) => b.density_per_deg),
    width: known.map((b) => (b.to_deg ?? 0) - (b.from_deg ?? 0)),
    marker: { color: alpha(accent, 0.35), line: { color: accent, width: 1 } },
    hovertemplate: "%{x}°: %{y:.4f} per degree<extra></extra>",
  };
}

function curve(name: string, density: (t: number) => number, stroke: string, dash: string, visible: Trace["visible"]): Trace {
  return { type: "scatter", mode: "lines", name, x: degrees, y: degrees.map((t) => perDegree(density, t)), line: { color: stroke, width: 1.6, dash }, visible: visible ?? true, hoverinfo: "name" };
}

export function leafAngles(r: Describe, s: Section): void {
  if (r.leaf_angle.bins.length === 0) return;
  const { mean_deg: mean, sd_deg: sd, ellipsoidal_chi: chi, beta } = r.leaf_angle;
  const fitted: Trace[] = [];
  if (beta !== null && beta.mu !== null && beta.nu !== null)
    fitted.push(curve(`beta (μ ${significant(beta.mu, 3)}, ν ${significant(beta.nu, 3)})`, betaDensity(beta.mu, beta.nu), "#d1812a", "solid", true));
  if (chi !== null && chi > 0) fitted.push(curve(`ellipsoidal (χ ${significant(chi, 3)})`, ellipsoidalDensity(chi), "#9c4f96", "dash", true));
  const theory = deWit.map((d, i) =>
    curve(d.name, d.density, d.name === "spherical" ? ink : colour(i + 1), d.name === "spherical" ? "solid" : "dot", shown.includes(d.name) ? true : "legendonly"),
  );
  const line = mean === null ? null : mark(mean, sd === null ? `mean ${fixed(mean, 1)}°` : `mean ${fixed(mean, 1)}°, sd ${fixed(sd, 1)}°`);
  s.plot(
    "angles",
    {
      height: 420,
      data: [bars(r.leaf_angle.bins), ...fitted, ...theory],
      layout: {
        xaxis: { title: axisTitle("leaf inclination from the horizontal (°)"), range: [0, 90], dtick: 15 },
        yaxis: { title: axisTitle("density (per degree)"), range: [0, tallest(r)] },
        shapes: line ? [line.shape] : [],
        annotations: line ? [line.annotation] : [],
        showlegend: true,
      },
    },
    "Distribution of leaf inclination, weighted by area, with the beta and the ellipsoidal distribution fitted to it and those of de Wit. Names in the legend switch curves on and off.",
  );
}

// Room for the bars and de Wit's curves; a fitted curve may leave the frame where it goes to infinity.
function tallest(r: Describe): number {
  return 1.08 * Math.max(0.0225, ...r.leaf_angle.bins.map((b) => b.density_per_deg ?? 0));
}

export function leafAzimuths(r: Describe, s: Section): void {
  if (r.leaf_azimuth.length === 0) return;
  const even: Trace = { type: "scatter", mode: "lines", x: [0, 360], y: [1 / 360, 1 / 360], line: { color: "#6b7280", width: 1.2, dash: "dot" }, hoverinfo: "skip" };
  s.plot(
    "azimuths",
    {
      height: 300,
      data: [bars(r.leaf_azimuth), even],
      layout: {
        xaxis: { title: axisTitle("azimuth of the upward leaf normal (°)"), range: [0, 360], dtick: 45 },
        yaxis: { title: axisTitle("density (per degree)"), rangemode: "tozero" },
        showlegend: false,
      },
    },
    `Distribution of the azimuth of leaf normals, weighted by area (${r.azimuth_convention === "east_counterclockwise" ? "counter-clockwise from east" : "clockwise from north"}). Dotted: no preferred azimuth.`,
  );
}

export function gFunction(r: Describe, s: Section): void {
  const g = r.g_function.filter((p) => p.zenith_deg !== null && p.g !== null);
  if (g.length === 0) return;
  const hinge = mark(57.5, "57.5°");
  const own = errorLine({ x: g.map((p) => p.zenith_deg), y: g.map((p) => p.g) }, accent, { name: "leaves" });
  const whole = r.g_function.filter((p) => p.plant_g !== null);
  const plant: Trace[] = r.stem_area_m2 || r.other_area_m2 ? [{ ...errorLine({ x: whole.map((p) => p.zenith_deg), y: whole.map((p) => p.plant_g) }, "#a7863c", { name: "all surfaces" }), mode: "lines" }] : [];
  const steps = degrees.filter((d) => d % 3 === 0);
  const theory = deWitG.map((d, i): Trace => ({
    type: "scatter", mode: "lines", name: d.name, x: steps, y: steps.map((t) => d.g(radians(t))),
    line: { color: d.name === "spherical" ? ink : colour(i + 1), width: 1.3, dash: "dot" },
    visible: shown.includes(d.name) ? true : "legendonly", hoverinfo: "name",
  })); // prettier-ignore
  s.plot(
    "g",
    {
      height: 400,
      data: [...theory, ...plant, own],
      layout: {
        xaxis: { title: axisTitle("zenith angle (°)"), range: [-2, 92], dtick: 15 },
        yaxis: { title: axisTitle("G(θ)"), range: [0, Math.max(1, ...g.map((p) => (p.g ?? 0) * 1.05))] },
        shapes: [hinge.shape],
        annotations: [hinge.annotation],
        showlegend: true,
      },
    },
    "G(θ), the mean projection of a unit of leaf area towards the zenith angle θ, with the curves of de Wit's distributions, which meet near 57.5°.",
  );
}

export function gByAzimuth(r: Describe, s: Section): void {
  const of = r.g_by_azimuth;
  if (of === null || of.g.length === 0 || of.azimuth_deg.length === 0) return;
  s.plot(
    "g-azimuth",
    {
      height: 320,
      data: [{ type: "heatmap", x: of.azimuth_deg, y: of.zenith_deg, z: of.g, colorscale: "Viridis", colorbar: { title: { text: "G(θ, φ)" } }, hovertemplate: "φ %{x}°, θ %{y}°: %{z:.3f}<extra></extra>" }],
      layout: {
        xaxis: { title: axisTitle("azimuth φ (°)"), dtick: 45 },
        yaxis: { title: axisTitle("zenith angle θ (°)"), dtick: 30 },
        showlegend: false,
      },
    },
    "G by azimuth: where leaves have a preferred azimuth, as much leaf area is not seen from all sides.",
  );
}

export function scattering(r: Describe, s: Section): void {
  const of = r.area_scattering;
  if (of === null || of.tables.length === 0) return;
  const bands = [...new Set(of.tables.map((t) => t.band ?? ""))];
  const spec = (band: string) => {
    const tables = of.tables.filter((t) => (t.band ?? "") === band);
    return {
      height: 380,
      data: tables.map((t, i): Trace => {
        // The principal plane as one line: on the source's side negative.
        const plane = t.view_zenith_deg
          .map((zenith, k) => ({ zenith, azimuth: t.relative_azimuth_deg[k] ?? null, gamma: t.gamma[k] ?? null }))
          .filter((p) => p.zenith !== null && (p.azimuth === 0 || p.azimuth === 180))
          .map((p) => ({ x: p.azimuth === 0 ? -(p.zenith ?? 0) : (p.zenith ?? 0), y: p.gamma }))
          .sort((a, b) => a.x - b.x);
        return { type: "scatter", mode: "lines", name: `light from ${fixed(t.source_zenith_deg, 0)}°`, x: plane.map((p) => p.x), y: plane.map((p) => p.y), line: { color: colour(i), width: 1.8 } };
      }),
      layout: {
        xaxis: { title: axisTitle("view zenith in the plane of the light (°), negative on its side"), range: [-180, 180], dtick: 45 },
        yaxis: { title: axisTitle("Γ"), rangemode: "tozero" },
        shapes: [mark(-90, "").shape, mark(90, "").shape],
        showlegend: true,
      },
    };
  };
  s.plot(
    "scattering",
    bands.map((band) => ({ label: band === "" ? "all bands" : band, spec: () => spec(band) })),
    "The leaf area scattering phase function Γ, averaged over the azimuth of the canopy: reflected upwards between the dashed lines, and downwards outside of them (beyond 90°).",
  );
}
