// The members that each kind of tolerance has: schemas/part.json.
import type { Element } from './elements';

export const toleranceKinds = [
  'diameter', 'length', 'straightness', 'circularity', 'flatness', 'cylindricity', 'profile', 'parallelism',
  'perpendicularity', 'angularity', 'position', 'coaxiality', 'circular-radial-runout', 'circular-axial-runout',
  'total-radial-runout', 'total-axial-runout',
];
const sizes = ['diameter', 'length'];
const withoutDatum = ['straightness', 'circularity', 'flatness', 'cylindricity', 'profile-without-datum', ...sizes];

/** The same tolerance as another kind: its width, its limits and its places as far as that has them. */
export function reformed(t: Element, kind: string): Element {
  const { value_mm, limits_mm, of, between, datum, ...rest } = t;
  const width = value_mm ?? (Array.isArray(limits_mm) ? Number((limits_mm[1] - limits_mm[0]).toFixed(6)) : 0.02);
  const place = of ?? between?.[0] ?? 'left';
  return {
    ...rest, kind,
    ...(kind === 'length' ? { between: between ?? ['left', 'right'] } : { of: place }),
    ...(sizes.includes(kind) ? { limits_mm: limits_mm ?? [-width / 2, width / 2] } : { value_mm: width }),
    ...(datum !== undefined && !withoutDatum.includes(kind) && { datum }),
  };
}
