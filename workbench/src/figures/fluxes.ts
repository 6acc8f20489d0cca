// Where the light goes: absorbed by what, reflected, transmitted; of the absorbed, the parts by layer and by organ.

import type { Choice, Section } from "../book";
import type { Fluxes, Simulate } from "../data";
import { fixed } from "../format";
import { bandColour, ink, materialColour, orderColour } from "../palette";
import { axisTitle, type PlotSpec, type Trace } from "../plot";
import { z95 } from "./errorbars";

type Row = Fluxes["rows"][number];
const skyColour = "#8fb4dc";
const lostColour = "#c4c9d0";
const mostOrgans = 30;
const mostBands = 8; // side by side

const whole = (f: Fluxes, flux: string): Row[] => f.rows.filter((x) => x.flux === flux && (x.origin ?? "total") === "total");

export function bandsOf(r: Simulate, f: Fluxes): string[] {
  const count = f.rows[0]?.value.length ?? 0;
  return Array.from({ length: count }, (_, b) => {
    const nm = f.wavelength_nm[b];
    return r.band_names[b] ?? (typeof nm === "number" ? `${fixed(nm, nm % 1 === 0 ? 0 : 1)} nm` : count === 1 ? "all" : `band ${b + 1}`);
  });
}

const errors = (x: Row, colour = ink): NonNullable<Trace["error_y"]> => ({
  type: "data",
  array: x.standard_error.map((e) => (e === null ? null : z95 * e)),
  thickness: 1.1,
  width: 2.5,
  color: colour,
});

// What becomes of all that enters: a stack of 1 for each band.
export function balance(r: Simulate, f: Fluxes): PlotSpec {
  const bands = bandsOf(r, f);
  const stack = (x: Row, name: string, colour: string): Trace => ({
    type: "bar", name, x: bands, y: x.value, marker: { color: colour }, hovertemplate: `${name}: %{y:.4f}<extra></extra>`,
  }); // prettier-ignore
  const some = (x: Row): boolean => x.value.some((v) => (v ?? 0) !== 0);
  const materials = whole(f, "absorbed").filter(some);
  const lost = [...whole(f, "lost_sides"), ...whole(f, "lost_wraps")].filter(some);
  const reflected = whole(f, "reflected");
  const transmitted = whole(f, "transmitted");
  // Where there is a ground, what arrives there is absorbed by it or comes up again; else it is gone.
  const stays = [...materials, ...reflected, ...lost];
  const gone = transmitted.filter((t) => t.value.some((v, b) => 1 - stays.reduce((sum, x) => sum + (x.value[b] ?? 0), 0) > 0.5 * (v ?? 0) && (v ?? 0) > 0));
  const data: Trace[] = [
    ...materials.map((x, i) => stack(x, `absorbed by ${x.of ?? "all"}`, materialColour(x.of, i))),
    ...gone.map((x) => stack(x, "transmitted", "#e8c86a")),
    ...reflected.map((x) => stack(x, "reflected", skyColour)),
    ...lost.map((x) => stack(x, x.flux === "lost_sides" ? "leaves through the sides" : "lost at the wrap limit", lostColour)),
  ];
  for (const x of transmitted.filter((t) => !gone.includes(t)))
    data.push({
      type: "scatter", mode: "markers", name: "transmitted (arrives at the ground)", x: bands, y: x.value, error_y: errors(x),
      marker: { color: "#ffffff", size: 9, symbol: "diamond", line: { color: ink, width: 1.4 } }, hovertemplate: "transmitted: %{y:.4f}<extra></extra>",
    }); // prettier-ignore
  return {
    height: 400,
    data,
    layout: {
      barmode: "stack",
      bargap: 0.3,
      xaxis: { title: axisTitle("band"), type: "category" },
      yaxis: { title: axisTitle("fraction of the light that enters"), range: [0, Math.max(1, ...transmitted.flatMap((x) => x.value.map((v) => v ?? 0))) * 1.02] },
      legend: { orientation: "v", x: 1.01, y: 1, traceorder: "reversed" },
      showlegend: true,
    },
  };
}

// So many of the numbers 0 ... count - 1, evenly.
function spread(count: number, most: number): number[] {
  if (count <= most) return Array.from({ length: count }, (_, i) => i);
  return Array.from({ length: most }, (_, i) => Math.round((i * (count - 1)) / (most - 1)));
}

// A profile or a ranking: horizontal bars, a colour for each band.
export function parts(r: Simulate, f: Fluxes, rows: Row[], axis: string): PlotSpec {
  const bands = bandsOf(r, f);
  const names = rows.map((x) => x.of ?? "");
  const shown = spread(bands.length, mostBands);
  const own = shown.map((b) => bandColour(f.wavelength_nm[b] ?? null, b));
  const data = shown.map((b, i): Trace => {
    const band = bands[b] ?? "";
    const colour = new Set(own).size === own.length ? (own[i] ?? ink) : orderColour(i, own.length);
    const se = rows.map((x) => x.standard_error[b] ?? null);
    return {
      type: "bar", orientation: "h", name: band, x: rows.map((x) => x.value[b] ?? null), y: names, marker: { color: colour },
      error_x: { type: "data", array: se.map((e) => (e === null ? null : z95 * e)), thickness: 1.1, width: 2.5, color: ink },
      hovertemplate: `%{y}, ${band}: %{x:.4f}<extra></extra>`,
    }; // prettier-ignore
  });
  return {
    height: 130 + Math.max(160, names.length * (8 + 9 * Math.min(4, shown.length))),
    data,
    layout: {
      bargap: 0.25,
      xaxis: { title: axisTitle("absorbed fraction of the light that enters"), rangemode: "tozero" },
      yaxis: { title: axisTitle(axis), type: "category" },
      showlegend: bands.length > 1,
    },
  };
}

export function fluxes(r: Simulate, s: Section): void {
  const shown = r.fluxes.filter((f) => f.rows.length > 0);
  const draw = (name: string, some: Fluxes[], spec: (f: Fluxes) => PlotSpec, caption: string): void => {
    if (some.length > 0) s.plot(name, some.map((f): Choice => ({ label: f.name ?? "", spec: () => spec(f) })), caption);
  };
  draw("fluxes", shown, (f) => balance(r, f), "What becomes of the light that enters: absorbed by each material, reflected through the top, and the rest; for each band the stack is the whole.");
  const layers = (f: Fluxes): Row[] => whole(f, "absorbed_layer");
  draw("flux-layers", shown.filter((f) => layers(f).length > 0), (f) => parts(r, f, layers(f), "layer of the canopy"), `Light absorbed in each layer of the canopy, from the bottom up: the profile of fAPAR by band (of at most ${mostBands} bands), with ±1.96 standard errors.`);
  const organs = (f: Fluxes): Row[] => {
    const total = (x: Row): number => x.value.reduce((sum: number, v) => sum + (v ?? 0), 0);
    return [...whole(f, "absorbed_organ")].sort((a, b) => total(a) - total(b)).slice(-mostOrgans);
  };
  draw("flux-organs", shown.filter((f) => organs(f).length > 0), (f) => parts(r, f, organs(f), "organ"), `Light absorbed by each organ, all its instances together, with ±1.96 standard errors; the largest ${mostOrgans} at most.`);
}
