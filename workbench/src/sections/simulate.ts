// Radiance and its parts, simulated by ray tracing.

import type { Section } from "../book";
import { simulate as read, type Simulate } from "../data";
import { fluxes } from "../figures/fluxes";
import { gaps } from "../figures/gaps";
import { images } from "../figures/pictures";
import { polarMaps } from "../figures/polar";
import { isWhole, reflectance } from "../figures/reflectance";
import { fractions, lightParts, orders, scatteringParts } from "../figures/radiance_parts";
import { orderDecay } from "../figures/scattering_orders";
import { spectra } from "../figures/spectra";
import { count, duration, magnitude, missing, plural } from "../format";
import { defineSection } from "./section";

const reasons: Record<string, string> = {
  target_se: "the wanted standard error was reached",
  samples: "the wanted number of paths was traced",
  max_samples: "the largest number of samples was reached",
  max_seconds: "the time was up",
  interrupt: "it was interrupted",
};

function runTable(r: Simulate, s: Section): void {
  const rows = [
    ["paths traced", magnitude(r.samples)],
    ["rays", magnitude(r.rays)],
    ["time", duration(r.seconds)],
    ["rays per second", r.rays !== null && r.seconds ? magnitude(r.rays / r.seconds) : missing],
    ["threads", count(r.threads)],
    ["seed", r.seed ?? missing],
    ["stopped because", r.stopped_by === null ? missing : (reasons[r.stopped_by] ?? r.stopped_by)],
    ["version", r.version ?? missing],
  ].filter(([, value]) => value !== missing);
  s.table(
    [
      { head: "run", text: true, cell: (row) => row[0] },
      { head: "value", cell: (row) => row[1] },
    ],
    rows,
    "The run.",
  );
}

export const simulate = defineSection({
  kind: "simulate",
  step: "simulate",
  title: "Simulated radiance",
  explanation:
    "Radiance of the scene by ray tracing, each value with its standard error; bars and bands are ±1.96 standard errors. " +
    "View zenith angles are signed: negative on the sun's side, so that the hot spot lies at minus the sun's zenith angle (dashed line).",
  read,
  summarise: (r) => {
    const totals = r.series.filter((x) => x.material === null && isWhole(x) && x.quantity !== "gap");
    const se = totals.flatMap((x) => x.standard_error).filter((e): e is number => e !== null);
    const effort = r.rays === null ? "" : ` with ${magnitude(r.rays)} rays`;
    const time = r.seconds === null ? "" : ` in ${duration(r.seconds)}`;
    const sensors = r.sensors.length || new Set(r.series.map((x) => x.sensor)).size;
    return {
      sentence: sensors === 0 && r.rays === null ? null : `${plural(sensors, "sensor")} simulated${effort}${time}.`,
      cards: [
        ...(r.rays === null ? [] : [{ label: "Rays traced", value: magnitude(r.rays), note: r.seconds === null ? "" : `in ${duration(r.seconds)}` }]),
        ...(se.length === 0 ? [] : [{ label: "Largest standard error", value: largest(se), note: "of a view's total" }]),
      ],
    };
  },
  render: (r, s) => {
    reflectance(r, s);
    polarMaps(r, s);
    scatteringParts(r, s);
    orders(r, s);
    orderDecay(r, s);
    lightParts(r, s);
    fractions(r, s);
    gaps(r, s);
    spectra(r, s);
    fluxes(r, s);
    images(r, s);
    runTable(r, s);
  },
});

function largest(se: readonly number[]): string {
  return Math.max(...se).toPrecision(2);
}
