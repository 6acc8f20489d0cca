// How sure pairs of cameras place a point, over the distance.

import type { Section } from "../book";
import type { Calibrate } from "../data";
import { significant } from "../format";
import { colour } from "../palette";
import { axisTitle, oneTwoFive, type Trace } from "../plot";

type Row = Calibrate["triangulation"][number];

function byPair(rows: readonly Row[]): { name: string; rows: Row[] }[] {
  const name = (t: Row): string => `${t.a ?? "?"} – ${t.b ?? "?"}`;
  return [...new Set(rows.map(name))].map((n) => ({
    name: n,
    rows: rows.filter((t) => name(t) === n && t.range_m !== null).sort((a, b) => (a.range_m ?? 0) - (b.range_m ?? 0)),
  }));
}

export function triangulationTraces(all: readonly Row[]): Trace[] {
  const parts: { name: string; total: (t: Row) => number | null; observation: (t: Row) => number | null; shift: number }[] = [
    { name: "along the baseline", total: (t) => t.sigma_x_m, observation: (t) => t.observation_sigma_x_m, shift: 2 },
    { name: "across", total: (t) => t.sigma_y_m, observation: (t) => t.observation_sigma_y_m, shift: 5 },
    { name: "depth", total: (t) => t.sigma_z_m, observation: (t) => t.observation_sigma_z_m, shift: 1 },
  ];
  const mm = (v: number | null): number | null => (v === null ? null : 1000 * v);
  const pairs = byPair(all);
  const dashes = ["solid", "dash", "dashdot", "longdash"];
  return pairs.flatMap((pair, k) =>
    parts.flatMap((p): Trace[] => {
      const of = (f: (t: Row) => number | null, name: string, line: Trace["line"]): Trace => ({
        type: "scatter", mode: "lines+markers", name: pairs.length > 1 ? `${pair.name}: ${name}` : name, x: pair.rows.map((t) => t.range_m), y: pair.rows.map((t) => mm(f(t))),
        line: line ?? {}, marker: { color: line?.color, size: line?.dash === "dot" ? 3 : 6 }, hovertemplate: `%{x:.3f} m, ${name}: %{y:.3g} mm<extra>${pair.name}</extra>`,
      }); // prettier-ignore
      const c = colour(p.shift + (pairs.length > 1 ? 3 * k : 0));
      return [of(p.total, p.name, { color: c, width: 2, dash: dashes[k % dashes.length] ?? "solid" }), of(p.observation, `${p.name}, observation alone`, { color: c, width: 1.2, dash: "dot" })];
    }),
  ).filter((t) => t.y?.some((y) => y !== null));
}

export function triangulationCurves(r: Calibrate, s: Section): void {
  const data = triangulationTraces(r.triangulation);
  if (data.length === 0) return;
  const values = data.flatMap((t) => (t.y ?? []).filter((y): y is number => typeof y === "number" && y > 0));
  const ticks = oneTwoFive(Math.min(...values) / 2, Math.max(...values) * 2);
  s.plot(
    "triangulation",
    {
      height: 420,
      maxWidth: 900,
      data,
      layout: {
        xaxis: { title: axisTitle("distance from the middle of the baseline (m)") },
        yaxis: { title: axisTitle("σ of a point (mm)"), type: "log", tickvals: ticks, ticktext: ticks.map((v) => significant(v, 1)) },
        showlegend: true,
      },
    },
    "How sure a point on the common axis of a pair is, seen once by each of its cameras with the residual σ of this calibration as pixel error: lateral along and across the baseline, and in depth. " +
      "Dotted is the part of the observation, which repeated measurements average out; what lies above it is the calibration's, common to all points.",
  );
}
