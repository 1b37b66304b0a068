// Setups in the document: where it says nothing, those that the drawing shows are written in.
import type { Drawing, Part } from './types';

/**
 * The document with the setups that hold without it saying so. What they grip and the
 * clampings they may have stay the planner's choice.
 */
export function written(part: Part, drawing: Drawing | undefined): Part {
  if (Array.isArray(part.setups) || !drawing) return part;
  const { choose, ...rest } = part;
  const { setups: _, ...others } = choose ?? {};
  const setups = drawing.setups.map(({ hold }) => ({ hold }));
  return { ...rest, ...(Object.keys(others).length && { choose: others }), setups };
}

/** A length as a hand sets it: half millimetres inside a range. */
export const handy = (mm: number, least: number, most: number): number =>
  Math.min(most, Math.max(least, Math.round(2 * mm) / 2));

/** The document with jaws that grip so much, or a rest that stands there, in one setup. */
export function withSetup(part: Part, drawing: Drawing, setup: number, member: 'grip_mm' | 'steady_mm', mm: number): Part {
  const next = written(part, drawing);
  const setups = next.setups.with(setup, { ...next.setups[setup], [member]: mm });
  return { ...next, setups };
}
