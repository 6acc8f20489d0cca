// A panel for each camera that shows its image area: u to the right, v down, one scale on both axes.

import type { Calibrate } from "../data";
import { panelGrid, type Panel } from "./panels";

export function cameraNames(r: Calibrate): string[] {
  const names = [...r.cameras.map((c) => c.name), ...r.views.map((v) => v.camera)];
  return [...new Set(names.filter((n): n is string => n !== null))];
}

// The camera's, or what its corners reach.
export function imageSize(r: Calibrate, name: string | null): [number, number] {
  const camera = r.cameras.find((c) => c.name === name);
  const reach = (i: 0 | 1): number =>
    r.views.filter((v) => v.camera === name).reduce((most, v) => v.residuals.reduce((m, p) => Math.max(m, p[i] ?? 0), most), 1);
  return [camera?.width ?? reach(0), camera?.height ?? reach(1)];
}

export interface ImagePanels {
  panels: Panel[];
  layout: Record<string, unknown>;
  height: number;
}

export function imagePanels(titles: readonly string[], sizes: readonly [number, number][], right = 0): ImagePanels {
  const columns = Math.min(titles.length, titles.length > 6 ? 3 : 2);
  const grid = panelGrid(titles, { columns, xTitle: "u (px)", yTitle: "v (px)", gapX: 0.07, gapY: 0.12 });
  const layout: Record<string, unknown> = { ...grid.layout, annotations: grid.annotations, showlegend: false };
  if (right > 0) layout["margin"] = { l: 64, r: right, t: 28, b: 52 };
  grid.panels.forEach((p, i) => {
    const [w, hgt] = sizes[i] ?? [1, 1];
    layout[p.xKey] = { ...(layout[p.xKey] as object), constraintoward: "left", range: [-0.5, w - 0.5], constrain: "domain", zeroline: false };
    layout[p.yKey] = { ...(layout[p.yKey] as object), range: [hgt - 0.5, -0.5], scaleanchor: p.x, constrain: "domain", constraintoward: "top", zeroline: false };
  });
  const aspect = Math.max(...sizes.map(([w, hgt]) => hgt / w));
  const width = (columns === 1 ? 975 : columns === 2 ? 455 : 285) - right / columns;
  return { panels: grid.panels, layout, height: Math.round(Math.min(640, width * aspect) * grid.rows + 84) };
}
