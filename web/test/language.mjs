// The page in German: of a tour through every tab no text is left English, and what is filled
// in, what is asked and every number are those of the English page.
//
// Usage: node test/language.mjs TURNWRIGHT FOLDER [PAGE]
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { program, results } from './files.mjs';
import { inTurn, stage, wide } from './stage.mjs';

const { base, open, pictured, look, close } = await stage('--language', 'de');
const german = JSON.parse(readFileSync(new URL('../../languages/de/page.json', import.meta.url), 'utf8'));
const files = new Set(['setup-1.ngc', 'setup-2.ngc']);
const file = (name, text) => (files.add(name), { name, mimeType: 'text/plain', buffer: Buffer.from(text) });

/** Every text that a reader may see or hear, also of closed sections and tabs; no documents. */
const texts = (page) => page.evaluate(() => {
  const all = [];
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT | NodeFilter.SHOW_ELEMENT);
  for (let node = walk.nextNode(); node; node = walk.nextNode()) {
    if (node.nodeType === 3) {
      if (!node.parentElement.closest('script, noscript, pre, textarea, .value')) all.push(node.data);
    } else for (const name of ['aria-label', 'aria-valuetext', 'title', 'placeholder', 'label'])
      if (!node.matches('textarea')) all.push(node.getAttribute(name) ?? ''); // examples of what is typed there
  }
  return all.map((text) => text.trim()).filter(Boolean);
});
const values = (page) => page.evaluate(() =>
  [...document.querySelectorAll('input:not([type=file]), select:not(#part), textarea')].map((field) => field.type === 'checkbox' ? field.checked : field.value));

// What is said in answers, and names and ids in documents, are not the page's.
const spoken = new Set(['id', 'sentence', 'why', 'text', 'got', 'expected', 'pointer', 'detail', 'tool', 'what', 'on', 'of', 'datum', 'at',
  'device', 'designation', 'fit', 'insert', 'source', 'note', 'chain', 'currency', 'reason', 'general', 'undercut', 'material', 'where',
  'confounded', 'warnings', 'taken', 'not_predicted', 'not_identified', 'unreachable', 'cannot', 'left_out', 'kinds', 'form', 'use', 'uses', 'format']);
function collect(document, key, listed, all) {
  if (typeof document === 'string') {
    if (spoken.has(key) || (listed && key === 'name')) all.add(document);
  } else if (document !== null && typeof document === 'object')
    for (const [own, value] of Object.entries(document)) collect(value, Array.isArray(document) ? key : own, listed, all);
}

