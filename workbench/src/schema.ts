// Tolerant readers: a reader turns any JSON value into its type and never throws.
// A missing or ill-typed value becomes null (or an empty list), so that a page shows what is there.

export type Reader<T> = (value: unknown) => T;
export type Infer<R> = R extends Reader<infer T> ? T : never;

export const number: Reader<number | null> = (v) => (typeof v === "number" && Number.isFinite(v) ? v : null);
export const text: Reader<string | null> = (v) => (typeof v === "string" ? v : typeof v === "number" ? String(v) : null);
export const flag: Reader<boolean | null> = (v) => (typeof v === "boolean" ? v : null);
export const raw: Reader<unknown> = (v) => v;

export function isObject(v: unknown): v is Record<string, unknown> {
  return typeof v === "object" && v !== null && !Array.isArray(v);
}

export function list<T>(item: Reader<T>): Reader<T[]> {
  return (v) => (Array.isArray(v) ? v.map((x: unknown) => item(x)) : []);
}

// A list of objects; entries that are no objects are dropped.
export function rows<T>(item: Reader<T>): Reader<T[]> {
  return (v) => (Array.isArray(v) ? v.filter(isObject).map((x) => item(x)) : []);
}

export function record<T>(item: Reader<T>): Reader<Record<string, T>> {
  return (v) => (isObject(v) ? Object.fromEntries(Object.entries(v).map(([k, x]) => [k, item(x)])) : {});
}

export function optional<T>(item: Reader<T>): Reader<T | null> {
  return (v) => (isObject(v) ? item(v) : null);
}

export function object<S extends Record<string, Reader<unknown>>>(shape: S): Reader<{ [K in keyof S]: Infer<S[K]> }> {
  const entries = Object.entries(shape);
  return (v) => {
    const source = isObject(v) ? v : {};
    return Object.fromEntries(entries.map(([k, read]) => [k, read(source[k])])) as { [K in keyof S]: Infer<S[K]> };
  };
}

export const numbers = list(number);
