// JSON pointers (RFC 6901) into a document of the planner's.

const steps = (pointer: string): string[] =>
  pointer
    .split('/')
    .slice(1)
    .map((step) => step.replaceAll('~1', '/').replaceAll('~0', '~'));

/** What stands at the pointer; undefined where nothing does. */
export function at(document: unknown, pointer: string): unknown {
  let value = document;
  for (const step of steps(pointer)) {
    if (value === null || typeof value !== 'object') return undefined;
    value = (value as Record<string, unknown>)[step];
  }
  return value;
}

type Holder = Record<string, unknown> | unknown[];

const holder = (value: unknown): value is Holder => value !== null && typeof value === 'object';

/**
 * The document with another value there; undefined takes the member away. What lies beside
 * the way is shared with the document before, so that equal members stay identical.
 */
export function put<T>(document: T, pointer: string, value: unknown): T {
  return placed(document, steps(pointer), value) as T;
}

function placed(parent: unknown, path: string[], value: unknown): unknown {
  const [step, ...rest] = path;
  const copy: Holder = Array.isArray(parent) ? [...parent] : holder(parent) ? { ...parent } : {};
  const members = copy as Record<string, unknown>;
  if (rest.length) members[step] = placed(members[step], rest, value);
  else if (value !== undefined) members[step] = value;
  else if (Array.isArray(copy)) copy.splice(Number(step), 1);
  else delete members[step];
  return copy;
}
