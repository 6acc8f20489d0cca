// The report of calibrate: cameras with both sigmas, views with residuals, targets, poses, maps over the image.

import { common } from "./data_common";
import { flag, list, number, numbers, object, optional, record, rows, text, type Infer } from "./schema";

// Over the image, row by row; null where the lens has no ray.
const imageMap = object({
  range_m: number,
  x_px: numbers,
  y_px: numbers,
  px: numbers,
  median_px: number,
  p90_px: number,
  max_px: number,
});
export type ImageMap = Infer<typeof imageMap>;

// The rows of [R | t].
const pose = list(numbers);

const camera = object({
  name: text,
  model: text,
  width: number,
  height: number,
  fx: number,
  fy: number,
  cx: number,
  cy: number,
  distortion: numbers,
  parameter_names: list(text),
  sigma: record(number),
  sigma_clustered: record(number),
  projection_sigma: optional(imageMap),
  cam_from_rig: pose,
});

const pair = object({
  a: text,
  b: text,
  baseline_m: number,
  baseline_sigma_m: number,
  baseline_sigma_clustered_m: number,
  rotation_deg: numbers,
  translation_m: numbers,
});

// `points` are those of the target, one for each residual.
const view = object({
  image: text,
  camera: text,
  frame: text,
  target: number,
  rms_px: number,
  outlier: flag,
  reason: text,
  residuals: list(numbers),
  points: numbers,
  sharpness: number,
});

const target = object({
  name: text,
  kind: text,
  columns: number,
  rows: number,
  square_m: number,
  stands: flag,
  views: number,
  warp_m: numbers,
  nominal_points_m: list(numbers),
  points_m: list(numbers),
  scale_bars: rows(object({ a: text, b: text, length_m: number, sigma_m: number, found_m: number })),
});

const triangulation = object({
  a: text,
  b: text,
  range_m: number,
  sigma_x_m: number,
  sigma_y_m: number,
  sigma_z_m: number,
  observation_sigma_x_m: number,
  observation_sigma_y_m: number,
  observation_sigma_z_m: number,
});

const choice = object({
  choice: text,
  parameters: number,
  rms_px: number,
  cross_validated_px: number,
  se_px: number,
  chosen: flag,
  refused: text,
});

export const calibrate = object({
  ...common,
  cameras: rows(camera),
  pairs: rows(pair),
  residual_rms_px: number,
  residual_sigma_px: number,
  corners_used: number,
  corners_total: number,
  frames: number,
  views: rows(view),
  targets: rows(target),
  poses: optional(object({ frames: list(text), rig_from_world: list(pose), world_from_target: list(list(pose)) })),
  board_warp_m: numbers,
  converged: flag,
  outliers: rows(object({ image: text, corner: text, residual_px: number })),
  skipped: rows(object({ image: text, reason: text })),
  half_sets: optional(
    object({ odd_baseline_m: number, even_baseline_m: number, difference_m: number, sigma_clustered_m: number, difference: rows(imageMap) }),
  ),
  model_differences: rows(object({ camera: text, model: text, map: optional(imageMap) })),
  covariance_kind: text,
  covariance: optional(object({ order: list(text), matrix: list(numbers) })),
  triangulation: rows(triangulation),
  turntable: optional(object({ direction: numbers, point_m: numbers, direction_sigma_clustered_rad: number, point_sigma_clustered_m: number })),
  lens_selection: rows(choice),
});
export type Calibrate = Infer<typeof calibrate>;
