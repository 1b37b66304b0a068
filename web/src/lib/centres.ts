// Centre holes of ISO 6411 that the drawing asks for in the ends of a part.
import { ends, entries, mouths, type Element } from './elements';
import type { Part } from './types';

export type End = 'left' | 'right';
export interface Centre {
  form: 'A' | 'B' | 'R';
  /** Diameters of the pilot hole and where it is widest. */
  pilot: number;
  widest: number;
}

/** d, the largest diameter of the forms A and R, and that of B (0: form A alone), as the planner knows them: src/part/drawing.cpp. */
const rows = [
  [0.5, 1.06, 0], [0.63, 1.32, 0], [0.8, 1.7, 0],
  [1, 2.12, 3.15], [1.25, 2.65, 4], [1.6, 3.35, 5], [2, 4.25, 6.3], [2.5, 5.3, 8], [3.15, 6.7, 10], [4, 8.5, 12.5], [5, 10.6, 16],
  [6.3, 13.2, 18], [8, 17, 22.4], [10, 21.2, 28],
];
export const centres: Centre[] = (['A', 'B', 'R'] as const).flatMap((form) =>
  rows.filter(([, , b]) => b > 0 || form === 'A').map(([pilot, a, b]) => ({ form, pilot, widest: form === 'B' ? b : a })));

/** "A4/8.5". */
export const centreText = (c: Centre): string => `${c.form}${c.pilot}/${c.widest}`;

/** The centre hole of a designation like "ISO 6411-A4/8.5", "DIN 332-A4x8,5", "A4/8.5". */
export function centreOf(designation: unknown): Centre | undefined {
  const m = /^\s*(?:(?:ISO\s*6411|DIN\s*332)\s*[-\s]\s*)?([ABR])\s*([\d.,]+)\s*[/xX×]\s*([\d.,]+)\s*$/.exec(String(designation));
  const number = (digits: string) => Number(digits.replace(',', '.'));
  return m ? centres.find((c) => c.form === m[1] && c.pilot === number(m[2]) && c.widest === number(m[3])) : undefined;
}

const list = (part: Part): Element[] => (Array.isArray(part.centre_holes) ? part.centre_holes : []);

/** Where in the document's list that of an end stands; -1: nowhere. */
export const centreIndex = (part: Part, end: End): number => list(part).findIndex((c) => c?.at === end);

/** The designation that an end has, in the words of the table where it is in it. */
export function centreAt(part: Part, end: End): string | undefined {
  const given = list(part)[centreIndex(part, end)]?.designation;
  const known = centreOf(given);
  return known ? centreText(known) : given;
}

/** The document with a centre hole in an end; undefined takes it away. */
export function withCentre(part: Part, end: End, designation: unknown): Part {
  const index = centreIndex(part, end), before = list(part);
  const entry = { ...before[index], at: end, designation };
  const next = designation === undefined ? before.filter((_, i) => i !== index)
    : index < 0 ? [...before, entry] : before.with(index, entry);
  const { centre_holes: _, ...rest } = part;
  return next.length ? { ...part, centre_holes: next } : rest;
}

/** Whether a bore or the tube's hole opens at an end, which then has no centre hole. */
export const isHollow = (part: Part, end: End): boolean => part.stock?.kind === 'tube' || mouths(part).some((m) => m.end === end);

/** Those that are less wide than an end. */
export function centresFor(part: Part, end: End): string[] {
  const outer = entries(part, 'outer');
  const d = end === 'left' ? ends(outer[0])[0] : ends(outer[outer.length - 1])[1];
  return centres.filter((c) => !(c.widest >= d)).map(centreText);
}
