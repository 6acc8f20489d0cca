// The page under construction: sections with numbered figures and tables.

import { h, table, type Child, type Column } from "./dom";
import { draw, type PlotSpec } from "./plot";

export interface Figure {
  id: string;
  number: number;
  caption: string;
  element: HTMLElement;
  // Draws into the element once it is on the page; `spec` is what a chart will show first.
  start: (() => void) | null;
  spec: PlotSpec | null;
}

// One state of a chart that a small select switches.
export interface Choice {
  label: string;
  spec: () => PlotSpec;
}

export interface Card {
  label: string;
  value: string;
  note?: string;
}

export class Book {
  readonly figures: Figure[] = [];
  private tables = 0;
  private readonly kinds = new Map<string, number>();

  // The id of a second report of one kind ends in -2, and so on.
  section(kind: string, title: string): Section {
    const n = (this.kinds.get(kind) ?? 0) + 1;
    this.kinds.set(kind, n);
    return new Section(this, n === 1 ? kind : `${kind}-${n}`, n === 1 ? title : `${title} (${n})`);
  }

  nextTable(): number {
    this.tables += 1;
    return this.tables;
  }

  start(): void {
    for (const figure of this.figures) {
      try {
        figure.start?.();
      } catch (error) {
        figure.element.append(h("p", { class: "absent" }, `This figure could not be drawn: ${String(error)}`));
      }
    }
  }
}

export class Section {
  readonly element: HTMLElement;

  constructor(
    private readonly book: Book,
    readonly id: string,
    readonly title: string,
  ) {
    this.element = h("section", { id }, h("h2", {}, title));
  }

  add(...children: Child[]): void {
    for (const child of children) if (child) this.element.append(typeof child === "number" ? String(child) : child);
  }

  paragraph(...children: Child[]): void {
    this.add(h("p", {}, ...children));
  }

  // A statement of the run itself: a warning, a remark.
  note(text: string): void {
    this.add(h("p", { class: "note" }, text));
  }

  heading(text: string): void {
    this.add(h("h3", {}, text));
  }

  cards(cards: readonly Card[]): void {
    if (cards.length > 0) this.add(cardRow(cards));
  }

  table<Row>(columns: readonly Column<Row>[], rows: readonly Row[], caption: string, mark?: (row: Row) => string | null): void {
    if (rows.length === 0) return;
    const long = rows.length > 20;
    const holder = h("div", { class: long ? "scroll long" : "scroll" }, table(columns, rows, mark));
    const line = h("p", { class: "caption" }, h("b", {}, `Table ${this.book.nextTable()}. `), caption);
    this.add(h("div", { class: "table" }, line, holder));
  }

  plot(name: string, what: PlotSpec | readonly Choice[], caption: string): void {
    const place = h("div", { class: "plot" });
    const choices = "data" in what ? [{ label: "", spec: () => what }] : what;
    const first = choices[0];
    if (!first) return;
    const firstSpec = first.spec();
    place.style.minHeight = `${firstSpec.height}px`;
    if (firstSpec.maxWidth !== undefined) place.style.maxWidth = `${firstSpec.maxWidth}px`;
    const select = choices.length > 1 ? h("select", {}, ...choices.map((c, i) => h("option", { value: i }, c.label))) : null;
    select?.addEventListener("change", () => draw(place, (choices[Number(select.value)] ?? first).spec()));
    const content = h("div", {}, select && h("label", { class: "choice" }, "Show ", select), place);
    this.figure(name, content, caption, () => draw(place, firstSpec), firstSpec);
  }

  figure(name: string, content: HTMLElement, caption: string, start: (() => void) | null = null, spec: PlotSpec | null = null): void {
    const id = `${this.id}-${name}`;
    const number = this.book.figures.length + 1;
    const line = h("figcaption", {}, h("a", { href: `#${id}` }, h("b", {}, `Figure ${number}.`)), " ", caption);
    const element = h("figure", { id }, content, line);
    this.book.figures.push({ id, number, caption, element, start, spec });
    this.add(element);
  }
}

export function cardRow(cards: readonly Card[]): HTMLElement {
  const one = (c: Card): HTMLElement =>
    h("div", { class: "card" }, h("div", { class: "label" }, c.label), h("div", { class: "value" }, c.value), c.note ? h("div", { class: "remark" }, c.note) : null);
  return h("div", { class: "cards" }, ...cards.map(one));
}
