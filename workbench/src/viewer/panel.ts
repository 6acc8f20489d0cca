// The column beside the picture: colours with their legend, views, section, the organ that was clicked.

import { h } from "../dom";
import { significant } from "../format";
import type { Colouring, InstanceGroup, PartInfo, PrototypeData } from "./data";
import { directions, type Axis, type Section } from "./stage";

export interface PanelActions {
  colour: (name: string) => void;
  look: (name: string) => void;
  project: (orthographic: boolean) => void;
  cut: (section: Section | null) => void;
  ground: (shown: boolean) => void;
  save: () => void;
}

export function legend(of: Colouring): HTMLElement {
  const swatch = (colour: string, label: string): HTMLElement => {
    const box = h("span", { class: "swatch" });
    box.style.background = colour;
    return h("li", {}, box, label);
  };
  if (!of.scale) {
    const most = 60;
    const more = of.entries.length - most;
    return h("ul", { class: "legend" }, ...of.entries.slice(0, most).map((e) => swatch(e.colour, e.label)), more > 0 && h("li", {}, `and ${more} more`));
  }
  const { low, high, colours, no_value } = of.scale;
  const bar = h("div", { class: "ramp" });
  bar.style.background = `linear-gradient(to right, ${colours.join(", ")})`;
  const steps = high > low ? [0, 0.5, 1] : [0.5];
  const numbers = h("div", { class: "numbers" }, ...steps.map((s) => h("span", {}, significant(low + s * (high - low), 3))));
  return h("div", { class: "legend" }, h("div", { class: "unit" }, of.title), bar, numbers, no_value !== undefined && h("ul", {}, swatch(no_value, "no value")));
}

type Row = [string, string];

export function partRows(part: PartInfo, prototype: PrototypeData, group: InstanceGroup, instance: number): Row[] {
  const scale = group.poses[8 * instance + 7] ?? 1;
  const rows: Row[] = [["plant", `${prototype.name} no. ${group.plants[instance] ?? instance}`], ["kind", part.kind], ["material", part.material]]; // prettier-ignore
  const add = (name: string, value: number | null, factor: number, unit: string): void => {
    if (value !== null) rows.push([name, `${significant(value * factor, 4)} ${unit}`]);
  };
  add("length", part.length_m, 100 * scale, "cm");
  add("area", part.area_m2, 1e4 * scale * scale, "cm²");
  add("mean height", part.height_m, 100 * scale, "cm");
  add("mean inclination", part.inclination_deg, 1, "°");
  if (scale !== 1) rows.push(["scale of the clone", significant(scale, 4)]);
  const [x = 0, y = 0, z = 0] = group.poses.subarray(8 * instance, 8 * instance + 3);
  rows.push(["stands at", `${[x, y, z].map((v) => v.toFixed(3)).join(", ")} m`]);
  return rows;
}

export class Panel {
  private readonly legendPlace = h("div", {});
  private readonly organ = h("div", { class: "organ" });
  private readonly colourChoice: HTMLSelectElement;
  private readonly flat = h("input", { type: "checkbox", id: "orthographic" });
  readonly element: HTMLElement;

  constructor(
    title: string,
    counts: string,
    colourings: readonly Colouring[],
    hasGround: boolean,
    notes: readonly string[],
    private readonly act: PanelActions,
  ) {
    this.colourChoice = h("select", { id: "colour" }, ...colourings.map((c) => h("option", { value: c.name }, c.name.replace(/_/g, " "))));
    this.colourChoice.addEventListener("change", () => act.colour(this.colourChoice.value));
    this.flat.addEventListener("change", () => act.project(this.flat.checked));
    this.element = h(
      "aside",
      {},
      h("h1", {}, title),
      h("p", { class: "counts" }, counts),
      h("h2", {}, h("label", { for: "colour" }, "Colour by"), this.colourChoice),
      this.legendPlace,
      h("h2", {}, "View"),
      h("div", { class: "buttons" }, ...Object.keys(directions).map((name) => this.button(name, () => act.look(name)))),
      h("label", { class: "line" }, this.flat, "orthographic"),
      hasGround && this.groundLine(),
      ...this.sectionLines(),
      h("h2", {}, "Organ"),
      this.organ,
      h("div", { class: "buttons" }, this.button("save picture", () => act.save())),
      ...notes.map((note) => h("p", { class: "note" }, note)),
      h("details", { class: "help" }, h("summary", {}, "Mouse and keys"), h("ul", {}, ...help.map((line) => h("li", {}, line)))),
    );
    this.showPart(null, []);
  }

  private button(name: string, run: () => void): HTMLButtonElement {
    const out = h("button", { type: "button" }, name);
    out.addEventListener("click", run);
    return out;
  }

  private groundLine(): HTMLElement {
    const box = h("input", { type: "checkbox", checked: true });
    box.addEventListener("change", () => this.act.ground(box.checked));
    return h("label", { class: "line" }, box, "ground");
  }

  private sectionLines(): HTMLElement[] {
    const axis = h("select", { id: "section" }, ...["none", "x", "y", "z"].map((name) => h("option", { value: name }, name === "none" ? name : `across ${name}`)));
    const place = h("input", { type: "range", min: 0, max: 1, step: 0.002, value: 0.5, disabled: true });
    const upper = h("input", { type: "checkbox", disabled: true });
    const changed = (): void => {
      const off = axis.value === "none";
      place.disabled = upper.disabled = off;
      this.act.cut(off ? null : { axis: axis.value as Axis, place: Number(place.value), upper: upper.checked });
    };
    for (const input of [axis, upper]) input.addEventListener("change", changed);
    place.addEventListener("input", changed);
    return [h("h2", {}, h("label", { for: "section" }, "Section"), axis), place, h("label", { class: "line" }, upper, "show the other side")];
  }

  showColouring(of: Colouring): void {
    this.colourChoice.value = of.name;
    this.legendPlace.replaceChildren(legend(of));
  }
  showOrthographic(flat: boolean): void {
    this.flat.checked = flat;
  }

  showPart(part: PartInfo | null, rows: readonly Row[]): void {
    if (!part) return this.organ.replaceChildren(h("p", { class: "absent" }, "Click one to see what it is."));
    const table = (entries: readonly Row[]): HTMLElement => h("table", {}, ...entries.map(([name, value]) => h("tr", {}, h("th", {}, name), h("td", {}, value))));
    const named = (title: string, values: Record<string, string> | undefined): (HTMLElement | false)[] =>
      values ? [h("h3", {}, title), table(Object.entries(values))] : [];
    this.organ.replaceChildren(
      h("h3", {}, part.label || part.kind),
      table(rows),
      ...named("carried along", part.properties).filter((e) => e !== false),
      ...named("parameters", part.parameters).filter((e) => e !== false),
    );
  }
}

const help = [
  "left button: turn; wheel: nearer; right button: move",
  "click: what is it; Escape: nothing",
  "1 2 3 4: oblique, front, side, top; o: orthographic",
  "metres, x east, y north, z up",
];
