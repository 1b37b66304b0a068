// Numbers as people read them; the documents have them whole.

/** So many decimals; "-" for none. */
export function fixed(value: number | null | undefined, decimals: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const text = value.toFixed(decimals);
  return (/^-0\.?0*$/.test(text) ? text.slice(1) : text).replace('-', '−');
}

/** So many significant digits, without trailing zeros. */
export function significant(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  return String(Number(value.toPrecision(digits))).replace('-', '−');
}

const numbers = (value: number | [number, number]): number[] => [value].flat();

/** A length of mm, or a pair of them, in µm. */
export const micrometres = (mm: number | [number, number], decimals = 1): string =>
  numbers(mm)
    .map((x) => fixed(1000 * x, decimals))
    .join(' … ');

/** A deviation with its sign, in mm. */
export const signed = (mm: number): string =>
  mm === 0 ? '0' : (mm > 0 ? '+' : '−') + String(Number(Math.abs(mm).toFixed(4)));
