import { t } from './language';

/** One thing wrong with a document, as the server tells it. */
export interface Problem {
  pointer: string;
  got: string;
  expected: string;
  code: string;
}

/** What is wrong, in words. */
export const complaint = (p: Problem): string => t("got {}, expected {}", p.got, p.expected);

/** The server understood the call and refused it. */
export class Refused extends Error {
  constructor(
    readonly status: number,
    message: string,
    readonly problems: Problem[] = [],
  ) {
    super(message);
  }
}

/** The server's refusal that was caught, after asking for the key if it wants one; whatever else was caught is thrown on. */
export function refusal(error: unknown, unlock: () => void): Refused {
  if (!(error instanceof Refused)) throw error;
  if (error.status === 401) unlock();
  return error;
}

const keyName = 'turnwright-key';

/** The bearer key of servers that want one; kept until the tab is closed. */
export const key = {
  get: () => sessionStorage.getItem(keyName) ?? '',
  set: (value: string) => sessionStorage.setItem(keyName, value),
};

async function call(path: string, init: RequestInit): Promise<Response> {
  const headers = new Headers(init.headers);
  if (key.get()) headers.set('Authorization', `Bearer ${key.get()}`);
  let response: Response;
  try {
    response = await fetch(path, { ...init, headers });
  } catch (error) {
    if (init.signal?.aborted) throw error;
    throw new Refused(0, t("The server does not answer. Is turnwright serve still running?"));
  }
  if (response.ok) return response;
  const problem = await response.json().catch(() => ({}));
  throw new Refused(response.status, problem.detail ?? response.statusText, problem.errors ?? []);
}

function send(path: string, document: unknown, signal?: AbortSignal): Promise<Response> {
  const headers = { 'Content-Type': 'application/json' };
  return call(path, { method: 'POST', headers, body: JSON.stringify(document), signal });
}

/** What a capability answers to a document. */
export async function ask<T>(name: string, document: unknown, signal?: AbortSignal): Promise<T> {
  return (await send(`/v1/${name}`, document, signal)).json();
}

/** The same as a report, HTML. */
export async function report(name: string, document: unknown): Promise<string> {
  return (await send(`/v1/${name}/report`, document)).text();
}

export async function get<T>(path: string): Promise<T> {
  return (await call(path, {})).json();
}

/** Lets the browser save a text as a file. */
export function save(text: string, type: string, file: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = file;
  link.click();
  URL.revokeObjectURL(link.href);
}
