// What any report may carry.

import { list, object, optional, rows, text, type Infer } from "./schema";

const provenance = object({
  version: text,
  command: text,
  seed: text,
  inputs: rows(object({ path: text, sha256: text })),
});
export type Provenance = Infer<typeof provenance>;

export const common = { report: text, warnings: list(text), provenance: optional(provenance) };
