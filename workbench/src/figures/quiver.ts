// Residual vectors as scaled line segments from their corner.

import { niceBelow } from "../format";
import type { Trace } from "../plot";

export interface Vector {
  u: number;
  v: number;
  du: number;
  dv: number;
}

export function vectors(rows: readonly (readonly (number | null)[])[]): Vector[] {
  return rows.flatMap(([u, v, du, dv]) =>
    typeof u === "number" && typeof v === "number" && typeof du === "number" && typeof dv === "number"
      ? [{ u, v, du, dv }]
      : [],
  );
}

// A 1-2-5 scale at which the 90th percentile of the lengths covers at most `share` of the image's diagonal.
export function quiverScale(all: readonly Vector[], diagonal: number, share = 0.04): number {
  const lengths = all.map((r) => Math.hypot(r.du, r.dv)).sort((a, b) => a - b);
  const typical = lengths[Math.min(lengths.length - 1, Math.floor(lengths.length * 0.9))] ?? 0;
  return typical > 0 && diagonal > 0 ? niceBelow((share * diagonal) / typical) : 1;
}

export function quiver(all: readonly Vector[], scale: number, colour: string, extra: Partial<Trace>): Trace[] {
  const segments: Trace = {
    type: "scatter",
    mode: "lines",
    x: all.flatMap((r) => [r.u, r.u + scale * r.du, null]),
    y: all.flatMap((r) => [r.v, r.v + scale * r.dv, null]),
    line: { color: colour, width: 1.1 },
    hoverinfo: "skip",
    ...extra,
  };
  const feet: Trace = {
    type: "scatter",
    mode: "markers",
    x: all.map((r) => r.u),
    y: all.map((r) => r.v),
    marker: { color: colour, size: 2.6 },
    text: all.map((r) => `(${r.u.toFixed(1)}, ${r.v.toFixed(1)}): ${r.du.toFixed(3)}, ${r.dv.toFixed(3)} px`),
    hoverinfo: "text",
    ...extra,
    showlegend: false,
  };
  return [segments, feet];
}
