// What lies over the picture: the bar of known length and the compass.

import type * as THREE from "three";
import { lengthLabel } from "../figures/scene3d_content";
import { niceBelow } from "../format";
import { h, svg } from "../dom";

export class Overlay {
  private readonly bar = h("div", { class: "bar" });
  private readonly label = h("span", {});
  private readonly axes = svg("svg", { viewBox: "-40 -40 80 80", class: "axes" });
  readonly element = h("div", { class: "overlay" }, h("div", { class: "scale" }, this.bar, this.label), this.axes);

  update(metresPerPixel: number, camera: THREE.Camera): void {
    const length = niceBelow(160 * metresPerPixel);
    this.bar.style.width = `${length / metresPerPixel}px`;
    this.label.textContent = lengthLabel(length);
    const m = camera.matrixWorldInverse.elements; // columns: where x, y and z of the scene point on the screen
    const axes: [string, string, number][] = [["east", "#b3402a", 0], ["north", "#2f7d4f", 4], ["up", "#3b6fb6", 8]]; // prettier-ignore
    this.axes.replaceChildren(
      ...axes.flatMap(([name, colour, at]) => {
        const [x, y] = [24 * (m[at] ?? 0), -24 * (m[at + 1] ?? 0)];
        if (Math.hypot(x, y) < 4) return [];
        const out = 1.28;
        return [
          svg("line", { x1: 0, y1: 0, x2: x, y2: y, stroke: colour, "stroke-width": 2 }),
          svg("text", { x: x * out, y: y * out + 3, fill: colour, "text-anchor": "middle" }, name),
        ];
      }),
    );
  }
}
