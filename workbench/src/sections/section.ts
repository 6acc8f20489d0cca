// What a section of the page is. Adding one: a file beside this one, a line in index.ts, a reader in ../data.ts.

import type { Card, Section } from "../book";
import type { Reader } from "../schema";

export interface Summary {
  sentence: string | null; // one line at the head of the page
  cards: Card[]; // key figures at the head of the page
}

interface Definition<T> {
  kind: string; // the value of "report"
  step: string; // in the pipeline strip
  title: string;
  explanation: string; // what one sees: units, conventions
  read: Reader<T>;
  summarise: (report: T) => Summary;
  render: (report: T, section: Section) => void;
}

export interface SectionModule {
  kind: string;
  step: string;
  title: string;
  explanation: string;
  summarise: (raw: unknown) => Summary;
  render: (raw: unknown, section: Section) => void;
}

export function defineSection<T>(d: Definition<T>): SectionModule {
  return {
    ...d,
    summarise: (raw) => d.summarise(d.read(raw)),
    render: (raw, section) => d.render(d.read(raw), section),
  };
}
