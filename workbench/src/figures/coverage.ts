// Where the corners were in each image: what a lens was fitted to, and the hull outside which it is a guess.

import type { Section } from "../book";
import type { Calibrate } from "../data";
import { percent } from "../format";
import { accent } from "../palette";
import { colourBar, type Trace } from "../plot";
import { cameraNames, imagePanels, imageSize } from "./image_panels";

export type Pixel = [number, number];

// Of the corners that were used.
export function cornersOf(r: Calibrate, camera: string | null): Pixel[] {
  return r.views
    .filter((v) => v.camera === camera && !v.outlier)
    .flatMap((v) => v.residuals.flatMap(([u, w]): Pixel[] => (typeof u === "number" && typeof w === "number" ? [[u, w]] : [])));
}

// Andrew's monotone chain; its corners in one sense of rotation, none repeated.
export function convexHull(points: readonly Pixel[]): Pixel[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const chain = (all: readonly Pixel[]): Pixel[] => {
    const out: Pixel[] = [];
    for (const p of all) {
      for (;;) {
        const [b, a] = [out[out.length - 1], out[out.length - 2]];
        if (!a || !b || (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        out.pop();
      }
      out.push(p);
    }
    return out.slice(0, -1);
  };
  return sorted.length < 3 ? sorted : [...chain(sorted), ...chain(sorted.reverse())];
}

export function hullArea(hull: readonly Pixel[]): number {
  return Math.abs(hull.reduce((sum, p, i) => sum + p[0] * (hull[(i + 1) % hull.length]?.[1] ?? 0) - p[1] * (hull[(i + 1) % hull.length]?.[0] ?? 0), 0)) / 2;
}

export function hullLine(hull: readonly Pixel[], colour: string, at: Partial<Trace>): Trace {
  const closed = hull.length > 0 ? [...hull, hull[0] ?? [0, 0]] : [];
  return {
    type: "scatter", mode: "lines", x: closed.map((p) => p[0]), y: closed.map((p) => p[1]),
    line: { color: colour, width: 1.6, dash: "dash" }, hoverinfo: "skip", showlegend: false, ...at,
  }; // prettier-ignore
}

// How many corners lie in each cell of a grid over the image; an empty cell is null and stays white.
export function cellCounts(points: readonly Pixel[], [w, hgt]: Pixel, columns: number, rows: number): (number | null)[][] {
  const counts = Array.from({ length: rows }, () => new Array<number | null>(columns).fill(null));
  for (const [u, v] of points) {
    const row = counts[Math.min(rows - 1, Math.max(0, Math.floor(((v + 0.5) / hgt) * rows)))];
    const i = Math.min(columns - 1, Math.max(0, Math.floor(((u + 0.5) / w) * columns)));
    if (row) row[i] = (row[i] ?? 0) + 1;
  }
  return counts;
}

export function coverage(r: Calibrate, s: Section): void {
  const all = cameraNames(r).map((name) => ({ name, corners: cornersOf(r, name) })).filter((c) => c.corners.length > 0);
  if (all.length === 0) return;
  const cameras = all.map((c) => {
    const size = imageSize(r, c.name);
    const hull = convexHull(c.corners);
    return { ...c, size, hull, share: hullArea(hull) / (size[0] * size[1]), counts: cellCounts(c.corners, size, 16, 12) };
  });
  const zmax = Math.max(...cameras.flatMap((c) => c.counts.flat().map((n) => n ?? 0)));
  const { panels, layout, height } = imagePanels(cameras.map((c) => `${c.name}: ${percent(c.share)} of the image`), cameras.map((c) => c.size), 96);
  const data = cameras.flatMap((c, i): Trace[] => {
    const at = { xaxis: panels[i]?.x ?? "x", yaxis: panels[i]?.y ?? "y" };
    const centres = (n: number, extent: number): number[] => Array.from({ length: n }, (_, k) => ((k + 0.5) * extent) / n - 0.5);
    return [
      {
        type: "heatmap", x: centres(16, c.size[0]), y: centres(12, c.size[1]), z: c.counts, zmin: 0, zmax, showscale: i === 0,
        colorscale: [[0, "#f1f7f2"], [1, "#5da97a"]], hovertemplate: "%{z} corners<extra></extra>",
        colorbar: colourBar("corners in a cell", { x: 1.01 }), ...at,
      },
      { type: "scatter", mode: "markers", x: c.corners.map((p) => p[0]), y: c.corners.map((p) => p[1]), marker: { color: "#24292f", size: 2.4, opacity: 0.6 }, hoverinfo: "skip", showlegend: false, ...at },
      hullLine(c.hull, accent, at),
    ]; // prettier-ignore
  });
  s.plot(
    "coverage",
    { height, data, layout },
    "Where the corners used were (dots), with their number in each cell of the image; white cells saw none. The dashed line is the convex hull of the corners: " +
      "outside it the lens is an extrapolation.",
  );
}
