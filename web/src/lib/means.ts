// Machines and tools that a part leaves to the planner: ids of the catalogue or documents.
import type { Part } from './types';

export type Means = string | Part;
export const idOf = (m: Means): string => (typeof m === 'string' ? m : String(m?.id ?? 'own'));

/** Machines to choose from; none: the planner's default. */
export function machinesOf(part: Part): Means[] {
  if (Array.isArray(part.choose?.machine)) return part.choose.machine;
  return part.machine === undefined ? [] : [part.machine];
}

/** One machine is the part's, several are left to the planner's choice. */
export function withMachines(part: Part, machines: Means[]): Part {
  const next: Part = { ...part, choose: { ...part.choose } };
  delete next.machine;
  delete next.choose.machine;
  if (machines.length === 1) next.machine = machines[0];
  if (machines.length > 1) next.choose.machine = machines;
  if (!Object.keys(next.choose).length) delete next.choose;
  return next;
}

/** The tools to choose from, where the part does not leave the whole catalogue. */
export const toolsOf = (part: Part): Means[] | undefined => (Array.isArray(part.tools) ? part.tools : undefined);

/** The part with documents of tools in its list, in place of those of the same ids. */
export function withDocuments(part: Part, documents: Part[]): Part {
  const ids = new Set(documents.map(idOf));
  return { ...part, tools: [...(toolsOf(part) ?? []).filter((m) => !ids.has(idOf(m))), ...documents] };
}

/** The whole catalogue needs no list. */
export function withTools(part: Part, tools: Means[], catalogue: string[]): Part {
  const { tools: _, ...rest } = part;
  const whole = catalogue.every((id) => tools.includes(id)) && tools.length === catalogue.length;
  return whole ? rest : { ...part, tools };
}

/** A list with an entry of that id put in (at its end), or taken out. */
export function ticked(list: Means[], id: string, on: boolean): Means[] {
  const others = list.filter((m) => idOf(m) !== id);
  return on ? [...others, id] : others;
}
