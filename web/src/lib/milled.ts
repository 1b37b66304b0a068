// Milled places: what a new keyway, slot, flat or cross hole is where nothing is known yet.
import { ends, entries, freshId, type Element } from './elements';
import type { Part } from './types';

export type Milled = 'keyway' | 'slot' | 'flat' | 'cross-hole';

// Up to a shaft diameter: width and depth in the shaft, of parallel keys as shops stock them.
const keys_mm = [
  [8, 2, 1.2], [10, 3, 1.8], [12, 4, 2.5], [17, 5, 3], [22, 6, 3.5], [30, 8, 4], [38, 10, 5], [44, 12, 5],
  [50, 14, 5.5], [58, 16, 6], [65, 18, 7], [75, 20, 7.5], [85, 22, 9], [95, 25, 9], [110, 28, 10],
];

const tenth = (mm: number) => Number(mm.toFixed(1));

/** A hole that is as wide as a drill of half millimetres, the smallest of 2.5 mm. */
const drilled = (mm: number) => Math.max(2.5, Math.floor(2 * mm) / 2);

/** A cross hole that goes through something, or to a depth that is at first its diameter. */
export function goingThrough(hole: Element, through: unknown): Element {
  const { depth_mm, through: before, ...rest } = hole;
  return through === undefined ? { ...rest, depth_mm: depth_mm ?? hole.diameter_mm } : { ...rest, through };
}

/** Left end and length of an outer element. */
export function extentOf(part: Part, id: string): { z: number; length: number; diameter: number } | undefined {
  let z = 0;
  for (const e of entries(part, 'outer')) {
    if (e.id === id) return { z, length: Number(e.length_mm), diameter: ends(e)[0] };
    z += Number(e.length_mm);
  }
  return undefined;
}

/** Outer cylinders, which alone are milled into. */
export const millable = (part: Part): Element[] => entries(part, 'outer').filter((e) => e.kind === 'cylinder');

/** The document with a keyway, slot, flat or cross hole in the middle of a cylinder (a slot at its end). */
export function withMilled(part: Part, kind: Milled, on: string): Part {
  const place = extentOf(part, on);
  if (!place) return part;
  const [, width, depth] = keys_mm.find(([d]) => place.diameter <= d) ?? keys_mm[keys_mm.length - 1];
  const length = tenth(Math.max(0.7 * place.length, Math.min(1.5 * width, place.length)));
  const z = kind === 'slot' ? tenth(place.z + place.length - length) : tenth(place.z + (place.length - length) / 2);
  const flat = kind === 'flat';
  const entry = kind === 'cross-hole'
    ? { id: freshId(part, 'h'), kind, on, at_mm: tenth(place.z + place.length / 2), diameter_mm: drilled(Math.min(width, place.length)), through: 'part' }
    : {
      id: freshId(part, kind[0]), kind, on, z_mm: z, length_mm: length,
      ...(!flat && { width_mm: width }), depth_mm: flat ? tenth(0.1 * place.diameter) : depth,
    };
  return { ...part, milling: [...(Array.isArray(part.milling) ? part.milling : []), entry] };
}
