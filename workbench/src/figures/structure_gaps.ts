// Gap fractions, clumping, gaps by azimuth, and the hemispherical picture.

import type { Section } from "../book";
import type { Describe } from "../data";
import { h, imageSource } from "../dom";
import { fixed, percent, withSigma } from "../format";
import { accent, colour } from "../palette";
import { axisTitle, mark, type Trace } from "../plot";
import { errorLine } from "./errorbars";
import { roundPicture } from "./pictures";

const hinge = mark(57.5, "57.5°");

function overZenith(title: string, extra: Record<string, unknown> = {}): Record<string, unknown> {
  return {
    xaxis: { title: axisTitle("zenith angle (°)"), range: [-2, 92], dtick: 15 },
    yaxis: { title: axisTitle(title), rangemode: "tozero", ...extra },
    shapes: [hinge.shape],
    annotations: [hinge.annotation],
    showlegend: true,
  };
}

// Beer's law with the report's own G and leaf area index.
function randomGaps(r: Describe): Trace[] {
  const lai = r.lai;
  const g = r.g_function.filter((p) => p.g !== null && p.zenith_deg !== null && p.zenith_deg < 89.9);
  if (lai === null || g.length < 3) return [];
  const y = g.map((p) => Math.exp((-(p.g ?? 0) * lai) / Math.cos(((p.zenith_deg ?? 0) * Math.PI) / 180)));
  return [{ type: "scatter", mode: "lines", name: "leaves at random positions", x: g.map((p) => p.zenith_deg), y, line: { color: "#6b7280", width: 1.3, dash: "dot" }, hoverinfo: "skip" }];
}

export function gapFraction(r: Describe, s: Section): void {
  const gaps = r.gap_fraction.filter((p) => p.zenith_deg !== null && p.p !== null);
  if (gaps.length === 0) return;
  const x = gaps.map((p) => p.zenith_deg);
  const stems = gaps.some((p) => p.others !== null && p.others < 1);
  const lines = [
    errorLine({ x, y: gaps.map((p) => p.p), se: gaps.map((p) => p.standard_error) }, accent, { name: "this canopy" }),
    ...(stems && gaps.some((p) => p.leaves !== null)
      ? [
          errorLine({ x, y: gaps.map((p) => p.leaves), se: gaps.map((p) => p.leaves_standard_error) }, "#7fae42", { name: "its leaves alone" }),
          errorLine({ x, y: gaps.map((p) => p.others), se: gaps.map((p) => p.others_standard_error) }, "#a7863c", { name: "stems and the rest alone" }),
        ]
      : []),
  ];
  const random = randomGaps(r);
  s.plot(
    "gap",
    { height: 400, data: [...random, ...lines], layout: overZenith("gap fraction P(θ)") },
    "Gap fraction: the share of rays from the ground towards the zenith angle θ that reach the sky. Bars are ±1.96 standard errors." +
      (random.length > 0 ? " The dotted line is exp(−G(θ) LAI / cos θ), the gap fraction of the same leaf area scattered at random." : ""),
  );
}

export function clumping(r: Describe, s: Section): void {
  const c = r.clumping.filter((p) => p.zenith_deg !== null && (p.leaves !== null || p.plant !== null));
  if (c.length === 0) return;
  const x = c.map((p) => p.zenith_deg);
  const one: Trace = { type: "scatter", mode: "lines", x: [0, 90], y: [1, 1], line: { color: "#9aa3ad", width: 1, dash: "dot" }, hoverinfo: "skip", showlegend: false };
  s.plot(
    "clumping",
    {
      height: 340,
      data: [
        one,
        errorLine({ x, y: c.map((p) => p.leaves), se: c.map((p) => p.leaves_standard_error) }, "#7fae42", { name: "leaves" }),
        errorLine({ x, y: c.map((p) => p.plant), se: c.map((p) => p.plant_standard_error) }, accent, { name: "all surfaces" }),
      ],
      layout: overZenith("clumping index Ω(θ)"),
    },
    "Clumping index −ln P cos θ / (G L): 1 where elements stand at random, less where they are clumped. Of leaves: their own gaps, G and area; of all surfaces likewise.",
  );
}

export function gapsByAzimuth(r: Describe, s: Section): void {
  const rows = r.gap_by_azimuth.filter((p) => p.zenith_deg !== null && p.azimuth_deg !== null && p.p !== null);
  if (rows.length === 0) return;
  const zeniths = [...new Set(rows.map((p) => p.zenith_deg ?? 0))];
  const chosen = zeniths.filter((z, i) => [30, 57.5, 75].includes(z) || zeniths.length <= 4 || (i === 0 && !zeniths.includes(30)));
  s.plot(
    "gap-azimuth",
    {
      height: 360,
      data: chosen.map((zenith, i) => {
        const own = rows.filter((p) => p.zenith_deg === zenith);
        return errorLine({ x: own.map((p) => p.azimuth_deg), y: own.map((p) => p.p), se: own.map((p) => p.standard_error) }, colour(i), { name: `θ = ${fixed(zenith, zenith % 1 === 0 ? 0 : 1)}°` });
      }),
      layout: {
        xaxis: { title: axisTitle("azimuth of the sector's middle (°)"), range: [-5, 365], dtick: 45 },
        yaxis: { title: axisTitle("gap fraction P(θ, φ)"), rangemode: "tozero" },
        showlegend: true,
      },
    },
    "Gap fraction by azimuth: along rows more of the sky is seen than across them.",
  );
}

export function effectiveLai(r: Describe, s: Section): void {
  const of = r.effective_lai;
  if (of === null) return;
  type One = NonNullable<typeof of.plant>["miller"] | undefined;
  const cell = (e: One): string => (e === null || e === undefined ? "–" : withSigma(e.value, e.standard_error));
  s.table(
    [
      { head: "from gaps as read by", text: true, cell: (m) => m.name },
      { head: "all surfaces", cell: (m) => cell(of.plant?.[m.key]) },
      { head: "leaves alone", cell: (m) => cell(of.leaves?.[m.key]) },
    ],
    [
      { name: "Miller's integral over zenith", key: "miller" as const },
      { name: "the rings of an LAI-2000", key: "lai_2000" as const },
      { name: "57.5° alone", key: "at_57_5" as const },
    ],
    `Effective area index, that of randomly placed elements with the same gaps; the true leaf area index is ${r.lai === null ? "not known" : fixed(r.lai, 3)}, with half the surface of stems and the rest ${r.pai === null ? "not known" : fixed(r.pai, 3)}.`,
  );
}

export function fisheye(r: Describe, s: Section): void {
  const picture = r.fisheye;
  if (picture === null || imageSource(picture.data_uri) === null) return;
  const where = picture.x_m === null || picture.y_m === null ? "" : ` at x ${fixed(picture.x_m, 2)} m, y ${fixed(picture.y_m, 2)} m`;
  s.figure(
    "fisheye",
    h("div", { class: "renderframe white" }, roundPicture(picture, "the sky seen from the ground")),
    `The sky from the ground${where}, zenith in the middle and horizon at the rim (distances from the middle are zenith angles), north at the top and east on the right as on a map: leaves green, the rest brown. ` +
      `${percent(picture.gap_share, 3)} of the sky's solid angle is seen.`,
  );
}
