// Planning of the part on the desk: one run at a time, and the last result with what was asked.
import { ask } from './api';
import { t } from './language';
import { fixed } from './numbers';
import type { Desk } from './desk.svelte';
import type { Part, Plan } from './types';

const planKey = 'turnwright-plan', runningKey = 'turnwright-planning';

export class Planner {
  plan = $state.raw<Plan | undefined>();
  before = $state.raw<Plan | undefined>();
  planned = $state.raw<Part | undefined>();
  running = $state.raw<AbortController | undefined>();
  seconds = $state(0);
  /** The page was loaded anew while it planned. */
  interrupted = $state(false);
  /** The page is going: calls that end now were not answered. */
  leaving = false;

  constructor(private desk: Desk) {}

  readonly stale = $derived.by(() => this.plan !== undefined && this.planned !== this.desk.part);

  /** After a reload: the result of this tab, if it belongs to the document on the desk. */
  resume() {
    this.interrupted = sessionStorage.getItem(runningKey) === this.desk.draft?.id;
    sessionStorage.removeItem(runningKey);
    try {
      const kept = JSON.parse(sessionStorage.getItem(planKey) ?? 'null');
      if (!kept || kept.draft !== this.desk.draft?.id) return;
      const same = JSON.stringify(kept.planned) === JSON.stringify(this.desk.part);
      this.planned = same ? this.desk.part : kept.planned;
      this.plan = kept.plan;
    } catch {
      sessionStorage.removeItem(planKey);
    }
  }

  private keep() {
    const kept = { draft: this.desk.draft?.id, planned: this.planned, plan: this.plan };
    try {
      sessionStorage.setItem(planKey, JSON.stringify(kept));
    } catch {
      sessionStorage.removeItem(planKey); // too large: it ends with a reload
    }
  }

  forget() {
    this.cancel();
    this.plan = this.before = this.planned = undefined;
    this.interrupted = false;
  }

  async run() {
    const request = this.desk.part;
    if (!request || this.running) return;
    const own = (this.running = new AbortController());
    const started = Date.now();
    this.seconds = 0;
    this.interrupted = false;
    sessionStorage.setItem(runningKey, this.desk.draft?.id ?? '');
    const clock = setInterval(() => (this.seconds = (Date.now() - started) / 1000), 100);
    try {
      const next = await ask<Plan>('plan', request, own.signal);
      if (this.running !== own) return;
      this.before = this.planned?.name === request.name ? this.plan : undefined;
      this.plan = next;
      this.planned = request;
      this.desk.problems = [];
      this.desk.fault = '';
      this.desk.said = next.status === 'ok' ? t("Planned: {} per part", fixed(next.cost_per_part, 2)) : t("The part is infeasible");
      this.keep();
    } catch (error) {
      if (!own.signal.aborted) this.desk.refused(error);
    } finally {
      clearInterval(clock);
      if (this.running === own) {
        this.running = undefined;
        // Calls are ended before the page knows that it goes; a page that went comes here no more.
        setTimeout(() => this.leaving || sessionStorage.removeItem(runningKey));
      }
    }
  }

  cancel() {
    if (!this.running) return;
    this.running.abort();
    this.running = undefined;
    sessionStorage.removeItem(runningKey);
  }
}
