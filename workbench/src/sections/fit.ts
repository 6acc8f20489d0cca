// Functions of arc length fitted to measured organs.

import type { Section } from "../book";
import { fit as read, type Fit } from "../data";
import { functionPanels, midribs } from "../figures/organ_functions";
import { count, fixed, length, missing, percent, plural, significant } from "../format";
import { organs, type Organs } from "../organs";
import { defineSection } from "./section";

// As on the command line: p:3 is a polynomial of degree 3.
function kindName(kind: string | null, order: number | null): string {
  if (kind === null) return missing;
  return order === null ? kind : `${kind}:${order}`;
}

const kinds = "p:K is a polynomial of degree K, f:K has K harmonics, n:K and s:K have K knots.";

function organTable(r: Fit, names: Organs, s: Section): void {
  const functions = [...new Set(r.organs.flatMap((o) => Object.keys(o.functions)))];
  s.table(
    [
      { head: "organ", text: true, cell: (o) => names.name(o) },
      { head: "points", cell: (o) => count(o.points) },
      { head: "length", cell: (o) => length(o.length_m, o.length_sigma_m) },
      { head: "width", cell: (o) => length(o.width_m, o.width_sigma_m, 3) },
      { head: "rms", unit: "mm", cell: (o) => significant(o.rms_m === null ? null : o.rms_m * 1000, 2) },
      { head: "rms", unit: "% of length", cell: (o) => significant(o.rms_fraction === null ? null : o.rms_fraction * 100, 2) },
      { head: "χ²/dof", cell: (o) => significant(o.chi2_per_dof, 3) },
      ...functions.map((f) => ({
        head: f,
        text: true,
        cell: (o: Fit["organs"][number]) => {
          const g = o.functions[f];
          return g ? kindName(g.kind, g.order) : missing;
        },
      })),
    ],
    r.organs,
    "Each organ with the functions that the evidence (AICc) chose. The rms is that of the residual at equal normalised arc length. " + kinds,
  );
}

// AICc compares what was tried for one function of one organ; figures of different functions have nothing in common.
function evidence(r: Fit, names: Organs, s: Section): void {
  const rows = r.organs.flatMap((o) => {
    const functions = [...new Set(o.aicc_table.map((a) => a.function))];
    return functions.flatMap((f) => {
      const tried = o.aicc_table.filter((a) => a.function === f && a.aicc !== null);
      const best = Math.min(...tried.map((a) => a.aicc ?? Infinity));
      const delta = new Map(tried.map((a) => [kindName(a.kind, a.order), (a.aicc ?? 0) - best]));
      return delta.size === 0 ? [] : [{ o, function: f, delta }];
    });
  });
  const tried = [...new Set(rows.flatMap((row) => [...row.delta.keys()]))];
  s.table(
    [
      { head: "organ", text: true, cell: (row) => names.name(row.o) },
      { head: "function", text: true, cell: (row) => row.function ?? missing },
      ...tried.map((kind) => ({ head: kind, cell: (row: (typeof rows)[number]) => fixed(row.delta.get(kind), 1) })),
    ],
    rows,
    "ΔAICc of what was tried for each function, against the best (0). A difference above 10 leaves little doubt. " + kinds,
  );
}

export const fit = defineSection({
  kind: "fit",
  step: "fit",
  title: "Functions of the organs",
  explanation:
    "Each organ is described by functions of its normalised arc length l, from 0 at the base to 1 at the tip: inclination, azimuth and twist in degrees, width in millimetres. " +
    "Shaded bands are ±1.96 σ of the fitted function.",
  read,
  summarise: (r) => {
    const n = r.summary.organs ?? r.organs.length;
    const typical = r.summary.rms_fraction_median;
    return {
      sentence:
        n === 0
          ? null
          : `${plural(n, "organ")} fitted${typical === null ? "" : `, median residual ${percent(typical)} of the length`}` +
            `${r.summary.failed ? `; ${plural(r.summary.failed, "organ")} failed` : ""}.`,
      cards: typical === null ? [] : [{ label: "Fit residual", value: percent(typical), note: "of the length, median" }],
    };
  },
  render: (r, s) => {
    const names = organs(r.organs);
    const m = r.summary;
    s.cards([
      { label: "Organs", value: count(m.organs ?? r.organs.length), note: m.failed === null ? "" : `${count(m.failed)} failed` },
      ...(m.rms_fraction_median === null ? [] : [{ label: "rms over length, median", value: percent(m.rms_fraction_median) }]),
      ...(m.rms_fraction_p90 === null ? [] : [{ label: "rms over length, 90 %", value: percent(m.rms_fraction_p90) }]),
    ]);
    functionPanels(r, names, s);
    organTable(r, names, s);
    midribs(r, names, s);
    evidence(r, names, s);
  },
});
