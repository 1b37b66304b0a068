// From the part's mm to the drawing's px.
import { path } from '../scale';
import type { Drawing } from '../types';
import type { Point } from './contour';

export interface Frame {
  /** px per mm */
  scale: number;
  /** y of the axis, and of the highest and the lowest place that the stock reaches */
  axis: number;
  top: number;
  bottom: number;
  x: (z: number) => number;
  y: (r: number) => number;
  /** A polyline of [z, r] on one side of the axis. */
  line: (points: Point[], side?: 1 | -1) => string;
}

/** The scale at which the stock fits the width and the height. */
export function scaleOf(drawing: Drawing, width: number, beside: number, highest: number): number {
  const [a, b] = drawing.stock.z_mm;
  return Math.min(Math.max(120, width - 2 * beside) / Math.max(b - a, 1e-3), highest / Math.max(drawing.stock.outer_mm, 1e-3));
}

/** The middle of the stock is that of the width; `above` px are left for texts. */
export function frameOf(drawing: Drawing, width: number, scale: number, above: number): Frame {
  const [a, b] = drawing.stock.z_mm;
  const left = (width - scale * (b - a)) / 2 - scale * a;
  const half = (scale * drawing.stock.outer_mm) / 2, axis = above + half;
  const x = (z: number) => left + scale * z, y = (r: number) => axis - scale * r;
  const line = (points: Point[], side: 1 | -1 = 1) => path(points.map(([z, r]): Point => [x(z), y(side * r)]));
  return { scale, axis, top: axis - half, bottom: axis + half, x, y, line };
}
