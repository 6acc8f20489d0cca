// Several panels in one chart: axes with their place, and a title above each.

import { axisTitle } from "../plot";
import { ink } from "../palette";

export interface Panel {
  x: string; // for a trace's xaxis
  y: string;
  xKey: string; // in the layout
  yKey: string;
}

export interface PanelOptions {
  columns: number;
  xTitle: string;
  yTitle: string | readonly string[];
  gapX?: number;
  gapY?: number;
  xaxis?: Record<string, unknown>;
  yaxis?: Record<string, unknown>;
}

export interface PanelGrid {
  panels: Panel[];
  layout: Record<string, unknown>;
  annotations: unknown[];
  rows: number;
}

export function panelGrid(titles: readonly string[], o: PanelOptions): PanelGrid {
  const columns = Math.max(1, Math.min(o.columns, titles.length));
  const rows = Math.max(1, Math.ceil(titles.length / columns));
  const gapX = columns > 1 ? (o.gapX ?? 0.08) : 0;
  const gapY = rows > 1 ? (o.gapY ?? 0.16) / Math.max(1, rows - 1) : 0;
  const width = (1 - gapX * (columns - 1)) / columns;
  const height = (1 - gapY * (rows - 1)) / rows;
  const layout: Record<string, unknown> = {};
  const annotations: unknown[] = [];
  const panels = titles.map((title, i): Panel => {
    const n = i === 0 ? "" : String(i + 1);
    const column = i % columns;
    const row = Math.floor(i / columns);
    const left = column * (width + gapX);
    const top = 1 - row * (height + gapY);
    const yTitle = typeof o.yTitle === "string" ? (column === 0 ? o.yTitle : "") : (o.yTitle[i] ?? "");
    const last = i + columns >= titles.length;
    layout[`xaxis${n}`] = {
      ...o.xaxis, domain: [left, left + width], anchor: `y${n}`, ...(last ? { title: axisTitle(o.xTitle) } : {}),
    }; // prettier-ignore
    layout[`yaxis${n}`] = { ...o.yaxis, domain: [Math.max(0, top - height), top], anchor: `x${n}`, title: axisTitle(yTitle) };
    if (title !== "")
      annotations.push({
        xref: "paper", yref: "paper", x: left + width / 2, y: top, xanchor: "center", yanchor: "bottom", yshift: 3,
        text: `<b>${title}</b>`, showarrow: false, font: { size: 13, color: ink },
      }); // prettier-ignore
    return { x: `x${n}`, y: `y${n}`, xKey: `xaxis${n}`, yKey: `yaxis${n}` };
  });
  return { panels, layout, annotations, rows };
}
