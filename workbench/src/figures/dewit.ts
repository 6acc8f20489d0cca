// De Wit's leaf angle distributions: densities over the leaf inclination θ in radians, each with integral 1 on [0, π/2].

const k = 2 / Math.PI;

export const deWit: { name: string; density: (theta: number) => number }[] = [
  { name: "spherical", density: (t) => Math.sin(t) },
  { name: "planophile", density: (t) => k * (1 + Math.cos(2 * t)) },
  { name: "erectophile", density: (t) => k * (1 - Math.cos(2 * t)) },
  { name: "plagiophile", density: (t) => k * (1 - Math.cos(4 * t)) },
  { name: "extremophile", density: (t) => k * (1 + Math.cos(4 * t)) },
  { name: "uniform", density: () => k },
];

export function perDegree(density: (theta: number) => number, degrees: number): number {
  return (density((degrees * Math.PI) / 180) * Math.PI) / 180;
}
