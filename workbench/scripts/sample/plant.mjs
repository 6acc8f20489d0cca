// A small plant from formulas, shared by the parts of the sample.

export function random(seed) {
  let a = seed >>> 0;
  const uniform = () => {
    a = (a + 0x6d2b79f5) >>> 0;
    let t = Math.imul(a ^ (a >>> 15), 1 | a);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
  const normal = () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform());
  return { uniform, normal };
}

export const round = (x, digits = 5) => (x === null || !Number.isFinite(x) ? null : Number(x.toPrecision(digits)));
export const range = (from, to, n) => Array.from({ length: n }, (_, i) => from + ((to - from) * i) / (n - 1));

const radians = Math.PI / 180;

// Leaves on a stem: inclination from the vertical grows from `from` to `to` along the blade.
export const leaves = [
  { rank: 1, length: 0.16, width: 0.016, foot: 0.05, azimuth: 20, from: 25, to: 105 },
  { rank: 2, length: 0.21, width: 0.02, foot: 0.1, azimuth: 195, from: 20, to: 120 },
  { rank: 3, length: 0.26, width: 0.024, foot: 0.16, azimuth: 35, from: 16, to: 110 },
  { rank: 4, length: 0.24, width: 0.022, foot: 0.23, azimuth: 215, from: 14, to: 80 },
  { rank: 5, length: 0.19, width: 0.018, foot: 0.3, azimuth: 10, from: 8, to: 45 },
];
export const stemHeight = 0.34;

export const inclination = (leaf, l) => leaf.from + (leaf.to - leaf.from) * l ** 1.3;
export const azimuth = (leaf, l) => 12 * Math.sin(2.2 * l + leaf.rank);
export const twist = (leaf, l) => 9 * leaf.rank * l * l - 6 * l;
export const width = (leaf, l) => leaf.width * (0.35 + 2.4 * l - 1.75 * l * l - l ** 5) * 1.3;

// Midrib in the plant's frame, metres, z up: the direction turns with inclination and azimuth.
export function midrib(leaf, n) {
  const points = [[0, 0, leaf.foot]];
  const steps = 40;
  const fine = [points[0]];
  for (let i = 0; i < steps; ++i) {
    const l = (i + 0.5) / steps;
    const zenith = inclination(leaf, l) * radians;
    const a = (leaf.azimuth + azimuth(leaf, l) - azimuth(leaf, 0)) * radians;
    const d = leaf.length / steps;
    const [x, y, z] = fine[i];
    fine.push([x + d * Math.sin(zenith) * Math.cos(a), y + d * Math.sin(zenith) * Math.sin(a), z + d * Math.cos(zenith)]);
  }
  return range(0, steps, n).map((s) => {
    const i = Math.min(steps - 1, Math.floor(s));
    return fine[i].map((v, k) => v + (s - i) * (fine[i + 1][k] - v));
  });
}

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

// The two edges of a blade, for the mesh and the outlines.
export function edges(leaf, n) {
  const middle = midrib(leaf, n);
  return middle.map((p, i) => {
    const l = i / (n - 1);
    const ahead = middle[Math.min(n - 1, i + 1)].map((v, k) => v - middle[Math.max(0, i - 1)][k]);
    const flat = unit(cross(ahead, [0, 0, 1]));
    const normal = unit(cross(flat, ahead));
    const t = twist(leaf, l) * radians;
    const side = flat.map((v, k) => v * Math.cos(t) + normal[k] * Math.sin(t));
    const half = Math.max(0, width(leaf, l)) / 2;
    return { left: p.map((v, k) => v - half * side[k]), middle: p, right: p.map((v, k) => v + half * side[k]) };
  });
}
