import { expect, test } from "vitest";
import { simulate, type Series } from "../src/data";
import { deWit, perDegree } from "../src/figures/dewit";
import { bandLine, errorLine } from "../src/figures/errorbars";
import { balance, parts } from "../src/figures/fluxes";
import { histogram } from "../src/figures/histogram";
import { inPlane } from "../src/figures/organ_functions";
import { panelGrid } from "../src/figures/panels";
import { interpolate, isHemisphere, polarPoints } from "../src/figures/polar";
import { decaySpec } from "../src/figures/scattering_orders";
import { betaDensity, deWitG, ellipsoidalDensity, gOf } from "../src/figures/leaf_angle_models";
import { quiver, quiverScale, vectors } from "../src/figures/quiver";
import { planes, signedZenith } from "../src/figures/view_angles";
import { organs } from "../src/organs";
import { orderColour } from "../src/palette";

test.each(deWit)("the $name distribution integrates to one", ({ density }) => {
  const n = 2000;
  const step = Math.PI / 2 / n;
  let sum = 0;
  for (let i = 0; i < n; ++i) sum += density((i + 0.5) * step) * step;
  expect(sum).toBeCloseTo(1, 6); // midpoint rule: error of the order of step² = 6e-7
});

test("a density per degree integrates to one over ninety degrees", () => {
  const spherical = deWit.find((d) => d.name === "spherical");
  let sum = 0;
  for (let t = 0.5; t < 90; ++t) sum += perDegree(spherical?.density ?? (() => 0), t);
  expect(sum).toBeCloseTo(1, 4); // steps of one degree
});

test("planophile leaves lie flat, erectophile ones stand", () => {
  const at = (name: string, t: number): number => deWit.find((d) => d.name === name)?.density(t) ?? Number.NaN;
  expect(at("planophile", 0)).toBeGreaterThan(at("planophile", 1.5));
  expect(at("erectophile", 0)).toBeLessThan(at("erectophile", 1.5));
});

test("a quiver is scaled to a 1-2-5 number that keeps typical vectors short", () => {
  const all = Array.from({ length: 100 }, () => ({ u: 0, v: 0, du: 0.15, dv: 0.2 })); // length 0.25 px
  expect(quiverScale(all, 800)).toBe(100); // 0.04 * 800 / 0.25 = 128
  expect(quiverScale(all.map((r) => ({ ...r, du: 1.5, dv: 2 })), 800)).toBe(10);
  expect(quiverScale([], 800)).toBe(1);
});

test("a vector is drawn from its corner to its scaled end", () => {
  const [segments] = quiver([{ u: 10, v: 20, du: 0.1, dv: -0.2 }], 100, "#000000", {});
  expect(segments?.x).toEqual([10, 20, null]);
  expect(segments?.y).toEqual([20, 0, null]);
});

test("incomplete residuals are left out", () => {
  expect(vectors([[1, 2, 3, 4], [1, 2, null, 4], [1, 2], []])).toEqual([{ u: 1, v: 2, du: 3, dv: 4 }]);
});

test("error bars are 1.96 standard errors, in the order of x", () => {
  const t = errorLine({ x: [2, 1, null], y: [20, 10, 5], se: [0.2, null, 1] }, "#000000");
  expect(t.x).toEqual([1, 2]);
  expect(t.error_y?.array[0]).toBeNull();
  expect(t.error_y?.array[1]).toBeCloseTo(0.392, 12);
});

test("a band goes up one side and back down the other", () => {
  const [band, line] = bandLine({ x: [0, 1], y: [5, 5], se: [1, 1] }, "#000000");
  expect(band?.x).toEqual([0, 1, 1, 0]);
  expect(band?.y?.[0]).toBeCloseTo(6.96, 12);
  expect(band?.y?.[3]).toBeCloseTo(3.04, 12);
  expect(line?.y).toEqual([5, 5]);
  expect(bandLine({ x: [0, 1], y: [5, 5] }, "#000000")).toHaveLength(1);
});

test("a histogram keeps every value, the outermost bins holding what lies beyond", () => {
  const h = histogram([-1, 0, 0.9, 1, 3.9, 4, 99], 0, 4, 4);
  expect(h.counts).toEqual([3, 1, 0, 3]);
  expect(h.centres).toEqual([0.5, 1.5, 2.5, 3.5]);
});

