import { expect, test } from "vitest";
import { calibrate, parseDocument, readDocument, reconstruct, simulate } from "../src/data";
import { imageSource, jsonTree } from "../src/dom";

test("a template that nobody filled says so", () => {
  expect(parseDocument("__BPMS_" + "DATA__")).toHaveProperty("problem");
  expect(parseDocument("  ")).toHaveProperty("problem");
});

test("broken data is a message, not an exception", () => {
  expect(parseDocument("{")).toHaveProperty("problem");
  expect(parseDocument("[1]")).toHaveProperty("problem");
});

test("missing keys become null and empty lists", () => {
  const r = calibrate({});
  expect(r.cameras).toEqual([]);
  expect(r.residual_rms_px).toBeNull();
  expect(reconstruct(null).check).toBeNull();
});

test("values of the wrong type are as good as missing, and null keeps its place in a list", () => {
  const r = simulate({ samples: "many", series: [{ vza_deg: [1, null, "x", 2] }, 7, null] });
  expect(r.samples).toBeNull();
  expect(r.series).toHaveLength(1);
  expect(r.series[0]?.vza_deg).toEqual([1, null, null, 2]);
});

test("names may be numbers", () => {
  expect(reconstruct({ rejected: [{ rank: 3, point: 12 }] }).rejected[0]).toMatchObject({ rank: "3", point: "12" });
});

test("a document keeps its reports in order and drops what is none", () => {
  const d = readDocument({ reports: [{ report: "fit" }, null, "x", { report: "build", warnings: ["w", null] }, {}] });
  expect(d.reports.map((r) => r.kind)).toEqual(["fit", "build", "unknown"]);
  expect(d.reports[1]?.warnings).toEqual(["w"]);
  expect(d.title).toBe("Report");
});

test("only pictures inside the document are shown", () => {
  expect(imageSource("data:image/png;base64,AAAA")).not.toBeNull();
  expect(imageSource("https://example.org/a.png")).toBeNull();
  expect(imageSource("data:image/svg+xml;base64,AAAA")).toBeNull();
});

test("an unknown report is shown as a tree of text", () => {
  const tree = jsonTree({ a: [1, { b: "<b>" }] });
  expect(tree.querySelector("b")).toBeNull();
  expect(tree.textContent).toContain("<b>");
});
