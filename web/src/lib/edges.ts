// Edges and inner corners of a part: where a chamfer, an undercut or a fillet may stand.
import { alongBores, ends, entries, mouths, type Element } from './elements';
import type { Part } from './types';

/** An undercut of DIN 509; recess: how deep form F goes into the shoulder, 0 of form E. */
export interface Undercut { radius: number; depth: number; width: number; recess: number }
/** Forms E and F by radius and depth, as the planner knows them: src/part/drawing.cpp. */
export const undercuts: Record<string, Undercut> = Object.fromEntries(
  ['E', 'F'].flatMap((form) =>
    [
      [0.2, 0.1, 1, 0.1], [0.4, 0.2, 2, 0.1], [0.6, 0.2, 2, 0.1], [0.6, 0.3, 2.5, 0.2], [0.8, 0.3, 2.5, 0.2], [1, 0.2, 2.5, 0.1],
      [1, 0.4, 4, 0.3], [1.2, 0.2, 2.5, 0.1], [1.2, 0.4, 4, 0.3], [1.6, 0.3, 4, 0.2], [2.5, 0.4, 5, 0.3], [4, 0.5, 7, 0.3],
    ].map(([radius, depth, width, recess]) =>
      [`${form}${radius}x${depth}`, { radius, depth, width, recess: form === 'F' ? recess : 0 }]),
  ),
);
export const usualUndercut = 'E0.8x0.3';

export interface Place {
  at: string;
  name: string;
  /** What may stand there: an edge has chamfers; the foot of a wall fillets and, outside, undercuts. */
  chamfer: boolean;
  fillet: boolean;
  undercut: boolean;
}

const turned = (e: Element | undefined) => ['cylinder', 'thread'].includes(String(e?.kind));
const is = (kind: string, ...all: Element[]) => all.some((e) => e.kind === kind);

function between(a: Element, b: Element, side: 'outer' | 'inner'): Place | undefined {
  const [left, right] = [ends(a)[1], ends(b)[0]];
  if (is('arc', a, b) || left === right) return undefined;
  const stands = left > right === (side === 'outer') ? a : b, groove = is('groove', a, b);
  return {
    at: `${a.id}|${b.id}`, name: `${a.id} to ${b.id}`, chamfer: turned(stands), fillet: !groove,
    undercut: side === 'outer' && !groove,
  };
}

/** The edges of a part from left to right, then those of its bores. */
export function edgePlaces(part: Part): Place[] {
  const outer = entries(part, 'outer'), bores = alongBores(part);
  const steps = (list: Element[], side: 'outer' | 'inner') =>
    list.slice(1).map((e, i) => between(list[i], e, side)).filter((p) => p !== undefined);
  const end = (at: string, e: Element | undefined, name: string): Place[] =>
    turned(e) ? [{ at, name, chamfer: true, fillet: false, undercut: false }] : [];
  const mouth = (side: 'left' | 'right') =>
    mouths(part).filter((m) => m.end === side)
      .flatMap(({ bore }) => end(`${side}|${bore.id}`, bore, `bore ${bore.id} at the ${side}`));
  return [
    ...end('left', outer[0], 'left end'), ...steps(outer, 'outer'), ...end('right', outer[outer.length - 1], 'right end'),
    ...mouth('left'), ...steps(bores, 'inner'), ...mouth('right'),
  ];
}

type Key = 'chamfer_mm' | 'angle_deg' | 'undercut' | 'fillet_mm';
const holder = (key: Key) => (key === 'angle_deg' ? 'chamfer_mm' : key);

const turnedRound = (at: string) => at.split('|').reverse().join('|');

/** Where in the document's list a corner's chamfer, undercut or fillet stands; -1: nowhere. */
export const edgeIndex = (part: Part, at: string, key: Key): number =>
  (Array.isArray(part.edges) ? part.edges : []).findIndex((e: Element) => [at, turnedRound(at)].includes(e?.at) && holder(key) in e);

/** The document with a chamfer, an undercut or a fillet there; undefined takes it away. */
export function withEdge(part: Part, at: string, key: Key, value: unknown): Part {
  const list: Element[] = Array.isArray(part.edges) ? part.edges : [];
  const index = edgeIndex(part, at, key);
  if (index < 0) return value === undefined || key === 'angle_deg' ? part : { ...part, edges: [...list, { at, [key]: value }] };
  if (value === undefined && key !== 'angle_deg') return { ...part, edges: list.toSpliced(index, 1) };
  const entry = { ...list[index], [key]: value };
  if (value === undefined) delete entry[key];
  return { ...part, edges: list.with(index, entry) };
}
