// Angular curves of each quantity, a panel for each band.

import type { Section } from "../book";
import type { Series, Simulate } from "../data";
import { sentenceCase } from "../format";
import { bandColour, colour } from "../palette";
import { mark, type Trace } from "../plot";
import { errorLine } from "./errorbars";
import { panelGrid, type Panel } from "./panels";
import { isHemisphere } from "./polar";
import { bandName, planes, type Plane } from "./view_angles";

export const longNames: Record<string, string> = {
  brf: "BRF",
  hdrf: "HDRF",
  radiance: "radiance",
  gap: "gap fraction",
  dhr: "directional-hemispherical reflectance",
  bhr: "bihemispherical reflectance",
  hdrf_recombined: "HDRF at another diffuse fraction",
  albedo_recombined: "albedo at another diffuse fraction",
  effective_g: "effective G",
  effective_gamma: "effective Γ",
};

export const quantityName = (q: string | null): string => longNames[q ?? ""] ?? sentenceCase(q ?? "value");

export function isWhole(x: Series): boolean {
  return (x.origin ?? "total") === "total" && (x.component ?? "all") === "all" && x.order === null;
}

export interface BandGroup {
  name: string;
  nm: number | null;
  series: Series[];
}

// Bands in the order of their wavelength.
export function byBand(series: readonly Series[]): BandGroup[] {
  const groups = new Map<string, BandGroup>();
  for (const x of series) {
    const name = bandName(x);
    const group = groups.get(name) ?? { name, nm: x.wavelength_nm, series: [] };
    group.series.push(x);
    groups.set(name, group);
  }
  return [...groups.values()].sort((a, b) => (a.nm ?? 0) - (b.nm ?? 0));
}

// Hot-spot lines for the panels.
export function hotSpots(series: readonly Series[], panels: readonly Panel[]): { shapes: unknown[]; annotations: unknown[] } {
  const suns = [...new Set(series.map((x) => x.sza_deg).filter((v): v is number => v !== null && v > 0))].slice(0, 4);
  const marks = panels.flatMap((p) => suns.map((sza) => mark(-sza, "hot spot", p.x, p.y)));
  return { shapes: marks.map((m) => m.shape), annotations: marks.map((m) => m.annotation) };
}

export interface Lines {
  groups: { title: string; traces: (at: Partial<Trace>) => Trace[]; series: Series[] }[];
  yTitle: string;
}

// The common frame of all figures over the signed view zenith angle.
export function anglePanels(lines: Lines, columns = 2, barmode?: string): { height: number; data: Trace[]; layout: Record<string, unknown> } {
  const n = lines.groups.length;
  const grid = panelGrid(
    lines.groups.map((g) => g.title),
    { columns: Math.min(columns, n), xTitle: "signed view zenith angle (°), sun's side negative", yTitle: lines.yTitle, gapX: 0.09, gapY: 0.14, xaxis: { dtick: 15 }, yaxis: { rangemode: "tozero" } },
  );
  const marks = lines.groups.map((g, i) => hotSpots(g.series, grid.panels.slice(i, i + 1)));
  const data = lines.groups.flatMap((g, i) => g.traces({ xaxis: grid.panels[i]?.x ?? "x", yaxis: grid.panels[i]?.y ?? "y" }));
  // A name stands once in the legend; one name alone needs none.
  const names = new Set<string>();
  for (const trace of data) {
    trace.showlegend = !names.has(trace.name ?? "");
    names.add(trace.name ?? "");
  }
  return {
    height: (grid.rows > 1 ? 300 : 370) * grid.rows + 80,
    data,
    layout: {
      ...grid.layout,
      ...(barmode ? { barmode } : {}),
      shapes: marks.flatMap((m) => m.shapes),
      annotations: [...grid.annotations, ...marks.flatMap((m) => m.annotations)],
      showlegend: names.size > 1,
    },
  };
}

// Gaps and fractions have figures of their own.
const wholeQuantities = (r: Simulate): string[] =>
  [...new Set(r.series.filter((x) => isWhole(x) && x.material === null && !/^(fraction|gap|bidirectional_gap|overlap)/.test(x.quantity ?? "")).map((x) => x.quantity ?? "value"))];

export function reflectance(r: Simulate, s: Section): void {
  for (const quantity of wholeQuantities(r)) {
    const chosen = r.series.filter((x) => (x.quantity ?? "value") === quantity && isWhole(x) && x.material === null && x.vza_deg.length > 1 && !isHemisphere(x));
    const bands = byBand(chosen);
    if (bands.length === 0) continue;
    const sensors = new Set(chosen.map((x) => x.sensor)).size > 1;
    const nameOf = (x: Series, plane: Plane): string => [sensors ? x.sensor : null, plane.name].filter(Boolean).join(", ") || quantityName(quantity);
    const names = [...new Set(chosen.flatMap((x) => planes(x).map((plane) => nameOf(x, plane))))];
    const groups = bands.map((band, b) => ({
      title: band.name,
      series: band.series,
      traces: (at: Partial<Trace>): Trace[] => {
        const lines = band.series.flatMap((x) => planes(x).map((plane) => ({ name: nameOf(x, plane), plane })));
        return lines.map(({ name, plane }) => {
          const c = names.length === 1 ? bandColour(band.nm, b) : colour(names.indexOf(name) + 2);
          const samples = { x: plane.rows.map((p) => p.vza), y: plane.rows.map((p) => p.value), se: plane.rows.map((p) => p.se) };
          return errorLine(samples, c, { ...at, name, legendgroup: name });
        });
      },
    }));
    s.plot(
      quantity,
      anglePanels({ groups, yTitle: quantityName(quantity) }),
      `${sentenceCase(quantityName(quantity))} over the signed view zenith angle${groups.length > 1 ? ", a panel for each band" : ""}. Bars are ±1.96 standard errors (often smaller than the dots).`,
    );
  }
}
