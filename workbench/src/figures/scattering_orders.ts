// How reflectance falls with the scattering order: the mean over the views, and the ratio of successive orders.

import type { Choice, Section } from "../book";
import type { OrderRow, Simulate } from "../data";
import { alpha, ink, orderColour, quiet } from "../palette";
import { axisTitle, type PlotSpec, type Trace } from "../plot";
import { z95 } from "./errorbars";
import { quantityName } from "./reflectance";
import { bandName } from "./view_angles";

const most = 20; // orders shown

export function decaySpec(row: OrderRow): PlotSpec {
  // Orders of a millionth of the first and less are left out.
  const shown = Math.max(3, row.value.filter((v) => v !== null && v > 1e-6 * (row.value[0] ?? 0)).length);
  const value = row.value.slice(0, Math.min(most, shown));
  const at = value.map((_, i) => i + 1);
  const bars: Trace = {
    type: "bar", x: at, y: value, marker: { color: at.map((_, i) => orderColour(i, at.length)) }, name: quantityName(row.quantity), showlegend: false,
    error_y: { type: "data", array: row.standard_error.slice(0, value.length).map((e) => (e === null ? null : z95 * e)), thickness: 1.1, width: 2.5, color: ink },
    hovertemplate: "order %{x}: %{y:.4g}<extra></extra>",
  }; // prettier-ignore
  // A ratio says something where it is known to a fifth of itself.
  const known = row.ratio.slice(0, value.length - 1).map((v, i) => (v !== null && (row.ratio_standard_error[i] ?? Infinity) < 0.2 * v ? v : null));
  const ratios: Trace = {
    type: "scatter", mode: "lines+markers", x: at.slice(1), y: known, yaxis: "y2", name: "ratio to the order before", showlegend: false,
    line: { color: "#d1812a", width: 1.6 }, marker: { color: "#d1812a", size: 6 },
    error_y: { type: "data", array: row.ratio_standard_error.slice(0, value.length - 1).map((e, i) => (known[i] === null || e === null ? null : z95 * e)), thickness: 1.1, width: 2.5, color: "#d1812a" },
    hovertemplate: "order %{x} over the one before: %{y:.3f}<extra></extra>",
  }; // prettier-ignore
  const enough = row.enough_order !== null && row.enough_order <= at.length ? row.enough_order : null;
  return {
    height: 380,
    data: [bars, ratios],
    layout: {
      bargap: 0.25,
      xaxis: { title: axisTitle("scattering order"), dtick: 1, range: [0.4, at.length + 0.6] },
      yaxis: { title: axisTitle(`${quantityName(row.quantity)} of the order`), type: "log", exponentformat: "power" },
      yaxis2: { title: axisTitle("ratio to the order before"), overlaying: "y", side: "right", range: [0, 1], showgrid: false, tickfont: { size: 12, color: "#b06a1c" } },
      margin: { l: 76, r: 70, t: 28, b: 52 },
      shapes: enough === null ? [] : [{ type: "rect", xref: "x", yref: "paper", x0: enough + 0.5, x1: at.length + 0.6, y0: 0, y1: 1, fillcolor: alpha(quiet, 0.1), line: { width: 0 }, layer: "below" }],
      annotations: enough === null || enough + 1 > at.length ? [] : [{ xref: "x", yref: "paper", x: at.length + 0.5, y: 1, xanchor: "right", yanchor: "top", text: "below the standard error", showarrow: false, font: { size: 11, color: quiet } }],
    },
  };
}

export function orderDecay(r: Simulate, s: Section): void {
  const rows = r.orders.filter((row) => row.value.length > 1);
  if (rows.length === 0) return;
  const choices = rows.map((row): Choice => ({ label: [row.sensor, bandName(row)].filter(Boolean).join(", "), spec: () => decaySpec(row) }));
  const enough = rows.map((row) => row.enough_order);
  const depth = enough.every((n): n is number => n !== null) ? ` With max_order = ${Math.max(...enough)} every view would be right within its standard error.` : "";
  s.plot("decay", choices, `Mean over the views by scattering order (bars, logarithmic; the last order kept holds all higher ones) and its ratio to the order before (line, where it is known to 20 %).${depth}`);
}
