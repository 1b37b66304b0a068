// A newcomer's round through the page: plan three parts, change a tolerance, see price and
// plan change, meet the errors, upload a ball-bar trace, draw a stability chart, take the
// report home. Every state is checked by axe-core; no request may leave the host.
//
// Usage: node test/round.mjs TURNWRIGHT FOLDER [PAGE]
// Pictures of every state are put into FOLDER; PAGE is the folder of another page.
import { readFileSync, writeFileSync } from 'node:fs';
import assert from 'node:assert/strict';
import { choose, cost, inTurn, plan, stage } from './stage.mjs';

const { base, browser, folder, open, look, close } = await stage();

async function planner() {
  const page = await open({ viewport: { width: 1360, height: 900 } });
  await page.getByRole('option', { name: 'Gearbox input shaft' }).waitFor({ state: 'attached' });
  await look(page, '01-empty');

  for (const part of ['pump-shaft', 'roller-tube']) {
    await choose(page, part);
    await plan(page);
    assert.ok((await cost(page)) > 0);
    if (part === 'roller-tube') {
      await page.getByRole('button', { name: 'Setup 2', exact: true }).click();
      await page.getByText('chuck steady, grip').waitFor(); // on a steady rest
    }
    await look(page, `02-${part}`);
  }

  await choose(page, 'gearbox-input-shaft');
  await page.getByRole('button', { name: /^d1, cylinder/ }).focus();
  await page.getByText('t1 cylindricity 0.008 mm').waitFor();
  await look(page, '03-drawing');
  await plan(page);
  const before = await cost(page);
  const prices = await page.getByText(/saves .* per part/).allInnerTexts();
  assert.ok(prices.length > 3);
  await page.getByRole('button', { name: 'Setup 1', exact: true }).click();
  await page.getByRole('button', { name: /s1-rough/ }).first().click();
  await look(page, '04-planned');
  await page.setViewportSize({ width: 1280, height: 1000 });
  await page.screenshot({ path: `${folder}/page-planned.png` }); // for docs/pictures

  // A tighter tolerance is dearer, and says so.
  const runout = page.locator('[data-pointer="/tolerances/0/value_mm"] input');
  await runout.fill('0.0012');
  await runout.press('Tab');
  await page.getByText('The document has changed since').waitFor();
  await plan(page);
  const after = await cost(page);
  assert.ok(after > before, `0.0012 instead of 0.008 mm costs ${after} against ${before}`);
  await page.getByText(/\+.* against .* before/).waitFor();
  assert.notDeepEqual(await page.getByText(/saves .* per part/).allInnerTexts(), prices);
  await look(page, '05-tighter');

  // Bad input marks the field it is about.
  const diameter = page.locator('[data-pointer="/outer/0/diameter_mm"] input');
  await diameter.fill('-30');
  await diameter.press('Tab');
  await page.getByText('got -30').first().waitFor();
  assert.equal(await diameter.getAttribute('aria-invalid'), 'true');
  assert.ok(await page.getByRole('button', { name: /^Plan/ }).isDisabled());
  await look(page, '06-bad-input');
  await diameter.fill('30');
  await diameter.press('Tab');
  await page.locator('[aria-invalid=true]').waitFor({ state: 'detached' });

  // The report is one file that shows the same cost.
  await plan(page);
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Report (HTML)' }).click();
  const file = `${folder}/report.html`;
  await (await download).saveAs(file);
  const report = readFileSync(file, 'utf8');
  assert.ok(report.includes(`<dd>${(await cost(page)).toFixed(2)} `));
  assert.equal(report.match(/class="setup-sheet"/g).length, 2);

  // One NC program a setup, with the plan's tools and speeds.
  await page.getByRole('button', { name: 'Write NC programs' }).click();
  const program = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save setup 1' }).click();
  await (await program).saveAs(`${folder}/program.ngc`);
  assert.match(readFileSync(`${folder}/program.ngc`, 'utf8'), /G96 .*S\d[^]*M30/);
  await page.getByText(/^setup-\d\.ngc/).first().click();

  // The cut: by keyboard from the finished work back to the stock, then on by operations.
  const slider = page.getByRole('slider', { name: 'Moves of setup 1' });
  const all = Number(await slider.getAttribute('max'));
  assert.ok(all > 20);
  await slider.focus();
  await page.keyboard.press('ArrowLeft');
  await page.getByText(`Move ${all - 1} of ${all}`).waitFor();
  await page.keyboard.press('Home');
  await page.getByText(`Move 0 of ${all}: before the first move`).waitFor();
  const work = page.getByRole('img', { name: /^The cut of setup 1/ }).locator('path.work');
  const stock = await work.getAttribute('d');
  await page.getByLabel('Up to the end of').first().selectOption({ index: 1 });
  assert.notEqual(await work.getAttribute('d'), stock);
  await page.getByText(/Move \d+ of \d+: T\d, s1-rough/).waitFor();
  // What is left has the drawing's diameters: 25 js7 at Z-20, 40 h7 at Z-90, the bar at Z-150.
  await slider.press('End');
  const section = await page.getByRole('img', { name: /^The cut of setup 1/ }).evaluate((svg) => ({
    points: svg.querySelector('path.work').getAttribute('d').match(/-?[\d.]+,-?[\d.]+/g).map((p) => p.split(',').map(Number)),
    texts: [...svg.querySelectorAll('text')].map((t) => ({
      value: Number(t.textContent.replace('\u2212', '-')), x: Number(t.getAttribute('x')), y: Number(t.getAttribute('y')),
      along: t.getAttribute('text-anchor') === 'middle',
    })),
  }));
  const axis = (along, key) => {
    const [one, other] = section.texts.filter((t) => t.along === along && Number.isFinite(t.value));
    return (place) => one.value + ((place - one[key]) * (other.value - one.value)) / (other[key] - one[key]);
  };
  const toZ = axis(true, 'x'), toDiameter = (y) => axis(false, 'y')(y + 4);
  for (const [Z, diameter] of [[-20, 25], [-90, 40], [-150, 50]]) {
    const found = section.points.filter(([x]) => Math.abs(toZ(x) - Z) < 0.5).map(([, y]) => toDiameter(y));
    assert.ok(Math.abs(Math.max(...found) - diameter) < 0.3, `${Math.max(...found)} at Z${Z}`);
  }
  await look(page, '07-nc');
  await page.context().close();
  await paper(file);
}

