// What radiance is made of: single and multiple scattering, scattering orders, sun and sky, sunlit and shaded materials.

import type { Choice, Section } from "../book";
import type { Series, Simulate } from "../data";
import { fixed } from "../format";
import { alpha, colour, ink, materialColour, orderColour } from "../palette";
import { axisTitle, type PlotSpec, type Trace } from "../plot";
import { errorLine } from "./errorbars";
import { anglePanels, byBand, isWhole, quantityName, type BandGroup } from "./reflectance";
import { isHemisphere } from "./polar";
import { mainPlane } from "./view_angles";

const radiometric = (x: Series): boolean => /^(brf|hdrf|radiance)$/.test(x.quantity ?? "brf") && x.vza_deg.length > 0 && !isHemisphere(x);

const componentNames: Record<string, string> = {
  all: "all",
  uc_sgl: "single, uncollided by the canopy (ground)",
  co_sgl: "single, by the canopy",
  mlt: "multiple",
};
const componentColours: Record<string, string> = { all: ink, uc_sgl: "#8a6a4a", co_sgl: "#3f8f4f", mlt: "#3b6fb6" };

// Figures of parts show the first sensor and quantity; the others are in the data.
function first(series: Series[]): Series[] {
  const head = series[0];
  return head ? series.filter((x) => x.sensor === head.sensor && x.quantity === head.quantity) : [];
}

function line(x: Series, name: string, c: string, at: Partial<Trace>, dash = "solid"): Trace {
  const rows = mainPlane(x);
  const samples = { x: rows.map((p) => p.vza), y: rows.map((p) => p.value), se: rows.map((p) => p.se) };
  return errorLine(samples, c, { ...at, name, legendgroup: name, line: { color: c, width: 1.6, dash }, marker: { color: c, size: 4 } });
}

function panelsOf(bands: BandGroup[], yTitle: string, draw: (band: BandGroup, at: Partial<Trace>) => Trace[]): PlotSpec {
  return anglePanels({ yTitle, groups: bands.map((band) => ({ title: band.name, series: band.series, traces: (at) => draw(band, at) })) });
}

export function scatteringParts(r: Simulate, s: Section): void {
  // Components are those of direct light; under a sky its own share is the direct one.
  const parts = r.series.filter((x) => radiometric(x) && x.order === null && x.material === null && x.component !== null);
  const origin = parts.find((x) => x.component !== "all")?.origin ?? "total";
  const chosen = first(parts.filter((x) => (x.origin ?? "total") === origin));
  if (!chosen.some((x) => x.component !== "all")) return;
  const order = Object.keys(componentNames);
  const spec = panelsOf(byBand(chosen), quantityName(chosen[0]?.quantity ?? null), (band, at) =>
    [...band.series]
      .sort((a, b) => order.indexOf(a.component ?? "") - order.indexOf(b.component ?? ""))
      .map((x, i) => line(x, componentNames[x.component ?? ""] ?? x.component ?? "", componentColours[x.component ?? ""] ?? colour(i), at)),
  );
  s.plot("components", spec, `Single scattering by the ground through the gaps, single scattering by the canopy, and multiple scattering; together they are the whole${origin === "direct" ? " of the sun's light" : ""}.`);
}

export function lightParts(r: Simulate, s: Section): void {
  const chosen = first(r.series.filter((x) => radiometric(x) && x.order === null && x.material === null && (x.component ?? "all") === "all"));
  if (!chosen.some((x) => x.origin === "direct" || x.origin === "diffuse")) return;
  const look: Record<string, [string, string]> = { total: [ink, "solid"], direct: ["#d1812a", "solid"], diffuse: ["#3b6fb6", "dash"] };
  const spec = panelsOf(byBand(chosen), quantityName(chosen[0]?.quantity ?? null), (band, at) =>
    band.series.map((x) => {
      const origin = x.origin ?? "total";
      const [c, dash] = look[origin] ?? [ink, "dot"];
      return line(x, origin === "direct" ? "direct (sun)" : origin === "diffuse" ? "diffuse (sky)" : origin, c, at, dash);
    }),
  );
  const ofReflectance = (chosen[0]?.quantity ?? "brf") !== "radiance";
  const total = ofReflectance ? "each over its own irradiance; the total is their mean, weighted by irradiance" : "and their sum";
  s.plot("origin", spec, `Light that came from the sun (direct) and from the sky (diffuse), ${total}.`);
}

