// Residuals gathered by the point of the target, and turned back into its plane: what a target looks like that
// is not as it was said to be.

import type { Choice, Section } from "../book";
import type { Calibrate } from "../data";
import { length, niceBelow, significant } from "../format";
import { rejected } from "../palette";
import { axisTitle, colourBar, type PlotSpec } from "../plot";

type View = Calibrate["views"][number];
type Target = Calibrate["targets"][number];

export interface BoardPoint {
  x: number; // metres, in the plane of the target
  y: number;
  dx: number; // mean over the views, metres: where the images see the point, less where the solution puts it
  dy: number;
  se: number; // of dx and dy, metres, if views erred independently
  rms_px: number; // per axis
  views: number;
}

// Solves a x = b for several right-hand sides by elimination with pivots; null if singular.
export function solve(a: number[][], b: number[][]): number[][] | null {
  const n = a.length;
  const m = a.map((row, i) => [...row, ...(b[i] ?? [])]);
  for (let k = 0; k < n; ++k) {
    let best = k;
    for (let i = k + 1; i < n; ++i) if (Math.abs(m[i]?.[k] ?? 0) > Math.abs(m[best]?.[k] ?? 0)) best = i;
    const pivot = m[best];
    if (!pivot || Math.abs(pivot[k] ?? 0) < 1e-12) return null;
    m[best] = m[k] ?? [];
    m[k] = pivot;
    m.forEach((row, i) => {
      const factor = i === k ? 0 : (row[k] ?? 0) / (pivot[k] ?? 1);
      if (factor !== 0) pivot.forEach((p, j) => (row[j] = (row[j] ?? 0) - factor * p));
    });
  }
  return m.map((row, i) => row.slice(n).map((v) => v / (row[i] ?? 1)));
}

export interface BoardCorner {
  point: number;
  x: number;
  y: number;
  u: number;
  v: number;
  du: number;
  dv: number;
}

// Pixels as a quadratic function of the place in the plane (a plane where there are few corners), which takes
// in perspective and distortion well enough for its slope; residuals over that slope are metres on the board.
export function inPlane(corners: readonly BoardCorner[]): { point: number; dx: number; dy: number }[] {
  const reach = Math.max(...corners.map((c) => Math.max(Math.abs(c.x), Math.abs(c.y))));
  const terms = corners.length >= 12 ? 6 : 3;
  if (corners.length < 4 || !(reach > 0)) return [];
  const basis = (x: number, y: number): number[] => [1, x, y, x * x, x * y, y * y].slice(0, terms);
  const rows = corners.map((c) => basis(c.x / reach, c.y / reach));
  const sum = (f: (k: number) => number): number => corners.reduce((total, _, k) => total + f(k), 0);
  const index = Array.from({ length: terms }, (_, i) => i);
  const normal = index.map((i) => index.map((j) => sum((k) => (rows[k]?.[i] ?? 0) * (rows[k]?.[j] ?? 0))));
  const right = index.map((i) => [sum((k) => (rows[k]?.[i] ?? 0) * (corners[k]?.u ?? 0)), sum((k) => (rows[k]?.[i] ?? 0) * (corners[k]?.v ?? 0))]);
  const found = solve(normal, right);
  if (!found) return [];
  return corners.flatMap((c) => {
    const [x, y] = [c.x / reach, c.y / reach];
    const by = (derivatives: number[], axis: 0 | 1): number => derivatives.slice(0, terms).reduce((total, d, i) => total + d * (found[i]?.[axis] ?? 0), 0) / reach;
    const [bx, byy] = [[0, 1, 0, 2 * x, y, 0], [0, 0, 1, 0, x, 2 * y]];
    const step = solve([[by(bx, 0), by(byy, 0)], [by(bx, 1), by(byy, 1)]], [[c.du], [c.dv]]); // prettier-ignore
    const [dx, dy] = [step?.[0]?.[0], step?.[1]?.[0]];
    return dx === undefined || dy === undefined ? [] : [{ point: c.point, dx, dy }];
  });
}

function isFlat(target: Target): boolean {
  const extent = (i: number): number => {
    const all = target.nominal_points_m.flatMap((p) => (typeof p[i] === "number" ? [p[i]] : []));
    return all.reduce((m, v) => Math.max(m, v), -Infinity) - all.reduce((m, v) => Math.min(m, v), Infinity);
  };
  return extent(2) < 0.02 * Math.max(extent(0), extent(1));
}

// Older reports name no points: where all corners were used they are in their order.
function cornersOn(target: Target, view: View): BoardCorner[] {
  const points = view.points.length === view.residuals.length ? view.points : view.residuals.length === target.nominal_points_m.length ? view.residuals.map((_, i) => i) : [];
  return view.residuals.flatMap(([u, v, du, dv], i): BoardCorner[] => {
    const point = points[i] ?? -1;
    const [x, y] = target.nominal_points_m[point] ?? [];
    return [u, v, du, dv, x, y].every((k) => typeof k === "number") ? [{ point, x, y, u, v, du, dv } as BoardCorner] : [];
  });
}

