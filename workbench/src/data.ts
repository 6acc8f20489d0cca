// The report document and the reports in it. Units are in the names (_m, _deg, _px, _nm); l is the normalised arc length.
// Adding a report kind: its reader here or in a file of its own, its section in sections/, one line in sections/index.ts.

import { common, type Provenance } from "./data_common";
import { flag, isObject, list, number, numbers, object, optional, raw, record, rows, text, type Infer } from "./schema";

export * from "./data_calibrate";
export * from "./data_describe";
export * from "./data_simulate";
export type { Provenance } from "./data_common";

// The labels that name a measured organ.
const label = { plant: text, axis: text, rank: text, organ: text };
export type OrganLabel = Record<keyof typeof label, string | null>;

export const reconstruct = object({
  ...common,
  points: number,
  rejected: rows(object({ ...label, feature: text, point: text, reason: text, chi2: number })),
  reprojection_rms_px: number,
  photographs: rows(object({ view: text, camera: text, width: number, height: number, data_uri: text })),
  curves: rows(
    object({
      ...label,
      feature: text,
      points: rows(
        object({
          point: text,
          x_m: number,
          y_m: number,
          z_m: number,
          sigma_m: numbers,
          chi2: number,
          rejected: flag,
          digitised: record(numbers),
          reprojected: record(numbers),
        }),
      ),
    }),
  ),
  figures: rows(object({ name: text, value: number, sigma: number, unit: text, note: text })),
  check: optional(
    object({
      name: text,
      median_ratio: number,
      points: rows(object({ label: text, dz_m: number, sigma_m: number, ratio: number, rejected: flag })),
    }),
  ),
  vertical_m: numbers,
  towards_cameras: numbers,
});
export type Reconstruct = Infer<typeof reconstruct>;

const organFunction = object({
  kind: text,
  order: number,
  unit: text,
  coefficients: numbers,
  sigma: numbers,
  aicc: number,
  curve: optional(object({ l: numbers, value: numbers, sigma: numbers })),
});

export const fit = object({
  ...common,
  organs: rows(
    object({
      ...label,
      id: text,
      points: number,
      length_m: number,
      length_sigma_m: number,
      width_m: number, width_sigma_m: number,
      rms_m: number,
      rms_fraction: number,
      chi2_per_dof: number,
      functions: record(organFunction),
      measured: record(numbers),
      points_m: list(numbers),
      fitted_m: list(numbers),
      aicc_table: rows(object({ function: text, kind: text, order: number, aicc: number })),
    }),
  ),
  summary: object({ organs: number, rms_fraction_median: number, rms_fraction_p90: number, failed: number }),
});
export type Fit = Infer<typeof fit>;

export const build = object({
  ...common,
  mesh: optional(object({ positions: numbers, indices: numbers, organ_ids: numbers })),
  organs: rows(object({ id: number, label: text, material: text })),
  area_m2: number,
  triangles: number,
  files: list(text),
});
export type Build = Infer<typeof build>;

const anyReport = object(common);

export interface Report {
  kind: string;
  warnings: string[];
  provenance: Provenance | null;
  raw: Record<string, unknown>;
}

export interface ReportDocument {
  title: string;
  version: string | null;
  command: string | null;
  created: string | null;
  notes: string[];
  reports: Report[];
}

export type Parsed = { document: ReportDocument } | { problem: string };

// The text of the data element. A template that nobody filled still holds its token, which starts with two underscores.
export function parseDocument(source: string): Parsed {
  const trimmed = source.trim();
  if (trimmed === "" || trimmed.startsWith("__")) return { problem: "There is no data in this page yet." };
  let value: unknown;
  try {
    value = JSON.parse(trimmed);
  } catch (error) {
    return { problem: `The data in this page cannot be read: ${String(error)}` };
  }
  return isObject(value) ? { document: readDocument(value) } : { problem: "The data in this page is no report." };
}

const head = object({ title: text, version: text, command: text, created: text, notes: list(text), reports: list(raw) });

export function readDocument(value: unknown): ReportDocument {
  const d = head(value);
  const present = (s: string | null): s is string => s !== null && s !== "";
  const reports = d.reports.filter(isObject).map((r): Report => {
    const { report, warnings, provenance } = anyReport(r);
    return { kind: report ?? "unknown", warnings: warnings.filter(present), provenance, raw: r };
  });
  return { ...d, title: d.title ?? "Report", notes: d.notes.filter(present), reports };
}
