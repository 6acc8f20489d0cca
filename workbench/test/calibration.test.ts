import { readFileSync } from "node:fs";
import { expect, test, vi } from "vitest";
import { calibrate, readDocument, type Calibrate } from "../src/data";
import { compare, table } from "../src/dom";
import { boardPoints, inPlane, solve } from "../src/figures/board_residuals";
import { apply, applyInverse, poseOf, sceneSpec } from "../src/figures/calibration_scene";
import { correlations, strongest } from "../src/figures/correlation";
import { cellCounts, convexHull, hullArea, type Pixel } from "../src/figures/coverage";
import { grid, levels, mapScale } from "../src/figures/image_maps";
import { normalised, rmsOf } from "../src/figures/residual_statistics";
import { triangulationTraces } from "../src/figures/triangulation";
import { renderDocument } from "../src/page";
import { oneTwoFive } from "../src/plot";
import { parameters, rotationVector } from "../src/sections/calibrate_tables";

vi.mock("plotly.js-cartesian-dist-min", () => ({ react: vi.fn() }));
HTMLCanvasElement.prototype.getContext = () => null;

const sample = (JSON.parse(readFileSync("test/sample.json", "utf8")) as { reports: Record<string, unknown>[] }).reports[0] ?? {};

test("the hull is what a rubber band would touch, without points along its sides", () => {
  const square: Pixel[] = [[0, 0], [4, 0], [4, 3], [0, 3]]; // prettier-ignore
  const hull = convexHull([[2, 1], ...square, [2, 0], [1, 3], [0, 0]]);
  expect(hull).toHaveLength(4);
  expect(new Set(hull.map(String))).toEqual(new Set(square.map(String)));
  expect(hullArea(hull)).toBe(12);
  expect(convexHull([[1, 1]])).toEqual([[1, 1]]);
  expect(hullArea(convexHull([[0, 0], [1, 1], [2, 2]]))).toBe(0);
});

test("a corner counts in the cell that holds it; pixel centres are integers", () => {
  // Two cells a side of an image of 10 x 10: the border between them is at 4.5.
  expect(cellCounts([[4.4, 0], [4.6, 0], [-0.5, 9.5]], [10, 10], 2, 2)).toEqual([[1, 1], [1, null]]);
});

const map = (px: (number | null)[]) => ({ range_m: 1, x_px: [0, 1, 2], y_px: [0, 1], px, median_px: null, p90_px: null, max_px: null });

test("maps that span decades have a logarithmic scale", () => {
  expect(mapScale([map([1, 2, 3, 4, 5, 19])])).toEqual({ logarithmic: false, low: 0, high: 19 });
  expect(mapScale([map([1, 2]), map([3, null, 21])])).toEqual({ logarithmic: true, low: 1, high: 21 });
  expect(mapScale([map([null, null])])).toBeNull();
  expect(levels({ logarithmic: true, low: 0.09, high: 2 })).toEqual([0.1, 0.2, 0.5, 1, 2]);
  expect(oneTwoFive(3, 4)).toEqual([]);
});

test("a map is row by row, and keeps its holes", () => {
  expect(grid(map([1, 2, 3, 4, null, 6]))).toEqual([[1, 2, 3], [4, null, 6]]);
});

test("correlations have ones on the diagonal and are null where nothing varies", () => {
  const m = correlations([[4, -3, 0], [-3, 9, 0], [0, 0, 0]]);
  expect(m).toEqual([[1, -0.5, null], [-0.5, 1, null], [null, null, null]]);
  expect(strongest(m, ["a", "b", "c"], 2)).toEqual([{ a: "a", b: "b", value: -0.5 }]);
});

test("a system of equations is solved, a singular one is not", () => {
  expect(solve([[0, 2], [3, 1]], [[4], [5]])).toEqual([[1], [2]]);
  expect(solve([[1, 2], [2, 4]], [[1], [2]])).toBeNull();
});

// Corners of a 5 x 4 board by a tilted pinhole; one is misprinted by 0.3 and -0.2 mm.
const spacing = 0.03;
const shift = { point: 7, dx: 0.0003, dy: -0.0002 };
const pinhole = (x: number, y: number, tilt: number): [number, number] => {
  const z = 0.6 + Math.sin(tilt) * x;
  return [(800 * (Math.cos(tilt) * x - 0.05)) / z + 320, (800 * (y - 0.04)) / z + 240];
};
const boardView = (tilt: number) => {
  const residuals = Array.from({ length: 20 }, (_, k) => {
    const [x, y] = [spacing * (k % 5), spacing * Math.floor(k / 5)];
    const [u0, v0] = pinhole(x, y, tilt);
    const [u, v] = k === shift.point ? pinhole(x + shift.dx, y + shift.dy, tilt) : [u0, v0];
    return [u, v, u - u0, v - v0];
  });
  return { image: `a${tilt}.png`, camera: "a", frame: String(tilt), target: 0, outlier: false, residuals, points: residuals.map((_, k) => k) };
};
const nominal_points_m = Array.from({ length: 20 }, (_, k) => [spacing * (k % 5), spacing * Math.floor(k / 5), 0]);
const misprinted = (views: object[]): Calibrate => calibrate({ views, targets: [{ name: "b", square_m: spacing, nominal_points_m }] });

