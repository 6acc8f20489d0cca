// The measuring part of the sample: calibrate, reconstruct, fit.
import { azimuth, edges, inclination, leaves, midrib, random, range, round, stemHeight, twist, width } from "./plant.mjs";
import { calibrate as calibration } from "./calibration.mjs";
import { pngUri } from "./png.mjs";

const size = [640, 480];
const focal = 760;
const baseline = 0.08317;
const provenance = (command, inputs) => ({
  version: "0.1.0", command, seed: 1,
  inputs: inputs.map((path, i) => ({ path, sha256: [...Array(64)].map((_, k) => ((k * 7 + i * 5 + path.length) % 16).toString(16)).join("") })),
}); // prettier-ignore

export const calibrate = () => calibration(provenance);

// The plant stands 0.78 m before the left camera; camera frame x right, y down, z forward.
const toCamera = ([x, y, z]) => [x + baseline / 2, 0.22 - z, 0.78 + y];
const project = ([x, y, z], view) => {
  const shift = view === "left" ? 0 : baseline;
  return [(focal * (x - shift)) / z + 320, (focal * y) / z + 240];
};

function photograph(view) {
  const strips = leaves.map((leaf) => edges(leaf, 24).map((e) => ({ at: project(toCamera(e.middle), view), half: Math.max(1.5, (0.5 * focal * width(leaf, 0.5)) / 0.78 / 1.6) })));
  const stem = range(0, stemHeight, 24).map((z) => ({ at: project(toCamera([0, 0, z]), view), half: 3 }));
  const inside = (strip, x, y) => strip.some(({ at, half }, i) => {
    const b = (strip[i + 1] ?? strip[i]).at;
    const [dx, dy] = [b[0] - at[0], b[1] - at[1]];
    const t = Math.max(0, Math.min(1, ((x - at[0]) * dx + (y - at[1]) * dy) / (dx * dx + dy * dy || 1)));
    return Math.hypot(x - at[0] - t * dx, y - at[1] - t * dy) < half;
  }); // prettier-ignore
  const foot = project(toCamera([0, 0, 0]), view);
  return pngUri(size[0] / 2, size[1] / 2, (px, py) => {
    const [x, y] = [2 * px + 0.5, 2 * py + 0.5];
    const k = strips.findIndex((strip) => inside(strip, x, y));
    if (k >= 0) return [70 + 12 * k, 110 + 12 * k, 62];
    if (inside(stem, x, y)) return [126, 140, 74];
    const pot = y > foot[1] && Math.abs(x - foot[0]) < 62 - 0.1 * (y - foot[1]);
    if (pot) return [150, 92, 66];
    return y > 455 ? [150, 146, 138] : [196, 200, 204].map((v) => v - Math.floor(y / 80) * 6);
  });
}

