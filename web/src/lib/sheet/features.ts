// What a drawing shows beside the contour: milled places, centre holes, texts of sizes.
import { centreOf, centres, centreText, type Centre } from '../centres';
import { entries, type Element } from '../elements';
import { t } from '../language';
import { significant, signed } from '../numbers';
import type { Drawing, DrawnTolerance, Part, Surface } from '../types';
import { words } from '../words';
import type { Point } from './contour';

export interface MilledShape {
  id: string;
  kind: 'keyway' | 'slot' | 'flat' | 'cross-hole';
  on: Surface;
  z: [number, number];
  /** Half of its width as seen from above, and whether its ends are round. */
  half: number;
  round: [boolean, boolean];
  text: string;
}

const finite = (...all: unknown[]) => all.every((x) => typeof x === 'number' && Number.isFinite(x) && x >= 0);
const ends_mm = 0.05; // a slot that comes so near to an end runs out there

const at = (deg?: number) => (deg ? ` ${t("at {}°", significant(deg))}` : '');

/** A cross hole, a circle as it is seen turned to the viewer. */
function crossHole(m: Element, on: Surface): MilledShape[] {
  if (!finite(m.at_mm, m.diameter_mm, ...('through' in m ? [] : [m.depth_mm]))) return [];
  const half = m.diameter_mm / 2, times = m.count > 1 ? `${m.count} × ` : '', turned = at(m.angle_deg);
  const goes = 'through' in m ? t("through {}", words(String(m.through))) : `× ${significant(m.depth_mm)}`;
  return [{
    id: String(m.id ?? m.kind), kind: m.kind, on, z: [m.at_mm - half, m.at_mm + half], half, round: [true, true],
    text: `${times}⌀${significant(m.diameter_mm)} ${goes}${turned}`,
  }];
}

/** Milled places that the document gives wholly, as they are seen turned to the viewer. */
export function milledShapes(part: Part, drawing: Drawing): MilledShape[] {
  return entries(part, 'milling').flatMap((m): MilledShape[] => {
    const on = drawing.elements.find((e) => e.id === m.on);
    if (m.kind === 'cross-hole') return on ? crossHole(m, on) : [];
    const flat = m.kind === 'flat';
    const R = on ? on.diameters_mm[0] / 2 : 0, depth = m.depth_mm ?? R - m.across_flats_mm / 2;
    if (!on || !finite(m.z_mm, m.length_mm, depth) || !(flat || finite(m.width_mm))) return [];
    const left = Math.max(0, R - depth), times = m.count > 1 ? `${m.count} × ` : '';
    const z: [number, number] = [m.z_mm, m.z_mm + m.length_mm];
    const size = [flat ? undefined : m.width_mm, depth, m.length_mm].filter((x) => x !== undefined);
    return [{
      id: String(m.id ?? m.kind), kind: m.kind, on, z, half: flat ? Math.sqrt(R * R - left * left) : m.width_mm / 2,
      round: flat ? [false, false] : [
        m.kind === 'keyway' || z[0] > on.z_mm[0] + ends_mm, m.kind === 'keyway' || z[1] < on.z_mm[1] - ends_mm],
      text: `${times}${words(m.kind)} ${size.map((x) => significant(x)).join('×')}${at(m.angle_deg)}`,
    }];
  });
}

/** Countersinks of centring tools: tools/fixed/DIN333-A.json. */
export const countersinks_mm = [1.06, 1.7, 2.12, 2.65, 3.35, 4.25, 5.3, 6.7, 8.5, 10.6, 13.2, 17, 21.2];
const share = 0.35; // of the end's diameter that a countersink may take
const pilot = 2.12; // countersink over hole, of the sizes above
const slope = Math.tan(Math.PI / 6);

