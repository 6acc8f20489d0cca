// The report of simulate: series over views, spectra, images, scattering orders.

import { common } from "./data_common";
import { list, number, numbers, object, raw, rows, text, type Infer } from "./schema";

// What the rows of the tables below have in common.
const of = { sensor: text, quantity: text };
const estimates = { value: numbers, standard_error: numbers };
const oneBand = { band: text, wavelength_nm: number };

const series = object({
  ...of, ...oneBand, ...estimates,
  origin: text, component: text, order: number, material: text,
  sza_deg: number, saa_deg: number, vza_deg: numbers, vaa_deg: numbers,
}); // prettier-ignore
export type Series = Infer<typeof series>;

const spectrum = object({ ...of, ...estimates, wavelength_nm: numbers, vza_deg: number, vaa_deg: number, sza_deg: number });
export type Spectrum = Infer<typeof spectrum>;

const orderRow = object({ ...of, ...oneBand, ...estimates, ratio: numbers, ratio_standard_error: numbers, enough_order: number });
export type OrderRow = Infer<typeof orderRow>;

// Fractions of the power that enters, an entry a band.
const fluxes = object({
  name: text,
  wavelength_nm: numbers,
  rows: rows(object({ ...estimates, flux: text, of: text, origin: text })),
});
export type Fluxes = Infer<typeof fluxes>;

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
  fluxes: rows(fluxes),
});
export type Simulate = Infer<typeof simulateKeys>;

// Bands of a sensor go by their names.
export const simulate = (value: unknown): Simulate => {
  const r = simulateKeys(value);
  const named = <T extends { band: string | null }>(x: T): T => ({ ...x, band: r.band_names[Number(x.band) - 1] ?? x.band });
  return { ...r, series: r.series.map(named), orders: r.orders.map(named) };
};
