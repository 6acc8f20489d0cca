// Curves beside measured leaf angles: beta and ellipsoidal densities, and G of de Wit's distributions.
// Angles in radians; inclination of the blade from the horizontal.

import { deWit } from "./dewit";

// ln Gamma(x) for x > 0, Stirling's series after shifting x above 8.
function logGamma(x: number): number {
  let shift = 0;
  let z = x;
  while (z < 8) {
    shift += Math.log(z);
    z += 1;
  }
  const r = 1 / (z * z);
  return (z - 0.5) * Math.log(z) - z + 0.5 * Math.log(2 * Math.PI) + (1 / 12 - r * (1 / 360 - r / 1260)) / z - shift;
}

// Goel & Strebel (1984): mu goes with 1 - 2t/pi.
export function betaDensity(mu: number, nu: number): (t: number) => number {
  const logB = logGamma(mu) + logGamma(nu) - logGamma(mu + nu);
  return (t) => {
    const x = Math.min(1 - 1e-6, Math.max(1e-6, (2 * t) / Math.PI));
    return (2 / Math.PI) * Math.exp((mu - 1) * Math.log(1 - x) + (nu - 1) * Math.log(x) - logB);
  };
}

// Campbell (1990).
export function ellipsoidalDensity(chi: number): (t: number) => number {
  const e = Math.sqrt(Math.abs(chi < 1 ? 1 - chi * chi : 1 - 1 / (chi * chi)));
  const lambda =
    e < 1e-4 ? chi + 1 : chi < 1 ? chi + Math.asin(e) / e : chi + Math.log((1 + e) / (1 - e)) / (2 * e * chi);
  return (t) => {
    const q = Math.cos(t) ** 2 + (chi * Math.sin(t)) ** 2;
    return (2 * chi ** 3 * Math.sin(t)) / (lambda * q * q);
  };
}

// |n . direction| averaged over the leaf's azimuth (Warren Wilson 1960).
export function meanProjection(leaf: number, zenith: number): number {
  const a = Math.cos(zenith) * Math.cos(leaf);
  const b = Math.sin(zenith) * Math.sin(leaf);
  if (b <= Math.abs(a)) return Math.abs(a);
  const psi = Math.acos(Math.max(-1, Math.min(1, -a / b)));
  return (a * (2 * psi - Math.PI) + 2 * b * Math.sin(psi)) / Math.PI;
}

export function gOf(density: (t: number) => number, zenith: number): number {
  const steps = 180;
  let sum = 0;
  for (let i = 0; i < steps; ++i) {
    const t = ((i + 0.5) * Math.PI) / 2 / steps;
    sum += density(t) * meanProjection(t, zenith);
  }
  return (sum * Math.PI) / 2 / steps;
}

export const deWitG = deWit.map((d) => ({ name: d.name, g: (zenith: number) => gOf(d.density, zenith) }));
