// Maps of a quantity over the hemisphere of views: zenith from the middle outwards, azimuth from the sun, which stands at the top.

import type { Choice, Section } from "../book";
import type { Series, Simulate } from "../data";
import { sentenceCase } from "../format";
import { ink, quiet } from "../palette";
import { axisTitle, type PlotSpec, type Trace } from "../plot";
import { byBand, isWhole, quantityName } from "./reflectance";

const radians = Math.PI / 180;

export interface PolarPoint {
  x: number; // degrees from nadir, to the right of the sun
  y: number; // towards the sun
  value: number;
}

// A negative zenith angle looks from the other side.
export function polarPoints(s: Series): PolarPoint[] {
  const saa = s.saa_deg ?? 0;
  return s.vza_deg.flatMap((vza, i) => {
    const value = s.value[i] ?? null;
    const vaa = s.vaa_deg[i] ?? null;
    if (vza === null || value === null || vaa === null) return [];
    const angle = (vaa - saa) * radians;
    return [{ x: vza * Math.sin(angle), y: vza * Math.cos(angle), value }];
  });
}

// Views over the hemisphere and not along a plane or two: three planes or more.
export function isHemisphere(s: Series): boolean {
  const planes = new Set(
    s.vza_deg.flatMap((vza, i) => {
      const vaa = s.vaa_deg[i] ?? null;
      return vza === null || vaa === null || Math.abs(vza) < 1e-6 ? [] : [Math.round((((vaa % 180) + 180) % 180) * 10) % 1800];
    }),
  );
  return planes.size >= 3 && s.vza_deg.length >= 9;
}

// Between the views by the inverse fourth power of the distance, which goes through each of them.
export function interpolate(points: readonly PolarPoint[], x: number, y: number): number | null {
  let sum = 0;
  let weights = 0;
  for (const p of points) {
    const d2 = (p.x - x) ** 2 + (p.y - y) ** 2;
    if (d2 < 1e-9) return p.value;
    const w = 1 / (d2 * d2);
    sum += w * p.value;
    weights += w;
  }
  return weights > 0 ? sum / weights : null;
}

function ring(radius: number): Trace {
  const at = Array.from({ length: 73 }, (_, i) => i * 5 * radians);
  return {
    type: "scatter", mode: "lines", x: at.map((a) => radius * Math.sin(a)), y: at.map((a) => radius * Math.cos(a)),
    line: { color: "rgba(255,255,255,0.55)", width: 1 }, hoverinfo: "skip", showlegend: false,
  }; // prettier-ignore
}

function label(x: number, y: number, text: string, colour: string): Record<string, unknown> {
  return { x, y, text, showarrow: false, font: { size: 11, color: colour } };
}

export function polarMap(s: Series): PlotSpec {
  const points = polarPoints(s);
  const outermost = Math.max(...points.map((p) => Math.hypot(p.x, p.y)));
  const n = 121;
  const grid = Array.from({ length: n }, (_, i) => -outermost + (2 * outermost * i) / (n - 1));
  const z = grid.map((y) => grid.map((x) => (Math.hypot(x, y) <= outermost ? interpolate(points, x, y) : null)));
  const map: Trace = {
    type: "heatmap", x: grid, y: grid, z, colorscale: "Viridis", zsmooth: "best", hoverinfo: "skip",
    colorbar: { title: { text: quantityName(s.quantity), side: "right", font: { size: 13, color: ink } }, thickness: 14, len: 0.85, outlinewidth: 0 },
  }; // prettier-ignore
  const dots: Trace = {
    type: "scatter", mode: "markers", x: points.map((p) => p.x), y: points.map((p) => p.y), marker: { color: "rgba(255,255,255,0.7)", size: 3 },
    text: points.map((p) => `view zenith ${Math.hypot(p.x, p.y).toFixed(1)}°<br>${quantityName(s.quantity)} ${p.value.toPrecision(4)}`),
    hovertemplate: "%{text}<extra></extra>", showlegend: false,
  }; // prettier-ignore
  const sun = s.sza_deg !== null && s.sza_deg <= outermost ? s.sza_deg : null;
  const sunMark: Trace[] =
    sun === null ? [] : [{ type: "scatter", mode: "markers", x: [0], y: [sun], marker: { symbol: "circle-open", size: 13, color: "#ffffff", line: { width: 2 } }, hovertemplate: `the sun, ${sun}°<extra></extra>`, showlegend: false }];
  const zeniths = [15, 30, 45, 60, 75].filter((zenith) => zenith <= outermost + 1e-6);
  const off = outermost * 1.08;
  const around = [0, 45, 90, 135, 180, 225, 270, 315].map((a) => label(off * Math.sin(a * radians), off * Math.cos(a * radians), `${a}°`, quiet));
  const heights = zeniths.map((zenith) => label(zenith * Math.sin(2.75), zenith * Math.cos(2.75), `${zenith}°`, "#ffffff"));
  const hidden = { visible: false, range: [-1.16 * outermost, 1.16 * outermost] };
  return {
    height: 520,
    maxWidth: 640,
    data: [map, ...zeniths.map(ring), dots, ...sunMark],
    layout: {
      xaxis: { ...hidden, constrain: "domain" },
      yaxis: { ...hidden, scaleanchor: "x", title: axisTitle("") },
      annotations: [...around, ...heights],
      margin: { l: 10, r: 10, t: 10, b: 10 },
      showlegend: false,
    },
  };
}

export function polarMaps(r: Simulate, s: Section): void {
  const chosen = r.series.filter((x) => isWhole(x) && x.material === null && isHemisphere(x) && !/^fraction/.test(x.quantity ?? ""));
  for (const quantity of new Set(chosen.map((x) => x.quantity))) {
    const choices = byBand(chosen.filter((x) => x.quantity === quantity)).flatMap((band): Choice[] =>
      band.series.map((x) => ({ label: [x.sensor, band.name].filter(Boolean).join(", "), spec: () => polarMap(x) })),
    );
    const sun = chosen.some((x) => x.sza_deg !== null);
    s.plot(
      `polar-${quantity ?? "value"}`,
      choices,
      `${sentenceCase(quantityName(quantity))} over the hemisphere of views (dots), interpolated in between. The view zenith angle grows outwards; azimuths are those of the sensor${sun ? " from the sun, which stands at the top (ring)" : ""}.`,
    );
  }
}
