import assert from 'node:assert/strict';
import { readdirSync } from 'node:fs';
import { test } from 'node:test';
import { load, projectFile } from './load.mjs';

const german = JSON.parse(projectFile('languages/de/page.json'));

/** A module as a page has it that is served in a language, at an address. */
async function loadIn(name, lang, search) {
  Object.assign(globalThis, { document: { documentElement: { lang } }, location: { search } });
  try {
    return await load(name);
  } finally {
    delete globalThis.document;
    delete globalThis.location;
  }
}

// Loaded before the tests, which change what they find.
const { known, limit, place, words } = await load('words');
const inGerman = await loadIn('words', 'de', '');

test('the address says the language, else the service', async () => {
  for (const [lang, search, language] of [['en', '', 'en'], ['de', '', 'de'], ['de', '?language=en', 'en'], ['en', '?language=de', 'de'],
    ['de', '?language=xx', 'de'], ['xx', '', 'en'], ['constructor', '', 'en']])
    assert.equal((await loadIn('language', lang, search)).language, language, `${lang} ${search}`);
  assert.equal((await load('language')).language, 'en');
});

test('values stand at their places, in turn or by number, and as they are', async () => {
  const { t } = await load('language');
  assert.equal(t('{} of {}', 1, '{}'), '1 of {}');
  assert.equal(t('{1} of {0}', 'a', 'b'), 'b of a');
  assert.equal(t('an object, {{..}}'), 'an object, {..}');
  assert.equal((await loadIn('language', 'de', '')).t('Setup {}', 2), german['Setup {}'].replace('{}', '2'));
});

test('words of the documents are known', () => {
  const enumerated = (name, ...path) => path.reduce((at, step) => at[step], JSON.parse(projectFile(`schemas/${name}.json`)));
  const plan = 'plan.result', part = 'part';
  const kinds = (side) => enumerated(part, 'definitions', side, 'oneOf').map((one) => one.properties.kind.const);
  const ids = [
    ...kinds('outer'), ...kinds('inner'), ...enumerated(part, 'definitions', 'tolerance_kind', 'enum'),
    ...enumerated(part, 'properties', 'milling', 'items', 'else', 'properties', 'kind', 'enum'),
    ...['hold', 'jaws'].flatMap((key) => enumerated(part, 'properties', 'setups', 'items', 'properties', key, 'enum')),
    ...enumerated(part, 'properties', 'setups', 'items', 'properties', 'clampings', 'items', 'enum'),
    ...enumerated(plan, 'properties', 'tolerances', 'items', 'properties', 'verdict', 'enum'),
    ...enumerated('review.result', 'properties', 'setups', 'items', 'properties', 'cuts', 'items', 'properties', 'kind', 'enum'),
    ...enumerated('stability.request', 'definitions', 'milling', 'properties', 'direction', 'enum'),
  ];
  assert.ok(ids.length > 40);
  for (const id of ids) assert.ok(known.includes(words(id)), id);
  for (const word of known) assert.equal(inGerman.words(word), german[word], word);
});

test('limits of operations and causes are known', () => {
  const literals = (path, pattern) => [...projectFile(path).matchAll(pattern)].map(([, name]) => name);
  const limits = literals('src/planning/limits/limit_table.cpp', /(?:\.name = |row\(|roughness<\w+>\(|no_limit\(|least_of_window<[^(]*>\(\s*|largest_of_window<[^(]*>\(\s*)(?:to_translate\()?"([^"]+)"/g);
  assert.ok(limits.length > 25, limits.join());
  for (const name of limits) assert.ok(known.includes(name), name);
});

test('a limit is named with whom it is of', () => {
  for (const name of ['power', 'grip of the chuck', 'power of lathe-medium', 'grip force in setup 1', 'cost +5 %', 'something else', 'd1:diameter'])
    assert.equal(limit(name), name);
  assert.equal(limit('t1 total-radial-runout'), 't1 total radial runout');
  assert.equal(inGerman.limit('roughness Ra of d1|d2'), `${german['roughness Ra']} (d1|d2)`);
  assert.equal(inGerman.limit('largest depth of cut'), german['largest depth of cut']);
  assert.equal(inGerman.limit('grip force in setup 2'), german['{} in setup {}'].replace('{}', german['grip force']).replace('{}', '2'));
  assert.equal(inGerman.limit('t1 flatness'), `t1 ${german.flatness}`);
});

test('ids of surfaces stay, ends are words', () => {
  for (const id of ['left', 'd1', 'right|b1', 'left .. d1|d2', 'upright', 'left-seat']) assert.equal(place(id), id);
  assert.equal(inGerman.place('right|b1'), `${german.right}|b1`);
  assert.equal(inGerman.place('left .. right'), `${german.left} .. ${german.right}`);
  assert.equal(inGerman.place('upright|left-seat'), 'upright|left-seat');
});

test('members of the machines and tools that the page shows are words', () => {
  const units = /_(mm|um|N|kW|Nm|MPa|deg|rad|min|rpm|K|Hz|pct|m_min|mm_min|mm_rev|N_mm|mm_N|rad_N|rad_Nmm|kg_m)$/;
  const symbols = /^(E[A-Z0]{2,3}.?|[EMPTbcfhnu]|c\d|Ra|alpha|ap|dc|err|gamma|id|format|hex|kapr|l[fhu]|n (max|min)|nu|re|sq|tool r[rt]|(at )?vc|wf|zefp|y max|Fc max)$/;
  const keys = new Set();
  const walk = (value) => {
    if (value === null || typeof value !== 'object') return;
    for (const [key, member] of Object.entries(value)) {
      if (!Array.isArray(value)) keys.add(words(key.replace(units, '')));
      walk(member);
    }
  };
  const root = process.env.TURNWRIGHT_ROOT ?? new URL('../../..', import.meta.url).pathname;
  for (const folder of ['tools', 'machines'])
    for (const file of readdirSync(`${root}/${folder}`, { recursive: true }).filter((name) => name.endsWith('.json')))
      walk(JSON.parse(projectFile(`${folder}/${file}`)));
  assert.ok(keys.size > 120);
  for (const key of keys) assert.ok(known.includes(key) || symbols.test(key), key);
});
