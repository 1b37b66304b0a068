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

/** A copy of the document with another value there; undefined takes the member away. */
export function put<T>(document: T, pointer: string, value: unknown): T {
  const copy = structuredClone(document);
  const path = steps(pointer);
  const last = path.pop()!;
  let parent = copy as Record<string, unknown>;
  for (const step of path) parent = (parent[step] ??= {}) as Record<string, unknown>;
  if (value !== undefined) parent[last] = value;
  else if (Array.isArray(parent)) parent.splice(Number(last), 1);
  else delete parent[last];
  return copy;
}
