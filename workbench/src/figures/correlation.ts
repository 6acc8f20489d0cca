// Correlations of the parameters of a rig, from its covariance.

import type { Section } from "../book";
import type { Calibrate } from "../data";
import { fixed } from "../format";
import { colourBar } from "../plot";

type Matrix = (number | null)[][];

// Null where a variance is not positive.
export function correlations(covariance: readonly (readonly (number | null)[])[]): Matrix {
  const sd = covariance.map((row, i) => Math.sqrt(row[i] ?? 0));
  return covariance.map((row, i) =>
    covariance.map((_, j) => {
      const [c, scale] = [row[j] ?? null, (sd[i] ?? 0) * (sd[j] ?? 0)];
      return c !== null && scale > 0 ? c / scale : null;
    }),
  );
}

export function strongest(matrix: Matrix, names: readonly (string | null)[], n: number): { a: string; b: string; value: number }[] {
  return matrix
    .flatMap((row, i) => row.slice(0, i).flatMap((value, j) => (value === null ? [] : [{ a: names[j] ?? "?", b: names[i] ?? "?", value }])))
    .sort((a, b) => Math.abs(b.value) - Math.abs(a.value))
    .slice(0, n);
}

export function correlationMatrix(r: Calibrate, s: Section): void {
  const names = r.covariance?.order ?? [];
  const matrix = correlations(r.covariance?.matrix ?? []);
  if (names.length < 2 || matrix.length !== names.length) return;
  const labels = names.map((n, i) => n ?? `parameter ${i + 1}`);
  const few = names.length <= 60;
  const top = strongest(matrix, names, 3).map((p) => `${p.a} with ${p.b} (${fixed(p.value, 3)})`);
  const ticks = { tickfont: { size: few ? 10 : 8 }, showgrid: false, zeroline: false, ...(few ? { dtick: 1 } : {}) };
  s.plot(
    "correlation",
    {
      height: Math.max(380, Math.min(820, 150 + 24 * names.length)),
      maxWidth: Math.max(520, Math.min(960, 260 + 24 * names.length)),
      data: [
        {
          type: "heatmap", x: labels, y: labels, z: matrix, zmin: -1, zmax: 1, colorscale: [[0, "#3b6fb6"], [0.5, "#ffffff"], [1, "#c2542f"]],
          hovertemplate: "%{x} with %{y}: %{z:.3f}<extra></extra>", colorbar: colourBar("", { tickvals: [-1, -0.5, 0, 0.5, 1] }),
        },
      ],
      layout: { xaxis: { ...ticks, tickangle: -60 }, yaxis: { ...ticks, autorange: "reversed" }, margin: { l: 90, r: 20, t: 16, b: 90 } },
    },
    `Correlations of the rig's parameters. Strong ones are no fault: they say which parameters trade against each other, so that one must not be read, or changed, without the other. Strongest: ${top.join(", ")}.`,
  ); // prettier-ignore
}
