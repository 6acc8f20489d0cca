// Lines with error bars, and lines with a shaded confidence band, at 1.96 standard errors.

import type { Trace } from "../plot";
import { alpha } from "../palette";

export const z95 = 1.96;
type Num = number | null;

export interface Samples {
  x: readonly Num[];
  y: readonly Num[];
  se?: readonly Num[];
}

// In the order of x, without the places where x is unknown; a missing y leaves a gap.
export function sorted(s: Samples): { x: number[]; y: Num[]; se: Num[] } {
  const rows = s.x
    .map((x, i) => ({ x, y: s.y[i] ?? null, se: s.se?.[i] ?? null }))
    .filter((r): r is { x: number; y: Num; se: Num } => r.x !== null)
    .sort((a, b) => a.x - b.x);
  return { x: rows.map((r) => r.x), y: rows.map((r) => r.y), se: rows.map((r) => r.se) };
}

export function errorLine(s: Samples, colour: string, extra: Partial<Trace> = {}): Trace {
  const { x, y, se } = sorted(s);
  const trace: Trace = {
    type: "scatter",
    mode: "lines+markers",
    x,
    y,
    line: { color: colour, width: 1.6 },
    marker: { color: colour, size: 5 },
    ...extra,
  };
  if (se.some((e) => e !== null))
    trace.error_y = { type: "data", array: se.map((e) => (e === null ? null : z95 * e)), thickness: 1.1, width: 2.5, color: colour };
  return trace;
}

// The band first, so that the line lies over it.
export function bandLine(s: Samples, colour: string, extra: Partial<Trace> = {}, opacity = 0.16): Trace[] {
  const { x, y, se } = sorted(s);
  const line: Trace = { type: "scatter", mode: "lines", x, y, line: { color: colour, width: 1.5 }, ...extra };
  const known = x.flatMap((xi, i) => {
    const yi = y[i];
    const e = se[i];
    return typeof yi === "number" && typeof e === "number" ? [{ x: xi, low: yi - z95 * e, high: yi + z95 * e }] : [];
  });
  if (known.length < 2) return [line];
  const back = [...known].reverse();
  const band: Trace = {
    ...extra,
    type: "scatter",
    mode: "lines",
    x: [...known, ...back].map((k) => k.x),
    y: [...known.map((k) => k.high), ...back.map((k) => k.low)],
    line: { color: "rgba(0,0,0,0)", width: 0 },
    fill: "toself",
    fillcolor: alpha(colour, opacity),
    hoverinfo: "skip",
    showlegend: false,
  };
  return [band, line];
}
