// Spectra with their confidence bands.

import type { Section } from "../book";
import type { Simulate } from "../data";
import { significant } from "../format";
import { colour } from "../palette";
import { axisTitle, type Trace } from "../plot";
import { bandLine } from "./errorbars";
import { quantityName } from "./reflectance";

export function spectra(r: Simulate, s: Section): void {
  const shown = r.spectra.filter((x) => x.wavelength_nm.length > 1);
  const quantities = [...new Set(shown.map((x) => x.quantity))];
  for (const quantity of quantities) {
    const data = shown
      .filter((x) => x.quantity === quantity)
      .flatMap((x, i): Trace[] => {
        const parts = [
          x.sensor,
          x.vza_deg === null ? null : `view ${significant(x.vza_deg, 3)}°`,
          x.sza_deg === null ? null : `sun ${significant(x.sza_deg, 3)}°`,
        ];
        const name = parts.filter((p) => p !== null).join(", ") || `spectrum ${i + 1}`;
        return bandLine({ x: x.wavelength_nm, y: x.value, se: x.standard_error }, colour(i === 0 ? 0 : i + 1), { name, legendgroup: name, showlegend: true });
      });
    s.plot(
      quantities.length > 1 ? `spectrum-${quantity ?? "value"}` : "spectrum",
      {
        height: 400,
        data,
        layout: { xaxis: { title: axisTitle("wavelength (nm)") }, yaxis: { title: axisTitle(quantityName(quantity)), rangemode: "tozero" }, showlegend: true },
      },
      `Spectrum of the ${quantityName(quantity)} with its band of ±1.96 standard errors.`,
    );
  }
}
