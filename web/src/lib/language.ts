// The page's language. Texts are written in English where they arise; languages/de/page.json
// has their German. Documents, requests, units and numbers are the same in every language.
import german from '../../../languages/de/page.json';

const translations = new Map<string, Record<string, string>>([['en', {}], ['de', german]]);

/** That of the address, "?language=de"; else that of the page as the service sends it. */
export const language: string = [
  new URLSearchParams(globalThis.location?.search).get('language'), globalThis.document?.documentElement.lang,
].find((tag) => translations.has(tag ?? '')) ?? 'en';

const texts = new Map(Object.entries(translations.get(language)!));

/** The English text in the page's language; as it is where no translation is known. */
export const translated = (english: string): string => texts.get(english) ?? english;

/** A text with its values: "{} of {}" takes them in turn, "{1} of {0}" by number; "{{" is a brace. */
export function t(english: string, ...values: unknown[]): string {
  let next = 0;
  return translated(english).replace(/\{\{|\}\}|\{(\d*)\}/g, (place, number?: string) =>
    number === undefined ? place[0] : String(values[number === '' ? next++ : Number(number)]));
}

/** Marks a text of a table, which is translated where it is shown. */
export const later = (english: string): string => english;
