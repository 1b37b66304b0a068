// A module of web/src/lib, compiled as the page is; files of the project beside the page.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { runnerImport } from 'vite';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));

export const load = async (name) =>
  (await runnerImport(here(`../../src/lib/${name}.ts`), { configFile: false, logLevel: 'silent' })).module;

const root = process.env.TURNWRIGHT_ROOT ?? here('../../..');
export const projectFile = (path) => readFileSync(`${root}/${path}`, 'utf8');
export const part = (id) => JSON.parse(projectFile(`parts/${id}.json`));

/** The same numbers between 0 and 1 in every run. */
export function random(seed) {
  return () => {
    seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
    return seed / 2 ** 32;
  };
}
