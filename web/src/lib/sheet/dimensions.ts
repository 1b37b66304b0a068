// Where dimension lines and their texts stand, so that none runs over another. Lengths in px.

/** Width of a text of 11 px, a little too much rather than too little. */
export const textWidth = (text: string): number => 6.4 * text.length + 4;

const arrow = 8, gap = 3;
const lane = 10; // between texts of a row, for lines of higher rows to pass

/** A length to be dimensioned: where it begins and ends, and its text. */
export interface Span {
  from: number;
  to: number;
  text: string;
  id: string;
}

export interface LaidSpan extends Span {
  row: number;
  /** The middle of the text. */
  at: number;
  /** Arrows stand inside the length and point outwards, or the other way round. */
  inside: boolean;
}

interface Box {
  from: number;
  to: number;
}
const apart = (a: Box, b: Box) => a.to <= b.from + 0.5 || b.to <= a.from + 0.5;

/** Whole room of a dimension: its line, arrows outside and a text beside them. */
function room(s: Span, width: number): { box: Box; at: number; inside: boolean } {
  const w = textWidth(s.text), long = s.to - s.from;
  if (long >= w + 2 * arrow) return { box: s, at: (s.from + s.to) / 2, inside: true };
  const right = s.to + arrow + gap + w <= width;
  const at = right ? s.to + arrow + gap + w / 2 : s.from - arrow - gap - w / 2;
  const box = right ? { from: s.from - arrow, to: at + w / 2 } : { from: at - w / 2, to: s.to + arrow };
  return { box, at, inside: false };
}

/** Rows for lengths: the shorter the nearer to the part, none over another. */
export function lengthRows(spans: Span[], width: number): LaidSpan[] {
  const rows: Box[][] = [];
  return [...spans]
    .sort((a, b) => a.to - a.from - (b.to - b.from) || a.from - b.from)
    .map((s) => {
      const { box, at, inside } = room(s, width);
      const whole = rows.length;
      let row = rows.findIndex((boxes) => boxes.every((b) => apart(b, box)));
      if (row < 0) row = whole;
      (rows[row] ??= []).push(box);
      return { ...s, row, at, inside };
    });
}

/** A text above the part with a line down to what it names. */
export interface Callout {
  /** Where its line may stand, the best place first. */
  xs: number[];
  text: string;
  id: string;
  /** Callouts of a smaller rank find their place first. */
  rank: number;
}

export interface LaidCallout {
  x: number;
  /** 0 is nearest to the part. */
  row: number;
  from: number;
  to: number;
}

/** Where a text of a width may stand to its line: over it, right of it, left of it. */
const besides = [0.5, 0.08, 0.92];

function firstFree(xs: number[], w: number, width: number, most: number, free: (c: LaidCallout) => boolean) {
  for (let row = 0; row < most; ++row)
    for (const x of xs.filter((px) => px > gap && px < width - gap))
      for (const part of besides) {
        const from = Math.min(Math.max(x - part * w, 0), width - w);
        const place = { x, row, from, to: from + w };
        if (free(place)) return place;
      }
  return undefined;
}

/**
 * Rows for callouts: no text over another, no line through a text of a lower row. One that
 * finds no place in `most` rows is left out.
 */
export function calloutRows<T extends Callout>(all: T[], width: number, most: number): (T & LaidCallout)[] {
  const laid: (T & LaidCallout)[] = [];
  const free = ({ x, row, from, to }: LaidCallout) => laid.every((other) => {
    if (Math.abs(other.x - x) < gap) return false;
    if (other.row === row) return apart(other, { from: from - lane, to: to + lane });
    return other.row < row ? x < other.from - gap || x > other.to + gap : other.x < from - gap || other.x > to + gap;
  });
  for (const c of [...all].sort((a, b) => a.rank - b.rank || a.xs[0] - b.xs[0])) {
    const w = textWidth(c.text);
    const place = w <= width ? firstFree(c.xs, w, width, most, free) : undefined;
    if (place) laid.push({ ...c, ...place });
  }
  return laid;
}
