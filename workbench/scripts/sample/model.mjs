// The modelling part of the sample: build, describe, simulate.
import { edges, leaves, random, range, round, stemHeight } from "./plant.mjs";
import { pngUri } from "./png.mjs";

const radians = Math.PI / 180;

export function build() {
  const positions = [];
  const indices = [];
  const organ_ids = [];
  const organs = [];
  const add = (p) => positions.push(...p.map((v) => round(v, 4))) / 3 - 1;
  const strip = (a, b, id) => {
    for (let i = 0; i + 1 < a.length; ++i) {
      indices.push(a[i], b[i], b[i + 1], a[i], b[i + 1], a[i + 1]);
      organ_ids.push(id, id);
    }
  };
  for (const leaf of leaves) {
    const id = organs.push({ id: leaf.rank, label: `leaf ${leaf.rank}`, material: "leaf" }) && leaf.rank;
    const rows = edges(leaf, 22).map((e) => [e.left, e.middle, e.right].map(add));
    strip(rows.map((r) => r[0]), rows.map((r) => r[1]), id); // prettier-ignore
    strip(rows.map((r) => r[1]), rows.map((r) => r[2]), id); // prettier-ignore
  }
  const tube = (id, label, material, profile) => {
    organs.push({ id, label, material });
    const rings = profile.map(([radius, z]) => range(0, 2 * Math.PI, 17).map((a) => add([radius * Math.cos(a), radius * Math.sin(a), z])));
    for (let i = 0; i + 1 < rings.length; ++i) strip(rings[i], rings[i + 1], id);
  };
  tube(10, "stem", "stem", range(0, stemHeight, 5).map((z) => [0.004 - 0.006 * z, z])); // prettier-ignore
  tube(11, "pot", "pot", [[0.001, -0.09], [0.038, -0.09], [0.05, 0.005], [0.046, 0.005], [0.045, -0.008]]); // prettier-ignore
  tube(12, "soil in the pot", "soil", [[0.0455, -0.008], [0.001, -0.006]]); // prettier-ignore
  return { report: "build", mesh: { positions, indices, organ_ids }, organs, area_m2: 0.0391, triangles: organ_ids.length, files: ["plant.ply"] };
}

