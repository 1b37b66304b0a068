// The contour of a part as polylines of [z, r] in mm: what a drawing shows as thick lines.
import { undercutOf, type Undercut } from '../edges';
import type { Drawing, Surface } from '../types';

export type Point = [z: number, r: number];

const chords = 12;
const drillPoint = Math.tan((59 * Math.PI) / 180);
const same_mm = 1e-6;

/** Of the pitch: what a thread's minor diameter is less, 2 (5/8) H of turnwright/part/cut.hpp. */
const threadDeep = 1.0825;
export const minor = (e: Surface): number => Math.max(0.2, e.diameters_mm[0] - threadDeep * (e.pitch_mm ?? 0));

/** Radii at both ends; an inner thread is a bore of its minor diameter. */
export function radii(e: Surface): [number, number] {
  if (e.kind === 'thread' && e.side === 'inner') return [minor(e) / 2, minor(e) / 2];
  return [e.diameters_mm[0] / 2, e.diameters_mm[1] / 2];
}

const arc = (centre: Point, radius: number, from: number, to: number, count = chords): Point[] =>
  Array.from({ length: count + 1 }, (_, k) => {
    const a = from + ((to - from) * k) / count;
    return [centre[0] + radius * Math.cos(a), centre[1] + radius * Math.sin(a)];
  });

/** An undercut from the shoulder inwards: (1) and (2) of turnwright/part/drawing.hpp. */
function undercut({ radius, depth, width, recess, falls, leans: a }: Undercut): Point[] {
  const height = a > 0 ? radius * (1 + Math.sin(a)) + (recess - radius * (1 - Math.cos(a))) / Math.tan(a) : radius;
  const centre = radius - recess;
  return [
    [0, height - depth], ...arc([centre, radius - depth], radius, Math.PI - a, 1.5 * Math.PI, 6),
    [Math.max(centre, width - depth / Math.tan(falls)), -depth], [width, 0],
  ];
}

/** The end of a surface, from the end inwards: distance from the end, radius above its own. */
function end(e: Surface, side: 'left' | 'right'): Point[] {
  const out = e.side === 'outer' ? 1 : -1;
  const chamfer = e[`${side}_chamfer_mm`], R = e[`${side}_radius_mm`], f = e[`${side}_fillet_mm`], u = undercutOf(e[`${side}_undercut`], e.pitch_mm);
  if (chamfer) return [[0, -out * chamfer[1]], [chamfer[0], 0]];
  if (R) return arc([R, -R], R, Math.PI, 0.5 * Math.PI, 6).map(([z, r]) => [z, out * r]);
  if (u) return undercut(u);
  if (f) return arc([f, f], f, Math.PI, 1.5 * Math.PI, 6).map(([z, r]) => [z, out * r]);
  return [[0, 0]];
}

/** Inside an arc between its ends: points on its circle, bulging outwards if convex. */
function bulge(e: Surface, [z0, r0]: Point, [z1, r1]: Point): Point[] {
  const radius = e.radius_mm ?? 0, chord = Math.hypot(z1 - z0, r1 - r0);
  if (e.kind !== 'arc' || 2 * radius < chord) return [];
  const off = Math.sqrt(Math.max(0, radius * radius - (chord * chord) / 4)) * (e.convex === false ? 1 : -1);
  const centre: Point = [(z0 + z1) / 2 - (off * (r1 - r0)) / chord, (r0 + r1) / 2 + (off * (z1 - z0)) / chord];
  const from = Math.atan2(r0 - centre[1], z0 - centre[0]), to = Math.atan2(r1 - centre[1], z1 - centre[0]);
  const turn = Math.atan2(Math.sin(to - from), Math.cos(to - from));
  return arc(centre, radius, from, from + turn, 2 * chords).slice(1, -1);
}

/** The profile of a surface from its left to its right end, with chamfer, radius, fillet, undercut. */
export function profile(e: Surface): Point[] {
  const [z0, z1] = e.z_mm, [r0, r1] = radii(e);
  const left = end(e, 'left').map(([d, dr]): Point => [z0 + d, r0 + dr]);
  const right = end(e, 'right').map(([d, dr]): Point => [z1 - d, r1 + dr]).reverse();
  return [...left, ...bulge(e, left[left.length - 1], right[0]), ...right];
}