/** Pages of A4 that the open page takes. */
async function sheets(page, path) {
  const pdf = await page.pdf({ path, preferCSSPageSize: true });
  return pdf.toString('latin1').match(/\/Type\s*\/Page\b/g).length;
}

/** Nothing that a report shows comes from elsewhere. */
async function onPaper() {
  const page = await (await browser.newContext()).newPage();
  page.on('request', (r) => assert.ok(/^(file|data):/.test(r.url()), r.url()));
  return page;
}

/** The report as it is read on a screen. */
async function paper(file) {
  const page = await onPaper();
  await page.goto(`file://${file}`);
  await look(page, '08-report');
  await page.context().close();
}

/** Faults of what a report shows on A4: type below 7 pt, set-up sheets of more than a page. */
async function smallOrLong(page) {
  await page.emulateMedia({ media: 'print' });
  await page.setViewportSize({ width: Math.round((186 * 96) / 25.4), height: 1000 });
  return page.evaluate(() => {
    const mm = 96 / 25.4, faults = [];
    const tooSmall = (px, what) => { if (px * 0.75 < 6.99) faults.push(`${what}: ${(px * 0.75).toFixed(2)} pt`); };
    for (const element of document.body.querySelectorAll('*'))
      if ([...element.childNodes].some((n) => n.nodeType === 3 && n.data.trim()))
        tooSmall(parseFloat(getComputedStyle(element).fontSize), element.textContent.slice(0, 30));
    for (const img of document.images) {
      const svg = decodeURIComponent(img.src.slice(img.src.indexOf(',') + 1));
      const types = [...svg.matchAll(/font-size: ([\d.]+)px/g)].map((m) => Number(m[1]));
      if (!types.length) faults.push(`${img.alt}: no type`);
      tooSmall((Math.min(...types) * mm * img.clientWidth) / img.naturalWidth, img.alt);
    }
    for (const sheet of document.querySelectorAll('.setup-sheet')) {
      const high = sheet.getBoundingClientRect().height / mm;
      if (high > 273) faults.push(`${sheet.querySelector('h1').textContent}: ${high.toFixed(0)} mm`);
    }
    return faults;
  });
}

