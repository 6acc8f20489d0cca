// Histograms counted here, so that their bins are known to captions and tests.

export interface Bins {
  centres: number[];
  counts: number[];
  width: number;
}

export function histogram(values: readonly number[], from: number, to: number, n: number): Bins {
  const width = (to - from) / n;
  const counts = new Array<number>(n).fill(0);
  for (const v of values) {
    const i = Math.max(0, Math.min(n - 1, Math.floor((v - from) / width)));
    counts[i] = (counts[i] ?? 0) + 1;
  }
  return { centres: counts.map((_, i) => from + (i + 0.5) * width), counts, width };
}
