// Fitted functions of all organs, a panel for each function; measured points against fitted midribs.

import type { Section } from "../book";
import type { Fit } from "../data";
import { sentenceCase } from "../format";
import type { Organs } from "../organs";
import { alpha } from "../palette";
import { axisTitle, type Trace } from "../plot";
import { bandLine } from "./errorbars";
import { panelGrid } from "./panels";

type Organ = Fit["organs"][number];

const order = ["inclination", "azimuth", "twist", "width", "curvature"];

function scaleAndUnit(name: string, unit: string | null): [number, string] {
  if (unit === "m" || (unit === null && name === "width")) return [1000, "mm"];
  return [1, unit === null || unit === "deg" ? "°" : unit];
}

const times = (scale: number, v: readonly (number | null)[]): (number | null)[] => v.map((x) => (x === null ? null : x * scale));

export function functionPanels(r: Fit, names: Organs, s: Section): void {
  const present = [...new Set(r.organs.flatMap((o) => Object.keys(o.functions)))].filter((f) =>
    r.organs.some((o) => (o.functions[f]?.curve?.l.length ?? 0) > 1),
  );
  const rank = (f: string): number => (order.includes(f) ? order.indexOf(f) : order.length);
  const functions = present.sort((a, b) => rank(a) - rank(b));
  if (functions.length === 0) return;
  const units = functions.map((f) => scaleAndUnit(f, r.organs.find((o) => o.functions[f]?.unit)?.functions[f]?.unit ?? null));
  const grid = panelGrid(functions.map(sentenceCase), {
    columns: 2,
    xTitle: "normalised arc length l",
    yTitle: functions.map((f, i) => `${f} (${units[i]?.[1] ?? ""})`),
    gapX: 0.1,
    gapY: 0.13,
  });
  const seen = new Set<string>();
  const opacity = Math.min(0.16, 1 / Math.max(1, r.organs.length));
  const data: Trace[] = functions.flatMap((f, i) =>
    r.organs.flatMap((o) => {
      const curve = o.functions[f]?.curve;
      if (!curve) return [];
      const [scale] = units[i] ?? [1];
      const name = names.name(o);
      const at = {
        name,
        legendgroup: name,
        showlegend: !seen.has(name),
        xaxis: grid.panels[i]?.x ?? "x",
        yaxis: grid.panels[i]?.y ?? "y",
      };
      seen.add(name);
      return [...bandLine({ x: curve.l, y: times(scale, curve.value), se: times(scale, curve.sigma) }, names.colour(o), at, opacity), ...measured(o, f, scale, names.colour(o), at)];
    }),
  );
  s.plot(
    "functions",
    {
      height: 320 * grid.rows + 80,
      data,
      layout: { ...grid.layout, annotations: grid.annotations, showlegend: true },
    },
    "The fitted functions, a line for each organ with its band of ±1.96 σ; dots are measured values where the input has them. Click a name in the legend to hide an organ, double-click to see it alone.",
  );
}

function measured(o: Organ, f: string, scale: number, colour: string, at: Partial<Trace>): Trace[] {
  const l = o.measured["l"] ?? [];
  const values = o.measured[f] ?? [];
  if (l.length === 0 || values.length === 0) return [];
  return [
    { type: "scatter", mode: "markers", ...at, x: l, y: times(scale, values), marker: { color: alpha(colour, 0.6), size: 4 }, showlegend: false },
  ];
}

// In the organ's own vertical plane: along the horizontal direction to the point farthest from the base, and up.
export function inPlane(points: readonly (readonly (number | null)[])[], reference = points): { r: number; z: number }[] {
  const known = (list: typeof points): [number, number, number][] =>
    list.flatMap(([x, y, z]) => (typeof x === "number" && typeof y === "number" && typeof z === "number" ? [[x, y, z] as [number, number, number]] : []));
  const frame = known(reference);
  const base = frame[0];
  if (!base) return [];
  let ux = 1;
  let uy = 0;
  let far = 0;
  for (const [x, y] of frame) {
    const d = Math.hypot(x - base[0], y - base[1]);
    if (d > far) [far, ux, uy] = [d, (x - base[0]) / d, (y - base[1]) / d];
  }
  return known(points).map(([x, y, z]) => ({ r: (x - base[0]) * ux + (y - base[1]) * uy, z: z - base[2] }));
}

export function midribs(r: Fit, names: Organs, s: Section): void {
  const shown = r.organs.filter((o) => o.points_m.length > 1 && o.fitted_m.length > 1);
  if (shown.length === 0) return;
  const data = shown.flatMap((o): Trace[] => {
    const colour = names.colour(o);
    const name = names.name(o);
    const line = inPlane(o.fitted_m, o.points_m);
    const dots = inPlane(o.points_m);
    const mm = (v: number): number => v * 1000;
    return [
      { type: "scatter", mode: "lines", name, legendgroup: name, x: line.map((p) => mm(p.r)), y: line.map((p) => mm(p.z)), line: { color: colour, width: 1.6 } },
      { type: "scatter", mode: "markers", name, legendgroup: name, showlegend: false, x: dots.map((p) => mm(p.r)), y: dots.map((p) => mm(p.z)), marker: { color: "#ffffff", size: 6, line: { color: colour, width: 1.4 } } },
    ];
  });
  s.plot(
    "midribs",
    {
      height: 480,
      maxWidth: 760,
      data,
      layout: {
        xaxis: { title: axisTitle("horizontal distance from the base (mm)"), constrain: "domain", constraintoward: "left" },
        yaxis: { title: axisTitle("height above the base (mm)"), scaleanchor: "x", constrain: "domain" },
        showlegend: true,
      },
    },
    "Measured points (circles) and fitted midribs (lines), each organ turned into the vertical plane through its base and the point farthest from it.",
  );
}
