// Residuals by frame, and against the normal curve.

import type { Section } from "../book";
import type { Calibrate } from "../data";
import { count, percent } from "../format";
import { colour, ink, quiet, rejected } from "../palette";
import { axisTitle, type PlotSpec, type Trace } from "../plot";
import { histogram } from "./histogram";
import { cameraNames } from "./image_panels";
import { vectors } from "./quiver";

type View = Calibrate["views"][number];

export function frameNames(r: Calibrate): string[] {
  const names = [...(r.poses?.frames ?? []), ...r.views.map((v) => v.frame)];
  return [...new Set(names.filter((n): n is string => n !== null))];
}

// Per axis, over the residuals of the views.
export function rmsOf(views: readonly View[]): number | null {
  const all = vectors(views.flatMap((v) => v.residuals));
  return all.length === 0 ? null : Math.sqrt(all.reduce((sum, p) => sum + p.du ** 2 + p.dv ** 2, 0) / (2 * all.length));
}

export function errorsByFrame(r: Calibrate, s: Section): void {
  const frames = frameNames(r);
  if (frames.length < 2) return;
  const kept = r.views.filter((v) => !v.outlier);
  const of = (views: readonly View[]): (number | null)[] => frames.map((f) => rmsOf(views.filter((v) => v.frame === f)));
  const names = cameraNames(r);
  const line = (name: string, y: (number | null)[], c: string, width: number): Trace => ({
    type: "scatter", mode: "lines+markers", name, x: frames, y, line: { color: c, width }, marker: { color: c, size: width > 2 ? 6 : 4 },
    hovertemplate: `frame %{x}, ${name}: %{y:.3f} px<extra></extra>`,
  }); // prettier-ignore
  const data = names.map((n, i) => line(n, of(kept.filter((v) => v.camera === n)), colour(i + 2), 1.2));
  if (names.length > 1) data.push(line("all cameras", of(kept), ink, 2.4));
  const out = r.views.filter((v) => v.outlier && v.frame !== null && v.rms_px !== null);
  if (out.length > 0)
    data.push({ type: "scatter", mode: "markers", name: "left out", x: out.map((v) => v.frame), y: out.map((v) => v.rms_px), text: out.map((v) => v.image ?? ""), hovertemplate: "%{text}: %{y:.3f} px<extra></extra>", marker: { color: rejected, symbol: "x", size: 8 } });
  const mean = rmsOf(kept);
  s.plot(
    "frames",
    {
      height: 340,
      data: data.filter((t) => t.y?.some((y) => y !== null)),
      layout: {
        xaxis: { title: axisTitle("frame"), type: "category", categoryorder: "array", categoryarray: frames },
        yaxis: { title: axisTitle("rms residual (px)"), rangemode: "tozero" },
        shapes: mean === null ? [] : [{ type: "line", xref: "paper", x0: 0, x1: 1, y0: mean, y1: mean, line: { color: quiet, width: 1, dash: "dot" } }],
        showlegend: true,
      },
    },
    "Root mean square of the residuals, per axis, of the corners used in each frame, in the order in which the frames were taken; dotted: of all frames. " +
      "A frame that stands out in every camera was moved or bent; a drift along the frames is a camera that changed.",
  );
}

// Residuals in units of the standard deviation that the solution gives them.
export function normalised(r: Calibrate): number[] {
  const sigma = r.residual_sigma_px;
  if (sigma === null || !(sigma > 0)) return [];
  return vectors(r.views.filter((v) => !v.outlier).flatMap((v) => v.residuals)).flatMap((p) => [p.du / sigma, p.dv / sigma]);
}

function normalPlot(values: readonly number[], logarithmic: boolean): PlotSpec {
  const bins = histogram(values, -5, 5, 50);
  const density = bins.counts.map((n) => n / (values.length * bins.width));
  const x = Array.from({ length: 201 }, (_, i) => -5 + i / 20);
  const axis = logarithmic ? { type: "log", range: [Math.log10(0.3 / (values.length * bins.width)), 0] } : { rangemode: "tozero" };
  return {
    height: 380,
    maxWidth: 760,
    data: [
      { type: "bar", name: "residuals", x: bins.centres, y: density, width: bins.width, marker: { color: "#a9c7b4" }, customdata: bins.counts, hovertemplate: "%{x:.1f} σ: %{customdata}<extra></extra>" },
      { type: "scatter", mode: "lines", name: "normal curve", x, y: x.map((t) => Math.exp(-t * t / 2) / Math.sqrt(2 * Math.PI)), line: { color: ink, width: 1.6 }, hoverinfo: "skip" },
    ],
    layout: { bargap: 0, xaxis: { title: axisTitle("residual / σ"), range: [-5.05, 5.05], dtick: 1 }, yaxis: { title: axisTitle("probability density"), ...axis }, showlegend: true },
  }; // prettier-ignore
}

export function normalCurve(r: Calibrate, s: Section): void {
  const values = normalised(r);
  if (values.length < 20) return;
  const beyond = (k: number): string => percent(values.filter((v) => Math.abs(v) > k).length / values.length);
  s.plot(
    "normal",
    [
      { label: "density", spec: () => normalPlot(values, false) },
      { label: "density, logarithmic (tails)", spec: () => normalPlot(values, true) },
    ],
    `${count(values.length)} residuals (both axes of the corners used) in units of their σ, against the normal curve; the outermost bars hold what lies beyond. ` +
      `Beyond 2 σ lie ${beyond(2)} (normal: 4.6 %), beyond 3 σ ${beyond(3)} (0.27 %). Heavy tails are bad corners, a narrow peak with broad shoulders views of different quality.`,
  );
}
