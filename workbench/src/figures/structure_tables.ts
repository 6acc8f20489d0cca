// Areas and angles by material, species, plant and organ.

import type { Section } from "../book";
import type { Describe } from "../data";
import { area, count, fixed, length, percent, significant } from "../format";

export function structureTables(r: Describe, s: Section): void {
  const materials = Object.entries(r.materials).map(([name, m]) => ({ name, area_m2: m.area_m2 }));
  const total = materials.reduce((sum, m) => sum + (m.area_m2 ?? 0), 0);
  s.table(
    [
      { head: "material", text: true, cell: (m) => m.name },
      { head: "area", cell: (m) => area(m.area_m2) },
      { head: "share", cell: (m) => percent(total > 0 && m.area_m2 !== null ? m.area_m2 / total : null, 3) },
      { head: "per ground area", cell: (m) => significant(m.area_m2 !== null && r.ground_area_m2 ? m.area_m2 / r.ground_area_m2 : null, 3) },
    ],
    materials,
    "Area by material: one-sided for leaves, of all the surface for the rest.",
  );
  s.table(
    [
      { head: "species", text: true, cell: (m) => m.species },
      { head: "plants", cell: (m) => count(m.count) },
      { head: "leaf area", cell: (m) => area(m.leaf_area_m2) },
      { head: "other area", cell: (m) => area(m.other_area_m2) },
      { head: "leaf area index", cell: (m) => significant(m.lai, 3) },
      { head: "mean inclination", cell: (m) => `${fixed(m.inclination_deg, 1)}°` },
      { head: "height", cell: (m) => length(m.height_m, null, 3) },
    ],
    r.species,
    "Species, that is plant files or prototypes, all their plants together.",
  );
  if (r.plants.length > 1)
    s.table(
      [
        { head: "plant", text: true, cell: (p) => p.plant },
        { head: "species", text: true, cell: (p) => p.species },
        { head: "x", unit: "m", cell: (p) => fixed(p.x_m, 3) },
        { head: "y", unit: "m", cell: (p) => fixed(p.y_m, 3) },
        { head: "leaf area", cell: (p) => area(p.leaf_area_m2) },
        { head: "other area", cell: (p) => area(p.other_area_m2) },
        { head: "height", cell: (p) => length(p.height_m, null, 3) },
      ],
      r.plants.slice(0, 200),
      r.plants_total !== null && r.plants_total > Math.min(200, r.plants.length) ? `Plants, the first ${Math.min(200, r.plants.length)} of ${count(r.plants_total)}.` : "Plants.",
    );
  s.table(
    [
      { head: "organ", text: true, cell: (o) => o.label ?? o.id },
      { head: "of", text: true, cell: (o) => o.plant },
      { head: "material", text: true, cell: (o) => o.material },
      { head: "length", cell: (o) => length(o.length_m) },
      { head: "area", cell: (o) => area(o.area_m2) },
      { head: "mean inclination", cell: (o) => (o.inclination_deg === null ? "–" : `${fixed(o.inclination_deg, 1)}°`) },
    ],
    r.organs.slice(0, 500),
    r.organs.length > 500 ? `Organs, the first 500 of ${count(r.organs.length)}.` : "Organs.",
  );
}
