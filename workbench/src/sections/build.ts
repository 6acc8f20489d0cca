// The geometry of a plant or a canopy.

import { build as read, type Build } from "../data";
import { scene3d } from "../figures/scene3d";
import type { Part } from "../figures/scene3d_content";
import { area, count, plural } from "../format";
import { colour, materialColour } from "../palette";
import { defineSection } from "./section";

function parts(r: Build): Part[] {
  const materials = [...new Set(r.organs.map((o) => o.material))];
  let leaves = 0;
  return r.organs.flatMap((o) => {
    if (o.id === null) return [];
    const name = o.label ?? `organ ${o.id}`;
    const label = o.material === null ? name : `${name} (${o.material})`;
    const material = materialColour(o.material, materials.indexOf(o.material));
    const leafy = o.material === null || /leaf|blade/i.test(o.material);
    return [{ id: o.id, label, colours: [leafy ? colour(leaves++) : material, material] }];
  });
}

export const build = defineSection({
  kind: "build",
  step: "build",
  title: "Geometry",
  explanation:
    "The organs as triangles, in metres with z up; leaves are single sheets whose triangle area is the one-sided area. " +
    "Point at an organ to read its name.",
  read,
  summarise: (r) => {
    const triangles = r.triangles ?? (r.mesh ? Math.floor(r.mesh.indices.length / 3) : null);
    const size = r.area_m2 === null ? "" : ` with ${area(r.area_m2)} of surface`;
    return {
      sentence: triangles === null ? null : `${r.organs.length > 0 ? `${plural(r.organs.length, "organ")} in ` : ""}${plural(triangles, "triangle")}${size}.`,
      cards: r.area_m2 === null ? [] : [{ label: "Surface area", value: area(r.area_m2), note: "one-sided for leaves" }],
    };
  },
  render: (r, s) => {
    s.cards([
      ...(r.area_m2 === null ? [] : [{ label: "Area", value: area(r.area_m2) }]),
      ...(r.triangles === null ? [] : [{ label: "Triangles", value: count(r.triangles) }]),
      ...(r.organs.length === 0 ? [] : [{ label: "Organs", value: count(r.organs.length) }]),
    ]);
    if (r.mesh) {
      const { positions, indices, organ_ids } = r.mesh;
      const scene = scene3d({
        mesh: { positions, indices, partIds: organ_ids, parts: parts(r) },
        colourings: ["organ", "material"],
        height: 640,
      });
      s.figure("scene", scene.element, "The geometry. The grid lies at the lowest point; one of its cells is the scale bar.", scene.start);
    }
    s.table([{ head: "file", text: true, cell: (f) => f }], r.files.filter((f): f is string => f !== null), "Files written.");
  },
});
