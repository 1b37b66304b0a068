import type { Tolerance } from './types';

export interface Slice {
  source: string;
  um: number;
}

/**
 * What takes a tolerance's width, end to end. Independent sources add by squares, so all
 * but the deflection are reduced in proportion until they and what is left add up to it.
 */
export function stack(t: Tolerance): { slices: Slice[]; leftUm: number } {
  const width = 1000 * t.width_mm;
  const ends = Array.isArray(t.predicted_mm) ? 2 : 1;
  const sum = (all: Slice[]) => all.reduce((total, share) => total + share.um, 0);
  const cut = t.shares.filter((share) => share.source === 'deflection');
  const others = sum(t.shares.filter((share) => share.source !== 'deflection'));
  const leftUm = cut.length ? ends * 1000 * t.margin_mm : width - others;
  const factor = cut.length && others > 0 ? (width - sum(cut) - leftUm) / others : 1;
  const slices = t.shares.map(({ source, um }) => ({
    source,
    um: source === 'deflection' ? um : Math.max(0, factor * um),
  }));
  return { slices, leftUm };
}
