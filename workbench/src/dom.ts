// Elements without innerHTML: every text from a report goes in as text.

export type Child = Node | string | number | null | undefined | false;
type Attributes = Record<string, string | number | boolean | null | undefined>;

function fill<T extends Element>(element: T, attributes: Attributes, children: readonly Child[]): T {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    element.setAttribute(name, value === true ? "" : String(value));
  }
  for (const child of children) {
    if (child === null || child === undefined || child === false) continue;
    element.append(typeof child === "number" ? String(child) : child);
  }
  return element;
}

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  return fill(document.createElement(tag), attributes, children);
}

export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  return fill(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

// Only pictures that lie in the document itself are shown; anything else would need a network.
export function imageSource(uri: string | null): string | null {
  return uri !== null && /^data:image\/(png|jpeg|webp|gif);base64,/.test(uri) ? uri : null;
}

export interface Column<Row> {
  head: string;
  unit?: string;
  cell: (row: Row) => Child;
  text?: boolean; // left-aligned words instead of right-aligned figures
  sort?: (row: Row) => number | string | null; // with it the head is a button that sorts the rows
}

// Numbers before words, what is missing last in either direction.
export function compare(a: number | string | null, b: number | string | null, down: boolean): number {
  if (a === null || b === null) return a === b ? 0 : a === null ? 1 : -1;
  const order = typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b), "en", { numeric: true });
  return down ? -order : order;
}

export function table<Row>(columns: readonly Column<Row>[], rows: readonly Row[], mark?: (row: Row) => string | null) {
  const body = h("tbody");
  const fillBody = (shown: readonly Row[]): void =>
    body.replaceChildren(...shown.map((row) => h("tr", { class: mark?.(row) }, ...columns.map((c) => h("td", { class: c.text ? "text" : null }, c.cell(row))))));
  const head = columns.map((c) => {
    const unit = c.unit ? h("span", { class: "unit" }, c.unit) : null;
    const cell = h("th", { class: c.text ? "text" : null, scope: "col" });
    const { sort } = c;
    if (!sort) cell.append(c.head, ...(unit ? [unit] : []));
    else {
      const button = h("button", { type: "button", class: "sort", title: "sort by this column" }, c.head, unit);
      button.addEventListener("click", () => {
        // Figures from the largest down first, words from a.
        const state = cell.getAttribute("aria-sort");
        const down = state === null ? !c.text : state === "ascending";
        for (const other of head) other.removeAttribute("aria-sort");
        cell.setAttribute("aria-sort", down ? "descending" : "ascending");
        fillBody([...rows].sort((a, b) => compare(sort(a), sort(b), down)));
      });
      cell.append(button);
    }
    return cell;
  });
  fillBody(rows);
  return h("table", {}, h("thead", {}, h("tr", {}, ...head)), body);
}

// Any JSON value as a tree that unfolds.
export function jsonTree(value: unknown, name = "", depth = 0): HTMLElement {
  const title = name === "" ? "" : `${name}: `;
  if (typeof value !== "object" || value === null)
    return h("div", { class: "leaf" }, title, h("code", {}, JSON.stringify(value) ?? "undefined"));
  const entries = Object.entries(value);
  const kind = Array.isArray(value) ? `[${entries.length}]` : `{${entries.length}}`;
  const shown = entries.slice(0, 200);
  return h(
    "details",
    { class: "json", open: depth === 0 && name === "" },
    h("summary", {}, title, h("span", { class: "unit" }, kind)),
    ...(depth > 12 ? [] : shown.map(([k, v]) => jsonTree(v, k, depth + 1))),
    shown.length < entries.length && h("div", { class: "leaf" }, `and ${entries.length - shown.length} more`),
  );
}
