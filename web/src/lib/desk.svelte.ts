// The part on the desk: its document, which alone is true, the documents before it, its draft
// in the browser's store, and what the server reads in it.
import { ask, Refused, type Problem } from './api';
import { draftKey, drafts, forgetDraft, keepDraft, loadDraft, readDraft, type Draft } from './drafts';
import { t } from './language';
import { begun, redone, stepped, undone, type History } from './history';
import { stockFollows } from './stock';
import type { Drawing, Part } from './types';

const currentKey = 'turnwright-draft'; // of this tab
const undoKey = 'turnwright-undo:';
const undoBytes = 500_000;
const pause_ms = 150;

export class Desk {
  history = $state.raw<History<Part | undefined>>(begun(undefined));
  /** The document as text; what is typed there may be no JSON yet. */
  text = $state('');
  syntax = $state('');
  draft = $state.raw<Omit<Draft, 'part' | 'text'> | undefined>();
  list = $state.raw<Draft[]>([]);
  drawing = $state.raw<Drawing | undefined>();
  problems = $state.raw<Problem[]>([]);
  fault = $state('');
  /** What was done last, for those who hear the page. */
  said = $state('');
  /** What the store does not take. */
  unkept = $state(false);

  readonly part = $derived(this.history.now);
  /** Called with another part than the one before, which ends what was planned of that. */
  onOther = () => {};
  private waiting: ReturnType<typeof setTimeout> | undefined;
  private reading: AbortController | undefined;

  constructor(private onRefused: (error: Refused) => void) {
    this.refresh();
  }

  /** After a reload: the draft of this tab, with what can be undone. */
  resume(): boolean {
    const id = sessionStorage.getItem(currentKey);
    const draft = id ? loadDraft(localStorage, id) : undefined;
    if (draft) this.openDraft(draft);
    return draft !== undefined;
  }

  refresh = () => (this.list = drafts(localStorage));

  /** A part that was chosen, dropped or started becomes a draft. */
  open(part: Part, more: Pick<Draft, 'untouched' | 'remarks'> = {}) {
    this.openDraft({ id: crypto.randomUUID?.() ?? String(Date.now()), changed: Date.now(), part, ...more });
    this.keep();
  }

  openDraft({ part, text, ...draft }: Draft) {
    if (this.draft?.untouched && this.draft.id !== draft.id) forgetDraft(localStorage, this.draft.id);
    this.draft = draft;
    sessionStorage.setItem(currentKey, draft.id);
    this.history = { ...begun<Part | undefined>(part), past: this.readPast(draft.id) };
    this.drawing = undefined;
    this.problems = [];
    this.fault = '';
    this.onOther();
    this.show(part, 0);
    this.refresh();
    if (text !== undefined) {
      this.text = text;
      this.typed();
    }
  }

  /** The next document. Stock that fitted the part goes on fitting it. */
  edit(next: Part, told = '') {
    const now = this.part;
    this.step(stepped(this.history, now ? stockFollows(now, next) : next), told);
  }

  undo = () => this.history.past.length && this.step(undone(this.history), t("Undone"));
  redo = () => this.history.future.length && this.step(redone(this.history), t("Done again"));

  private step(history: History<Part | undefined>, told: string) {
    this.history = history;
    if (this.draft) this.draft = { ...this.draft, untouched: undefined };
    this.said = told;
    this.show(history.now!, pause_ms);
    this.keep();
  }

  private show(part: Part, after_ms: number) {
    this.text = JSON.stringify(part, null, 2);
    this.syntax = '';
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => this.draw(), after_ms);
  }

  /** The text was edited: the document follows as soon as it is JSON. */
  typed() {
    const own = this.text;
    try {
      const next = JSON.parse(own);
      if (next === null || typeof next !== 'object' || Array.isArray(next)) throw new Error(t("a part document is an object, {{..}}"));
      if (!this.draft) this.open(next);
      else if (JSON.stringify(next) !== JSON.stringify(this.part)) this.edit(next);
      this.text = own; // as it was typed
      this.syntax = '';
    } catch (error) {
      this.syntax = (error as Error).message;
    }
    this.keep();
  }

  private keep() {
    if (!this.draft || !this.part) return;
    const draft = { ...this.draft, changed: Date.now(), part: this.part, ...(this.syntax && { text: this.text }) };
    this.unkept = !keepDraft(localStorage, draft);
    this.keepPast();
    this.refresh();
  }

  private keepPast() {
    let past = this.history.past;
    let text = JSON.stringify(past);
    while (text.length > undoBytes && past.length > 1) text = JSON.stringify((past = past.slice(Math.ceil(past.length / 2))));
    try {
      sessionStorage.setItem(undoKey + this.draft!.id, text.length > undoBytes ? '[]' : text);
    } catch {
      sessionStorage.removeItem(undoKey + this.draft!.id); // undo then ends with a reload
    }
  }
  private readPast(id: string): Part[] {
    try {
      const past = JSON.parse(sessionStorage.getItem(undoKey + id) ?? '[]');
      return Array.isArray(past) ? past : [];
    } catch {
      return [];
    }
  }

  /** What an import into the open part assumed and ignored stays beside it. */
  remark(remarks: NonNullable<Draft['remarks']>) {
    if (this.draft) this.draft = { ...this.draft, remarks };
    this.keep();
  }

  /** The remarks of an import were read. */
  understood() {
    if (this.draft) this.draft = { ...this.draft, remarks: undefined };
    this.keep();
  }

  forget(id: string) {
    forgetDraft(localStorage, id);
    sessionStorage.removeItem(undoKey + id);
    if (this.draft?.id === id) this.close();
    this.refresh();
  }

  private close() {
    clearTimeout(this.waiting);
    this.reading?.abort();
    sessionStorage.removeItem(currentKey);
    this.draft = this.drawing = undefined;
    this.history = begun(undefined);
    this.text = this.syntax = this.fault = '';
    this.problems = [];
    this.onOther();
  }

  /** Another tab has written a draft: the list shows it, and the same draft follows. */
  stored(event: StorageEvent) {
    if (event.key !== null && !event.key.startsWith(draftKey)) return;
    this.refresh();
    if (!this.draft || event.key !== draftKey + this.draft.id) return;
    const theirs = readDraft(event.newValue);
    if (!theirs) return; // forgotten there: it stays on this desk and is kept with the next edit
    this.history = stepped(this.history, theirs.part);
    this.said = t("Changed in another tab");
    this.show(theirs.part, 0);
  }

  /** What the server reads in the document: its drawing, or what is wrong with it. */
  private async draw() {
    this.reading?.abort();
    const own = (this.reading = new AbortController());
    try {
      const drawing = await ask<Drawing>('drawing', this.part, own.signal);
      if (own.signal.aborted) return;
      this.drawing = drawing;
      this.problems = [];
      this.fault = '';
    } catch (error) {
      if (!own.signal.aborted) this.refused(error);
    }
  }

  refused = (error: unknown) => {
    if (!(error instanceof Refused)) throw error;
    this.onRefused(error);
    this.problems = error.problems;
    this.fault = error.message;
  };
}
