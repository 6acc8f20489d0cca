// Residuals of a calibration: by view, over the image, as a cloud.

import type { Section } from "../book";
import type { Calibrate } from "../data";
import { fileNames, niceBelow, significant } from "../format";
import { colour, rejected } from "../palette";
import { axisTitle, type Trace } from "../plot";
import { cameraNames, imagePanels, imageSize } from "./image_panels";
import { quiver, quiverScale, vectors, type Vector } from "./quiver";

export function errorsByView(r: Calibrate, s: Section): void {
  const views = r.views.filter((v) => v.rms_px !== null);
  if (views.length === 0) return;
  const names = cameraNames(r);
  const short = fileNames(views.map((v) => v.image ?? "?"));
  const label = (v: Calibrate["views"][number]): string => short(v.image ?? "?");
  const bar = (name: string, chosen: typeof views, c: string): Trace => ({
    type: "bar",
    name,
    x: chosen.map(label),
    y: chosen.map((v) => v.rms_px),
    text: chosen.map((v) => (v.image ?? "") + (v.outlier && v.reason ? `<br>left out: ${v.reason}` : "")),
    hovertemplate: "%{text}<br>%{y:.3f} px<extra></extra>",
    marker: { color: c },
    textposition: "none",
  });
  const kept = names.map((n, i) => bar(n, views.filter((v) => v.camera === n && !v.outlier), colour(i + 2)));
  const outliers = views.filter((v) => v.outlier);
  const red: Trace = { ...bar("left out", outliers, rejected), text: outliers.map(label), textposition: "inside", textangle: -90, textfont: { color: "#ffffff", size: 10 } };
  const unnamed = views.filter((v) => v.camera === null && !v.outlier);
  const data = [...kept, ...(unnamed.length > 0 ? [bar("no camera", unnamed, "#9aa3ad")] : []), red];
  s.plot(
    "views",
    {
      height: 380,
      data: data.filter((t) => (t.x?.length ?? 0) > 0),
      layout: {
        barmode: "overlay",
        bargap: 0.25,
        xaxis: { categoryorder: "array", categoryarray: views.map(label), tickangle: -50, tickfont: { size: views.length > 45 ? 8 : 10 }, dtick: views.length > 80 ? undefined : 1 },
        yaxis: { title: axisTitle("rms residual (px)"), rangemode: "tozero" },
        legend: { orientation: "h", x: 0, y: 1.02, yanchor: "bottom" },
        showlegend: true,
        margin: { l: 64, r: 20, t: 36, b: 90 },
      },
    },
    "Root mean square of the residuals of each view. Views left out of the solution are red" +
      (outliers.length > 0 ? `: ${outliers.map(label).join(", ")}.` : "; here there are none."),
  );
}

export function quiverByCamera(r: Calibrate, s: Section): void {
  const names = cameraNames(r).filter((n) => r.views.some((v) => v.camera === n && v.residuals.length > 0));
  if (names.length === 0) return;
  const of = (name: string, outlier: boolean): Vector[] =>
    vectors(r.views.filter((v) => v.camera === name && (v.outlier ?? false) === outlier).flatMap((v) => v.residuals));
  const sizes = names.map((n) => imageSize(r, n));
  const scale = quiverScale(names.flatMap((n) => of(n, false)), Math.max(...sizes.map(([w, hgt]) => Math.hypot(w, hgt))));
  const { panels, layout, height } = imagePanels(names, sizes);
  const data = names.flatMap((name, i) => {
    const p = panels[i];
    const at = { xaxis: p?.x ?? "x", yaxis: p?.y ?? "y" };
    return [...quiver(of(name, true), scale, rejected, { ...at, opacity: 0.35 }), ...quiver(of(name, false), scale, colour(i + 2), at)];
  });
  s.plot(
    "quiver",
    { height, data, layout },
    `Residual vectors over the image of each camera, drawn ${significant(scale, 3)} times their length: a line of ${significant(scale, 3)} px stands for 1\u00a0px. ` +
      "Dots are the corners; red ones belong to views left out. A sound lens model leaves no pattern.",
  );
}

export function residualScatter(r: Calibrate, s: Section): void {
  const names = cameraNames(r);
  const all = names.map((n) => vectors(r.views.filter((v) => v.camera === n && !v.outlier).flatMap((v) => v.residuals)));
  const largest = Math.max(0, ...all.flat().map((p) => Math.max(Math.abs(p.du), Math.abs(p.dv))));
  if (largest === 0) return;
  const range = [-1.08 * largest, 1.08 * largest];
  const dtick = niceBelow(largest / 2);
  const data = names.map((name, i): Trace => ({
    type: "scatter",
    mode: "markers",
    name,
    x: (all[i] ?? []).map((p) => p.du),
    y: (all[i] ?? []).map((p) => p.dv),
    marker: { color: colour(i + 2), size: 4, opacity: 0.55 },
    hoverinfo: "skip",
  }));
  s.plot(
    "scatter",
    {
      height: 500,
      maxWidth: 560,
      data,
      layout: {
        xaxis: { title: axisTitle("du (px)"), range, dtick, constrain: "domain" },
        yaxis: { title: axisTitle("dv (px)"), range, dtick, scaleanchor: "x", constrain: "domain" },
        legend: { orientation: "h", x: 0, y: 1.01, yanchor: "bottom" },
        showlegend: true,
      },
    },
    "All residuals of the views that were used. The cloud should be round and centred on zero.",
  );
}
