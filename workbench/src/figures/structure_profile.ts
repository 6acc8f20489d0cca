// Leaf area over height.

import type { Section } from "../book";
import type { Describe } from "../data";
import { accent, alpha } from "../palette";
import { panelGrid } from "./panels";
import type { Trace } from "../plot";

export function profile(r: Describe, s: Section): void {
  const layers = r.profile.filter((l) => l.from_m !== null && l.to_m !== null);
  if (layers.length === 0) return;
  const grid = panelGrid(["", ""], { columns: 2, xTitle: "", yTitle: ["height above ground (m)", ""] });
  const [left, right] = grid.panels;
  if (!left || !right) return;
  const y = layers.map((l) => ((l.from_m ?? 0) + (l.to_m ?? 0)) / 2);
  const bars: Trace = {
    type: "bar", orientation: "h", name: "leaves", x: layers.map((l) => l.leaf_area_density_per_m), y,
    width: layers.map((l) => (l.to_m ?? 0) - (l.from_m ?? 0)),
    marker: { color: alpha(accent, 0.35), line: { color: accent, width: 1 } }, xaxis: left.x, yaxis: left.y,
    hovertemplate: "%{y:.3f} m: %{x:.3f} m² m⁻³<extra></extra>",
  }; // prettier-ignore
  const line = (name: string, x: readonly (number | null)[], at: readonly (number | null)[], axes: typeof left, color: string, dash: string): Trace => ({
    type: "scatter", mode: "lines", name, x, y: at, xaxis: axes.x, yaxis: axes.y, line: { color, width: 1.7, dash },
  }); // prettier-ignore
  const borders = layers.map((l) => l.from_m);
  const top = layers[layers.length - 1]?.to_m ?? null;
  const down = (values: (number | null)[]): (number | null)[] => [...values, 0];
  const data = [
    bars,
    line("with half of the rest's surface", layers.map((l) => l.plant_area_density_per_m), y, left, "#a7863c", "dot"),
    line("leaf area index above", down(layers.map((l) => l.cumulative_lai)), [...borders, top], right, accent, "solid"),
    line("plant area index above", down(layers.map((l) => l.cumulative_pai)), [...borders, top], right, "#a7863c", "dot"),
  ];
  const titled = (key: string, title: string): Record<string, unknown> => ({ ...(grid.layout[key] as object), title: { text: title, font: { size: 13 }, standoff: 8 }, rangemode: "tozero" });
  s.plot(
    "profile",
    {
      height: 400,
      data,
      layout: {
        ...grid.layout,
        [left.xKey]: titled(left.xKey, "leaf area density (m² m⁻³)"),
        [right.xKey]: titled(right.xKey, "cumulative area index from the top"),
        showlegend: true,
      },
    },
    "Leaf area by height: density in each layer, and the area index above each height.",
  );
}