export function reconstruct() {
  const { normal } = random(11);
  const curve = (leaf, feature, points, rejectedAt) => ({
    plant: "1", axis: "1", rank: leaf.rank, organ: "leaf", feature,
    points: points.map((p, i) => {
      const at = toCamera(p);
      const rejected = i === rejectedAt;
      const seen = (view, noise) => project(at, view).map((v, k) => round(v + noise * normal() + (rejected && k === 1 && noise > 0 ? (view === "left" ? 14 : -14) : 0), 5));
      const [x_m, y_m, z_m] = at.map((v) => round(v, 5));
      return {
        point: i + 1, x_m, y_m, z_m, sigma_m: [0.00021, 0.0002, 0.0011], chi2: rejected ? 41.7 : round(Math.abs(normal()) + 0.1, 3), rejected,
        digitised: { left: seen("left", 0.35), right: seen("right", 0.35) }, reprojected: { left: seen("left", 0), right: seen("right", 0) },
      };
    }),
  }); // prettier-ignore
  const curves = leaves.flatMap((leaf) => {
    const sides = edges(leaf, 9);
    return [
      curve(leaf, "midrib", midrib(leaf, 11), leaf.rank === 3 ? 7 : leaf.rank === 1 ? 2 : -1),
      curve(leaf, "edge_left", sides.map((e) => e.left), -1),
      curve(leaf, "edge_right", sides.map((e) => e.right), -1),
    ];
  });
  const rejected = curves.flatMap(({ points, ...label }) =>
    points.filter((p) => p.rejected).map((p) => ({ ...label, point: p.point, reason: "rays do not meet", chi2: p.chi2 })),
  );
  const check = curves.filter((c) => c.feature === "midrib").flatMap((c) => c.points.map((p) => {
    const ratio = p.rejected ? 9.3 : Math.abs(1.15 * normal());
    return { label: `leaf ${c.rank}, point ${p.point}`, dz_m: round(ratio * 0.0011, 3), sigma_m: 0.0011, ratio: round(ratio, 3), rejected: p.rejected };
  })); // prettier-ignore
  return {
    report: "reconstruct", points: curves.reduce((n, c) => n + c.points.length, 0), rejected, reprojection_rms_px: 0.357,
    warnings: ["Two points were rejected because their rays do not meet; both are named below."],
    photographs: ["left", "right"].map((view) => ({ view, camera: view, width: size[0], height: size[1], data_uri: photograph(view) })),
    curves,
    figures: [{ name: "pot_rim_diameter", value: 101.37, sigma: 0.42, unit: "mm", note: "measured with callipers: 101.5 mm" }, { name: "plant_height", value: 341.2, sigma: 1.3, unit: "mm" }],
    check: { name: "a dense disparity map", median_ratio: 0.74, points: check },
    vertical_m: [0, -1, 0],
    provenance: provenance("bpms reconstruct points.csv --rig rig.toml -o vectors.csv", ["points.csv", "rig.toml"]),
  }; // prettier-ignore
}

export function fit() {
  const { normal } = random(5);
  const l = range(0, 1, 25);
  const organs = leaves.map((leaf) => {
    const f = (kind, order, value, sigma, unit) => ({
      kind, order, unit, coefficients: range(0, 1, order + 1).map((t) => round(value(leaf, t), 4)), sigma: range(0, 1, order + 1).map(() => sigma), aicc: round(-120 + 3 * normal(), 4),
      curve: { l: l.map((x) => round(x, 4)), value: l.map((x) => round(value(leaf, x), 5)), sigma: l.map((x) => round(sigma * (0.6 + 1.4 * (x - 0.5) ** 2 * 4), 3)) },
    }); // prettier-ignore
    const fitted = midrib(leaf, 21);
    const rms = 0.0006 + 0.00008 * leaf.rank;
    return {
      id: `l${leaf.rank}`, plant: "1", axis: "1", rank: leaf.rank, organ: "leaf", points: 11, length_m: round(leaf.length * 1.0012, 5), length_sigma_m: 0.00061, width_m: leaf.width,
      rms_m: round(rms, 3), rms_fraction: round(rms / leaf.length, 3), chi2_per_dof: round(1 + 0.2 * normal(), 3),
      functions: { inclination: f("p", 3, inclination, 1.6, "deg"), azimuth: f("p", 2, azimuth, 1.1, "deg"), twist: f("p", 2, twist, 3.2, "deg"), width: f("n", 6, width, 0.0004, "m") },
      measured: { l: range(0, 1, 11).map((x) => round(x, 3)), width: range(0, 1, 11).map((x) => round(Math.max(0, width(leaf, x) + 0.0004 * normal()), 4)) },
      points_m: midrib(leaf, 11).map((p) => p.map((v) => round(v + rms * 0.8 * normal(), 5))), fitted_m: fitted.map((p) => p.map((v) => round(v, 5))),
      aicc_table: [["p", 2, 14.2], ["p", 3, 0], ["p", 4, 2.7], ["n", 4, 9.8], ["f", 3, 6.1]].map(([kind, order, d]) => ({ function: "inclination", kind, order, aicc: round(-120 + d + (d ? leaf.rank * 0.6 : 0), 4) })),
    };
  }); // prettier-ignore
  return { report: "fit", organs, summary: { organs: organs.length, rms_fraction_median: 0.0039, rms_fraction_p90: 0.0046, failed: 0 }, provenance: provenance("bpms fit vectors.csv -o plant.bpms --report fit.json", ["vectors.csv"]) };
}
