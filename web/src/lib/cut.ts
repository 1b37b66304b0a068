// The cut of a turning program, from the text of a LinuxCNC program: its moves, and the work
// after every one of them. Lengths are mm, x a radius, z the program's own.
import type { Drawing } from './types';
import { stockRadius } from './sheet/contour';

export interface Program {
  setup: number;
  name: string;
  text: string;
}

/** A place of the tool's programmed point: [z, x]. */
export type Place = [number, number];

export interface Move {
  kind: 'rapid' | 'feed' | 'thread';
  tool: number;
  operation: string;
  /** The places passed, from the first to the last; an arc as chords. */
  way: Place[];
}

type Shape = 'corner' | 'face' | 'blade' | 'drill' | 'nothing';
interface Cutter {
  shape: Shape;
  bore: boolean;
  /** Corner radius, width of a blade, radius of a drill. */
  size: number;
}

/** Rings of material at equal distances along the axis. */
export interface Work {
  from: number;
  step: number;
  outer: Float32Array;
  inner: Float32Array;
}

export interface Cut {
  setup: number;
  name: string;
  moves: Move[];
  /** before the first move and after each of them */
  works: Work[];
}

const RINGS = 500;
const RISES = Math.PI / 6; // of the edge behind a corner
const HALF_POINT = (59 * Math.PI) / 180; // of a drill
const CHORDS = 16;
const THIRDS = 36;

interface Tool {
  corner: number;
  orientation: number;
  size: number;
  id: string;
}

/** LinuxCNC's tool table: number, corner diameter, orientation, name with its size. */
function toolsOf(table: string): Map<number, Tool> {
  const all = new Map<number, Tool>();
  for (const line of table.split('\n')) {
    const found = /^T(\d+).* D(\S+) Q(\d+) ;(.*)$/.exec(line);
    if (!found) continue;
    const size = / ([\d.]+) mm$/.exec(found[4]);
    all.set(Number(found[1]), {
      corner: Number(found[2]) / 2, orientation: Number(found[3]), id: found[4],
      size: size ? Number(size[1]) : 0,
    });
  }
  return all;
}

function cutterOf(tool: Tool | undefined, endFace: boolean): Cutter {
  if (!tool) return { shape: 'nothing', bore: false, size: 0 };
  const bore = tool.orientation === 3; // as LinuxCNC's interpreter counts; 2 is outside
  if (tool.orientation === 7) return { shape: 'drill', bore, size: tool.size / 2 };
  if (tool.corner > 0) return { shape: endFace ? 'face' : 'corner', bore, size: tool.corner };
  return { shape: tool.size > 0 ? 'blade' : 'nothing', bore, size: tool.size };
}

function chords(from: Place, to: Place, centre: Place): Place[] {
  const angle = ([z, x]: Place) => Math.atan2(x - centre[1], z - centre[0]);
  const start = angle(from), radius = Math.hypot(from[0] - centre[0], from[1] - centre[1]);
  const turn = Math.atan2(Math.sin(angle(to) - start), Math.cos(angle(to) - start));
  const inside = Array.from({ length: CHORDS - 1 }, (_, k): Place => {
    const a = start + (turn * (k + 1)) / CHORDS;
    return [centre[0] + radius * Math.cos(a), centre[1] + radius * Math.sin(a)];
  });
  return [from, ...inside, to];
}

interface Step extends Move {
  cutter: Cutter;
}

