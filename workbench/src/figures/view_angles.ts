// Signed view zenith angles and the planes they lie in: negative on the sun's side, the hot spot at minus the sun's zenith.

import type { Series } from "../data";

export interface Row {
  vza: number; // signed
  value: number | null;
  se: number | null;
}

export interface Plane {
  name: string;
  rows: Row[];
}

const radians = Math.PI / 180;

// Azimuths are directions to the sun and to the viewer, in one convention, so only their difference counts.
export function signedZenith(vza: number, vaa: number | null, saa: number | null): number {
  if (vaa === null || saa === null || vza < 0) return vza;
  const c = Math.cos((vaa - saa) * radians);
  if (Math.abs(c) > 1e-6) return c > 0 ? -vza : vza;
  return Math.sin((vaa - saa) * radians) > 0 ? vza : -vza;
}

// The angle between the view plane and the sun's plane, 0 to 90.
function planeAngle(vaa: number, saa: number): number {
  const d = (((vaa - saa) % 180) + 180) % 180;
  return Math.round(Math.min(d, 180 - d) * 10) / 10;
}

function planeName(angle: number): string {
  if (angle < 1) return "principal plane";
  return angle > 89 ? "cross plane" : `${angle}° from the principal plane`;
}

// The views of one series, sorted, in one or more planes; nadir belongs to every plane.
export function planes(s: Series): Plane[] {
  const signedAlready = s.vza_deg.some((v) => v !== null && v < 0);
  const all = s.vza_deg.flatMap((vza, i) => {
    if (vza === null) return [];
    const vaa = s.vaa_deg[i] ?? null;
    const known = vaa !== null && s.saa_deg !== null;
    const nadir = Math.abs(vza) < 1e-6;
    const angle = known && !nadir ? planeAngle(vaa, s.saa_deg ?? 0) : null;
    const signed = signedAlready ? vza : signedZenith(vza, vaa, s.saa_deg);
    return [{ angle, nadir, row: { vza: signed, value: s.value[i] ?? null, se: s.standard_error[i] ?? null } }];
  });
  const angles = [...new Set(all.filter((p) => !p.nadir).map((p) => p.angle))].sort((a, b) => (a ?? -1) - (b ?? -1));
  const groups = angles.length > 0 ? angles : [null];
  return groups.map((angle) => ({
    name: angle === null ? "" : planeName(angle),
    rows: all
      .filter((p) => p.nadir || p.angle === angle)
      .map((p) => p.row)
      .sort((a, b) => a.vza - b.vza),
  }));
}

// The plane to show where there is room for one: the principal one if the series has it.
export function mainPlane(s: Series): Row[] {
  return planes(s)[0]?.rows ?? [];
}

export function bandName(s: { band: string | null; wavelength_nm: number | null }): string {
  const nm = s.wavelength_nm === null ? null : `${Math.round(s.wavelength_nm * 10) / 10} nm`;
  if (s.band === null || s.band === "" || s.band === nm) return nm ?? "";
  return nm === null || /nm$/.test(s.band) ? s.band : `${s.band} (${nm})`;
}
