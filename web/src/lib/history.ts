// Undo as a stack of documents: documents are never changed in place, so keeping one is free.

export interface History<T> {
  past: T[];
  now: T;
  future: T[];
}

const most = 200;

export const begun = <T>(now: T): History<T> => ({ past: [], now, future: [] });

/** A further document; what was undone before is given up. */
export function stepped<T>(h: History<T>, next: T): History<T> {
  return next === h.now ? h : { past: [...h.past, h.now].slice(-most), now: next, future: [] };
}

export function undone<T>(h: History<T>): History<T> {
  if (!h.past.length) return h;
  return { past: h.past.slice(0, -1), now: h.past[h.past.length - 1], future: [h.now, ...h.future] };
}

export function redone<T>(h: History<T>): History<T> {
  if (!h.future.length) return h;
  return { past: [...h.past, h.now], now: h.future[0], future: h.future.slice(1) };
}