/** A walk through everything that the page shows; its steps know no word of it. */
async function tour(language) {
  const page = await open(wide, `?language=${language}`);
  const seen = [], filled = [], asked = [], data = new Set();
  page.on('request', (request) => request.method() === 'POST' && !request.url().endsWith('/drawing') && asked.push([request.url(), request.postData()]));
  const answers = [];
  page.on('response', (response) => /json/.test(response.headers()['content-type']) && answers.push(
    response.json().then((json) => collect(json, '', response.request().method() === 'GET', data), () => {})));
  const unfold = () => page.evaluate(() => document.querySelectorAll('details').forEach((d) => { d.open = true; }));
  const state = async (name) => {
    await unfold();
    seen.push(...(await texts(page)));
    filled.push(await values(page));
    // The other rounds ask axe-core about the English page, which has the same colours.
    const picture = `language-${language}-${name}`;
    if (language === 'de') await look(page, picture, ['color-contrast']);
    else await pictured(page, picture);
  };
  const drawing = async (act) => Promise.all([page.waitForResponse((r) => r.url().endsWith('/v1/drawing')), act()]);
  const choose = (id) => drawing(() => page.locator('#part').selectOption(id));
  const main = page.locator('.bar button.main');
  const plan = async () => {
    await Promise.all([page.waitForResponse((r) => r.url().endsWith('/v1/plan')), main.click()]);
    await page.locator('.results').waitFor();
  };
  const panel = (id) => page.locator(`#panel-${id}`);
  await page.reload(); // with the answers to what it asks first
  await page.locator('#part option[value=pump-shaft]').waitFor({ state: 'attached' });
  await page.waitForLoadState('networkidle');
  assert.equal(await page.locator('html').getAttribute('lang'), language);
  await state('empty');

  await choose('gearbox-input-shaft');
  await page.locator('[data-pointer="/pareto"] input').fill('3');
  await drawing(() => page.locator('[data-pointer="/pareto"] input').press('Tab'));
  await plan();
  await page.locator('.results form select').selectOption({ index: 1 });
  await drawing(() => page.locator('.results form button').click());
  await plan();
  await page.locator('.results tbody button').nth(1).click();
  await page.locator('#control ~ button').first().click();
  await page.locator('input[type=range]').first().waitFor();
  await page.locator('.views button').nth(1).click();
  await state('planned');
  await page.setViewportSize({ width: 400, height: 800 });
  await state('planned-narrow');
  await page.setViewportSize(wide.viewport);

  await choose('infeasible-as-drawn');
  await plan();
  await state('infeasible');
  for (const id of ['drilled-bush', 'keyed-shaft', 'threaded-spindle', 'iron-hub', 'motor-shaft']) {
    await choose(id);
    for (const one of ['first', 'last']) { // an element, a face
      await page.locator('.sheet [role=button]')[one]().focus();
      seen.push(...(await texts(page)));
    }
    await state(id);
  }
  await drawing(() => page.locator('.built .add button').first().click()); // an element is inserted
  await page.locator('[data-pointer="/tools"] button.plain:not(:disabled)').first().click();
  await page.locator('details.own').waitFor();
  await page.locator('[data-pointer="/outer/0/length_mm"] input').fill('-3');
  await drawing(() => page.locator('[data-pointer="/outer/0/length_mm"] input').press('Tab'));
  await page.locator('[aria-invalid=true]').first().waitFor();
  await unfold();
  await page.locator('#json').fill('[1]');
  await state('wrong');

  await page.locator('#line').fill('d50 h7 x 40; 1x45; d30 k6 x 32; bore d12 x 72');
  await page.locator('#line ~ button').click();
  await page.locator('#import-material').selectOption('C45');
  await state('importing');
  await drawing(() => page.locator('#import-material ~ button').first().click());
  await page.locator('[data-pointer="/name"] input').fill('Pin'); // instead of that of the page, in its language
  await drawing(() => page.locator('[data-pointer="/name"] input').press('Tab'));
  await state('imported');
  await page.locator('#file').setInputFiles(file('list.json', '[1]'));
  await page.locator('.alert').first().waitFor();
  await state('refused');

  await choose('pump-shaft');
  await page.locator('#tab-review').click();
  await page.locator('#programs').setInputFiles(file('s1.nc', program));
  await panel('review').locator('table').first().waitFor();
  await state('reviewed');
  await page.locator('#turret').fill('nix');
  await panel('review').locator('button.main').click();
  await panel('review').locator('.alert').waitFor();
  await state('no-tool');

  await page.locator('#tab-learn').click();
  await panel('learn').locator('input[type=checkbox]').uncheck();
  await page.locator('#results').setInputFiles(file('seat.qif', results()));
  await panel('learn').locator('table').first().waitFor();
  await state('learned');

  await page.locator('#tab-stability').click();
  for (const model of ['milling', 'turning']) {
    await page.locator('#model').selectOption(model);
    await panel('stability').locator('button.main').click();
    await panel('stability').locator('.told').waitFor();
    await state(`stability-${model}`);
  }
  await page.locator('#tab-ballbar').click();
  await panel('ballbar').locator('.row button').first().click();
  await panel('ballbar').locator('table').first().waitFor();
  await state('ball-bar');
  await page.context().close();
  await Promise.all(answers);
  return { seen, filled, asked, data };
}

// Words that are the same in both languages, and what is no word: units, symbols, codes, names.
const wordsOf = (texts) => new Set(texts.flatMap((text) => text.match(/\p{L}+/gu) ?? []));
const same = wordsOf(Object.keys(german).filter((english) => german[english] === english));
const ofGerman = wordsOf(Object.values(german));
const ofEnglish = new Set([...wordsOf(Object.keys(german))].filter((one) => !ofGerman.has(one)));
const names = new Set(['min', 'rev', 'max', 'deg', 'pct', 'theta', 'gamma', 'ccw', 'Linux', 'Haas', 'Okuma', 'Fanuc', 'Siemens', 'Turnwright', 'Enter']);
const word = /\p{L}*\p{Ll}{3,}|\b(?:as|at|by|in|is|it|no|of|on|or|to|up)\b/gu;

async function both() {
  const [en, de] = await Promise.all([tour('en'), tour('de')]);
  assert.deepEqual(de.filled, en.filled);
  assert.deepEqual(de.asked, en.asked);
  const data = [...files, ...en.data, ...de.data].filter((text) => !['left', 'right'].includes(text)).sort((a, b) => b.length - a.length);
  const english = new Set(en.seen);
  const left = [...new Set(de.seen)].filter((text) => {
    const own = data.reduce((rest, known) => rest.replaceAll(known, ' '), text).match(word) ?? [];
    const other = (one) => !same.has(one) && !names.has(one);
    return own.some((one) => ofEnglish.has(one) || (english.has(text) && other(one)));
  });
  assert.equal(left.join('\n'), '', `${left.length} texts of the German page are English`);
  assert.ok(english.size > 600, `${english.size} texts were seen`);
}

/** The service's own language where the address names none. */
async function served() {
  const page = await open(wide);
  assert.equal(await page.locator('html').getAttribute('lang'), 'de');
  assert.equal(await page.locator('#tab-review').innerText(), german.Review);
  await page.context().close();
  assert.ok((await fetch(base)).ok);
}

await inTurn(served, both);
await close();