export function describe() {
  const g = (t) => 0.5 + 0.06 * (Math.cos(2 * t * radians) - Math.cos(115 * radians));
  const zeniths = [0, 10, 20, 30, 40, 50, 57.5, 65, 75, 85];
  const weights = range(5, 85, 9).map((t) => 0.55 * Math.sin(t * radians) + 0.45 * (1 - Math.cos(2 * t * radians)) + 0.12);
  const total = weights.reduce((a, b) => a + b, 0);
  const omega = (t) => 0.72 + 0.18 * Math.sin(t * radians);
  const gap = (zenith_deg, clumped) => {
    const leaves = Math.exp((-clumped * g(zenith_deg) * 2.923) / Math.cos(zenith_deg * radians));
    const others = Math.exp(-0.02 - 0.08 * Math.tan(zenith_deg * radians));
    const se = (p) => round(Math.sqrt((p * (1 - p)) / 900), 3);
    const p = leaves * others;
    return { zenith_deg, p: round(p, 4), standard_error: se(p), leaves: round(leaves, 4), leaves_standard_error: se(leaves), others: round(others, 4), others_standard_error: se(others), rays: 65536 };
  };
  const density = range(0, 19, 20).map((k) => 4.8 * Math.sin(((k + 0.5) / 20) ** 0.7 * Math.PI) ** 1.3 + 0.2);
  const scale = 2.923 / (density.reduce((a, b) => a + b, 0) * 0.0306);
  let above = 0;
  const profile = density.map((d, k) => ({ from_m: round(0.0306 * k, 4), to_m: round(0.0306 * (k + 1), 4), leaf_area_density_per_m: round(d * scale, 4), plant_area_density_per_m: round(d * scale + 0.35, 4) }))
    .reverse()
    .map((l) => ({ ...l, cumulative_lai: round((above += l.leaf_area_density_per_m * 0.0306), 4), cumulative_pai: round(above + 0.35 * (0.612 - l.from_m), 4) }))
    .reverse(); // prettier-ignore
  const half = (azimuth) => range(0, 180, 19).map((view) => [view, azimuth]);
  const directions = [...half(0), ...half(90), ...half(180)];
  const scattering = (source) => ({
    band: "850 nm", source_zenith_deg: source, g: round(g(source), 4), integral: round(0.9 * g(source), 4),
    view_zenith_deg: directions.map((d) => d[0]), relative_azimuth_deg: directions.map((d) => d[1]),
    gamma: directions.map(([view, azimuth]) => {
      const cosine = -Math.cos(source * radians) * Math.cos(view * radians) - Math.sin(source * radians) * Math.sin(view * radians) * Math.cos(azimuth * radians);
      const beta = Math.acos(Math.max(-1, Math.min(1, cosine)));
      return round((0.9 / (3 * Math.PI)) * (Math.sin(beta) - beta * Math.cos(beta)) + (0.42 / 3) * Math.cos(beta), 4);
    }),
  }); // prettier-ignore
  const size = 120;
  const picture = (column, row) => {
    const [x, y] = [(2 * column) / size - 1, 1 - (2 * row) / size];
    const zenith = Math.min(1, Math.hypot(x, y));
    const leaf = Math.sin(23 * x + 9 * y) + Math.sin(17 * y - 11 * x) + Math.sin(5 * x * y + 31 * zenith) > 1.1 - 2.6 * zenith;
    return leaf ? [38, 92, 52] : [255, 255, 255];
  };
  return {
    report: "describe", leaf_area_m2: 8.36, stem_area_m2: 0.742, other_area_m2: 0, ground_area_m2: 2.86, lai: 2.923, pai: 3.053, height_m: 0.612, cover: 0.781, cover_standard_error: 0.001,
    gap_fraction: zeniths.map((z) => gap(z, omega(z))),
    gap_by_azimuth: [30, 57.5].flatMap((z) => range(0, 330, 12).map((azimuth_deg) => ({ ...gap(z, omega(z) - 0.2 * Math.cos(2 * azimuth_deg * radians) * Math.sin(z * radians)), azimuth_deg, width_deg: 30, g: round(g(z), 4) }))),
    azimuth_convention: "north_clockwise",
    g_function: range(0, 90, 19).map((zenith_deg) => ({ zenith_deg, g: round(g(zenith_deg), 4), plant_g: round(g(zenith_deg) * 0.96 + 0.02 * Math.sin(zenith_deg * radians), 4) })),
    g_by_azimuth: { zenith_deg: range(0, 90, 10), azimuth_deg: range(0, 345, 24), g: range(0, 90, 10).map((z) => range(0, 345, 24).map((a) => round(g(z) + 0.05 * Math.sin(z * radians) * Math.cos(2 * a * radians), 4))) },
    leaf_angle: {
      mean_deg: 54.3, sd_deg: 21.6, mean_cos2: 0.41, ellipsoidal_chi: 1.11, beta: { mu: 1.28, nu: 1.94 },
      bins: weights.map((w, i) => ({ from_deg: 10 * i, to_deg: 10 * i + 10, probability: round(w / total, 4), density_per_deg: round(w / total / 10, 4) })),
    },
    leaf_azimuth: range(0, 350, 36).map((from_deg) => ({ from_deg, to_deg: from_deg + 10, probability: round((1 + 0.3 * Math.cos(2 * from_deg * radians)) / 36, 4), density_per_deg: round((1 + 0.3 * Math.cos(2 * from_deg * radians)) / 360, 5) })),
    area_scattering: { optics: [{ band: "850 nm", material: "leaf", reflectance: 0.48, transmittance: 0.42 }], tables: [0, 30, 60].map(scattering) },
    clumping: zeniths.map((z) => ({ zenith_deg: z, leaves: round(omega(z), 4), leaves_standard_error: 0.008, plant: round(omega(z) + 0.02, 4), plant_standard_error: 0.008 })),
    effective_lai: {
      plant: { miller: { value: 2.61, standard_error: 0.006, last_zenith_deg: 85 }, lai_2000: { value: 2.55, standard_error: 0.005 }, at_57_5: { value: 2.57, standard_error: 0.008 } },
      leaves: { miller: { value: 2.46, standard_error: 0.006, last_zenith_deg: 85 }, lai_2000: { value: 2.41, standard_error: 0.005 }, at_57_5: { value: 2.44, standard_error: 0.008 } },
    },
    profile,
    fisheye: { x_m: 0.12, y_m: -0.3, gap_share: 0.214, width: size, height: size, rings: [{ angle_deg: 30, radius: 0.3333 }, { angle_deg: 60, radius: 0.6667 }], data_uri: pngUri(size, size, picture) },
    materials: { leaf: { area_m2: 8.36, leaf_area_m2: 8.36, other_area_m2: 0 }, stem: { area_m2: 0.742, leaf_area_m2: 0, other_area_m2: 0.742 } },
    organs: leaves.map((leaf) => ({ id: `l${leaf.rank}`, label: `leaf ${leaf.rank}`, kind: "leaf", material: "leaf", length_m: leaf.length, area_m2: round(leaf.length * leaf.width * 0.74, 4), inclination_deg: round(40 + 4 * leaf.rank, 1), plant: "grass" })),
    species: [{ species: "grass", count: 214, leaf_area_m2: 8.36, other_area_m2: 0.742, lai: 2.923, inclination_deg: 54.3, height_m: 0.612 }],
    plants: range(0, 4, 5).map((k) => ({ plant: k, species: "grass", x_m: round(0.13 * k - 0.3, 3), y_m: round(0.21 * k - 0.4, 3), leaf_area_m2: round(0.039 + 0.001 * k, 4), other_area_m2: 0.0035, height_m: round(0.56 + 0.01 * k, 3) })),
    plants_total: 214, notes: [], overlap: null,
  }; // prettier-ignore
}