/** The outside of the stock from its left end to its right one. */
export function stockProfile(stock: Drawing['stock']): Point[] {
  const [from, to] = stock.z_mm, r = stock.outer_mm / 2;
  let z = from;
  return stock.outline?.flatMap((piece): Point[] => {
    const begins = z;
    z += piece.length_mm;
    return [[begins, piece.left_mm / 2], [z, piece.right_mm / 2]];
  }) ?? [[from, r], [to, r]];
}

/** Its radius there; at a step that of the larger side. */
export function stockRadius(stock: Drawing['stock'], z: number): number {
  const line = stockProfile(stock);
  let most = 0;
  for (let k = 0; k + 1 < line.length; ++k) {
    const [a, ra] = line[k], [b, rb] = line[k + 1];
    if (z < a - same_mm || z > b + same_mm) continue;
    most = Math.max(most, b > a ? ra + ((rb - ra) * (z - a)) / (b - a) : Math.max(ra, rb));
  }
  return most;
}

/** What a later setup cuts still is stock. */
export function asStock(e: Surface, stock: Drawing['stock']): Surface {
  const d = e.side === 'outer' ? 2 * stockRadius(stock, (e.z_mm[0] + e.z_mm[1]) / 2) : stock.inner_mm;
  return { id: e.id, side: e.side, kind: 'cylinder', z_mm: e.z_mm, diameters_mm: [d, d], setup: e.setup };
}

/** The edge of the hole along the whole part, from the left end: r = 0 where there is none. */
export function hole(drawing: Drawing, inner: Surface[]): Point[] {
  const through = drawing.stock.inner_mm / 2;
  const bores = inner.filter((e) => radii(e)[0] > 0 || radii(e)[1] > 0).sort((a, b) => a.z_mm[0] - b.z_mm[0]);
  const line: Point[] = [];
  let z = 0;
  const bridge = (to: number, before?: Surface, behind?: Surface) => {
    if (to - z <= same_mm) return;
    const tip = (e: Surface | undefined, r: number) => (e && through === 0 ? Math.min(r / drillPoint, (to - z) / 2) : 0);
    const fromLeft = tip(before, before ? radii(before)[1] : 0), fromRight = tip(behind, behind ? radii(behind)[0] : 0);
    line.push([z + fromLeft, through], [to - fromRight, through]);
  };
  bores.forEach((e, i) => {
    bridge(e.z_mm[0], bores[i - 1], e);
    line.push(...profile(e));
    z = e.z_mm[1];
  });
  bridge(drawing.length_mm, bores[bores.length - 1]);
  return line;
}

/** Circles that are seen from the side as straight lines: edges of steps and of chamfers. */
export function rings(surfaces: Surface[]): Point[] {
  const all: Point[] = [];
  const widest = surfaces[0]?.side === 'inner' ? Math.min : Math.max;
  surfaces.forEach((e, i) => {
    const own = profile(e), before = i > 0 ? profile(surfaces[i - 1]) : undefined;
    const joint = before && Math.abs(surfaces[i - 1].z_mm[1] - e.z_mm[0]) < same_mm ? before[before.length - 1][1] : undefined;
    const step = joint === undefined || Math.abs(joint - own[0][1]) > same_mm;
    const thread = e.kind === 'thread' || surfaces[i - 1]?.kind === 'thread';
    if (step || thread) all.push([e.z_mm[0], joint === undefined ? own[0][1] : widest(joint, own[0][1])]);
    if (e.left_chamfer_mm) all.push(own[1]);
    if (e.right_chamfer_mm) all.push(own[own.length - 2]);
    const behind = surfaces[i + 1];
    if (!behind || Math.abs(behind.z_mm[0] - e.z_mm[1]) > same_mm) all.push([e.z_mm[1], own[own.length - 1][1]]);
  });
  return all;
}
