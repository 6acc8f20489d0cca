// Structure of a canopy: area, angles, gaps, heights.

import { describe as read } from "../data";
import { jsonTree } from "../dom";
import { clumping, effectiveLai, fisheye, gapFraction, gapsByAzimuth } from "../figures/structure_gaps";
import { gByAzimuth, gFunction, leafAngles, leafAzimuths, scattering } from "../figures/structure_angles";
import { profile } from "../figures/structure_profile";
import { structureTables } from "../figures/structure_tables";
import { area, fixed, length, percent, significant } from "../format";
import { defineSection } from "./section";

export const describe = defineSection({
  kind: "describe",
  step: "describe",
  title: "Structure",
  explanation:
    "What the geometry amounts to as a canopy. Leaf areas are one-sided, angles in degrees; inclination is that of the blade from the horizontal, zenith angles are counted from the vertical. " +
    "Areas, angles, G and heights are summed over all facets; gaps and what follows from them are sampled by rays and have standard errors.",
  read,
  summarise: (r) => ({
    sentence:
      r.lai === null && r.height_m === null && r.leaf_area_m2 === null
        ? null
        : [
            r.lai !== null ? `Leaf area index ${significant(r.lai, 3)}` : r.leaf_area_m2 !== null ? `Leaf area ${area(r.leaf_area_m2)}` : null,
            r.height_m === null ? null : `height ${length(r.height_m, null, 3)}`,
            r.leaf_angle.mean_deg === null ? null : `mean leaf inclination ${fixed(r.leaf_angle.mean_deg, 1)}°`,
          ]
            .filter((x) => x !== null)
            .join(", ") + ".",
    cards: [
      ...(r.lai === null ? [] : [{ label: "Leaf area index", value: significant(r.lai, 3) }]),
      ...(r.height_m === null ? [] : [{ label: "Height", value: length(r.height_m, null, 3) }]),
    ],
  }),
  render: (r, s) => {
    s.cards([
      ...(r.leaf_area_m2 === null ? [] : [{ label: "Leaf area", value: area(r.leaf_area_m2) }]),
      ...(r.ground_area_m2 === null ? [] : [{ label: "Ground area", value: area(r.ground_area_m2) }]),
      ...(r.lai === null ? [] : [{ label: "Leaf area index", value: significant(r.lai, 3) }]),
      ...(r.pai === null ? [] : [{ label: "Plant area index", value: significant(r.pai, 3), note: "leaves, and half the surface of the rest" }]),
      ...(r.height_m === null ? [] : [{ label: "Height", value: length(r.height_m, null, 3) }]),
      ...(r.cover === null ? [] : [{ label: "Cover", value: percent(r.cover, 3), note: "seen from above" }]),
      ...(r.leaf_angle.mean_deg === null ? [] : [{ label: "Mean inclination", value: `${fixed(r.leaf_angle.mean_deg, 1)}°` }]),
    ]);
    for (const note of r.notes) if (note !== null) s.note(note);
    leafAngles(r, s);
    leafAzimuths(r, s);
    gFunction(r, s);
    gByAzimuth(r, s);
    scattering(r, s);
    gapFraction(r, s);
    gapsByAzimuth(r, s);
    clumping(r, s);
    effectiveLai(r, s);
    fisheye(r, s);
    profile(r, s);
    structureTables(r, s);
    if (r.overlap !== undefined && r.overlap !== null) s.add(jsonTree(r.overlap, "overlap"));
  },
});