const sza = 30;
const views = range(-75, 75, 31);

export function simulate() {
  const { normal } = random(3);
  const series = [];
  const hot = (v) => Math.exp(-Math.abs(v + sza) / 9);
  const add = (band, wavelength_nm, quantity, value, extra) => series.push({
    sensor: "principal plane", quantity, band, wavelength_nm, origin: "total", component: "all", order: null, material: null, sza_deg: sza, saa_deg: 0, ...extra,
    vza_deg: views, vaa_deg: views.map((v) => (v < 0 ? 0 : 180)), value: views.map((v) => round(value(v), 4)), standard_error: views.map((v) => round(0.006 * value(v) + 0.0002, 2)),
  }); // prettier-ignore
  for (const [band, nm, leaf, ground, many] of [["red", 660, 0.034, 0.03, 0.12], ["nir", 850, 0.21, 0.045, 0.52]]) {
    const gap = (v) => Math.exp(-0.7 / Math.cos(v * radians));
    const parts = {
      uc_sgl: (v) => ground * gap(v) * 2 * (1 + 0.9 * hot(v)),
      co_sgl: (v) => leaf * (1 - 0.5 * gap(v)) * (0.75 + 0.5 * hot(v)) * (1 + 0.22 * Math.sin(v * radians) ** 2),
      mlt: (v) => leaf * many * 1.1 * (1 + 0.15 * Math.sin(v * radians) ** 2),
    };
    const all = (v) => parts.uc_sgl(v) + parts.co_sgl(v) + parts.mlt(v);
    add(band, nm, "brf", (v) => all(v) * (1 + 0.004 * normal()), {});
    for (const [component, value] of Object.entries(parts)) add(band, nm, "brf", value, { component });
    add(band, nm, "brf", (v) => 0.82 * all(v), { origin: "direct" });
    add(band, nm, "brf", () => 0.18 * all(0), { origin: "diffuse" });
    const ratio = many / (1 + many);
    for (let order = 1; order <= 6; ++order)
      add(band, nm, "brf", (v) => (order === 1 ? parts.uc_sgl(v) + parts.co_sgl(v) : parts.mlt(v) * (1 - ratio) * ratio ** (order - 2)), { order });
  }
  const soil = (v) => 0.42 * Math.exp(-0.75 / Math.cos(v * radians)) * 2.2;
  const lit = (v) => 0.45 + 0.5 * hot(v);
  for (const [material, value] of [["soil", soil], ["leaf", (v) => 1 - soil(v)]]) {
    add("nir", 850, "fraction_sunlit", (v) => value(v) * lit(v), { material });
    add("nir", 850, "fraction_shaded", (v) => value(v) * (1 - lit(v)), { material });
  }
  const nm = range(400, 1000, 61);
  const curve = (w) => 0.02 + 0.05 * Math.exp(-(((w - 555) / 35) ** 2)) + 0.42 / (1 + Math.exp(-(w - 715) / 14));
  const spectrum = (vza_deg, scale) => ({
    sensor: "principal plane", quantity: "brf", sza_deg: sza, vza_deg, vaa_deg: 0, wavelength_nm: nm,
    value: nm.map((w) => round(curve(w) * scale, 4)), standard_error: nm.map((w) => round(0.015 * curve(w) * scale + 0.0004, 2)),
  }); // prettier-ignore
  const image = pngUri(256, 160, (x, y) => {
    const row = Math.abs(((x + 20 * Math.sin(y / 37)) % 32) - 16) / 16;
    const noise = ((x * 7 + y * 13) % 11) + ((x * 3 + y * 5) % 7);
    return row > 0.55 ? [126 - noise, 104 - noise, 78 - noise] : [52 + 40 * row + noise, 104 + 50 * row + noise, 44 + noise];
  });
  return {
    report: "simulate", sensors: [{ name: "principal plane", type: "brf" }, { name: "drone", type: "perspective" }],
    samples: 65536, seconds: 84.6, rays: 4.31e8, threads: 8, stopped_by: "target_se", seed: 1, version: "0.1.0", series,
    spectra: [spectrum(0, 1), spectrum(-30, 1.42)],
    images: [{ sensor: "drone", caption: "The canopy from above in true colour, rendered by the sensor “drone”.", width: 256, height: 160, data_uri: image }],
    provenance: { version: "0.1.0", command: "bpms simulate scene.toml -o out.nc", seed: 1, inputs: [{ path: "scene.toml", sha256: "3b1f".repeat(16) }] },
  }; // prettier-ignore
}