test("a misprinted point is off on the board by what it is misprinted", () => {
  const all = boardPoints(misprinted([-0.5, 0.1, 0.6].map(boardView)), 0);
  expect(all).toHaveLength(20);
  const at = all[shift.point];
  // The slope of a quadratic is not quite that of a perspective: within 2 % at these tilts.
  expect(Math.abs((at?.dx ?? 0) / shift.dx - 1)).toBeLessThan(0.02);
  expect(Math.abs((at?.dy ?? 0) / shift.dy - 1)).toBeLessThan(0.02);
  expect(at?.views).toBe(3);
  for (const [k, p] of all.entries()) if (k !== shift.point) expect(Math.hypot(p.dx, p.dy)).toBeLessThan(1e-12);
});

test("points are told apart by their number, views left out do not count, and older reports go by the order", () => {
  const reversed = (v: ReturnType<typeof boardView>) => ({ ...v, residuals: [...v.residuals].reverse(), points: [...v.points].reverse() });
  const plain = boardPoints(misprinted([boardView(0.3)]), 0);
  expect(boardPoints(misprinted([reversed(boardView(0.3))]), 0)[shift.point]?.dx).toBeCloseTo(plain[shift.point]?.dx ?? 0, 12);
  expect(boardPoints(misprinted([{ ...boardView(0.3), outlier: true }]), 0)).toEqual([]);
  expect(boardPoints(misprinted([{ ...boardView(0.3), points: undefined }]), 0)[shift.point]?.dx).toBeCloseTo(plain[shift.point]?.dx ?? 0, 12);
  expect(inPlane([])).toEqual([]);
});

test("a pose and its inverse undo each other", () => {
  const pose = poseOf([[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3]]);
  if (!pose) throw new Error("no pose");
  expect(apply(pose, [1, 0, 0])).toEqual([1, 3, 3]);
  expect(applyInverse(pose, [1, 3, 3])).toEqual([1, 0, 0]);
  expect(poseOf([[1, 0, 0, null], [0, 1, 0, 0], [0, 0, 1, 0]])).toBeNull();
  expect(rotationVector(pose.r)[2]).toBeCloseTo(Math.PI / 2, 12);
});

const identity = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]; // prettier-ignore
const moving = (frames: string[]) => ({
  cameras: [{ name: "a", width: 640, height: 480, fx: 500, fy: 500, cx: 320, cy: 240, cam_from_rig: identity }],
  views: frames.map((frame) => ({ camera: "a", frame, target: 0, residuals: [[1, 1, 0, 0]] })),
  targets: [{ name: "frame", stands: true, nominal_points_m: [[0, 0, 2], [1, 0, 2], [0, 1, 2.5]], points_m: [] }],
  poses: { frames: ["1", "2", "3"], rig_from_world: [0, 1, 2].map((x) => identity.map((row, i) => (i === 0 ? [...row.slice(0, 3), -x] : row))), world_from_target: [[identity]] },
});

test("a rig that moves has a path through the frames that were seen, and what stands is dots", () => {
  const path = (frames: string[]) => sceneSpec(calibrate(moving(frames)))?.curves?.find((c) => c.label === "path of the rig")?.points;
  expect(path(["1", "2", "3"])).toEqual([[0, 0, 0], [1, 0, 0], [2, 0, 0]]);
  expect(path(["1", "3"])).toEqual([[0, 0, 0], [2, 0, 0]]);
  expect(sceneSpec(calibrate(moving(["1"])))?.dots?.[0]?.points).toEqual([[0, 0, 2], [1, 0, 2], [0, 1, 2.5]]);
});

test("boards stand where the frames saw them", () => {
  const spec = sceneSpec(calibrate(sample));
  expect(spec?.mesh?.parts).toHaveLength(8);
  expect(spec?.mesh?.positions).toHaveLength(8 * 4 * 3);
  const [first] = calibrate(sample).poses?.world_from_target[0] ?? [];
  // The first corner of the drawn board lies a square outside the first point.
  const expected = apply(poseOf(first) ?? { r: [], t: [0, 0, 0] }, [-0.025, -0.025, 0]);
  expected.forEach((v, i) => expect(spec?.mesh?.positions[i]).toBeCloseTo(v, 12));
});

