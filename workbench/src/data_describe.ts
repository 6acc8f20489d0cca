// The report of describe: areas, leaf angles, G, gaps and what follows from them, profiles, tables.

import { common } from "./data_common";
import { list, number, numbers, object, optional, raw, record, rows, text, type Infer } from "./schema";

const gap = {
  zenith_deg: number, p: number, standard_error: number,
  leaves: number, leaves_standard_error: number, others: number, others_standard_error: number,
}; // prettier-ignore

const angleBins = rows(object({ from_deg: number, to_deg: number, probability: number, density_per_deg: number }));
const estimate = optional(object({ value: number, standard_error: number, last_zenith_deg: number }));
const effective = optional(object({ miller: estimate, lai_2000: estimate, at_57_5: estimate }));

const scatteringTable = object({
  band: text,
  source_zenith_deg: number,
  g: number,
  integral: number,
  view_zenith_deg: numbers,
  relative_azimuth_deg: numbers,
  gamma: numbers,
});

export const describe = object({
  ...common,
  leaf_area_m2: number,
  stem_area_m2: number,
  other_area_m2: number,
  ground_area_m2: number,
  lai: number,
  pai: number,
  height_m: number,
  cover: number,
  cover_standard_error: number,
  gap_fraction: rows(object(gap)),
  gap_by_azimuth: rows(object({ ...gap, azimuth_deg: number, width_deg: number, g: number })),
  azimuth_convention: text,
  g_function: rows(object({ zenith_deg: number, g: number, plant_g: number })),
  g_by_azimuth: optional(object({ zenith_deg: numbers, azimuth_deg: numbers, g: list(numbers) })),
  leaf_angle: object({
    mean_deg: number,
    sd_deg: number,
    mean_cos2: number,
    ellipsoidal_chi: number,
    beta: optional(object({ mu: number, nu: number })),
    bins: angleBins,
  }),
  leaf_azimuth: angleBins,
  area_scattering: optional(
    object({
      optics: rows(object({ band: text, material: text, reflectance: number, transmittance: number })),
      tables: rows(scatteringTable),
    }),
  ),
  clumping: rows(
    object({ zenith_deg: number, leaves: number, leaves_standard_error: number, plant: number, plant_standard_error: number }),
  ),
  effective_lai: optional(object({ plant: effective, leaves: effective })),
  profile: rows(
    object({
      from_m: number,
      to_m: number,
      leaf_area_density_per_m: number,
      plant_area_density_per_m: number,
      cumulative_lai: number,
      cumulative_pai: number,
    }),
  ),
  fisheye: optional(
    object({
      x_m: number,
      y_m: number,
      gap_share: number,
      width: number,
      height: number,
      data_uri: text,
      rings: rows(object({ angle_deg: number, radius: number })),
    }),
  ),
  materials: record(object({ area_m2: number, leaf_area_m2: number, other_area_m2: number })),
  organs: rows(
    object({ id: text, label: text, kind: text, material: text, length_m: number, area_m2: number, inclination_deg: number, plant: text }),
  ),
  species: rows(
    object({ species: text, count: number, leaf_area_m2: number, other_area_m2: number, lai: number, inclination_deg: number, height_m: number }),
  ),
  plants: rows(
    object({ plant: text, species: text, x_m: number, y_m: number, leaf_area_m2: number, other_area_m2: number, height_m: number }),
  ),
  plants_total: number,
  notes: list(text),
  overlap: raw,
});
export type Describe = Infer<typeof describe>;
