// The page: head with key figures, the pipeline strip, a section for each report, provenance.

import { Book, cardRow, type Card, type Section } from "./book";
import { parseDocument, type Report, type ReportDocument } from "./data";
import { h, jsonTree } from "./dom";
import { sentenceCase } from "./format";
import { hasProvenance, renderProvenance } from "./provenance";
import { sections } from "./sections";
import type { SectionModule } from "./sections/section";

interface Part {
  section: Section;
  module: SectionModule | null;
  report: Report;
}

function failure(error: unknown): HTMLElement {
  return h("p", { class: "absent" }, `This part of the report could not be shown: ${String(error)}`);
}

function renderReport(book: Book, report: Report): Part {
  const module = sections.find((m) => m.kind === report.kind) ?? null;
  const section = book.section(report.kind, module?.title ?? `Report “${report.kind}”`);
  if (module) section.add(h("p", { class: "explanation" }, module.explanation));
  for (const warning of report.warnings) section.note(warning);
  try {
    if (module) module.render(report.raw, section);
    else {
      section.paragraph("This page knows no figures for this kind of report; here is its content.");
      section.add(jsonTree(report.raw));
    }
  } catch (error) {
    section.add(failure(error));
  }
  return { section, module, report };
}

function summaryOf(part: Part): { sentence: string | null; cards: Card[] } {
  try {
    return part.module?.summarise(part.report.raw) ?? { sentence: null, cards: [] };
  } catch {
    return { sentence: null, cards: [] };
  }
}

// The pipeline as a strip that is the table of contents too; steps without a report are grey.
function strip(parts: readonly Part[], provenance: boolean): HTMLElement {
  const known = sections.flatMap((m) => {
    const own = parts.filter((p) => p.module === m);
    if (own.length === 0) return [h("span", { class: "step absent" }, m.step)];
    return own.map((p, i) => h("a", { class: "step", href: `#${p.section.id}` }, own.length > 1 ? `${m.step} ${i + 1}` : m.step));
  });
  const others = parts.filter((p) => p.module === null).map((p) => h("a", { class: "step", href: `#${p.section.id}` }, p.report.kind));
  const last = provenance ? [h("a", { class: "step", href: "#provenance" }, "provenance")] : [];
  return h("nav", { class: "strip", "aria-label": "contents" }, ...known, ...others, ...last);
}

function dateLine(d: ReportDocument): string {
  const date = d.created === null ? null : new Date(d.created);
  const valid = date !== null && !Number.isNaN(date.getTime());
  const when = valid ? date.toISOString().replace("T", " ").replace(/:\d\d\.\d+Z$/, " UTC") : d.created;
  return [d.version === null ? "bpms" : `bpms ${d.version}`, when].filter((x) => x !== null).join(" · ");
}

function header(d: ReportDocument, parts: readonly Part[], provenance: boolean): HTMLElement {
  const summaries = parts.map((p) => ({ part: p, ...summaryOf(p) }));
  const lines = summaries.flatMap((x) =>
    x.sentence === null ? [] : [h("li", {}, h("a", { href: `#${x.part.section.id}` }, sentenceCase(x.part.module?.step ?? "")), ": ", x.sentence)],
  );
  // Of several reports of one kind the first one's figures stand here.
  const all = summaries.flatMap((x) => x.cards);
  const cards = all.filter((card, i) => all.findIndex((other) => other.label === card.label) === i).slice(0, 10);
  return h(
    "header",
    {},
    h("div", { class: "dateline" }, dateLine(d)),
    h("h1", {}, d.title),
    ...d.notes.map((n) => h("p", { class: "lead" }, n)),
    lines.length > 0 && h("ul", { class: "summary" }, ...lines),
    cards.length > 0 && cardRow(cards),
    strip(parts, provenance),
    d.command !== null && h("p", { class: "command" }, h("code", {}, d.command)),
  );
}

export function renderDocument(d: ReportDocument): { element: HTMLElement; book: Book } {
  const book = new Book();
  const parts = d.reports.map((r) => renderReport(book, r));
  const element = h("div", {});
  const provenance = hasProvenance(d);
  element.append(header(d, parts, provenance), ...parts.map((p) => p.section.element));
  if (parts.length === 0) element.append(h("p", { class: "absent" }, "There is no report in this document."));
  if (provenance) {
    const section = book.section("provenance", "Provenance");
    renderProvenance(d, section);
    element.append(section.element);
  }
  return { element, book };
}

// The figures that the address asks for: #only=calibrate-views,calibrate-quiver
export function wanted(hash: string, search: string): string[] {
  const value = new URLSearchParams(hash.replace(/^#/, "")).get("only") ?? new URLSearchParams(search).get("only");
  return (value ?? "").split(",").filter((id) => id !== "");
}

export function showPage(place: HTMLElement, source: string, only: readonly string[] = []): Book | null {
  const parsed = parseDocument(source);
  if ("problem" in parsed) {
    place.replaceChildren(h("header", {}, h("h1", {}, "Report"), h("p", { class: "absent" }, parsed.problem)));
    return null;
  }
  document.title = parsed.document.title;
  const { element, book } = renderDocument(parsed.document);
  if (only.length === 0) place.replaceChildren(element);
  else {
    const chosen = book.figures.filter((f) => only.includes(f.id));
    const known = book.figures.map((f) => f.id).join(", ");
    document.body.classList.add("only");
    place.replaceChildren(...chosen.map((f) => f.element));
    if (chosen.length === 0) place.append(h("p", { class: "absent" }, `No such figure. This page has: ${known}.`));
    book.figures.splice(0, book.figures.length, ...chosen);
  }
  book.start();
  return book;
}