/** As drawn: the cone of 60 deg, of form B within one of 120 deg; form R by its chord. */
function drawnCentre({ form, pilot: d, widest }: Centre): Point[] {
  const r = d / 2, R = widest / 2, cone = form === 'B' ? centres.find((c) => c.form === 'A' && c.pilot === d)!.widest / 2 : R;
  const mouth = (R - cone) * slope, seat = mouth + (cone - r) / slope;
  const protectedBy: Point[] = form === 'B' ? [[mouth, cone]] : [];
  return [[0, R], ...protectedBy, [seat, r], [seat + 1.25 * d, r], [seat + 1.25 * d + r * slope, 0]];
}

export interface CentreHole {
  end: 'left' | 'right';
  text: string;
  /** From the end inwards: distance, radius. */
  profile: Point[];
}

const centred: Record<string, ('held' | 'free')[]> = {
  'chuck-tailstock': ['free'], 'tailstock-follow': ['free'], 'between-centres': ['held', 'free'],
};

/**
 * Centre holes: those that the drawing asks for, and of the ends to which each clamping that a
 * setup may have brings a centre.  Hollow ends have none.
 */
export function centreHoles(drawing: Drawing, clampings: string[][]): CentreHole[] {
  const outer = drawing.elements.filter((e) => e.side === 'outer');
  const hollow = (z: number) => drawing.stock.inner_mm > 0 ||
    drawing.elements.some((e) => e.side === 'inner' && e.z_mm.some((end) => Math.abs(end - z) < 1e-6));
  const wanted = new Set(drawing.setups.flatMap((s, i) => (['held', 'free'] as const)
    .filter((which) => clampings[i]?.length && clampings[i].every((c) => centred[c]?.includes(which)))
    .map((which) => ((which === 'held') === (s.hold === 'left') ? 'left' as const : 'right' as const))));
  const asked = new Map(drawing.faces.flatMap((f) => {
    const centre = f.centre_hole && centreOf(f.centre_hole);
    return centre ? [[f.id, centre] as const] : [];
  }));
  return (['left', 'right'] as const).filter((end) => asked.has(end) || wanted.has(end)).flatMap((end): CentreHole[] => {
    const centre = asked.get(end);
    if (centre) return [{ end, text: centreText(centre), profile: drawnCentre(centre) }];
    const z = end === 'left' ? 0 : drawing.length_mm;
    const d = end === 'left' ? outer[0]?.diameters_mm[0] : outer[outer.length - 1]?.diameters_mm[1];
    const D = countersinks_mm.findLast((size) => size <= share * d);
    if (!D || hollow(z)) return [];
    const r = D / pilot / 2, cone = (D / 2 - r) / Math.tan(Math.PI / 6);
    return [{
      end, text: `A ⌀${significant(D, 4)}`,
      profile: [[0, D / 2], [cone, r], [Math.max(cone, D - r / Math.sqrt(3)), r], [Math.max(D, cone), 0]],
    }];
  });
}

/** A size as it stands on a drawing: "⌀30 k6", "M30×1.5", "⌀50 0/−0.1". */
export function sizeText(e: Surface): string {
  const [a, b] = e.diameters_mm.map((d) => significant(d, 6));
  const limits = e.limits_mm && !e.fit ? limitsText(e.limits_mm) : '';
  const fit = e.fit ?? limits;
  const size = e.kind === 'thread' ? `M${a}×${significant(e.pitch_mm)}` : a === b ? `⌀${a}` : `⌀${a}–⌀${b}`;
  return [size, fit, e.knurl && `DIN 82-${e.knurl}`].filter(Boolean).join(' ');
}

const limitsText = ([lower, upper]: [number, number]) =>
  lower === -upper ? `±${significant(upper)}` : `${signed(upper)}/${signed(lower)}`;

/** Of a length with limits: "70 ±0.05". */
export const lengthText = (mm: number, limits?: [number, number]): string =>
  significant(mm, 6) + (limits ? ` ${limitsText(limits)}` : '');

/** Letters of the datums, in the order in which tolerances name them. */
export function datumLetters(tolerances: DrawnTolerance[]): Map<string, string> {
  const names = [...new Set(tolerances.map((t) => t.datum).filter((d) => d !== undefined))];
  return new Map(names.map((name, i) => [name, String.fromCharCode(65 + (i % 26))]));
}
