// The last section: what made which report from what.

import type { Section } from "./book";
import type { ReportDocument } from "./data";
import { h } from "./dom";
import { missing } from "./format";

export function hasProvenance(d: ReportDocument): boolean {
  return d.reports.some((r) => r.provenance !== null);
}

export function renderProvenance(d: ReportDocument, s: Section): void {
  const steps = d.reports.flatMap((r) => (r.provenance ? [{ kind: r.kind, ...r.provenance }] : []));
  const inputs = steps.flatMap((p) => p.inputs.map((i) => ({ kind: p.kind, ...i })));
  s.paragraph("The commands that made these figures, and the files they read with their checksums.");
  s.table(
    [
      { head: "step", text: true, cell: (p) => p.kind },
      { head: "command", text: true, cell: (p) => h("code", {}, p.command ?? missing) },
      { head: "version", text: true, cell: (p) => p.version ?? missing },
      { head: "seed", cell: (p) => p.seed ?? missing },
    ],
    steps,
    "Commands.",
  );
  s.table(
    [
      { head: "step", text: true, cell: (i) => i.kind },
      { head: "input", text: true, cell: (i) => i.path ?? missing },
      {
        head: "SHA-256",
        text: true,
        cell: (i) => (i.sha256 === null ? missing : h("code", { title: i.sha256, class: "sum" }, i.sha256.slice(0, 16) + (i.sha256.length > 16 ? "…" : ""))),
      },
    ],
    inputs,
    "Inputs. Point at a checksum to see all of it.",
  );
}
