// The calibration of the sample: a stereo pair that sees a board in eight frames.
import { random, range, round } from "./plant.mjs";

const size = [640, 480];
const focal = 760;
const baseline = 0.08317;
const square = 0.025;
const centre = (camera) => (camera === "left" ? [321.4, 238.7] : [319.7, 240.4]);
const board = range(0, 53, 54).map((k) => [round(square * (k % 9), 4), round(square * Math.floor(k / 9), 4), 0]);

// Board in the frame of the left camera: turned about x, then y, then z, its middle at a place.
function pose(a, b, c, [x, y, z]) {
  const [ca, sa, cb, sb, cc, sc] = [a, b, c].flatMap((w) => [Math.cos(w), Math.sin(w)]);
  const r = [
    [cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa],
    [sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa],
    [-sb, cb * sa, cb * ca],
  ];
  const middle = [4 * square, 2.5 * square];
  return r.map((row, i) => [...row, [x, y, z][i] - row[0] * middle[0] - row[1] * middle[1]]);
}

function project(rows, camera, p) {
  const x = rows.map((row) => row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
  const [cx, cy] = centre(camera);
  return [(focal * (x[0] - (camera === "left" ? 0 : baseline))) / x[2] + cx, (focal * x[1]) / x[2] + cy];
}

// Over the image, growing towards its corners; null where the lens has no ray.
function map(range_m, middle, edge, hole) {
  const [columns, rows] = [8, 6];
  const x_px = range(0, columns - 1, columns).map((i) => ((i + 0.5) * size[0]) / columns - 0.5);
  const y_px = range(0, rows - 1, rows).map((j) => ((j + 0.5) * size[1]) / rows - 0.5);
  const px = y_px.flatMap((v) => x_px.map((u) => round(middle + edge * Math.hypot((u - 320) / 400, (v - 240) / 400) ** 4, 2)));
  if (hole) px[0] = null;
  const sorted = px.filter((v) => v !== null).sort((a, b) => a - b);
  return { range_m, x_px, y_px, px, median_px: sorted[24], p90_px: sorted[43], max_px: sorted[sorted.length - 1] };
}

const sigma = { fx: 0.31, fy: 0.33, cx: 0.42, cy: 0.39, k1: 0.0011, k2: 0.0043, p1: 0.00009, p2: 0.00011 };
const poseSigma = { rx: 0.0002, ry: 0.0004, rz: 0.0001, tx: 0.00003, ty: 0.00003, tz: 0.00012 };
const clustered = (of) => Object.fromEntries(Object.entries(of).map(([k, s], i) => [k, round(s * (2.1 + 0.3 * (i % 3)), 3)]));

function covariance() {
  const all = { ...Object.fromEntries(Object.entries(sigma).map(([k, s]) => [`left.${k}`, s])), ...Object.fromEntries(Object.entries(poseSigma).map(([k, s]) => [`right.${k}`, s])) };
  const order = Object.keys(all);
  const matrix = order.map((a, i) => order.map((b, j) => round((i === j ? 1 : 0.7 * Math.cos(0.8 * (i - j)) * Math.exp(-0.35 * Math.abs(i - j))) * all[a] * all[b], 2)));
  return { kind: "clustered", order, matrix };
}

export function calibrate(provenance) {
  const { uniform, normal } = random(7);
  const frames = range(1, 8, 8).map((i) => `0${i}`);
  const poses = frames.map((_, i) =>
    pose(0.7 * Math.sin(2.1 * i), 0.6 * Math.cos(1.3 * i), 0.15 * normal(), [0.04 + 0.045 * Math.cos(2.4 * i), 0.04 * Math.sin(2.4 * i), 0.46 + 0.08 * uniform()]).map((row) => row.map((v) => round(v, 4))),
  );
  const points = range(0, 53, 54).filter((k) => k % 2 === 0);
  const views = ["left", "right"].flatMap((camera) =>
    frames.map((frame, i) => {
      const outlier = camera === "right" && frame === "05";
      const spread = outlier ? 1.4 : 0.11 + 0.08 * uniform();
      const residuals = points.map((k) => [
        ...project(poses[i], camera, board[k]).map((v) => round(v, 4)),
        ...[outlier ? 1.1 : 0.06 * Math.cos(k), 0].map((shift) => round(spread * normal() + shift, 2)),
      ]);
      const rms = Math.sqrt(residuals.reduce((sum, r) => sum + r[2] ** 2 + r[3] ** 2, 0) / (2 * residuals.length));
      const reason = outlier ? { reason: "rms above 4 times the median" } : {};
      return { image: `${camera}${frame}.jpg`, camera, frame, target: 0, rms_px: round(rms, 4), outlier, ...reason, sharpness: round(40 + 20 * uniform(), 3), residuals, points };
    }),
  );
  const camera = (name, d) => ({
    name, model: "brown_conrady", width: size[0], height: size[1], fx: focal + d, fy: focal + 0.2 + d, cx: centre(name)[0], cy: centre(name)[1],
    distortion: [-0.2871, 0.0904, 0.00118, -0.00021], parameter_names: Object.keys(sigma), sigma: { ...sigma, ...(d ? poseSigma : {}) }, sigma_clustered: clustered({ ...sigma, ...(d ? poseSigma : {}) }),
    projection_sigma: map(0.45, 0.04, 0.9, d > 0), cam_from_rig: [[1, 0, 0, d ? -baseline : 0], [0, 1, 0, 0], [0, 0, 1, 0]],
  }); // prettier-ignore
  const triangulation = [0.225, 0.315, 0.45, 0.63, 0.9].map((range_m) => {
    const [lateral, depth] = [(0.15 * range_m) / (Math.SQRT2 * focal), (Math.SQRT2 * 0.15 * range_m ** 2) / (focal * baseline)];
    const by = (s, rig) => round(Math.hypot(s, rig), 3);
    return {
      a: "left", b: "right", range_m, sigma_x_m: by(lateral, 0.0002 * range_m), sigma_y_m: by(lateral, 0.0001 * range_m), sigma_z_m: by(depth, 0.0016 * range_m),
      observation_sigma_x_m: by(lateral, 0), observation_sigma_y_m: by(lateral, 0), observation_sigma_z_m: by(depth, 0),
    };
  }); // prettier-ignore
  return {
    report: "calibrate", cameras: [camera("left", 0), camera("right", 1.7)],
    pairs: [{ a: "left", b: "right", baseline_m: baseline, baseline_sigma_m: 0.000031, baseline_sigma_clustered_m: 0.000108, rotation_deg: [0, 0, 0], translation_m: [-baseline, 0, 0] }],
    residual_rms_px: 0.1497, residual_sigma_px: 0.1511, corners_used: 459, corners_total: 486, frames: frames.length, views,
    targets: [{ name: "board", kind: "chessboard", columns: 9, rows: 6, square_m: square, stands: false, views: views.length, warp_m: [0.00021, -0.00008], nominal_points_m: board, points_m: [], scale_bars: [{ a: "0", b: "8", length_m: 0.2001, sigma_m: 0.00005, found_m: 0.20006 }] }],
    poses: { frames, rig_from_world: [], world_from_target: [poses] },
    board_warp_m: [0.00021, -0.00008], converged: true,
    outliers: [{ image: "left03.jpg", corner: "22", residual_px: 1.92 }],
    skipped: [{ image: "left10.jpg", reason: "no whole 9x6 chessboard found" }],
    half_sets: { odd_baseline_m: 0.08329, even_baseline_m: 0.08304, difference_m: 0.00025, sigma_clustered_m: 0.00022, difference: [map(0.45, 0.06, 1.3), map(0.45, 0.05, 1.1)] },
    model_differences: [{ camera: "left", model: "brown8", map: map(0.45, 0.02, 0.4) }],
    covariance_kind: "clustered", covariance: covariance(), triangulation,
    lens_selection: [
      { choice: "brown4", parameters: 8, rms_px: 0.1497, cross_validated_px: 0.1561, se_px: 0.0052, chosen: true },
      { choice: "brown5", parameters: 9, rms_px: 0.1495, cross_validated_px: 0.1566, se_px: 0.0055, chosen: false },
      { choice: "brown8", parameters: 12, rms_px: 0.1489, cross_validated_px: null, se_px: null, chosen: false, refused: "folds inside the image" },
    ],
    provenance: provenance("bpms calibrate --images 'left[0-9]*.jpg' 'right[0-9]*.jpg' --target chessboard:9x6:25mm -o rig.toml", ["left01.jpg", "right01.jpg"]),
  }; // prettier-ignore
}