test("panels fill their chart from the top left without overlap", () => {
  const grid = panelGrid(["a", "b", "c"], { columns: 2, xTitle: "x", yTitle: "y" });
  expect(grid.rows).toBe(2);
  const domain = (key: string): [number, number] => (grid.layout[key] as { domain: [number, number] }).domain;
  expect(domain("xaxis")[1]).toBeLessThan(domain("xaxis2")[0]);
  expect(domain("yaxis3")[1]).toBeLessThan(domain("yaxis")[0]);
  expect(domain("yaxis")[1]).toBe(1);
});

const series = (extra: Partial<Series>): Series => ({
  sensor: null, quantity: "brf", band: null, wavelength_nm: null, origin: null, component: null, order: null, material: null,
  sza_deg: 30, saa_deg: 100, vza_deg: [], vaa_deg: [], value: [], standard_error: [], ...extra,
}); // prettier-ignore

test("view angles are negative on the sun's side", () => {
  expect(signedZenith(30, 100, 100)).toBe(-30);
  expect(signedZenith(30, 280, 100)).toBe(30);
  expect(signedZenith(30, 190, 100)).toBe(30);
  expect(signedZenith(30, 10, 100)).toBe(-30);
  expect(signedZenith(-30, 100, 100)).toBe(-30); // signed by the sensor
  expect(signedZenith(30, null, 100)).toBe(30);
});

test("views of two planes make two lines that share nadir", () => {
  const all = planes(series({ vza_deg: [0, 30, 30, 40, 40], vaa_deg: [0, 100, 280, 190, 10], value: [1, 2, 3, 4, 5] }));
  expect(all.map((p) => p.name)).toEqual(["principal plane", "cross plane"]);
  expect(all[0]?.rows.map((r) => [r.vza, r.value])).toEqual([[-30, 2], [0, 1], [30, 3]]);
  expect(all[1]?.rows.map((r) => r.value)).toEqual([5, 1, 4]);
});

test("a midrib lies in the plane through its farthest point", () => {
  const [base, tip] = inPlane([[1, 1, 1], [4, 5, 3]]);
  expect(base).toEqual({ r: 0, z: 0 });
  expect(tip?.r).toBeCloseTo(5, 12);
  expect(tip?.z).toBe(2);
});

test("scattering orders have colours of their own, however many there are", () => {
  for (const n of [2, 8, 10, 24]) expect(new Set(Array.from({ length: n }, (_, i) => orderColour(i, n))).size).toBe(n);
});

test("a leaf has its colour whether or not a bud was digitised before it", () => {
  const leaf = { plant: "1", axis: "1", rank: "1", organ: "leaf" };
  const bud = { plant: "1", axis: "1", rank: "0", organ: "bud" };
  expect(organs([bud, leaf]).colour(leaf)).toBe(organs([leaf]).colour(leaf));
  expect(organs([bud, leaf]).colour(bud)).not.toBe(organs([bud, leaf]).colour(leaf));
});

const hemisphere: Series = {
  sensor: "h", quantity: "brf", band: "1", wavelength_nm: null, origin: "total", component: "all", order: null, material: null, sza_deg: 30, saa_deg: 100,
  vza_deg: [0, 30, 30, 30, 30, 60, 60, 60, 60, 60], vaa_deg: [0, 100, 190, 280, 10, 100, 190, 280, 10, 145],
  value: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10], standard_error: [],
}; // prettier-ignore

test("views over the hemisphere lie where their azimuth from the sun says", () => {
  const points = polarPoints(hemisphere);
  expect(points[1]?.x).toBeCloseTo(0, 10); // the sun's azimuth: at the top
  expect(points[1]?.y).toBeCloseTo(30, 10);
  expect(points[2]?.x).toBeCloseTo(30, 10);
  expect(isHemisphere(hemisphere)).toBe(true);
  expect(isHemisphere({ ...hemisphere, vaa_deg: hemisphere.vza_deg.map(() => 100) })).toBe(false);
});

test("the map goes through its views and stays within them", () => {
  const points = polarPoints(hemisphere);
  for (const p of points) expect(interpolate(points, p.x, p.y)).toBeCloseTo(p.value, 9);
  const between = interpolate(points, 11, 17) ?? Number.NaN;
  expect(between).toBeGreaterThan(1);
  expect(between).toBeLessThan(10);
});

