// Colours: one hue for one thing throughout the page. Red is kept for what was rejected.

export const ink = "#24292f";
export const quiet = "#6b7280";
export const rule = "#e3e6ea";
export const accent = "#2f6f4f";
export const rejected = "#d0312d";

const qualitative = [
  "#2f7d4f", "#d1812a", "#3b6fb6", "#9c4f96", "#a8962a", "#2a9d9a",
  "#7a5230", "#7fae42", "#d98bb4", "#5c4b9b", "#6b7785", "#55a6d9",
]; // prettier-ignore

// Beyond the list its colours come again, paler.
export function colour(i: number): string {
  const c = qualitative[((i % qualitative.length) + qualitative.length) % qualitative.length] ?? ink;
  return Math.floor(i / qualitative.length) % 2 === 1 ? between([c, "#ffffff"], 0.45) : c;
}

export function alpha(hex: string, a: number): string {
  const n = Number.parseInt(hex.slice(1), 16);
  return `rgba(${n >> 16}, ${(n >> 8) & 255}, ${n & 255}, ${a})`;
}

const materials: [RegExp, string][] = [
  [/soil|ground|sol/i, "#8a6a4a"],
  [/leaf|blade|lamina/i, "#3f8f4f"],
  [/stem|culm|stalk|tige/i, "#a7b64c"],
  [/bark|wood|branch|trunk/i, "#75573c"],
  [/head|ear|flower|fruit|spike/i, "#d9a833"],
  [/pot|rim/i, "#b5694a"],
];

export function materialColour(name: string | null, index = 0): string {
  if (name === null || name === "") return "#9aa3ad";
  return materials.find(([pattern]) => pattern.test(name))?.[1] ?? colour(index + 2);
}

// A colour that reminds of the wavelength; infrared in violet and brown.
export function bandColour(nm: number | null, index = 0): string {
  if (nm === null) return colour(index);
  if (nm < 500) return "#3b6fb6";
  if (nm < 590) return "#3f8f4f";
  if (nm < 700) return "#c2542f";
  if (nm < 760) return "#96345c";
  if (nm < 1100) return "#6c4aa0";
  return "#7a5230";
}

// Steps of one colour map (viridis at fixed places) for ordered things such as scattering orders.
const ordered = ["#440154", "#414487", "#2a788e", "#22a884", "#7ad151", "#d8c51e", "#e9a23b", "#c9c9c9"];
export function orderColour(i: number, n: number): string {
  if (n <= 1) return ordered[2] ?? ink;
  const last = ordered.length - 1;
  return n <= ordered.length ? (ordered[Math.max(0, Math.min(i, last))] ?? ink) : between(ordered, (i * last) / (n - 1));
}

// The colour at a place between the entries of a list, straight in red, green and blue.
function between(colours: readonly string[], place: number): string {
  const at = Math.max(0, Math.min(colours.length - 2, Math.floor(place)));
  const [a, b] = [colours[at] ?? ink, colours[at + 1] ?? ink].map((hex) => Number.parseInt(hex.slice(1), 16));
  const mixed = [16, 8, 0].map((shift) => {
    const [from, to] = [((a ?? 0) >> shift) & 255, ((b ?? 0) >> shift) & 255];
    return Math.round(from + Math.min(1, Math.max(0, place - at)) * (to - from));
  });
  return `#${mixed.map((x) => x.toString(16).padStart(2, "0")).join("")}`;
}
