// Photographs with the reconstruction drawn over them. Pixel centres are integers, so pixel (u, v) lies at
// (u + 0.5, v + 0.5) of a drawing that is as large as the image.

import type { Reconstruct } from "../data";
import { h, imageSource, svg } from "../dom";
import { significant } from "../format";
import type { Organs } from "../organs";
import { rejected } from "../palette";

type Photograph = Reconstruct["photographs"][number];
type Curve = Reconstruct["curves"][number];
type Point = Curve["points"][number];
type Uv = [number, number];

function place(p: readonly (number | null)[] | undefined): Uv | null {
  const [u, v] = p ?? [];
  return typeof u === "number" && typeof v === "number" ? [u + 0.5, v + 0.5] : null;
}

// A point names the view, or the camera where there is one photograph of each.
function inPhotograph(of: Record<string, (number | null)[]>, photo: Photograph): Uv | null {
  return place(of[photo.view ?? ""] ?? of[photo.camera ?? ""]);
}

function hover(organs: Organs, c: Curve, p: Point): string {
  const label = organs.full({ ...c, point: p.point });
  const state = p.rejected ? ", rejected" : "";
  const chi2 = p.chi2 === null ? "" : ` (χ² ${significant(p.chi2, 3)})`;
  return label + state + chi2;
}

function drawCurve(photo: Photograph, curve: Curve, organs: Organs, unit: number): SVGGElement {
  const colour = organs.colour(curve);
  const group = svg("g", { class: "curve" });
  const path = curve.points.filter((p) => !p.rejected).flatMap((p) => inPhotograph(p.reprojected, photo) ?? []);
  const points: string[] = [];
  for (let i = 0; i + 1 < path.length; i += 2) points.push(`${path[i]},${path[i + 1]}`);
  const outline = curve.feature !== null && !/midrib|axis/.test(curve.feature);
  const style = { points: points.join(" "), fill: "none", "stroke-linejoin": "round" };
  group.append(
    svg("polyline", { ...style, stroke: "#ffffff", "stroke-opacity": 0.7, "stroke-width": unit * (outline ? 2.2 : 4) }),
    svg("polyline", { ...style, stroke: colour, "stroke-width": unit * (outline ? 1.2 : 2.2) }),
  );
  for (const p of curve.points) {
    const at = inPhotograph(p.digitised, photo);
    if (!at) continue;
    const [x, y] = at;
    const r = unit * (p.rejected ? 5.5 : 3);
    const dot = svg("g", { class: "dot", "data-label": hover(organs, curve, p) });
    const ring = { cx: x, cy: y, r, "stroke-width": unit * 1.2 };
    if (p.rejected) {
      const d = r * 0.7;
      dot.append(
        svg("circle", { ...ring, fill: "rgba(255,255,255,0.55)", stroke: rejected, "stroke-width": unit * 1.8 }),
        svg("path", { d: `M${x - d},${y - d}L${x + d},${y + d}M${x - d},${y + d}L${x + d},${y - d}`, stroke: rejected, "stroke-width": unit * 1.8 }),
      );
    } else dot.append(svg("circle", { ...ring, fill: "#ffffff", stroke: colour }));
    dot.append(svg("circle", { cx: x, cy: y, r: r + unit * 4, fill: "transparent" }));
    group.append(dot);
  }
  return group;
}

function photograph(photo: Photograph, curves: readonly Curve[], organs: Organs): HTMLElement {
  const all = curves.flatMap((c) => c.points.flatMap((p) => [inPhotograph(p.digitised, photo), inPhotograph(p.reprojected, photo)]));
  const reach = (i: 0 | 1): number => Math.max(16, ...all.map((p) => (p ? p[i] : 0)));
  const width = photo.width ?? Math.ceil(reach(0) * 1.05);
  const height = photo.height ?? Math.ceil(reach(1) * 1.05);
  const source = imageSource(photo.data_uri);
  const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `photograph ${photo.view ?? ""}` });
  picture.append(svg("rect", { width, height, fill: "#d5d9dd" }));
  if (source !== null) picture.append(svg("image", { href: source, width, height, preserveAspectRatio: "none" }));
  for (const c of curves) picture.append(drawCurve(photo, c, organs, width / 640));
  const label = h("div", { class: "tip", hidden: true });
  const box = h("div", { class: "photo" }, picture, label);
  box.addEventListener("mousemove", (event) => {
    const dot = event.target instanceof Element ? event.target.closest("[data-label]") : null;
    label.hidden = dot === null;
    if (!dot) return;
    const frame = box.getBoundingClientRect();
    label.textContent = dot.getAttribute("data-label");
    label.style.left = `${Math.min(event.clientX - frame.left + 12, frame.width - label.offsetWidth - 4)}px`;
    label.style.top = `${event.clientY - frame.top + 14}px`;
  });
  box.addEventListener("mouseleave", () => (label.hidden = true));
  const name = [photo.view, photo.camera === photo.view ? null : photo.camera].filter((s) => s !== null).join(", ");
  return h("div", {}, h("div", { class: "phototitle" }, name), box);
}

export function photoOverlay(photographs: readonly Photograph[], curves: readonly Curve[], organs: Organs): HTMLElement {
  const legend = h("div", { class: "legend" });
  for (const o of organs.list) {
    const swatch = h("span", { class: "swatch" });
    swatch.style.background = o.colour;
    legend.append(h("span", { class: "entry" }, swatch, o.name));
  }
  const pictures = photographs.map((p) => photograph(p, curves, organs));
  return h("div", {}, h("div", { class: photographs.length > 1 ? "photos two" : "photos" }, ...pictures), legend);
}