test("ratios of orders that are not known are left out", () => {
  const row = { sensor: "s", quantity: "brf", band: "1", wavelength_nm: null, value: [0.2, 0.1, 0.05], standard_error: [0.001, 0.001, 0.001], ratio: [0.5, 0.5], ratio_standard_error: [0.01, 0.3], enough_order: 2 };
  const [, ratios] = decaySpec(row).data;
  expect(ratios?.x).toEqual([2, 3]);
  expect(ratios?.y).toEqual([0.5, null]);
});

const page = simulate({ band_names: ["red", "NIR"] });
const flux = (name: string, value: number[], of = ""): object => ({ flux: name, of, origin: "total", value, standard_error: value.map(() => 0.001) });
const numbersOf = (t: { x?: readonly unknown[]; y?: readonly unknown[] } | undefined): number[] => (t?.y ?? []) as number[];

test("what enters is absorbed, reflected or gone: the stack is the whole", () => {
  const rows = [
    flux("reflected", [0.05, 0.4]), flux("transmitted", [0.4, 0.5]), flux("absorbed", [0.6, 0.15], "leaf"), flux("absorbed", [0.35, 0.45], "soil"),
    flux("lost_sides", [0, 0]), { ...flux("reflected", [9, 9]), origin: "direct" },
  ]; // prettier-ignore
  const [f] = simulate({ fluxes: [{ name: "f", rows }] }).fluxes;
  const { data } = balance(page, f as NonNullable<typeof f>);
  const bars = data.filter((t) => t.type === "bar");
  expect(bars.map((t) => t.name)).toEqual(["absorbed by leaf", "absorbed by soil", "reflected"]);
  expect(bars[0]?.x).toEqual(["red", "NIR"]);
  for (const b of [0, 1]) expect(bars.reduce((sum, t) => sum + (numbersOf(t)[b] ?? 0), 0)).toBeCloseTo(1, 10);
  expect(data.find((t) => t.type === "scatter")?.y).toEqual([0.4, 0.5]); // at the ground, part of the stack already
});

test("without a ground what is transmitted is gone, and part of the stack", () => {
  const rows = [flux("reflected", [0.1, 0.3]), flux("transmitted", [0.3, 0.5]), flux("absorbed", [0.6, 0.2], "leaf")];
  const [f] = simulate({ fluxes: [{ name: "f", rows }] }).fluxes;
  const bars = balance(page, f as NonNullable<typeof f>).data;
  expect(bars.map((t) => [t.type, t.name])).toEqual([["bar", "absorbed by leaf"], ["bar", "transmitted"], ["bar", "reflected"]]); // prettier-ignore
});

test("layers are bars from the bottom up, a colour for each band", () => {
  const [f] = simulate({ fluxes: [{ name: "f", wavelength_nm: [650, 850], rows: [flux("absorbed_layer", [0.1, 0.05], "0-1 m"), flux("absorbed_layer", [0.5, 0.1], "1-2 m")] }] }).fluxes;
  const known = f as NonNullable<typeof f>;
  const { data } = parts(page, known, known.rows, "layer");
  expect(data.map((t) => [t.name, t.x, t.y])).toEqual([["red", [0.1, 0.5], ["0-1 m", "1-2 m"]], ["NIR", [0.05, 0.1], ["0-1 m", "1-2 m"]]]); // prettier-ignore
});

test("G of de Wit's distributions is that of the tables", () => {
  const g = (name: string, deg: number): number => deWitG.find((d) => d.name === name)?.g((deg * Math.PI) / 180) ?? Number.NaN;
  expect(g("planophile", 0)).toBeCloseTo(0.8488, 3);
  expect(g("erectophile", 57.5)).toBeCloseTo(0.5041, 3);
  expect(g("spherical", 40)).toBeCloseTo(0.5, 3);
});

test("fitted leaf angle densities integrate to one", () => {
  const n = 20000;
  for (const density of [betaDensity(2.77, 1.172), betaDensity(1.101, 1.93), ellipsoidalDensity(0.5), ellipsoidalDensity(1), ellipsoidalDensity(3)]) {
    let sum = 0;
    for (let i = 0; i < n; ++i) sum += (density(((i + 0.5) * Math.PI) / 2 / n) * Math.PI) / 2 / n;
    expect(sum).toBeCloseTo(1, 4);
  }
  expect(gOf(ellipsoidalDensity(2), 0)).toBeCloseTo(0.7245, 3); // Campbell 1990
});