// The longest reports, and one without a plan; TURNWRIGHT_PAPERS=all prints those of every part.
const longest = ['drilled-bush', 'gearbox-input-shaft', 'infeasible-as-drawn', 'keyed-shaft', 'threaded-spindle'];

/** A part's report: a few pages for the planner, and two for each setup. */
async function papers() {
  const page = await onPaper();
  const parts = await (await fetch(`${base}v1/parts`)).json();
  const printed = parts.filter(({ id }) => process.env.TURNWRIGHT_PAPERS === 'all' || longest.includes(id));
  assert.ok(printed.length >= longest.length);
  for (const { id } of printed) {
    const answer = await fetch(`${base}v1/plan/report`, {
      method: 'POST', headers: { 'Content-Type': 'application/json' },
      body: await (await fetch(`${base}v1/parts/${id}`)).text(),
    });
    assert.equal(answer.status, 200, id);
    writeFileSync(`${folder}/report-${id}.html`, await answer.text());
    await page.goto(`file://${folder}/report-${id}.html`);
    const pages = await sheets(page, `${folder}/report-${id}.pdf`);
    const setups = await page.locator('.setup-sheet').count();
    console.log(`report of ${id}: ${pages} pages of A4, ${setups} set-up sheets`);
    assert.ok(pages <= 6 + 2 * setups, id);
    assert.deepEqual(await smallOrLong(page), [], id);
  }
  await page.context().close();
}

async function otherwise() {
  const page = await open({ viewport: { width: 1360, height: 900 } });
  await choose(page, 'bearing-seat');
  await page.getByLabel('Cost against time').fill('3');
  await page.getByLabel('Cost against time').press('Tab');
  await plan(page);
  await page.getByRole('heading', { name: 'Cost against time' }).waitFor();
  await page.getByRole('img', { name: /^Cost against time of/ }).waitFor();
  const limit = page.getByLabel('Limit', { exact: true });
  await limit.selectOption({ index: 1 });
  const named = await limit.inputValue();
  await page.getByLabel('Change [%]').fill('20');
  await page.getByRole('button', { name: 'Ask', exact: true }).click();
  await page.getByText(`${named} +20 %: plan to see`).waitFor();
  await plan(page);
  await page.getByText('plan to see').waitFor({ state: 'detached' });
  await page.getByRole('button', { name: `Remove ${named} +20 %` }).waitFor();
  await look(page, '08-otherwise');
  await page.getByRole('button', { name: `Remove ${named} +20 %` }).click();
  await page.getByText('Prices are first order').waitFor();
  await page.setViewportSize({ width: 400, height: 800 });
  await look(page, '08-otherwise-narrow');
  await page.context().close();
}

async function cancelled() {
  const page = await open({ viewport: { width: 1360, height: 900 } });
  await page.route('**/v1/plan', () => {}); // it never answers
  await choose(page, 'spindle-nose');
  await page.getByRole('button', { name: 'Plan', exact: true }).click();
  await page.getByRole('button', { name: 'Cancel' }).waitFor();
  await look(page, '09-planning');
  await page.getByRole('button', { name: 'Cancel' }).click();
  await page.getByRole('button', { name: 'Plan', exact: true }).waitFor();
  await page.unroute('**/v1/plan');
  await page.route('**/v1/plan', (route) => route.abort());
  await page.waitForLoadState('networkidle'); // what is under way has come
  await page.keyboard.press('Control+Enter');
  await page.getByText('The server does not answer').waitFor();
  await look(page, '10-no-answer');
  await page.unroute('**/v1/plan');
  // Two problems of one place, of one kind.
  await choose(page, 'threaded-spindle');
  await page.locator('#source').evaluate((source) => { source.open = true; });
  const part = JSON.parse(await page.getByLabel(/^Paste a part/).inputValue());
  Object.assign(part.outer.find((element) => element.kind === 'groove'), { fit: 'h11', limits_mm: [-25, 0] });
  await page.getByLabel(/^Paste a part/).fill(JSON.stringify(part));
  await page.keyboard.press('Control+Enter');
  await page.getByText('fit or limits_mm, not both').first().waitFor();
  await page.getByText('limits that leave a diameter > 0 mm').first().waitFor();
  await page.context().close();
}

