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
  return {
    report: "describe", leaf_area_m2: 8.36, ground_area_m2: 2.86, lai: 2.923, height_m: 0.612, cover: 0.781,
    gap_fraction: zeniths.map((zenith_deg) => {
      const p = Math.exp((-0.86 * g(zenith_deg) * 2.923) / Math.cos(zenith_deg * radians));
      return { zenith_deg, p: round(p, 4), standard_error: round(Math.sqrt((p * (1 - p)) / 900), 3) };
    }),
    g_function: range(0, 90, 19).map((zenith_deg) => ({ zenith_deg, g: round(g(zenith_deg), 4) })),
    leaf_angle: {
      mean_deg: 54.3,
      bins: weights.map((w, i) => ({ from_deg: 10 * i, to_deg: 10 * i + 10, probability: round(w / total, 4), density_per_deg: round(w / total / 10, 4) })),
    },
    materials: { leaf: { area_m2: 8.36 }, stem: { area_m2: 0.742 }, soil: { area_m2: 2.86 } },
    organs: leaves.map((leaf) => ({ id: `l${leaf.rank}`, label: `leaf ${leaf.rank}`, material: "leaf", length_m: leaf.length, area_m2: round(leaf.length * leaf.width * 0.74, 4) })),
    overlap: null, profile: null,
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
