// Axes of the charts.

export type Scale = (value: number) => number;

export const linear =
  (from: number, to: number, a: number, b: number): Scale =>
  (x) =>
    a + ((b - a) * (x - from)) / (to - from || 1);

export const logarithmic = (from: number, to: number, a: number, b: number): Scale => {
  const inner = linear(Math.log(from), Math.log(to), a, b);
  return (x) => inner(Math.log(x));
};

/** The largest of 1, 2, 5, 10, .. that is not above the limit. */
export function roundBelow(limit: number): number {
  const power = 10 ** Math.floor(Math.log10(limit));
  return ([5, 2].find((digit) => digit * power <= limit * (1 + 1e-12)) ?? 1) * power;
}

/** Round values in the range, about `count` of them. */
export function ticks(from: number, to: number, count: number): number[] {
  const raw = (to - from) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((digit) => digit * power >= raw)! * power;
  const all: number[] = [];
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; ++k)
    all.push(Number((k * step).toPrecision(12)));
  return all;
}

/** 1, 2, 5, 10, .. in the range; round values where those are too few. */
export function logTicks(from: number, to: number): number[] {
  const all: number[] = [];
  for (let power = 10 ** Math.floor(Math.log10(from)); power <= to; power *= 10)
    for (const digit of [1, 2, 5]) {
      const value = Number((digit * power).toPrecision(12));
      if (value >= from && value <= to) all.push(value);
    }
  return all.length >= 3 ? all : ticks(from, to, 4);
}

export const path = (points: [number, number][]): string =>
  points.map(([x, y], i) => `${i ? 'L' : 'M'}${x.toFixed(2)},${y.toFixed(2)}`).join('');
