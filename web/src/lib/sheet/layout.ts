// What is dimensioned on a drawing, and where its lines and texts stand.
import { entries } from '../elements';
import { t } from '../language';
import { significant } from '../numbers';
import type { Drawing, DrawnTolerance, Part, Surface } from '../types';
import { profile, radii } from './contour';
import { calloutRows, lengthRows, type Callout, type LaidCallout, type LaidSpan, type Span } from './dimensions';
import { datumLetters, lengthText, milledShapes, sizeText } from './features';

/** A callout with where its line ends, as radii: at the named surface, and across the axis. */
export interface Note extends Callout {
  kind: 'diameter' | 'bore' | 'leader' | 'frame';
  /** Radius at which the line's arrow stands, and the one where it ends below. */
  r: number;
  until: number;
  /** Where the line ends if not below its text: it then goes aside first. */
  anchor?: number;
  /** Of a tolerance: its kind, width and the datum's letter. */
  frame?: { kind: string; value: string; datum: string };
}

export type LaidNote = Note & LaidCallout;

/** A note that does not know its px yet: places along the part instead, or one place. */
type Unplaced = Omit<Note, 'xs'> & ({ over: [number, number]; share: number } | { at: number; asides: number[] });

/** Places along a surface, the nearest to a share of its length first. */
const along = ([from, to]: [number, number], share: number) =>
  Array.from({ length: 39 }, (_, k) => (k + 1) / 40)
    .sort((a, b) => Math.abs(a - share) - Math.abs(b - share))
    .map((s) => from + s * (to - from));

/** Lines from an end go out of the part before they go up; others to either side. [px] */
const aside = [20, 32, 10, 46, 62, 80, 100];
const outwards = { left: aside.map((px) => -px), right: aside, '': [0, ...aside.flatMap((px) => [px, -px])] };

/** A size with the limits that the document itself gives; general ones stand in the title block. */
function ownSize(part: Part, drawing: Drawing, e: Surface): string {
  const { flats, across_flats_mm } = drawing.stock;
  if (e.kind === 'as-stock' && across_flats_mm) return flats === 6 ? t("hex {}", lengthText(across_flats_mm)) : t("sq {}", lengthText(across_flats_mm));
  const asked = entries(part, e.side).find((own) => own.id === e.id);
  return sizeText(asked?.limits_mm ? e : { ...e, limits_mm: undefined });
}

/** Share of the part's length below which a surface has little room for its text: it comes first. */
const narrow = 0.12;

/** Diameters stand nearer to the left of a surface, those of bores nearer to its right. */
function sizes(part: Part, drawing: Drawing): Unplaced[] {
  return drawing.elements.map((e) => {
    const straight = e.kind !== 'cone' && e.kind !== 'arc', outer = e.side === 'outer';
    const [a, b] = radii(e), r = straight ? a : (a + b) / 2;
    return {
      id: e.id, text: ownSize(part, drawing, e), rank: e.z_mm[1] - e.z_mm[0] < narrow * drawing.length_mm ? 0 : 1, r,
      ...(straight ? { over: e.z_mm, share: outer ? 0.3 : 0.72 } : { at: (e.z_mm[0] + e.z_mm[1]) / 2, asides: outwards[''] }),
      kind: outer && straight ? 'diameter' : outer ? 'leader' : 'bore', until: outer ? (straight ? -r : r) : -0.12 * r,
    };
  });
}

/** Chamfers, radii, undercuts, fillets: one line for all that stand at one place. */
function corners(drawing: Drawing): Unplaced[] {
  const all = new Map<string, Unplaced>();
  for (const e of drawing.elements)
    for (const side of ['left', 'right'] as const) {
      const text = cornerText(e, side);
      if (!text) continue;
      const p = profile(e), [[z0, r0], [z1, r1]] = side === 'left' ? p.slice(0, 2) : p.slice(-2);
      const end = e.z_mm[side === 'left' ? 0 : 1], r = (r0 + r1) / 2;
      const asides = outwards[end < 1e-6 ? 'left' : end > drawing.length_mm - 1e-6 ? 'right' : ''];
      const place = `${e.side}:${end.toFixed(4)}`, there = all.get(place);
      const note = { id: `corner:${place}`, text, rank: 3, at: (z0 + z1) / 2, asides, r, kind: 'leader' as const, until: r };
      all.set(place, there ? { ...(there.r > r ? there : note), text: `${there.text}, ${text}` } : note);
    }
  return [...all.values()];
}

function cornerText(e: Surface, side: 'left' | 'right'): string {
  const chamfer = e[`${side}_chamfer_mm`], undercut = e[`${side}_undercut`], fillet = e[`${side}_fillet_mm`];
  if (chamfer) return `${lengthText(chamfer[0])}×${Math.round((Math.atan2(chamfer[1], chamfer[0]) * 180) / Math.PI)}°`;
  const radius = e[`${side}_radius_mm`];
  if (radius) return `R${lengthText(radius)}`;
  return undercut ? undercut.replace('x', '×') : fillet ? `R${lengthText(fillet)} max` : '';
}

