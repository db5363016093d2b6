// Short names: "brick 10" for brick[1,4]. The bodies of an array are numbered from 1, in the order in which the scene makes them.
import type { BodyInfo } from './head';

const kOfArray = /^(.*\S)\s*\[\d+(?:,\s*\d+)*\]$/;
const kInText = /[^\s,;:("]+\[\d+(?:,\d+)*\]/g;

export interface ShortName {
  base: string; // "brick"
  number: number; // 10; 0 for a body that is no member of an array
}

export function shortNames(bodies: BodyInfo[]): ShortName[] {
  const counts = new Map<string, number>();
  return bodies.map(({ name }) => {
    const base = kOfArray.exec(name)?.[1];
    if (base === undefined) return { base: name, number: 0 };
    const number = (counts.get(base) ?? 0) + 1;
    counts.set(base, number);
    return { base, number };
  });
}

export function written({ base, number }: ShortName): string {
  return number === 0 ? base : `${base} ${number}`;
}

/** A sentence of the engine with short names in it. */
export function withShortNames(text: string, shortOf: ReadonlyMap<string, string>): string {
  return text.replace(kInText, (name) => shortOf.get(name) ?? name);
}
