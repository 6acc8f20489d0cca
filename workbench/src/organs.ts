// Names and colours of organs: "leaf 3", with plant and axis only where they tell organs apart.

import type { OrganLabel } from "./data";
import { colour } from "./palette";

type Label = OrganLabel & { feature?: string | null; point?: string | null };

function key(o: OrganLabel): string {
  return [o.plant, o.axis, o.rank, o.organ].join("\u0000");
}

export interface Organs {
  name: (o: Label) => string;
  full: (o: Label) => string; // with feature and point
  colour: (o: OrganLabel) => string;
  list: { name: string; colour: string }[];
}

export function organs(all: readonly Label[]): Organs {
  const several = (pick: (o: Label) => string | null): boolean => new Set(all.map(pick)).size > 1;
  const plants = several((o) => o.plant);
  const axes = several((o) => o.axis);
  const index = new Map<string, number>();
  const first: Label[] = [];
  for (const o of all) {
    if (index.has(key(o))) continue;
    index.set(key(o), 0);
    first.push(o);
  }
  // Leaves take the first colours, so that a leaf has one colour in all reports, whatever else was digitised.
  const isLeaf = (o: Label): boolean => o.organ === "leaf";
  [...first.filter(isLeaf), ...first.filter((o) => !isLeaf(o))].forEach((o, i) => index.set(key(o), i));
  const name = (o: Label): string => {
    const parts = [plants && o.plant !== null ? `plant ${o.plant}` : null, axes && o.axis !== null ? `axis ${o.axis}` : null];
    const organ = [o.organ ?? "organ", o.rank].filter((s) => s !== null && s !== "").join(" ");
    return [...parts, organ].filter((s) => s !== null).join(", ");
  };
  const full = (o: Label): string => {
    const point = o.point === null || o.point === undefined ? null : `point ${o.point}`;
    return [name(o), o.feature?.replace(/_/g, " "), point].filter((s) => s !== null && s !== undefined).join(", ");
  };
  const colourOf = (o: OrganLabel): string => colour(index.get(key(o)) ?? 0);
  return { name, full, colour: colourOf, list: first.map((o) => ({ name: name(o), colour: colourOf(o) })) };
}
