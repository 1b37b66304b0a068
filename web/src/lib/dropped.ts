// A file that is dropped or opened: a part document, a drawing for /v1/import, or a tool library for /v1/import-tools.
import { t } from './language';
import type { Part } from './types';

export const largest_bytes = 100e6;

export type Dropped =
  | { kind: 'part'; part: Part }
  | { kind: 'drawing'; request: Part }
  | { kind: 'library'; request: Part }
  | { kind: 'refused'; why: string };

/** Bytes in base64, in pieces that a call's argument list can take. */
function base64(bytes: Uint8Array): string {
  let text = '';
  for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(text);
}

/** The file's text where it is UTF-8, else its bytes. */
function content(bytes: Uint8Array): Part {
  try {
    return { text: new TextDecoder('utf-8', { fatal: true }).decode(bytes) };
  } catch {
    return { base64: base64(bytes) };
  }
}

function document(name: string, text: string): Dropped {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (error) {
    return { kind: 'refused', why: t("{} is no JSON: {}", name, (error as Error).message) };
  }
  if (value === null || typeof value !== 'object' || Array.isArray(value))
    return { kind: 'refused', why: t("{} is no part document: expected an object, {{..}}", name) };
  const { format, data, parameter } = value as Part;
  if (Array.isArray(data) || parameter !== undefined) return { kind: 'library', request: { text } };
  if (format !== undefined && format !== 'turnwright-part/1')
    return { kind: 'refused', why: t("{} is no part document: its format is {}", name, JSON.stringify(format)) };
  return { kind: 'part', part: value as Part };
}

/** What a file is, by its name and its first character. */
export function readDropped(name: string, bytes: Uint8Array): Dropped {
  if (bytes.length === 0) return { kind: 'refused', why: t("{} is empty", name) };
  if (bytes.length > largest_bytes)
    return { kind: 'refused', why: t("{} has {} MB, more than {} MB", name, Math.round(bytes.length / 1e6), largest_bytes / 1e6) };
  const given = content(bytes);
  if (/\.(tools|csv|xml|fctb)$/i.test(name)) return { kind: 'library', request: given };
  const text: string = (given.text ?? '').replace(/^\uFEFF/, '');
  if (/\.json$/i.test(name) || text.trimStart().startsWith('{')) return document(name, text);
  return { kind: 'drawing', request: given };
}
