// Numbers for people: significant digits, uncertainties, units. A missing number is an en dash.

export const missing = "–";
const minus = "−";
const thinSpace = " ";

type Num = number | null | undefined;

function signed(s: string): string {
  return s.replace(/^-/, minus);
}

function grouped(fixed: string): string {
  const [whole = "", fraction] = fixed.split(".");
  const digits = whole.replace("-", "");
  const out = digits.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, thinSpace) : whole;
  return fraction === undefined ? out : `${out}.${fraction}`;
}

const superscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";
export function superscript(n: number): string {
  const digits = [...String(Math.abs(n))].map((d) => superscripts[Number(d)]).join("");
  return (n < 0 ? "⁻" : "") + digits;
}

export function fixed(value: Num, decimals: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return missing;
  const s = value.toFixed(decimals);
  return signed(grouped(/^-0(\.0*)?$/.test(s) ? s.slice(1) : s));
}

export function count(value: Num): string {
  return fixed(value, 0);
}

// `digits` significant digits; powers of ten outside 1e-5 .. 1e7.
export function significant(value: Num, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return missing;
  if (value === 0) return "0";
  const exponent = Number(value.toExponential(digits - 1).split("e")[1]);
  if (exponent < -5 || exponent >= 7) {
    const mantissa = (value / 10 ** exponent).toFixed(digits - 1);
    return `${signed(mantissa)} × 10${superscript(exponent)}`;
  }
  return fixed(value, Math.max(0, digits - 1 - exponent));
}

export function unitSuffix(unit: string): string {
  if (unit === "") return "";
  return unit === "°" ? unit : ` ${unit}`;
}

// "83.17 ± 0.11 mm": the uncertainty to two significant digits, the value to the same decimal place.
export function withSigma(value: Num, sigma: Num, unit = "", digits = 5): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return missing;
  const suffix = unitSuffix(unit);
  if (sigma === null || sigma === undefined || !Number.isFinite(sigma) || sigma <= 0)
    return significant(value, digits) + suffix;
  const largest = Math.floor(Math.log10(Math.max(Math.abs(value), sigma)));
  if (largest < -5 || largest >= 7) {
    const scale = 10 ** largest;
    return `(${withSigma(value / scale, sigma / scale)}) × 10${superscript(largest)}${suffix}`;
  }
  const place = Number(sigma.toExponential(1).split("e")[1]) - 1;
  const round = (x: number): string => {
    const step = 10 ** place;
    return place > 0 ? fixed(Math.round(x / step) * step, 0) : fixed(x, -place);
  };
  const body = `${round(value)} ± ${round(sigma)}`;
  return unit === "°" || unit === "%" ? `(${body})${suffix}` : body + suffix;
}

// A length given in metres, shown in the unit in which its figures are readable.
export function length(value_m: Num, sigma_m?: Num, digits = 4): string {
  const size = Math.abs(value_m ?? 0);
  if (size >= 2) return withSigma(value_m, sigma_m, "m", digits);
  const mm = (x: Num): Num => (x === null || x === undefined ? x : x * 1000);
  return withSigma(mm(value_m), mm(sigma_m), "mm", digits);
}

export function area(value_m2: Num, digits = 4): string {
  if (value_m2 === null || value_m2 === undefined) return missing;
  const size = Math.abs(value_m2);
  return size > 0 && size < 0.1 ? `${significant(value_m2 * 1e4, digits)} cm²` : `${significant(value_m2, digits)} m²`;
}

export function percent(fraction: Num, digits = 2): string {
  if (fraction === null || fraction === undefined) return missing;
  return `${significant(fraction * 100, digits)} %`;
}

export function duration(seconds: Num): string {
  if (seconds === null || seconds === undefined) return missing;
  if (seconds < 120) return `${significant(seconds, 3)} s`;
  if (seconds < 7200) return `${significant(seconds / 60, 3)} min`;
  return `${significant(seconds / 3600, 3)} h`;
}

// Large counts in the short scale that papers use: 1.23 × 10⁹.
export function magnitude(value: Num): string {
  if (value === null || value === undefined) return missing;
  return Math.abs(value) < 1e6 ? count(value) : significantPower(value);
}

function significantPower(value: number): string {
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  return `${signed((value / 10 ** exponent).toFixed(2))} × 10${superscript(exponent)}`;
}

export function plural(n: number, one: string, many = `${one}s`): string {
  return `${count(n)} ${n === 1 ? one : many}`;
}

export function sentenceCase(s: string): string {
  const spaced = s.replace(/_/g, " ");
  return spaced.charAt(0).toUpperCase() + spaced.slice(1);
}

export function median(values: readonly Num[]): number | null {
  const sorted = values.filter((v): v is number => typeof v === "number").sort((a, b) => a - b);
  if (sorted.length === 0) return null;
  const middle = sorted.length >> 1;
  const upper = sorted[middle] ?? null;
  const lower = sorted[middle - 1];
  return sorted.length % 2 === 1 || lower === undefined || upper === null ? upper : (lower + upper) / 2;
}

// Paths by their file names, as long as these tell them apart.
export function fileNames(paths: readonly string[]): (path: string) => string {
  const name = (path: string): string => path.slice(path.lastIndexOf("/") + 1);
  const distinct = new Set(paths);
  return new Set([...distinct].map(name)).size === distinct.size ? name : (path) => path;
}

// The largest of 1, 2, 5 times a power of ten that does not exceed x.
export function niceBelow(x: number): number {
  if (!(x > 0) || !Number.isFinite(x)) return 1;
  const power = 10 ** Math.floor(Math.log10(x) + 1e-9);
  const lead = x / power + 1e-9;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}
