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

/** The tools that a part lists; `usual` are those of its shop, which it has without a list. */
export function toolsOf(part: Part, usual: string[], catalogue: string[]): Means[] {
  if (part.tools === 'all') return catalogue;
  return Array.isArray(part.tools) ? part.tools : usual;
}

/** Ids of the tools that the part's shop has; one without a list has the whole catalogue. */
export function shopsTools(part: Part, shops: Part[], catalogue: string[]): string[] {
  const named = part.shop ?? 'workshop';
  const shop = typeof named === 'string' ? shops.find((s) => s.id === named) : named;
  return Array.isArray(shop?.tools) && shop.tools.length ? catalogue.filter((id) => shop.tools.includes(id)) : catalogue;
}

/** The part with documents of tools in its list, in place of those of the same ids. */
export function withDocuments(part: Part, documents: Part[]): Part {
  const ids = new Set(documents.map(idOf));
  const listed: Means[] = Array.isArray(part.tools) ? part.tools : [];
  return { ...part, tools: [...listed.filter((m) => !ids.has(idOf(m))), ...documents] };
}

/** The shop's tools need no list, the whole catalogue is a word. */
export function withTools(part: Part, tools: Means[], usual: string[], catalogue: string[]): Part {
  const { tools: _, ...rest } = part;
  const are = (ids: string[]) => tools.length === ids.length && ids.every((id) => tools.includes(id));
  if (are(usual)) return rest;
  return { ...part, tools: are(catalogue) ? 'all' : tools };
}

/** A list with an entry of that id put in (at its end), or taken out. */
export function ticked(list: Means[], id: string, on: boolean): Means[] {
  const others = list.filter((m) => idOf(m) !== id);
  return on ? [...others, id] : others;
}