/** The moves of a program; X is a diameter, I and K count from where an arc begins. */
function movesOf(text: string, tools: Map<number, Tool>): Step[] {
  const moves: Step[] = [];
  let code = 0, tool = 0, operation = '', endFace = false;
  let x = NaN, z = NaN;
  for (const line of text.split('\n')) {
    const told = /^\(operation (\S+): (.*?) ([\w-]+), \d+ x /.exec(line);
    if (told) {
      operation = told[1];
      endFace = told[3] === 'face' && ['left', 'right'].includes(told[2]);
    }
    if (/^[(%]/.test(line)) continue;
    const words = new Map([...line.matchAll(/([A-Z])(-?[\d.]+)/g)].map((w) => [w[1], Number(w[2])]));
    if (words.has('T')) tool = words.get('T')!;
    const motion = /\bG(0|1|2|3|33)\b/.exec(line);
    if (motion) code = Number(motion[1]);
    if (!words.has('X') && !words.has('Z')) continue;
    const from: Place = [z, x];
    if (words.has('X')) x = words.get('X')! / 2;
    if (words.has('Z')) z = words.get('Z')!;
    if (!from.every(Number.isFinite)) continue;
    const centre: Place = [from[0] + (words.get('K') ?? 0), from[1] + (words.get('I') ?? 0)];
    moves.push({
      kind: code === 0 ? 'rapid' : code === 33 ? 'thread' : 'feed',
      tool, operation, cutter: cutterOf(tools.get(tool), endFace),
      way: code === 2 || code === 3 ? chords(from, [z, x], centre) : [from, [z, x]],
    });
  }
  return moves;
}

/** Height of a tool above its programmed point, so far behind it. */
function height(c: Cutter, behind: number): number {
  const r = c.size;
  if (c.shape === 'blade') return 0;
  if (c.shape === 'face' && behind > r) return 0;
  const tangent = r * (1 + Math.sin(RISES));
  if (behind > tangent) return r * (1 - Math.cos(RISES)) + (behind - tangent) * Math.tan(RISES);
  return r - Math.sqrt(Math.max(0, r * r - (behind - r) ** 2));
}

/** Least of a convex function between 0 and 1. */
function least(f: (s: number) => number): number {
  let low = 0, high = 1;
  for (let i = 0; i < THIRDS; ++i) {
    const third = (high - low) / 3;
    if (f(low + third) < f(high - third)) high -= third;
    else low += third;
  }
  return Math.min(f(0), f(1), f((low + high) / 2));
}

/** Takes off what a tool meets on a straight way: src/report/picture/removal.hpp, Eq. (1). */
function takeOff(work: Work, c: Cutter, [z0, x0]: Place, [z1, x1]: Place) {
  const reach = c.shape === 'blade' ? c.size : Infinity;
  const sign = c.bore ? -1 : 1;
  for (let i = 0; i < RINGS; ++i) {
    const z = work.from + i * work.step;
    if (c.shape === 'drill') {
      const deep = Math.min(c.size, (z - Math.min(z0, z1)) * Math.tan(HALF_POINT));
      work.inner[i] = Math.max(work.inner[i], deep);
      continue;
    }
    let s0 = 0, s1 = 1;
    if (z0 === z1) {
      if (z < z0 || z - z0 > reach) continue;
    } else {
      [s0, s1] = [(z - reach - z0) / (z1 - z0), (z - z0) / (z1 - z0)].sort((a, b) => a - b);
      s0 = Math.max(s0, 0);
      s1 = Math.min(s1, 1);
      if (!(s0 <= s1)) continue;
    }
    const h = least((t) => {
      const s = s0 + (s1 - s0) * t;
      const behind = Math.min(Math.max(0, z - (z0 + s * (z1 - z0))), reach);
      return sign * (x0 + s * (x1 - x0)) + height(c, behind);
    });
    if (c.bore) work.inner[i] = Math.max(work.inner[i], -h);
    else work.outer[i] = Math.min(work.outer[i], Math.max(0, h));
  }
}

/** z of the part at a program's Z, and back: turned round where the right end is held. */
const partZ = (drawing: Drawing, setup: number, z: number) =>
  drawing.setups[setup].hold === 'left' ? drawing.length_mm + z : -z;
const programZ = (drawing: Drawing, setup: number, z: number) =>
  drawing.setups[setup].hold === 'left' ? z - drawing.length_mm : -z;

/** The stock, or what the setup before has left. */
function workBefore(drawing: Drawing, setup: number, before?: { setup: number; work: Work }): Work {
  const [a, b] = drawing.stock.z_mm.map((z) => programZ(drawing, setup, z)).sort((p, q) => p - q);
  const step = (b - a) / (RINGS - 1);
  const work: Work = {
    from: a, step,
    outer: Float32Array.from({ length: RINGS }, (_, i) => stockRadius(drawing.stock, partZ(drawing, setup, a + i * step))),
    inner: new Float32Array(RINGS).fill(drawing.stock.inner_mm / 2),
  };
  if (before)
    for (let i = 0; i < RINGS; ++i) {
      const z = programZ(drawing, before.setup, partZ(drawing, setup, a + i * step));
      const k = Math.min(RINGS - 1, Math.max(0, Math.round((z - before.work.from) / before.work.step)));
      work.outer[i] = before.work.outer[k];
      work.inner[i] = before.work.inner[k];
    }
  return work;
}

const copy = (w: Work): Work => ({ ...w, outer: w.outer.slice(), inner: w.inner.slice() });

/** The cut of every program of a part, one after the other. */
export function cuts(programs: Program[], toolTable: string, drawing: Drawing): Cut[] {
  const tools = toolsOf(toolTable);
  let before: { setup: number; work: Work } | undefined;
  return programs.map(({ setup, name, text }) => {
    const moves = movesOf(text, tools);
    const works = [workBefore(drawing, setup, before)];
    for (const move of moves) {
      const last = works[works.length - 1];
      if (move.kind !== 'feed' || move.cutter.shape === 'nothing') {
        works.push(last);
        continue;
      }
      const next = copy(last);
      for (let k = 1; k < move.way.length; ++k) takeOff(next, move.cutter, move.way[k - 1], move.way[k]);
      works.push(next);
    }
    before = { setup, work: works[works.length - 1] };
    return { setup, name, moves, works };
  });
}
