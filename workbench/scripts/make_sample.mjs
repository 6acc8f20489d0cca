// Writes the sample document that tests and pictures use: node scripts/make_sample.mjs [out.json]
import { writeFileSync } from "node:fs";
import { calibrate, fit, reconstruct } from "./sample/measure.mjs";
import { build, describe, simulate } from "./sample/model.mjs";

const out = process.argv[2] ?? "test/sample.json";
const document = {
  title: "A young grass, from photographs to reflectance",
  version: "0.1.0",
  command: "bpms report calibrate.json reconstruct.json fit.json build.json describe.json simulate.json -o report.html",
  created: "2026-11-22T10:00:00Z",
  notes: ["All numbers on this page come from formulas: it is a sample that shows what a report looks like, not a measurement."],
  reports: [calibrate(), reconstruct(), fit(), build(), describe(), simulate()],
};
writeFileSync(out, `${JSON.stringify(document)}\n`);