test("the axis of a turntable is a line through its point", () => {
  const spec = sceneSpec(calibrate({ ...sample, turntable: { direction: [0, 1, 0], point_m: [0.1, 0, 0.5] } }));
  const ends = spec?.curves?.find((c) => c.label === "axis of the turntable")?.points ?? [];
  expect(ends.map((p) => [p[0], p[2]])).toEqual([[0.1, 0.5], [0.1, 0.5]]);
  expect((ends[0]?.[1] ?? 0) + (ends[1]?.[1] ?? 1)).toBeCloseTo(0, 12);
});

test("residuals are compared with their own sigma, without the views left out", () => {
  const r = calibrate({ residual_sigma_px: 0.5, views: [{ residuals: [[0, 0, 1, -0.5]] }, { outlier: true, residuals: [[0, 0, 9, 9]] }] });
  expect(normalised(r)).toEqual([2, -1]);
  expect(rmsOf(r.views.slice(0, 1))).toBeCloseTo(Math.sqrt(1.25 / 2), 12);
  expect(normalised(calibrate({ views: r.views }))).toEqual([]);
});

test("sigmas of triangulation are millimetres over the distance, with the observation's part beside them", () => {
  const row = (range_m: number) => ({ a: "l", b: "r", range_m, sigma_z_m: range_m / 1000, observation_sigma_z_m: range_m / 2000 });
  const traces = triangulationTraces(calibrate({ triangulation: [row(2), row(1)] }).triangulation);
  expect(traces.map((t) => [t.name, t.x, t.y])).toEqual([["depth", [1, 2], [1, 2]], ["depth, observation alone", [1, 2], [0.5, 1]]]); // prettier-ignore
});

test("parameters go by the names of the report, poses in degrees and millimetres", () => {
  const [left, right] = calibrate(sample).cameras;
  expect(left && parameters(left).map((p) => p.name)).toEqual(["fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2"]);
  const tx = right && parameters(right).find((p) => p.name === "tx");
  expect(tx?.unit).toBe("mm");
  expect(tx?.value).toBeCloseTo(-83.17, 9);
  const other = calibrate({ cameras: [{ fx: 1, fy: 1, cx: 1, cy: 1, distortion: [0.5], parameter_names: ["fx", "fy", "cx", "cy", "b1"] }] }).cameras[0];
  expect(other && parameters(other)[4]?.name).toBe("b1");
});

test("a table is sorted by a click on a head, both ways, what is missing last", () => {
  const rows = [{ name: "b", n: 2 }, { name: "a10", n: null }, { name: "a9", n: 7 }]; // prettier-ignore
  const element = table([{ head: "name", text: true, cell: (r) => r.name, sort: (r) => r.name }, { head: "n", cell: (r) => r.n, sort: (r) => r.n }], rows); // prettier-ignore
  const names = () => [...element.querySelectorAll("tbody tr")].map((row) => row.firstElementChild?.textContent);
  const [byName, byNumber] = element.querySelectorAll("button");
  byNumber?.click();
  expect(names()).toEqual(["a9", "b", "a10"]);
  byNumber?.click();
  expect(names()).toEqual(["b", "a9", "a10"]);
  byName?.click();
  expect(names()).toEqual(["a9", "a10", "b"]);
  expect(element.querySelectorAll("th[aria-sort]")).toHaveLength(1);
  expect(compare(null, 1, true)).toBe(1);
});

test("a report from before these figures opens with those that it can show", () => {
  const added = ["targets", "poses", "half_sets", "model_differences", "covariance", "triangulation", "lens_selection", "skipped"];
  const old = Object.fromEntries(Object.entries(sample).filter(([k]) => !added.includes(k)));
  old["cameras"] = (sample["cameras"] as Record<string, unknown>[]).map((c) => ({ ...c, projection_sigma: undefined, cam_from_rig: undefined, parameter_names: undefined }));
  old["views"] = (sample["views"] as Record<string, unknown>[]).map((v) => ({ ...v, frame: undefined, points: undefined, sharpness: undefined, target: undefined }));
  const { element, book } = renderDocument(readDocument({ reports: [old] }));
  expect(book.figures.map((f) => f.id)).toEqual(["views", "quiver", "scatter", "normal", "coverage"].map((f) => `calibrate-${f}`));
  expect(element.textContent).not.toContain("could not be");
});
