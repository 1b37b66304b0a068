// Edits of a part's contour. Every edit gives a new document and names what it had to take
// away: edges, faces, tolerances and milled places are written by the names of elements.
import { t } from './language';
import type { Part } from './types';
import { words } from './words';

export type Side = 'outer' | 'inner';
export type Kind = 'cylinder' | 'cone' | 'arc' | 'groove' | 'thread' | 'hole' | 'as-stock';

/** An entry of `outer` or `inner`; what the planner has written may be anything. */
// eslint-disable-next-line @typescript-eslint/no-explicit-any
export type Element = Record<string, any>;

export interface Edit {
  part: Part;
  /** What named places that are no more, in words. */
  lost: string[];
}

export const kinds: Record<Side, Kind[]> = {
  outer: ['cylinder', 'cone', 'arc', 'groove', 'thread', 'as-stock'],
  inner: ['cylinder', 'cone', 'groove', 'thread', 'hole'],
};

/** Across the flats of a bar over the circle through its corners. */
const flat: Record<string, number> = { hexagon: Math.cos(Math.PI / 6), square: Math.cos(Math.PI / 4) };

/** The outer diameter of a part's stock, through the corners of one that has them. */
export function outerOfStock(part: Part): number | undefined {
  const s = part.stock, size = flat[s?.kind] ? s.across_flats_mm / flat[s.kind] : (s?.diameter_mm ?? s?.outer_mm);
  return Number.isFinite(size) ? size : undefined;
}

/** The entries of a list of the document; none where it is something else. What stays as the stock is has its diameter. */
export const entries = (part: Part, name: string): Element[] =>
  (Array.isArray(part[name]) ? part[name].filter((e) => e !== null && typeof e === 'object') : [])
    .map((e: Element) => (name === 'outer' && e.kind === 'as-stock' ? { ...e, diameter_mm: outerOfStock(part) } : e));

/** Names that are taken, by elements and by what is milled into them. */
const taken = (part: Part) =>
  new Set(['outer', 'inner', 'milling', 'tolerances'].flatMap((l) => entries(part, l).map((e) => e.id)));

/** The first of d1, d2, .. that nothing is called yet. */
export function freshId(part: Part, letter: string): string {
  const ids = taken(part);
  let n = 1;
  while (ids.has(`${letter}${n}`)) ++n;
  return `${letter}${n}`;
}

