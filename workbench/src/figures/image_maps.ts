// Maps over the image of each camera, in pixels: how sure projections are, how far two calibrations differ.

import type { Section } from "../book";
import type { Calibrate, ImageMap } from "../data";
import { length, significant } from "../format";
import { colourBar, oneTwoFive, type Trace } from "../plot";
import { convexHull, cornersOf, hullLine } from "./coverage";
import { imagePanels, imageSize } from "./image_panels";

export interface NamedMap {
  title: string;
  camera: string | null;
  map: ImageMap;
}

export interface Scale {
  logarithmic: boolean;
  low: number; // px
  high: number;
}

// Common to the maps of a figure; logarithmic where they span more than a factor of 20.
export function mapScale(maps: readonly ImageMap[]): Scale | null {
  const values = maps.flatMap((m) => m.px.filter((v): v is number => v !== null && v > 0)).sort((a, b) => a - b);
  const high = values[values.length - 1];
  const low = values[Math.floor(0.01 * values.length)];
  if (high === undefined || low === undefined) return null;
  return high / low > 20 ? { logarithmic: true, low: Math.max(low, high * 1e-4), high } : { logarithmic: false, low: 0, high };
}

// 1, 2, 5 times powers of ten within the scale.
export function levels({ low, high }: Scale): number[] {
  return oneTwoFive(Math.max(low, high * 1e-4), high);
}

export function grid(map: ImageMap): (number | null)[][] {
  const columns = map.x_px.length;
  return map.y_px.map((_, j) => map.x_px.map((__, i) => map.px[j * columns + i] ?? null));
}

function colours(map: ImageMap, scale: Scale, first: boolean, at: Partial<Trace>): Trace {
  const place = (v: number): number => (scale.logarithmic ? Math.log10(Math.max(v, scale.low)) : v);
  const z = grid(map);
  return {
    type: "heatmap", x: map.x_px, y: map.y_px, z: z.map((row) => row.map((v) => (v === null ? null : place(v)))), zmin: place(scale.low), zmax: place(scale.high),
    colorscale: "Viridis", showscale: first, customdata: z, hovertemplate: "(%{x}, %{y}): %{customdata:.3g} px<extra></extra>",
    colorbar: scale.logarithmic
      ? colourBar("px (logarithmic)", { x: 1.01, tickvals: levels(scale).map(place), ticktext: levels(scale).map((v) => significant(v, 1)) })
      : colourBar("px", { x: 1.01, nticks: 7 }),
    ...at,
  }; // prettier-ignore
}

// At most six labelled lines between the levels, the highest ones being the ones that matter.
function lines(map: ImageMap, scale: Scale, at: Partial<Trace>): Trace[] {
  return levels(scale).slice(-6).map((value): Trace => ({
    type: "contour", x: map.x_px, y: map.y_px, z: grid(map), showscale: false, showlegend: false, hoverinfo: "skip",
    contours: { type: "constraint", operation: "=", value, showlabels: true, labelfont: { size: 10, color: "#ffffff" } },
    line: { color: "rgba(255,255,255,0.75)", width: 1 }, ...at,
  })); // prettier-ignore
}

export function imageMaps(r: Calibrate, s: Section, name: string, maps: readonly NamedMap[], caption: string): void {
  const drawn = maps.filter((m) => m.map.px.some((v) => v !== null) && m.map.x_px.length > 1 && m.map.y_px.length > 1);
  const scale = mapScale(drawn.map((m) => m.map));
  if (!scale) return;
  const titles = drawn.map((m) => `${m.title}: median ${significant(m.map.median_px, 2)} px`);
  const { panels, layout, height } = imagePanels(titles, drawn.map((m) => imageSize(r, m.camera)), 96);
  layout["plot_bgcolor"] = "#eceef0";
  const data = drawn.flatMap((m, i) => {
    const at = { xaxis: panels[i]?.x ?? "x", yaxis: panels[i]?.y ?? "y" };
    return [colours(m.map, scale, i === 0, at), ...lines(m.map, scale, at), hullLine(convexHull(cornersOf(r, m.camera)), "#ffffff", at)];
  });
  s.plot(name, { height, data, layout }, `${caption} Inside the dashed line there were corners; where the lens has no ray the map is grey.`);
}

function ranges(maps: readonly NamedMap[]): string {
  const all = [...new Set(maps.flatMap((m) => (m.map.range_m === null ? [] : [m.map.range_m === 0 ? "infinity" : length(m.map.range_m, null, 3)])))];
  return all.length === 0 ? "the usual range" : all.join(" and ");
}

export function projectionSigma(r: Calibrate, s: Section): void {
  const maps = r.cameras.flatMap((c): NamedMap[] => (c.projection_sigma ? [{ title: c.name ?? "?", camera: c.name, map: c.projection_sigma }] : []));
  imageMaps(
    r, s, "sigma", maps,
    `How sure projections are, pixel by pixel: one standard deviation along the worse direction of points at ${ranges(maps)} from the camera, from the covariance of the lens. ` +
      "A lens and the place of its camera trade against each other: the small motion of the camera that explains most of the change inside the dashed line is taken off first.",
  ); // prettier-ignore
}

export function halfSetDifference(r: Calibrate, s: Section): void {
  const maps = (r.half_sets?.difference ?? []).map((map, i): NamedMap => ({ title: r.cameras[i]?.name ?? `camera ${i + 1}`, camera: r.cameras[i]?.name ?? null, map }));
  imageMaps(
    r, s, "halves", maps,
    `How far the calibrations from the first, third, … frames and from the others put the same points apart, at ${ranges(maps)}, up to a small motion of the camera. ` +
      "Each half has √2 times the σ of all frames, and two halves differ by √2 times that: where the uncertainty is honest this is about twice the projection uncertainty.",
  ); // prettier-ignore
}

export function modelDifference(r: Calibrate, s: Section): void {
  const maps = r.model_differences.flatMap((d): NamedMap[] => (d.map ? [{ title: [d.camera, d.model].filter((x) => x !== null).join(", "), camera: d.camera, map: d.map }] : []));
  imageMaps(
    r, s, "models", maps,
    `How far another lens model, fitted to the same corners, puts the same points from those of the model used, at ${ranges(maps)}. ` +
      "Where this exceeds the projection uncertainty the model, not the noise, limits the calibration.",
  ); // prettier-ignore
}