async function impossible() {
  const page = await open({ viewport: { width: 1360, height: 900 }, colorScheme: 'dark' });
  assert.equal(await page.locator('html').getAttribute('data-theme'), 'dark');
  await choose(page, 'infeasible-as-drawn');
  await plan(page);
  await page.getByText('These limits cannot be kept together').waitFor();
  await look(page, '11-infeasible-dark');
  await page.context().close();
}

async function locked() {
  const page = await open({ viewport: { width: 1000, height: 700 } });
  await page.route('**/v1/**', (route) =>
    route.request().headers().authorization === 'Bearer a-key-of-16-characters'
      ? route.continue()
      : route.fulfill({ status: 401, json: { detail: 'expected Authorization: Bearer and a key' } }));
  await page.reload();
  await page.getByLabel('This server wants a key').fill('a-key-of-16-characters');
  await look(page, '12-locked');
  await page.getByRole('button', { name: 'Use it' }).click();
  await page.getByRole('option', { name: 'Gearbox input shaft' }).waitFor({ state: 'attached' });
  await page.context().close();
}

async function narrow() {
  for (const colorScheme of ['light', 'dark']) {
    const page = await open({ viewport: { width: 400, height: 800 }, colorScheme });
    await choose(page, 'flanged-bush');
    await plan(page);
    await look(page, `13-narrow-${colorScheme}`);
    await page.context().close();
  }
}

async function others() {
  const page = await open({ viewport: { width: 1200, height: 900 } });
  await page.getByRole('tab', { name: 'Plan' }).focus();
  const chart = page.getByRole('tab', { name: 'Stability', selected: true });
  while (!(await chart.count())) await page.keyboard.press('ArrowRight'); // by keyboard to the chart
  await page.getByRole('button', { name: 'Draw the chart' }).click();
  await page.getByText('it does not, margin').waitFor();
  await look(page, '14-stability');
  await page.getByRole('tab', { name: 'Ball bar' }).click();
  await look(page, '15-ball-bar-empty');
  // An eccentric circle of 5 um and a squareness error: the trace a user brings.
  const rows = Array.from({ length: 72 }, (_, k) => {
    const t = (2 * Math.PI * (k + 0.5)) / 72;
    const um = 5 * Math.cos(t) + 8 * Math.sin(2 * t);
    return `${((t * 180) / Math.PI).toFixed(3)},${(um + 1).toFixed(3)},${(um - 1).toFixed(3)}`;
  });
  await page.getByLabel('Values in').selectOption('um');
  await page.getByLabel('Open a trace').setInputFiles({
    name: 'trace.csv', mimeType: 'text/csv', buffer: Buffer.from(['theta_deg,ccw,cw', ...rows].join('\n')),
  });
  await page.getByRole('heading', { name: 'ISO 230-4' }).waitFor();
  // 1 um wider one way and 1 um narrower the other: the hysteresis is 2 um.
  assert.equal(await page.getByRole('row', { name: /H, hysteresis/ }).locator('td').last().innerText(), '2.00');
  await look(page, '16-ball-bar');
  await page.getByLabel(/^Table/).fill('theta_deg,ccw\n1,2');
  await page.getByRole('button', { name: 'Analyse' }).click();
  await page.getByRole('alert').waitFor();
  await look(page, '17-ball-bar-refused');
  await page.setViewportSize({ width: 400, height: 800 });
  await page.getByRole('tab', { name: 'Stability' }).click();
  await look(page, '18-stability-narrow');
  await page.context().close();
}

await Promise.all([
  inTurn(papers),
  inTurn(planner, otherwise, cancelled, impossible, locked, narrow, others),
]);
await close();
