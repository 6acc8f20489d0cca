// Gap probabilities over the view angle: of the view, of sun and view together, and what they share beyond chance.

import type { Section } from "../book";
import type { Series, Simulate } from "../data";
import { axisTitle, type Trace } from "../plot";
import { accent } from "../palette";
import { errorLine } from "./errorbars";
import { anglePanels } from "./reflectance";
import { isHemisphere } from "./polar";
import { mainPlane } from "./view_angles";

const lines: [string, string, string][] = [
  ["gap", "gap P(v)", accent],
  ["bidirectional_gap", "sunlit ground P(s, v)", "#d1812a"],
  ["overlap", "overlap P(s, v) − P(s) P(v)", "#3b6fb6"],
];

function curve(x: Series, name: string, colour: string, at: Partial<Trace>): Trace {
  const rows = mainPlane(x);
  return errorLine({ x: rows.map((p) => p.vza), y: rows.map((p) => p.value), se: rows.map((p) => p.se) }, colour, { ...at, name, legendgroup: name });
}

export function gaps(r: Simulate, s: Section): void {
  const chosen = r.series.filter((x) => lines.some(([quantity]) => quantity === x.quantity) && x.vza_deg.length > 1 && !isHemisphere(x));
  const sensor = chosen[0]?.sensor ?? null;
  const own = chosen.filter((x) => x.sensor === sensor);
  const sun = own.find((x) => x.sza_deg !== null && x.quantity !== "gap") ?? null;
  const ofSun = own.filter((x) => x.quantity === "gap" || (x.sza_deg === sun?.sza_deg && x.saa_deg === sun?.saa_deg));
  if (ofSun.length === 0) return;
  const several = r.suns.length > 1 ? " of the first sun" : "";
  const traces = (at: Partial<Trace>): Trace[] =>
    lines.flatMap(([quantity, name, colour]) => {
      const x = ofSun.find((y) => y.quantity === quantity);
      return x ? [curve(x, name, colour, at)] : [];
    });
  const spec = anglePanels({ yTitle: "probability", groups: [{ title: "", series: ofSun, traces }] }, 1);
  const towards = r.suns[0]?.gap ?? null;
  spec.layout["yaxis"] = { ...(spec.layout["yaxis"] as object), title: axisTitle("probability") };
  s.plot("gap", spec, `Gap probabilities${several} of the sensor ${sensor ?? ""}${towards === null ? "" : `; towards the sun P(s) = ${towards.toPrecision(3)}`}. Bars are ±1.96 standard errors.`);
}