function orderBars(series: Series[], x: (o: Series) => { at: (number | string)[]; value: (number | null)[] }): Trace[] {
  const all = [...new Set(series.map((o) => o.order ?? 0))].sort((a, b) => a - b);
  return all.map((order, i): Trace => {
    const own = series.filter((o) => o.order === order).map(x);
    return {
      type: "bar",
      name: order === 0 ? "emitted or unscattered" : `order ${order}`,
      x: own.flatMap((o) => o.at),
      y: own.flatMap((o) => o.value),
      marker: { color: orderColour(i, all.length) },
      hovertemplate: `order ${order}: %{y:.4g}<extra></extra>`,
    };
  });
}

export function orders(r: Simulate, s: Section): void {
  const chosen = first(r.series.filter((x) => radiometric(x) && x.order !== null && x.material === null && (x.origin ?? "total") === "total" && (x.component ?? "all") === "all"));
  const bands = byBand(chosen);
  if (bands.length === 0) return;
  const unit = quantityName(chosen[0]?.quantity ?? null);
  const layout = (title: string): Record<string, unknown> => ({
    barmode: "stack",
    bargap: 0.12,
    xaxis: { title: axisTitle(title), ...(title === "band" ? { type: "category" } : { dtick: 15 }) },
    yaxis: { title: axisTitle(unit), rangemode: "tozero" },
    legend: { orientation: "v", x: 1.01, y: 1, traceorder: "reversed" },
    showlegend: true,
  });
  const nearest = (x: Series): { at: string[]; value: (number | null)[] } => {
    const row = mainPlane(x).reduce<{ vza: number; value: number | null } | null>((a, b) => (a === null || Math.abs(b.vza) < Math.abs(a.vza) ? b : a), null);
    return { at: [byBand([x])[0]?.name ?? ""], value: [row?.value ?? null] };
  };
  const byAngle = (band: BandGroup): Choice => ({
    label: `${band.name || "all views"}: over the view angle`,
    spec: () => ({
      height: 400,
      data: orderBars(band.series, (x) => ({ at: mainPlane(x).map((p) => p.vza), value: mainPlane(x).map((p) => p.value) })),
      layout: layout("signed view zenith angle (°), sun's side negative"),
    }),
  });
  const several = bands.length > 1 && bands.some((b) => b.series.some((x) => x.vza_deg.length > 0));
  const atNadir: Choice = { label: "all bands at the view nearest to nadir", spec: () => ({ height: 400, data: orderBars(chosen, nearest), layout: layout("band") }) };
  const choices = [...bands.filter((b) => b.series.some((x) => x.vza_deg.length > 1)).map(byAngle).reverse(), ...(several ? [atNadir] : [])];
  const last = Math.max(...chosen.map((x) => x.order ?? 0));
  const rest = r.orders.some((row) => row.value.length === last) ? `the last, ${last}, holds all higher ones` : `orders above ${last} are not shown`;
  s.plot("orders", choices.length > 0 ? choices : [atNadir], `Contribution of each order of scattering, stacked; ${rest}.`);
}

export function fractions(r: Simulate, s: Section): void {
  const chosen = r.series.filter((x) => /^fraction_(sunlit|shaded)$/.test(x.quantity ?? "") && x.vza_deg.length > 1 && isWhole(x) && !isHemisphere(x));
  const sensor = chosen[0]?.sensor ?? null;
  // Fractions do not depend on the band: one band is enough.
  const band = byBand(chosen.filter((x) => x.sensor === sensor))[0];
  if (!band) return;
  const materials = [...new Set(band.series.map((x) => x.material))];
  const kinds = ["fraction_sunlit", "fraction_shaded"];
  const traces = (at: Partial<Trace>): Trace[] =>
    materials.flatMap((material, m) =>
      kinds.flatMap((kind) => {
        const x = band.series.find((y) => y.material === material && y.quantity === kind);
        if (!x) return [];
        const c = materialColour(material, m);
        const rows = mainPlane(x);
        const sunlit = kind === "fraction_sunlit";
        const name = `${material ?? "all"}, ${sunlit ? "sunlit" : "shaded"}`;
        const fillcolor = sunlit ? alpha(c, 0.6) : alpha(c, 0.95);
        const hovertemplate = `${name}: %{y:.3f} at %{x}°<extra></extra>`;
        return [{ ...at, type: "scatter" as const, mode: "lines" as const, name, x: rows.map((p) => p.vza), y: rows.map((p) => p.value), stackgroup: "one", fillcolor, line: { color: "#ffffff", width: 0.8 }, hovertemplate }];
      }),
    );
  const spec = anglePanels({ yTitle: "fraction of the view", groups: [{ title: "", series: band.series, traces }] }, 1);
  const at = band.series[0]?.sza_deg ?? null;
  s.plot("fractions", spec, `Sunlit (light) and shaded (dark) fractions of what a sensor sees, by material${at === null ? "" : `, with the sun at ${fixed(at, 0)}°`}.`);
}