/** Diameter of a metric or inch thread, "M24x1.5", "1/2-13 UNC", "#10-24"; NaN of other texts. */
function threadDiameter(designation: string): number {
  const metric = /^M([\d.]+)/.exec(designation);
  if (metric) return Number(metric[1]);
  const m = /^(?:#(\d+)|(?:(\d+)[- ])?(\d+)\/(\d+)|(\d*\.?\d+))-\d*\.?\d+/.exec(designation);
  if (!m) return NaN;
  const [number, whole, over, under, decimal] = m.slice(1).map((digits) => (digits === undefined ? undefined : Number(digits)));
  const inch = number !== undefined ? 0.06 + 0.013 * number : decimal ?? (whole ?? 0) + over! / under!;
  return Number((25.4 * inch).toFixed(6));
}

/** Diameters at the left and the right end; NaN where the document has none. */
export function ends(e: Element | undefined): [number, number] {
  const number = (value: unknown) => (typeof value === 'number' ? value : NaN);
  if (typeof e?.designation === 'string') {
    const d = threadDiameter(e.designation);
    return [d, d];
  }
  if (e && ('left_mm' in e || 'right_mm' in e)) return [number(e.left_mm), number(e.right_mm)];
  return [number(e?.diameter_mm), number(e?.diameter_mm)];
}

/** Bores in their order along the part, not in that of the list. */
export const alongBores = (part: Part): Element[] => {
  const bores = entries(part, 'inner');
  const from = (end: string) => bores.filter((e) => e.from === end);
  return [...from('left'), ...from('right').reverse()];
};

const lengthOf = (list: Element[]) => list.reduce((total, e) => total + Number(e.length_mm), 0);

/** Whether the bores of both ends meet. */
export const isThrough = (part: Part): boolean =>
  Math.abs(lengthOf(alongBores(part)) - lengthOf(entries(part, 'outer'))) < 1e-6;

/** Where bores open: the first of an end, or those of the other end where they go through. */
export function mouths(part: Part): { end: 'left' | 'right'; bore: Element }[] {
  const bores = alongBores(part), through = isThrough(part);
  return (['left', 'right'] as const).flatMap((end) => {
    const bore = end === 'left' ? bores[0] : bores[bores.length - 1];
    return bore && (through || bore.from === end) ? [{ end, bore }] : [];
  });
}

const pairs = (list: Element[]) => list.slice(1).map((e, i) => `${list[i].id}|${e.id}`);

/** Every name by which a document may speak of an element, an edge or a face. */
export function places(part: Part): Set<string> {
  const outer = entries(part, 'outer'), inner = entries(part, 'inner');
  return new Set([
    'left', 'right',
    ...[...outer, ...inner].map((e) => String(e.id)),
    ...pairs(outer), ...pairs(alongBores(part)), ...pairs(alongBores(part).reverse()),
    ...mouths(part).map(({ end, bore }) => `${end}|${bore.id}`),
  ]);
}

/** What is asked for at a place, in words: "chamfer d1|d2". */
const edgeName = (e: Element) =>
  `${'chamfer_mm' in e ? t("chamfer") : 'radius_mm' in e ? t("radius") : 'undercut' in e ? t("undercut") : t("fillet")} ${e.at}`;

/**
 * Lets a list of the document follow a change of names. An entry goes when `place` tells
 * that something it named is no more; other lists and their unknown members stay.
 */
function follow(
  part: Part, list: string, keys: string[], place: (name: string) => string | undefined,
  name: (e: Element) => string, lost: string[],
): Part {
  if (!Array.isArray(part[list])) return part;
  const kept = part[list].flatMap((entry: Element) => {
    if (entry === null || typeof entry !== 'object') return [entry];
    const next = { ...entry };
    for (const key of keys) {
      if (next[key] === undefined) continue;
      const named = [next[key]].flat().map((n) => place(String(n)));
      if (named.includes(undefined)) {
        lost.push(name(entry));
        return [];
      }
      next[key] = Array.isArray(next[key]) ? named : named[0];
    }
    return [next];
  });
  return { ...part, [list]: kept };
}

/** The document after an edit of its elements, with everything that named them. */
function settled(before: Part, after: Part, renamed: (name: string) => string = (n) => n): Edit {
  const were = places(before), are = places(after);
  const lost: string[] = [];
  const place = (name: string) => {
    const next = renamed(name);
    return were.has(name) && !are.has(next) ? undefined : next;
  };
  let part = after;
  part = follow(part, 'edges', ['at'], place, edgeName, lost);
  part = follow(part, 'faces', ['id'], place, (e) => t("roughness of {}", e.id), lost);
  part = follow(part, 'tolerances', ['of', 'datum', 'between'], place, (e) => t("tolerance {}", e.id), lost);
  part = follow(part, 'milling', ['on'], place, (e) => `${words(e.kind)} ${e.id ?? ''}`.trim(), lost);
  part = follow(part, 'operations', ['on'], place, (e) => t("operation {}", e.id), lost);
  return { part, lost };
}

const shapes = ['diameter_mm', 'left_mm', 'right_mm', 'radius_mm', 'bulge', 'pitch_mm', 'designation'];
const grooveDeep_mm = 1.5, grooveWide_mm = 3, finePitch_mm = 1.5;

/** The members that give a kind its shape between two diameters. */
function shape(kind: Kind, side: Side, [left, right]: [number, number], length: number): Element {
  const mean = Number(((left + right) / 2).toFixed(3));
  switch (kind) {
    case 'as-stock': return {};
    case 'cylinder': return { diameter_mm: left };
    case 'hole': return { diameter_mm: Math.round(mean) };
    case 'cone': return { left_mm: left, right_mm: left === right ? left + (side === 'outer' ? 4 : -2) : right };
    case 'arc': return { left_mm: left, right_mm: right, radius_mm: Math.max(length, Math.abs(left - right)) };
    case 'groove': return { diameter_mm: Math.max(1, left + (side === 'outer' ? -2 : 2) * grooveDeep_mm) };
    case 'thread': return { diameter_mm: Math.round(mean), pitch_mm: finePitch_mm };
  }
}

/** Whether turning may leave an allowance on an element that is ground. */
export const grindable = (e: Element): boolean => ['cylinder', 'cone'].includes(String(e.kind));

/** Whether a wheel may knurl an element. */
export const knurlable = (e: Element, side: Side): boolean => side === 'outer' && e.kind === 'cylinder';
/** Types and pitches of DIN 82. */
export const knurls: string[] = ['RAA', 'RBL', 'RBR', 'RGE', 'RGV', 'RKE', 'RKV']
  .flatMap((type) => [0.5, 0.6, 0.8, 1, 1.2, 1.6].map((pitch) => `${type}${pitch}`));

/** What stays of an element as another kind: a class of ISO 286 where both have one. */
function stays(key: string, from: Element, kind: Kind): boolean {
  if (kind === 'as-stock') return ['id', 'length_mm'].includes(key);
  if (key === 'knurl') return kind === 'cylinder';
  if (key === 'fit') return [from.kind, kind].every((k) => ['cylinder', 'hole'].includes(String(k)));
  return !shapes.includes(key) && (key !== 'grinding_allowance_mm' || grindable({ kind }));
}

/** The same element as another kind; what only its old kind has is left out. */
export function reshaped(part: Part, side: Side, index: number, kind: Kind): Part {
  const list = [...(part[side] as Element[])];
  const e = entries({ ...part, [side]: [list[index]] }, side)[0];
  const rest = Object.fromEntries(Object.entries(e).filter(([key]) => stays(key, e, kind)));
  const known = ends(e).map((d) => (Number.isFinite(d) ? d : 20)) as [number, number];
  list[index] = { ...rest, kind, ...shape(kind, side, known, Number(e.length_mm) || 10) };
  return { ...part, [side]: list };
}

/** A thread with its size as it is typed: a diameter, or in its place a designation, "M24x1.5" or "1/2-13 UNC". */
export function threaded(part: Part, side: Side, index: number, size: unknown): Part {
  const { designation: _, diameter_mm: __, pitch_mm, ...rest } = (part[side] as Element[])[index];
  const d = Number(String(size).replace(',', '.'));
  const written = size === undefined ? {} : Number.isFinite(d) ? { diameter_mm: d } : { designation: String(size) };
  const next = { ...rest, ...written, ...(!('designation' in written) && pitch_mm !== undefined && { pitch_mm }) };
  return { ...part, [side]: (part[side] as Element[]).with(index, next) };
}

/** What is inserted where nothing is known: as wide as its neighbour. */
function fresh(part: Part, side: Side, index: number, kind: Kind, from?: 'left' | 'right'): Element {
  const list = entries(part, side);
  const beside = list[index - 1] ?? list[index];
  const end = beside ? ends(beside)[list[index - 1] ? 1 : 0] : NaN;
  const thinnest = Math.min(...entries(part, 'outer').flatMap(ends).filter(Number.isFinite));
  const usual = side === 'outer' ? 30 : Number.isFinite(thinnest) ? Math.max(1, Math.round(thinnest / 2)) : 20;
  const d = Number.isFinite(end) ? end : usual;
  const length = kind === 'groove' ? grooveWide_mm : 20;
  return {
    id: freshId(part, side === 'outer' ? 'd' : 'b'), kind,
    ...(side === 'inner' && { from: from ?? beside?.from ?? 'right' }),
    length_mm: length, ...shape(kind, side, [d, d], length),
  };
}

/**
 * A new element before the one at `index`. Where a step was it stays: its chamfer, its
 * undercut and its face now belong to the new element and the one behind it.
 */
export function inserted(part: Part, side: Side, index: number, kind: Kind, from?: 'left' | 'right'): Edit & { id: string } {
  const list = Array.isArray(part[side]) ? part[side] : [];
  const element = fresh(part, side, index, kind, from);
  const before = list[index - 1], behind = list[index];
  const next = { ...part, [side]: list.toSpliced(index, 0, element) };
  const stands = side === 'outer' && before && behind && ends(before)[1] === ends(element)[0];
  const step = `${before?.id}|${behind?.id}`;
  const edit = settled(part, next, (name) => (stands && name === step ? `${element.id}|${behind.id}` : name));
  return { ...edit, id: element.id };
}

export function removed(part: Part, side: Side, index: number): Edit {
  return settled(part, { ...part, [side]: part[side].toSpliced(index, 1) });
}

/** The element one place on (by = 1) or back (-1) in its list. */
export function moved(part: Part, side: Side, index: number, by: 1 | -1): Edit {
  const list = [...part[side]];
  if (index + by < 0 || index + by >= list.length) return { part, lost: [] };
  [list[index], list[index + by]] = [list[index + by], list[index]];
  return settled(part, { ...part, [side]: list });
}

/** Another name of an element, wherever it is named. */
export function renamed(part: Part, side: Side, index: number, id: string): Part {
  const old = String(part[side][index]?.id);
  const list = part[side].map((e: Element, i: number) => (i === index ? { ...e, id } : e));
  const name = (place: string) => place.split('|').map((n) => (n === old ? id : n)).join('|');
  const twice = entries(part, side).filter((e) => e.id === old).length > 1;
  return twice ? { ...part, [side]: list } : settled(part, { ...part, [side]: list }, name).part;
}
