import { expect, test } from "vitest";
import { area, count, duration, fileNames, fixed, length, median, niceBelow, percent, significant, withSigma } from "../src/format";

test("an uncertainty has two significant digits and the value the same decimals", () => {
  expect(withSigma(83.1712, 0.108, "mm")).toBe("83.17 ± 0.11 mm");
  expect(withSigma(83.1712, 1.08, "mm")).toBe("83.2 ± 1.1 mm");
  expect(withSigma(-0.28713, 0.0026)).toBe("−0.2871 ± 0.0026");
  expect(withSigma(57.3, 0.5, "°")).toBe("(57.30 ± 0.50)°");
});

test("an uncertainty that rounds up to the next power of ten moves the last digit", () => {
  expect(withSigma(12.3456, 0.0996)).toBe("12.35 ± 0.10");
  expect(withSigma(12.341, 0.96)).toBe("12.34 ± 0.96");
});

test("an uncertainty above ten rounds the value to its place", () => {
  expect(withSigma(12345, 230)).toBe("12 350 ± 230");
  expect(withSigma(1234.4, 12.3)).toBe("1234 ± 12");
});

test("very large and very small values get one common power of ten", () => {
  expect(withSigma(4.312e8, 2e6, "rays")).toBe("(4.312 ± 0.020) × 10⁸ rays");
  expect(withSigma(1.234e-7, 2e-9)).toBe("(1.234 ± 0.020) × 10⁻⁷");
});

test("no or no positive uncertainty leaves the value alone", () => {
  expect(withSigma(83.17, null, "mm")).toBe("83.170 mm");
  expect(withSigma(83.17, 0, "mm")).toBe("83.170 mm");
});

test("a missing value is a dash whatever its uncertainty", () => {
  expect(withSigma(null, 0.1, "mm")).toBe("–");
  expect(withSigma(Number.NaN, 0.1)).toBe("–");
  expect(significant(undefined)).toBe("–");
  expect(percent(null)).toBe("–");
});

test("significant digits", () => {
  expect(significant(0.0123456, 3)).toBe("0.0123");
  expect(significant(9.996, 3)).toBe("10.0");
  expect(significant(-1234567, 3)).toBe("−1 234 567");
  expect(significant(12345678, 3)).toBe("1.23 × 10⁷");
  expect(significant(0, 3)).toBe("0");
});

test("no minus before a zero", () => {
  expect(fixed(-0.0001, 2)).toBe("0.00");
});

test("units follow the size", () => {
  expect(length(0.08317, 0.00011)).toBe("83.17 ± 0.11 mm");
  expect(length(12.5, 0.1)).toBe("12.50 ± 0.10 m");
  expect(area(0.0391, 3)).toBe("391 cm²");
  expect(area(2.5, 3)).toBe("2.50 m²");
  expect(duration(84.6)).toBe("84.6 s");
  expect(duration(9000)).toBe("2.50 h");
  expect(count(1234567)).toBe("1 234 567");
});

test("the median ignores what is missing", () => {
  expect(median([3, null, 1, undefined, 2])).toBe(2);
  expect(median([4, 1, 2, 3])).toBe(2.5);
  expect(median([])).toBeNull();
});

test("nice numbers do not exceed what they stand for", () => {
  expect(niceBelow(9.9)).toBe(5);
  expect(niceBelow(0.0201)).toBeCloseTo(0.02, 12);
  expect(niceBelow(1)).toBe(1);
  expect(niceBelow(1000)).toBe(1000);
});

test("paths are shown by file names while these tell them apart", () => {
  expect(["a/x.jpg", "a/y.jpg"].map(fileNames(["a/x.jpg", "a/y.jpg"]))).toEqual(["x.jpg", "y.jpg"]);
  expect(["a/x.jpg", "b/x.jpg"].map(fileNames(["a/x.jpg", "b/x.jpg"]))).toEqual(["a/x.jpg", "b/x.jpg"]);
});
