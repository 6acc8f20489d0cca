import { readFileSync } from "node:fs";
import { beforeEach, expect, test, vi } from "vitest";
import { readDocument } from "../src/data";
import { renderDocument, showPage, wanted } from "../src/page";
import { fill } from "../scripts/fill.mjs";

vi.mock("plotly.js-cartesian-dist-min", () => ({ react: vi.fn() }));

const source = readFileSync("test/sample.json", "utf8");
interface Sample {
  reports: Record<string, unknown>[];
}
const sample = JSON.parse(source) as Sample;

// As in a browser without WebGL.
HTMLCanvasElement.prototype.getContext = () => null;

beforeEach(() => {
  document.body.className = "";
  document.body.innerHTML = '<main id="page"></main>';
});

const place = (): HTMLElement => document.getElementById("page") as HTMLElement;

test.each([
  ["calibrate", ["scene", "views", "frames", "quiver", "scatter", "normal", "board", "coverage", "sigma", "halves", "models", "triangulation", "correlation"].map((f) => `calibrate-${f}`)],
  ["reconstruct", ["reconstruct-photographs", "reconstruct-check", "reconstruct-curves"]],
  ["fit", ["fit-functions", "fit-midribs"]],
  ["build", ["build-scene"]],
  ["describe", ["angles", "azimuths", "g", "g-azimuth", "scattering", "gap", "gap-azimuth", "clumping", "fisheye", "profile"].map((f) => `describe-${f}`)],
  ["simulate", ["brf", "components", "orders", "origin", "fractions", "spectrum", "image-1"].map((f) => `simulate-${f}`)],
])("%s shows its figures", (kind, ids) => {
  const { book } = renderDocument(readDocument({ reports: sample.reports.filter((r) => r["report"] === kind) }));
  expect(book.figures.map((f) => f.id)).toEqual(ids);
});

test("under a sky the components of the sun's light are shown", () => {
  const part = (origin: string, component: string) => ({ sensor: "s", quantity: "hdrf", band: "1", origin, component, vza_deg: [0, 10], value: [0.1, 0.2], standard_error: [0.01, 0.01] });
  const series = [part("total", "all"), part("direct", "all"), part("direct", "uc_sgl"), part("direct", "co_sgl"), part("direct", "mlt"), part("diffuse", "all")];
  const { book } = renderDocument(readDocument({ reports: [{ report: "simulate", series }] }));
  expect(book.figures.map((f) => f.id)).toContain("simulate-components");
});

const manyBands = { sensor: "s", quantity: "brf", vza_deg: 0, wavelength_nm: [443, 492, 560], value: [0.1, 0.2, 0.3], standard_error: [0.01, 0.01, 0.01] };

test("fluxes have their figures, for the sensors that have layers and organs", () => {
  const row = (flux: string, of = "") => ({ flux, of, origin: "total", value: [0.5], standard_error: [0.01] });
  const all = ["reflected", "transmitted", "absorbed_layer", "absorbed_organ"].map((x) => row(x, "x"));
  const ids = (rows: object[]): string[] => renderDocument(readDocument({ reports: [{ report: "simulate", fluxes: [{ name: "f", rows }] }] })).book.figures.map((f) => f.id);
  expect(ids(all)).toEqual(["simulate-fluxes", "simulate-flux-layers", "simulate-flux-organs"]);
  expect(ids(all.slice(0, 2))).toEqual(["simulate-fluxes"]);
});

test("a spectrum over the bands of a sensor goes by their names", () => {
  const spec = (band_names: string[]) => renderDocument(readDocument({ reports: [{ report: "simulate", band_names, spectra: [manyBands] }] })).book.figures[0]?.spec;
  expect(spec(["B1", "B2", "B3"])?.layout["xaxis"]).toMatchObject({ ticktext: ["B1", "B2", "B3"], tickvals: [0, 1, 2] });
  expect(spec([])?.layout["xaxis"]).toMatchObject({ title: { text: "wavelength (nm)" } });
});

test("AICc is compared within one function of one organ", () => {
  const aicc_table = [["inclination", "p", -200], ["inclination", "n", -197], ["twist", "p", 52.5], ["twist", "n", 50]].map(([f, kind, aicc]) => ({ function: f, kind, order: 3, aicc }));
  const { element } = renderDocument(readDocument({ reports: [{ report: "fit", organs: [{ rank: "1", organ: "leaf", aicc_table }] }] }));
  const rows = [...element.querySelectorAll("tr")].map((row) => [...row.children].map((cell) => cell.textContent));
  expect(rows).toContainEqual(["leaf 1", "inclination", "0.0", "3.0"]);
  expect(rows).toContainEqual(["leaf 1", "twist", "2.5", "0.0"]);
});

