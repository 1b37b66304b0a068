// Arrow heads of dimension lines, and how far rows of texts stand apart. In px.

export const noteRow_px = 19;
export const lengthRow_px = 20;
/** From the part to the first row of lengths; letters of datums stand between. */
export const belowPart_px = (datums: boolean): number => (datums ? 40 : 22);

const long = 8, half = 1.6;
const ways = { left: [-1, 0], right: [1, 0], up: [0, -1], down: [0, 1] };

/** A slender triangle with its tip at (x, y) that points the given way. */
export function arrowHead(x: number, y: number, way: keyof typeof ways): string {
  const [dx, dy] = ways[way];
  const bx = x - long * dx, by = y - long * dy;
  return `M${x},${y}L${bx + half * dy},${by + half * dx}L${bx - half * dy},${by - half * dx}Z`;
}
