// Edges and inner corners of a part: where a chamfer, a radius, an undercut or a fillet may stand.
import { alongBores, ends, entries, isThrough, mouths, type Element } from './elements';
import { t } from './language';
import type { Part } from './types';

/** recess: how deep it goes into the shoulder; falls: the slope's angle, leans: that of the way back to the shoulder. */
export interface Undercut { radius: number; depth: number; width: number; recess: number; falls: number; leans: number }
const rad = (deg: number) => (deg * Math.PI) / 180;
const ofE = [
  [0.2, 0.1, 1, 0.1], [0.4, 0.2, 2, 0.1], [0.6, 0.2, 2, 0.1], [0.6, 0.3, 2.5, 0.2], [0.8, 0.3, 2.5, 0.2], [1, 0.2, 2.5, 0.1],
  [1, 0.4, 4, 0.3], [1.2, 0.2, 2.5, 0.1], [1.2, 0.4, 4, 0.3], [1.6, 0.3, 4, 0.2], [2.5, 0.4, 5, 0.3], [4, 0.5, 7, 0.3],
];
const forms: { form: string; rows: number[][]; falls: number; leans: number }[] = [
  { form: 'E', rows: ofE.map((row) => [...row.slice(0, 3), 0]), falls: 15, leans: 0 },
  { form: 'F', rows: ofE, falls: 15, leans: 8 },
  { form: 'G', rows: [[0.4, 0.2, 0.9, 0.2]], falls: 17.5, leans: 17.5 },
  { form: 'H', rows: [[0.8, 0.3, 2, 0.05], [1.2, 0.3, 2.43, 0.05]], falls: 15, leans: 15 },
];
/** DIN 509 by form, radius and depth, as the planner knows them: src/part/drawing.cpp. */
export const undercuts: Record<string, Undercut> = Object.fromEntries(
  forms.flatMap(({ form, rows, falls, leans }) => rows.map(([radius, depth, width, recess]) =>
    [`${form}${radius}x${depth}`, { radius, depth, width, recess, falls: rad(falls), leans: rad(leans) }])),
);
/** DIN 76 behind a thread: pitch, d - dg, width of the forms A and B, radius. */
const threadUndercuts = [
  [0.5, 0.8, 1.75, 1.25, 0.2], [0.6, 1, 2.1, 1.5, 0.4], [0.7, 1.1, 2.45, 1.75, 0.4], [0.75, 1.2, 2.6, 1.9, 0.4],
  [0.8, 1.3, 2.8, 2, 0.4], [1, 1.6, 3.5, 2.5, 0.6], [1.25, 2, 4.4, 3.2, 0.6], [1.5, 2.3, 5.2, 3.8, 0.8],
  [1.75, 2.6, 6.1, 4.3, 1], [2, 3, 7, 5, 1], [2.5, 3.6, 8.7, 6.3, 1.2], [3, 4.4, 10.5, 7.5, 1.6], [3.5, 5, 12, 9, 1.6],
  [4, 5.7, 14, 10, 2], [4.5, 6.4, 16, 11, 2], [5, 7, 17.5, 12.5, 2.5], [5.5, 7.7, 19, 14, 3.2], [6, 8.3, 21, 15, 3.2],
];
export const threadForms = ['DIN 76-A', 'DIN 76-B'];
/** The undercut of a designation, of DIN 76 by the pitch of its thread. */
export function undercutOf(designation = '', pitch = 0): Undercut | undefined {
  const form = threadForms.indexOf(designation);
  if (form < 0) return undercuts[designation];
  const row = threadUndercuts.find(([p]) => Math.abs(p - pitch) < 1e-9);
  return row && { radius: row[4], depth: row[1] / 2, width: row[2 + form], recess: 0, falls: rad(30), leans: 0 };
}
export const usualUndercut = 'E0.8x0.3';

