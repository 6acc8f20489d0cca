// Spectra with their confidence bands.

import type { Section } from "../book";
import type { Simulate } from "../data";
import { significant } from "../format";
import { colour } from "../palette";
import { axisTitle, type Trace } from "../plot";
import { bandLine, errorLine } from "./errorbars";
import { quantityName } from "./reflectance";

// Of many views a few tell the story: spread evenly over each sensor's list, with the one nearest to nadir.
const mostOfSensor = 6;

function chosen<T extends { sensor: string | null; vza_deg: number | null }>(all: readonly T[]): T[] {
  const sensors = [...new Set(all.map((x) => x.sensor))];
  return sensors.flatMap((sensor) => {
    const own = all.filter((x) => x.sensor === sensor);
    if (own.length <= mostOfSensor) return own;
    const steps = mostOfSensor - 2;
    const picked = new Set(Array.from({ length: steps + 1 }, (_, i) => Math.round((i * (own.length - 1)) / steps)));
    const steepest = own.reduce((best, x, i) => (Math.abs(x.vza_deg ?? 90) < Math.abs(own[best]?.vza_deg ?? 90) ? i : best), 0);
    return own.filter((_, i) => picked.has(i) || i === steepest);
  });
}

export function spectra(r: Simulate, s: Section): void {
  const shown = r.spectra.filter((x) => x.value.length > 1);
  const names = r.band_names.map((n) => n ?? "");
  const named =
    names.length > 0
      ? { title: axisTitle("band"), tickmode: "array", tickvals: names.map((_, k) => k), ticktext: names, range: [-0.5, names.length - 0.5] }
      : null;
  const quantities = [...new Set(shown.map((x) => x.quantity))];
  for (const quantity of quantities) {
    const all = shown.filter((x) => x.quantity === quantity);
    const drawn = chosen(all);
    const data = drawn
      .flatMap((x, i): Trace[] => {
        const parts = [
          x.sensor,
          x.vza_deg === null ? null : `view ${significant(x.vza_deg, 3)}°${x.vaa_deg === null ? "" : ` / ${significant(x.vaa_deg, 3)}°`}`,
          x.sza_deg === null ? null : `sun ${significant(x.sza_deg, 3)}°`,
        ];
        const name = parts.filter((p) => p !== null).join(", ") || `spectrum ${i + 1}`;
        const look = { name, legendgroup: name, showlegend: true };
        const c = colour(i === 0 ? 0 : i + 1);
        // Between the bands of a sensor there is nothing to interpolate: their values stand side by side.
        return named
          ? [errorLine({ x: x.value.map((_, k) => k), y: x.value, se: x.standard_error }, c, { ...look, line: { color: c, width: 1, dash: "dot" } })]
          : bandLine({ x: x.wavelength_nm, y: x.value, se: x.standard_error }, c, look);
      });
    s.plot(
      quantities.length > 1 ? `spectrum-${quantity ?? "value"}` : "spectrum",
      {
        height: 400,
        data,
        layout: { xaxis: named ?? { title: axisTitle("wavelength (nm)") }, yaxis: { title: axisTitle(quantityName(quantity)), rangemode: "tozero" }, showlegend: true },
      },
      `Spectrum of the ${quantityName(quantity)} with its ${named ? "bars" : "band"} of ±1.96 standard errors${named ? ", by the sensor's bands" : "; views by zenith and azimuth"}.` +
        (drawn.length < all.length ? ` Of ${all.length} views ${drawn.length} are drawn.` : ""),
    );
  }
}