function milledNotes(part: Part, drawing: Drawing): Unplaced[] {
  return milledShapes(part, drawing).map((m) =>
    ({ id: m.id, text: m.text, rank: 2, over: m.z, share: 0.62, r: m.half, kind: 'leader' as const, until: m.half }));
}

/** Geometrical tolerances that the part asks for, as frames. */
function frames(part: Part, drawing: Drawing): Unplaced[] {
  const asked = drawnTolerances(part, drawing), letters = datumLetters(asked);
  return asked.filter((t) => t.of).flatMap((t): Unplaced[] => {
    const frame = { kind: t.kind, value: significant(t.value_mm), datum: t.datum ? letters.get(t.datum)! : '' };
    const e = drawing.elements.find((s) => s.id === t.of), f = drawing.faces.find((s) => s.id === t.of);
    if (!e && !f) return [];
    const z = e ? (e.z_mm[0] + e.z_mm[1]) / 2 : f!.z_mm;
    const place = e ? { over: e.z_mm, share: 0.55 } : { at: z, asides: outwards[''] };
    const beside = drawing.elements.filter((s) => s.side === 'outer' && s.z_mm[0] <= z + 1e-9 && s.z_mm[1] >= z - 1e-9);
    const r = e ? radii(e)[0] : Math.max(...beside.flatMap(radii)) * 0.94;
    return [{ id: t.id, text: `   ${frame.value}  ${frame.datum}`, rank: 2, ...place, r, kind: 'frame', until: r, frame }];
  });
}

/** Those of the document itself, without sizes and general tolerances. */
export const drawnTolerances = (part: Part, drawing: Drawing): DrawnTolerance[] => {
  const own = new Set((Array.isArray(part.tolerances) ? part.tolerances : []).map((t: { id?: string }) => t?.id));
  return drawing.tolerances.filter((t) => own.has(t.id) && t.kind !== 'length' && t.kind !== 'diameter');
};

/** Everything that is written above the part. */
export function notes(part: Part, drawing: Drawing, x: (z: number) => number, width: number): LaidNote[] {
  const most = width < 560 ? 3 : 6;
  const all = [...sizes(part, drawing), ...milledNotes(part, drawing), ...frames(part, drawing), ...corners(drawing)];
  const placed = all.map((n): Note => 'at' in n
    ? { ...n, anchor: x(n.at), xs: n.asides.map((px) => x(n.at) + px) }
    : { ...n, xs: along(n.over, n.share).map(x) });
  return calloutRows(placed, width, most);
}

const long_px = 140; // of a length that is shown in whatever row

/** Lengths of elements, depths of bores, lengths with limits of their own, the whole. */
export function lengths(drawing: Drawing, x: (z: number) => number, width: number): LaidSpan[] {
  const span = (from: number, to: number, id: string, limits?: [number, number]): Span =>
    ({ from: x(from), to: x(to), text: lengthText(to - from, limits), id });
  const L = drawing.length_mm;
  const limited = drawing.tolerances.filter((t) => t.kind === 'length' && t.limits_mm && t.between && !t.id.includes(':'));
  const z = (id: string) => drawing.faces.find((f) => f.id === id)?.z_mm;
  const toleranced = limited.flatMap((t) => {
    const [a, b] = t.between!.map(z);
    return a === undefined || b === undefined ? [] : [span(Math.min(a, b), Math.max(a, b), t.id, t.limits_mm)];
  });
  const outer = drawing.elements.filter((e) => e.side === 'outer');
  const bores = drawing.elements.filter((e) => e.side === 'inner');
  const steps = outer.length > 1 ? outer.map((e) => span(...e.z_mm, e.id)) : [];
  const depths = bores.flatMap((e) => {
    const right = bores.some((b) => b !== e && b.z_mm[0] >= e.z_mm[1] - 1e-9) || e.z_mm[1] > L - 1e-9;
    const [a, b] = e.kind === 'groove' ? e.z_mm : right ? [e.z_mm[0], L] : [0, e.z_mm[1]];
    return b - a < L - 1e-9 ? [span(a, b, `${e.id}:depth`)] : [];
  });
  const seen = new Set(toleranced.map((s) => `${s.from}:${s.to}`));
  const rest = [...steps, ...depths, span(0, L, 'length')].filter((s) => !seen.has(`${s.from}:${s.to}`) && seen.add(`${s.from}:${s.to}`));
  const most = width < 560 ? 4 : 8;
  return lengthRows([...toleranced, ...rest], width).filter((s) => s.row < most || s.to - s.from > long_px);
}
