// Drafts: part documents that the browser keeps. Each has a key of its own in the store, so
// that two tabs with two drafts never write over each other.
import { t } from './language';
import type { Remark, Part } from './types';

export interface Draft {
  id: string;
  /** Milliseconds since 1970, of its last change. */
  changed: number;
  part: Part;
  /** Opened and not yet edited: not kept once another part is opened. */
  untouched?: boolean;
  /** What the import of a drawing assumed and ignored. */
  remarks?: { assumed: Remark[]; ignored: Remark[] };
  /** Text of the document that is no JSON yet. */
  text?: string;
}

export const draftKey = 'turnwright-draft:';

/** A draft from its text in the store; undefined of anything else. */
export function readDraft(text: string | null): Draft | undefined {
  try {
    const d = JSON.parse(text ?? '');
    const part = d.part !== null && typeof d.part === 'object' && !Array.isArray(d.part);
    return part && typeof d.id === 'string' && typeof d.changed === 'number' ? d : undefined;
  } catch {
    return undefined;
  }
}

/** The drafts of a store, the last changed first. */
export function drafts(store: Storage): Draft[] {
  const keys = Array.from({ length: store.length }, (_, i) => store.key(i)!);
  return keys
    .filter((key) => key.startsWith(draftKey))
    .map((key) => readDraft(store.getItem(key)))
    .filter((d) => d !== undefined)
    .sort((a, b) => b.changed - a.changed);
}

export const loadDraft = (store: Storage, id: string) => readDraft(store.getItem(draftKey + id));

/** Keeps a draft; false where the store is full or forbidden. */
export function keepDraft(store: Storage, draft: Draft): boolean {
  try {
    store.setItem(draftKey + draft.id, JSON.stringify(draft));
    return true;
  } catch {
    return false;
  }
}

export const forgetDraft = (store: Storage, id: string) => store.removeItem(draftKey + id);

/** What a draft is called in a list: its part's name, with the number of equal ones. */
export function draftNames(all: Draft[]): { id: string; name: string }[] {
  const seen = new Map<string, number>();
  return all.map(({ id, part }) => {
    const name = String(part.name ?? '').trim() || t("part without a name");
    const n = (seen.get(name) ?? 0) + 1;
    seen.set(name, n);
    return { id, name: n > 1 ? `${name} (${n})` : name };
  });
}
