// Charts: what we use of Plotly, the page's common look, drawing.

import * as Plotly from "plotly.js-cartesian-dist-min";
import { ink, quiet, rule } from "./palette";

type Value = number | string | null;

interface ErrorBars {
  type: "data";
  array: readonly (number | null)[];
  thickness?: number;
  width?: number;
  color?: string;
}

export interface Trace {
  type: "scatter" | "bar" | "heatmap" | "contour";
  x?: readonly Value[];
  y?: readonly Value[];
  z?: readonly (readonly (number | null)[])[]; // of a heatmap
  colorscale?: string | readonly (readonly [number, string])[];
  colorbar?: Record<string, unknown>;
  zsmooth?: "best" | "fast" | false;
  zmin?: number;
  zmax?: number;
  showscale?: boolean;
  contours?: Record<string, unknown>;
  customdata?: readonly unknown[];
  name?: string;
  mode?: "lines" | "markers" | "lines+markers" | "text";
  text?: string | readonly string[];
  textposition?: string;
  textangle?: number;
  textfont?: Record<string, unknown>;
  line?: { color?: string; width?: number; dash?: string; shape?: string };
  marker?: Record<string, unknown>;
  error_y?: ErrorBars;
  error_x?: ErrorBars;
  orientation?: "h";
  fill?: "toself" | "tonexty" | "tozeroy" | "none";
  fillcolor?: string;
  stackgroup?: string;
  width?: number | readonly number[];
  opacity?: number;
  xaxis?: string;
  yaxis?: string;
  legendgroup?: string;
  showlegend?: boolean;
  hoverinfo?: "skip" | "text" | "name" | "x+y+name";
  hovertemplate?: string;
  visible?: true | "legendonly";
}

export interface PlotSpec {
  data: Trace[];
  layout: Record<string, unknown>;
  height: number; // without the legend below
  maxWidth?: number;
}

export const font = 'system-ui, "Segoe UI", "Helvetica Neue", Arial, "DejaVu Sans", sans-serif';

const axis = {
  automargin: true,
  gridcolor: rule,
  linecolor: "#b8bec6",
  zerolinecolor: "#cfd4da",
  zerolinewidth: 1,
  showline: true,
  mirror: true,
  ticks: "outside",
  ticklen: 4,
  tickcolor: "#b8bec6",
  tickfont: { size: 12, color: ink },
};

function isRecord(v: unknown): v is Record<string, unknown> {
  return typeof v === "object" && v !== null && !Array.isArray(v);
}

// The page's defaults under what a figure asks for.
export function withDefaults(layout: Record<string, unknown>): Record<string, unknown> {
  const out: Record<string, unknown> = {
    font: { family: font, size: 13, color: ink },
    paper_bgcolor: "#ffffff",
    plot_bgcolor: "#ffffff",
    margin: { l: 64, r: 20, t: 28, b: 52 },
    hovermode: "closest",
    hoverlabel: { font: { family: font, size: 12 } },
    xaxis: {},
    yaxis: {},
    ...layout,
  };
  for (const name of Object.keys(out)) {
    const own = out[name];
    if (/^[xy]axis\d*$/.test(name) && isRecord(own)) out[name] = { ...axis, ...own };
  }
  return out;
}

export function axisTitle(title: string): { text: string; font: { size: number; color: string }; standoff: number } {
  return { text: title, font: { size: 13, color: ink }, standoff: 8 };
}

export function colourBar(title: string, extra: Record<string, unknown> = {}): Record<string, unknown> {
  return { title: { text: title, side: "right", font: { size: 13, color: ink } }, tickfont: { size: 12 }, thickness: 14, outlinewidth: 0, ...extra };
}

// 1, 2, 5 times powers of ten between two positive numbers, both included up to rounding.
export function oneTwoFive(low: number, high: number): number[] {
  const out: number[] = [];
  if (!(low > 0) || !(high >= low)) return out;
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
    for (const lead of [1, 2, 5]) {
      const value = Number(`${lead}e${e}`);
      if (value >= low * 0.999 && value <= high * 1.001) out.push(value);
    }
  return out;
}

// A vertical dashed line with its name at the top, across one panel.
export function mark(x: number, name: string, xref = "x", yref = "y"): { shape: unknown; annotation: unknown } {
  return {
    shape: {
      type: "line", xref, yref: `${yref} domain`, x0: x, x1: x, y0: 0, y1: 1,
      line: { color: quiet, width: 1.2, dash: "dash" },
    },
    annotation: {
      xref, yref: `${yref} domain`, x, y: 1, xanchor: "left", yanchor: "top", xshift: 3, yshift: -2,
      text: name, showarrow: false, font: { size: 11, color: quiet },
    },
  }; // prettier-ignore
}

// A legend under the chart: as many rows as its names need, for which the chart grows.
export function legendBelow(data: readonly Trace[], width: number): { rows: number; layout: Record<string, unknown> } {
  const names = new Set(data.filter((t) => t.showlegend !== false && t.name !== undefined).map((t) => t.name ?? ""));
  const total = [...names].reduce((sum, n) => sum + 52 + 7.4 * n.length, 0);
  const rows = Math.max(1, Math.ceil(total / Math.max(200, width - 90)));
  return { rows, layout: { orientation: "h", x: 0, yref: "container", y: 0.002, yanchor: "bottom", font: { size: 12 } } };
}

// The layout as it is drawn, with its final height.
export function complete(spec: PlotSpec, width: number): Record<string, unknown> {
  const below = spec.layout["showlegend"] === true && spec.layout["legend"] === undefined ? legendBelow(spec.data, width) : null;
  if (!below) return { ...withDefaults(spec.layout), height: spec.height };
  const extra = 8 + 20 * below.rows;
  const margin = { l: 64, r: 20, t: 28, b: 52, ...(spec.layout["margin"] as object | undefined) };
  const layout = { ...spec.layout, legend: below.layout, margin: { ...margin, b: margin.b + extra } };
  return { ...withDefaults(layout), height: spec.height + extra };
}

export function draw(element: HTMLElement, spec: PlotSpec): void {
  const config = {
    responsive: true,
    displaylogo: false,
    modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"],
    toImageButtonOptions: { format: "svg" },
  };
  const layout = complete(spec, element.clientWidth || 1060);
  // Our traces are a subset of Plotly's; its own types cannot express arbitrary numbers of axes.
  void Plotly.react(element, spec.data as Plotly.Data[], layout as Partial<Plotly.Layout>, config as Partial<Plotly.Config>);
}