export function boardPoints(r: Calibrate, index: number): BoardPoint[] {
  const target = r.targets[index];
  if (!target || !isFlat(target)) return [];
  const sums = new Map<number, { n: number; dx: number; dy: number; squares: number; px: number }>();
  for (const view of r.views.filter((v) => !v.outlier && (v.target ?? 0) === index)) {
    const corners = cornersOn(target, view);
    const residual = new Map(corners.map((c) => [c.point, c.du ** 2 + c.dv ** 2]));
    for (const { point, dx, dy } of inPlane(corners)) {
      const at = sums.get(point) ?? { n: 0, dx: 0, dy: 0, squares: 0, px: 0 };
      sums.set(point, { n: at.n + 1, dx: at.dx + dx, dy: at.dy + dy, squares: at.squares + dx * dx + dy * dy, px: at.px + (residual.get(point) ?? 0) });
    }
  }
  return [...sums].sort((a, b) => a[0] - b[0]).map(([point, t]) => {
    const [x, y] = target.nominal_points_m[point] ?? [];
    const [dx, dy] = [t.dx / t.n, t.dy / t.n];
    const variance = t.n > 1 ? Math.max(0, t.squares / t.n - dx * dx - dy * dy) / 2 / (t.n - 1) : NaN;
    return { x: x ?? 0, y: y ?? 0, dx, dy, se: Math.sqrt(variance), rms_px: Math.sqrt(t.px / (2 * t.n)), views: t.n };
  }); // prettier-ignore
}

export function boardScale(points: readonly BoardPoint[]): number {
  const lengths = points.map((p) => Math.hypot(p.dx, p.dy)).sort((a, b) => a - b);
  const typical = lengths[Math.floor(lengths.length * 0.9)] ?? 0;
  const extent = (of: (p: BoardPoint) => number): number => Math.max(...points.map(of)) - Math.min(...points.map(of));
  const spacing = Math.sqrt((extent((p) => p.x) * extent((p) => p.y)) / Math.max(1, points.length)) || extent((p) => p.x);
  return typical > 0 ? niceBelow((0.8 * spacing) / typical) : 1;
}

export function boardSpec(points: readonly BoardPoint[], scale: number): PlotSpec {
  const mm = (v: number): number => 1000 * v;
  const extent = (of: (p: BoardPoint) => number): [number, number] => [Math.min(...points.map(of)), Math.max(...points.map(of))];
  const [x0, x1] = extent((p) => p.x);
  const [y0, y1] = extent((p) => p.y);
  const pad = 0.08 * Math.max(x1 - x0, y1 - y0);
  return {
    height: Math.round(Math.min(620, 90 + (700 * (y1 - y0 + 2 * pad)) / (x1 - x0 + 2 * pad))),
    maxWidth: 900,
    data: [
      {
        type: "scatter", mode: "lines", x: points.flatMap((p) => [mm(p.x), mm(p.x + scale * p.dx), null]), y: points.flatMap((p) => [mm(p.y), mm(p.y + scale * p.dy), null]),
        line: { color: rejected, width: 1.6 }, hoverinfo: "skip", showlegend: false,
      },
      {
        type: "scatter", mode: "markers", x: points.map((p) => mm(p.x)), y: points.map((p) => mm(p.y)), showlegend: false,
        marker: { color: points.map((p) => p.rms_px), colorscale: "Viridis", size: 8, colorbar: colourBar("rms residual (px)") },
        text: points.map((p) => `(${significant(mm(p.x), 4)}, ${significant(mm(p.y), 4)}) mm, ${p.views} views<br>off by ${significant(mm(p.dx), 2)}, ${significant(mm(p.dy), 2)} mm ± ${significant(mm(p.se), 2)}<br>rms ${significant(p.rms_px, 3)} px`),
        hovertemplate: "%{text}<extra></extra>",
      },
    ],
    layout: {
      xaxis: { title: axisTitle("x on the target (mm)"), range: [mm(x0 - pad), mm(x1 + pad)], constrain: "domain", zeroline: false },
      yaxis: { title: axisTitle("y on the target (mm)"), range: [mm(y1 + pad), mm(y0 - pad)], scaleanchor: "x", constrain: "domain", zeroline: false },
      showlegend: false,
    },
  }; // prettier-ignore
}

export function boardResiduals(r: Calibrate, s: Section): void {
  const known = r.targets.map((target, i) => ({ target, points: boardPoints(r, i) })).filter((t) => t.points.length > 0);
  const scale = boardScale(known.flatMap((t) => t.points));
  const choices = known.map((t): Choice => ({ label: t.target.name ?? "target", spec: () => boardSpec(t.points, scale) }));
  const largest = Math.max(0, ...known.flatMap((t) => t.points.map((p) => Math.hypot(p.dx, p.dy))));
  if (largest === 0) return;
  s.plot(
    "board",
    choices,
    `Residuals over the points of the target, averaged over all views and turned into its plane: lines are drawn ${significant(scale, 3)} times their length, the longest stands for ${length(largest, null, 2)}. ` +
      "Colours are the rms in the images. Points that lie off in all views are misprints, or a bending that the model of the board does not hold.",
  );
}