test("the whole sample is shown without a failure, its figures numbered through", () => {
  const book = showPage(place(), source);
  expect(book?.figures.map((f) => f.number)).toEqual(book?.figures.map((_, i) => i + 1));
  expect(place().textContent).not.toContain("could not be");
  expect(place().querySelector("h1")?.textContent).toBe("A young grass, from photographs to reflectance");
  expect(place().textContent).toContain("83.17 ± 0.11 mm");
  expect(place().querySelectorAll("nav a.step")).toHaveLength(7);
});

// Every key in turn, at every depth down to the lists of objects, set to null or removed.
function damaged(value: unknown, depth = 0): unknown[] {
  if (depth > 4 || typeof value !== "object" || value === null) return [];
  if (Array.isArray(value)) {
    const first: unknown = value[0];
    return [[], [null], ...damaged(first, depth + 1).map((d) => [d, ...(value.slice(1, 2) as unknown[])])];
  }
  return Object.entries(value).flatMap(([key, inner]) => {
    const rest = Object.fromEntries(Object.entries(value).filter(([k]) => k !== key));
    return [rest, { ...value, [key]: null }, { ...value, [key]: "text" }, ...damaged(inner, depth + 1).map((d) => ({ ...value, [key]: d }))];
  });
}

// Lists cut to two entries: damage does not depend on how many there are.
function short(value: unknown): unknown {
  if (Array.isArray(value)) return value.slice(0, typeof value[0] === "object" ? 2 : 6).map(short);
  if (typeof value !== "object" || value === null) return value;
  return Object.fromEntries(Object.entries(value).map(([k, v]) => [k, short(v)]));
}

test.each(sample.reports.map((r) => [String(r["report"]), short(r)] as const))("%s never fails on missing or broken keys", (kind, report) => {
  const cases = damaged(report).filter((r) => (r as { report?: unknown }).report === kind);
  expect(cases.length).toBeGreaterThan(30);
  for (const r of cases) {
    const { element } = renderDocument(readDocument({ reports: [r] }));
    if (element.textContent?.includes("could not be shown")) throw new Error(`${element.textContent}\n${JSON.stringify(r).slice(0, 2000)}`);
  }
}, 60_000);

test("without WebGL a 3-D figure says so", () => {
  const reports = sample.reports.filter((r) => r["report"] === "build");
  showPage(place(), JSON.stringify({ reports }));
  expect(place().textContent).toContain("WebGL");
});

test("a kind that the page does not know is a folded tree, and two reports of a kind have their own ids", () => {
  const { element, book } = renderDocument(readDocument({ reports: [{ report: "novel", x: 1 }, ...sample.reports.slice(0, 1), ...sample.reports.slice(0, 1)] }));
  expect(element.querySelector("#novel details")).not.toBeNull();
  expect(book.figures.map((f) => f.id)).toContain("calibrate-2-views");
});

test("warnings stand at the head of their section", () => {
  const { element } = renderDocument(readDocument({ reports: [{ report: "fit", warnings: ["careful"] }] }));
  expect(element.querySelector("#fit .note")?.textContent).toBe("careful");
});

test("one figure alone, as the address asks", () => {
  expect(wanted("#only=fit-functions,fit-midribs", "")).toEqual(["fit-functions", "fit-midribs"]);
  expect(wanted("#fit", "?only=build-scene")).toEqual(["build-scene"]);
  showPage(place(), source, ["fit-functions"]);
  expect([...place().querySelectorAll("figure")].map((f) => f.id)).toEqual(["fit-functions"]);
});

test("text that would end the data element does not, and comes out unchanged", () => {
  const template = readFileSync("report.html", "utf8");
  const title = 'a </script><script>alert("x")</script> <!-- b';
  const page = new DOMParser().parseFromString(fill(template, { title, reports: [] }), "text/html");
  expect(page.querySelectorAll("script")).toHaveLength(2);
  showPage(place(), page.getElementById("bpms-data")?.textContent ?? "");
  expect(place().querySelector("h1")?.textContent).toBe(title);
  expect(place().querySelector("script")).toBeNull();
});

test("the template holds the token once, on its line", () => {
  const lines = readFileSync("report.html", "utf8").split("\n").filter((l) => l.includes("__BPMS_DATA__"));
  expect(lines.map((l) => l.trim())).toEqual(['<script id="bpms-data" type="application/json">__BPMS_DATA__</script>']);
});

test("a page without data says so", () => {
  showPage(place(), "__BPMS_DATA__");
  expect(place().textContent).toContain("no data");
});

test("the sample stays small", () => {
  expect(source.length).toBeLessThan(200_000);
});
