// A size's demand in one field: a fit like "k6", or limits like "+0.02/-0.01" and "±0.05".

const number = String.raw`[+\-−]?\d*[.,]?\d+`;
const pair = new RegExp(`^\\s*(${number})\\s*(?:/|\\s|…)\\s*(${number})\\s*$`);
const both = new RegExp(`^\\s*(?:±|\\+-|\\+/-)\\s*(${number})\\s*$`);

const parsed = (text: string) => Number(text.replace(',', '.').replace('−', '-'));

/** The members that a text asks for; those it does not name are undefined. */
export function demandOf(text: string): { fit?: string; limits_mm?: [number, number] } {
  const given = text.trim();
  if (!given) return {};
  const even = both.exec(given);
  if (even) return { limits_mm: [-parsed(even[1]), parsed(even[1])] };
  const two = pair.exec(given);
  if (!two) return { fit: given };
  const limits = [parsed(two[1]), parsed(two[2])].sort((a, b) => a - b);
  return { limits_mm: [limits[0], limits[1]] };
}

const signed = (mm: unknown) => (typeof mm === 'number' && mm > 0 ? `+${mm}` : String(mm));

/** The text of an element's demand. */
export function demandText(e: { fit?: unknown; limits_mm?: unknown }): string {
  const limits = Array.isArray(e.limits_mm) ? e.limits_mm : [];
  const text = limits.length === 2 && limits[0] === -limits[1] ? `±${limits[1]}` : limits.toReversed().map(signed).join('/');
  return [e.fit === undefined ? '' : String(e.fit), text].filter(Boolean).join(' ');
}