export interface Place {
  at: string;
  name: string;
  /** What may stand there: an edge has chamfers; the foot of a wall fillets and, outside, undercuts. */
  chamfer: boolean;
  /** Of a cylinder's edge, which may be rounded instead. */
  radius: boolean;
  fillet: boolean;
  undercut: boolean;
  /** At the foot of a thread, whose undercuts are those of DIN 76. */
  thread?: boolean;
}

const turned = (e: Element | undefined) => ['cylinder', 'thread', 'hole', 'as-stock'].includes(String(e?.kind));
const round = (e: Element) => ['cylinder', 'as-stock'].includes(String(e.kind));
const is = (kind: string, ...all: Element[]) => all.some((e) => e.kind === kind);

function between(a: Element, b: Element, side: 'outer' | 'inner'): Place | undefined {
  const [left, right] = [ends(a)[1], ends(b)[0]];
  if (is('arc', a, b) || left === right) return undefined;
  const stands = left > right === (side === 'outer') ? a : b, groove = is('groove', a, b);
  return {
    at: `${a.id}|${b.id}`, name: t("{} to {}", a.id, b.id), chamfer: turned(stands), radius: round(stands) && !groove, fillet: !groove,
    undercut: side === 'outer' && !groove, thread: (stands === a ? b : a).kind === 'thread',
  };
}

/** The edges of a part from left to right, then those of its bores. */
export function edgePlaces(part: Part): Place[] {
  const outer = entries(part, 'outer'), bores = alongBores(part);
  const apart = (a: Element, b: Element) => a.from !== b.from && !isThrough(part);
  const steps = (list: Element[], side: 'outer' | 'inner') =>
    list.slice(1).map((e, i) => (apart(list[i], e) ? undefined : between(list[i], e, side))).filter((p) => p !== undefined);
  const end = (at: string, e: Element | undefined, name: string): Place[] =>
    turned(e) ? [{ at, name, chamfer: true, radius: round(e!), fillet: false, undercut: false }] : [];
  const mouth = (side: 'left' | 'right') =>
    mouths(part).filter((m) => m.end === side)
      .flatMap(({ bore }) => end(`${side}|${bore.id}`, bore, side === 'left' ? t("bore {} at the left", bore.id) : t("bore {} at the right", bore.id)));
  return [
    ...end('left', outer[0], t("left end")), ...steps(outer, 'outer'), ...end('right', outer[outer.length - 1], t("right end")),
    ...mouth('left'), ...steps(bores, 'inner'), ...mouth('right'),
  ];
}

export type Key = 'chamfer_mm' | 'angle_deg' | 'radius_mm' | 'undercut' | 'fillet_mm';
/** What an entry of the document's list makes of a corner. */
export const shapes: Key[] = ['chamfer_mm', 'radius_mm', 'undercut', 'fillet_mm'];
const holder = (key: Key) => (key === 'angle_deg' ? 'chamfer_mm' : key);

const turnedRound = (at: string) => at.split('|').reverse().join('|');

/** Where in the document's list a corner's chamfer, radius, undercut or fillet stands; -1: nowhere. */
export const edgeIndex = (part: Part, at: string, key: Key): number =>
  (Array.isArray(part.edges) ? part.edges : []).findIndex((e: Element) => [at, turnedRound(at)].includes(e?.at) && holder(key) in e);

/** The document with a chamfer, a radius, an undercut or a fillet there; undefined takes it away. */
export function withEdge(part: Part, at: string, key: Key, value: unknown): Part {
  const list: Element[] = Array.isArray(part.edges) ? part.edges : [];
  const index = edgeIndex(part, at, key);
  if (index < 0) return value === undefined || key === 'angle_deg' ? part : { ...part, edges: [...list, { at, [key]: value }] };
  if (value === undefined && key !== 'angle_deg') return { ...part, edges: list.toSpliced(index, 1) };
  const entry = { ...list[index], [key]: value };
  if (value === undefined) delete entry[key];
  return { ...part, edges: list.with(index, entry) };
}
