// The report of simulate: series over views, spectra, images, scattering orders.

import { common } from "./data_common";
import { list, number, numbers, object, raw, rows, text, type Infer } from "./schema";

const angles = { sza_deg: number, vza_deg: numbers, vaa_deg: numbers, value: numbers, standard_error: numbers };
const series = object({
  ...angles,
  sensor: text,
  quantity: text,
  band: text,
  wavelength_nm: number,
  origin: text,
  component: text,
  order: number,
  material: text,
  saa_deg: number,
});
export type Series = Infer<typeof series>;

const spectrum = object({
  sensor: text,
  quantity: text,
  vza_deg: number,
  vaa_deg: number,
  sza_deg: number,
  wavelength_nm: numbers,
  value: numbers,
  standard_error: numbers,
});
export type Spectrum = Infer<typeof spectrum>;

const orderRow = object({
  sensor: text,
  quantity: text,
  band: text,
  wavelength_nm: number,
  value: numbers,
  standard_error: numbers,
  ratio: numbers,
  ratio_standard_error: numbers,
  enough_order: number,
});
export type OrderRow = Infer<typeof orderRow>;

const picture = object({
  sensor: text,
  caption: text,
  width: number,
  height: number,
  data_uri: text,
  rings: rows(object({ angle_deg: number, radius: number })),
});
export type Picture = Infer<typeof picture>;

const simulateKeys = object({
  ...common,
  sensors: list(raw),
  samples: number,
  seconds: number,
  rays: number,
  threads: number,
  stopped_by: text,
  seed: text,
  version: text,
  series: rows(series),
  spectra: rows(spectrum),
  images: rows(picture),
  orders: rows(orderRow),
  suns: rows(object({ name: text, sza_deg: number, saa_deg: number, gap: number, effective_g: number })),
  band_names: list(text),
});
export type Simulate = Infer<typeof simulateKeys>;

// Bands of a sensor go by their names.
export const simulate = (value: unknown): Simulate => {
  const r = simulateKeys(value);
  const named = <T extends { band: string | null }>(x: T): T => ({ ...x, band: r.band_names[Number(x.band) - 1] ?? x.band });
  return { ...r, series: r.series.map(named), orders: r.orders.map(named) };
};
