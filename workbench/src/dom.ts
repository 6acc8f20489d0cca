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
}

export function table<Row>(columns: readonly Column<Row>[], rows: readonly Row[], mark?: (row: Row) => string | null) {
  const head = columns.map((c) =>
    h("th", { class: c.text ? "text" : null, scope: "col" }, c.head, c.unit ? h("span", { class: "unit" }, c.unit) : null),
  );
  const body = rows.map((row) =>
    h(
      "tr",
      { class: mark?.(row) },
      ...columns.map((c) => h("td", { class: c.text ? "text" : null }, c.cell(row))),
    ),
  );
  return h("table", {}, h("thead", {}, h("tr", {}, ...head)), h("tbody", {}, ...body));
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
