// Images that sensors saw; a hemispherical one in its circle with rings of equal angle to its axis.

import type { Section } from "../book";
import type { Picture, Simulate } from "../data";
import { h, imageSource, svg } from "../dom";

const view = 1000; // units across

// What a hemispherical picture needs to be drawn in its circle.
export type RoundPicture = Pick<Picture, "data_uri" | "rings">;

export function roundPicture(image: RoundPicture, alt: string): SVGSVGElement {
  const middle = view / 2;
  const clip = "round-" + Math.random().toString(36).slice(2);
  const rings = image.rings.flatMap(({ angle_deg, radius }) => {
    if (angle_deg === null || radius === null) return [];
    const r = radius * middle;
    return [
      svg("circle", { cx: middle, cy: middle, r, fill: "none", stroke: "#ffffff", "stroke-opacity": 0.6, "stroke-width": 2 }),
      svg("text", { x: middle + 6, y: middle - r + 24, class: "ring" }, `${angle_deg}°`),
    ];
  });
  return svg(
    "svg",
    { viewBox: `-6 -6 ${view + 12} ${view + 12}`, class: "render fisheye", role: "img", "aria-label": alt },
    svg("clipPath", { id: clip }, svg("circle", { cx: middle, cy: middle, r: middle })),
    svg("image", { href: imageSource(image.data_uri), width: view, height: view, "clip-path": `url(#${clip})`, style: "image-rendering: pixelated" }),
    ...rings,
    svg("circle", { cx: middle, cy: middle, r: middle, fill: "none", stroke: "#6b7280", "stroke-width": 3 }),
  );
}

export function images(r: Simulate, s: Section): void {
  const shown = r.images.filter((i) => imageSource(i.data_uri) !== null);
  shown.forEach((image, i) => {
    const alt = image.caption ?? image.sensor ?? "rendered image";
    const small = (image.width ?? 1000) < 400;
    const picture =
      image.rings.length > 0
        ? roundPicture(image, alt)
        : h("img", { src: imageSource(image.data_uri), alt, class: small ? "render small" : "render" });
    const caption = image.caption ?? `Image of the sensor ${image.sensor ?? ""}.`;
    const rings = image.rings.length > 0 ? ", with rings of the angle to its axis" : "";
    s.figure(`image-${i + 1}`, h("div", { class: image.rings.length > 0 ? "renderframe white" : "renderframe" }, picture), caption.replace(/\.$/, "") + rings + ".");
  });
}
