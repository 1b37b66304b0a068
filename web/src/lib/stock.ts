// Stock that fits a part, as the planner's import chooses it: src/document/exchange/import.cpp.
import { ends, entries } from './elements';
import type { Part } from './types';

// Round bars as dealers keep them, an estimate.
const bars_mm = [
  6, 8, 10, 12, 14, 15, 16, 18, 20, 22, 25, 28, 30, 32, 35, 36, 40, 42, 45, 48, 50, 52, 55, 60, 65, 70, 75, 80, 85, 90,
  95, 100, 105, 110, 115, 120, 125, 130, 140, 150, 160, 170, 180, 190, 200, 210, 220, 230, 240, 250,
];
const least_mm = 1, facing_mm = 2, wall_mm = 1;

/** Whether a kind of stock has an outline instead of a size and a length. */
export const hasOutline = (kind: unknown): boolean => kind === 'casting' || kind === 'forging';

const rounded = (mm: number) => Number(mm.toFixed(6));

/** The next bar, or for a tube the next ring, with 2 mm to face at each end; one that an element keeps, or that has corners, as wide as it is. */
export function fitting(part: Part): Part | undefined {
  const outer = entries(part, 'outer');
  const length = outer.reduce((sum, e) => sum + Number(e.length_mm), 0);
  const largest = Math.max(...outer.flatMap(ends));
  if (!(length > 0 && largest > 0) || hasOutline(part.stock?.kind)) return undefined;
  const wanted = largest + least_mm;
  const diameter = bars_mm.find((d) => d >= wanted) ?? 10 * Math.ceil(wanted / 10);
  const rest = { length_mm: rounded(length + 2 * facing_mm), left_allowance_mm: facing_mm };
  if (outer.some((e) => e.kind === 'as-stock') || !['bar', 'tube', undefined].includes(part.stock?.kind)) return rest;
  if (part.stock?.kind !== 'tube') return { kind: 'bar', diameter_mm: diameter, ...rest };
  const bores = entries(part, 'inner').flatMap(ends).filter(Number.isFinite);
  const inner = bores.length ? Math.min(...bores) - 2 * wall_mm : part.stock.inner_mm;
  return { kind: 'tube', outer_mm: diameter, inner_mm: inner, ...rest };
}

/** Stock that fitted the part before an edit fits it afterwards; stock written by hand stays. */
export function stockFollows(before: Part, after: Part): Part {
  const had = fitting(before), next = fitting(after);
  if (!had || !next || after.stock !== before.stock) return after;
  const same = Object.entries(had).every(([key, value]) => before.stock?.[key] === value);
  return same ? { ...after, stock: { ...after.stock, ...next } } : after;
}
