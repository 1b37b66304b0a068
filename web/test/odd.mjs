// What may go wrong with a part on the page: bad files, odd documents and names, a page loaded
// anew in the middle of things, two tabs with one draft.
//
// Usage: node test/odd.mjs TURNWRIGHT FOLDER [PAGE]
import assert from 'node:assert/strict';
import { begin, choose, documentOf, field, inTurn, picture, press, stage, wide, write } from './stage.mjs';

const { base, open, look, close } = await stage();

/** A file that is dropped anywhere on the page. */
async function drop(page, name, text) {
  const data = await page.evaluateHandle(([n, t]) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([t], n));
    return transfer;
  }, [name, text]);
  await page.dispatchEvent('body', 'drop', { dataTransfer: data });
}

async function dropped() {
  const page = await open(wide);
  await drop(page, 'broken.json', '{"outer": [}');
  await page.getByText('broken.json is no JSON').waitFor();
  await drop(page, 'list.json', '[1, 2]');
  await page.getByText('list.json is no part document').waitFor();
  await drop(page, 'line.txt', 'd50 h7 xx 40');
  await page.getByText('expected a length like x 40').first().waitFor();
  await look(page, 'refused');
  await drop(page, 'line.txt', 'd50 h7 x 40; 1x45; d30 k6 x 32; bore d12 x 72');
  await field(page, 'Material').selectOption('C45'); // the drawing names none
  await press(page, 'Import');
  await page.getByText('The stock is the next round bar').waitFor();
  await picture(page).waitFor();
  await look(page, 'imported');
  await page.reload();
  await page.getByText('The stock is the next round bar').waitFor(); // also kept
  await press(page, 'Understood');
  // An own document, with members that the form does not know: they survive.
  await drop(page, 'own.json', JSON.stringify({ ...(await documentOf(page)), name: 'A <b>&"name"</b>', what_if: [] }));
  await page.getByRole('group', { name: 'Drawing of A <b>&"name"</b>' }).waitFor();
  await write(page, 'Length of d1', '41');
  assert.deepEqual((await documentOf(page)).what_if, []);
  // Text that is no JSON yet is kept too, and so is a field that is still being typed in.
  await page.locator('#source').evaluate((source) => { source.open = true; });
  await page.locator('#json').fill('{"outer": ');
  await page.reload();
  await picture(page).waitFor();
  assert.equal(await page.locator('#json').inputValue(), '{"outer": ');
  await field(page, 'Length of d1').fill('43');
  await page.reload();
  await picture(page).waitFor();
  assert.equal((await documentOf(page)).outer[0].length_mm, 43);
  await press(page, 'Undo');
  assert.equal((await documentOf(page)).outer[0].length_mm, 41);
  await page.context().close();
}

/** A tool library on an open part becomes the part's own tools. */
async function libraries() {
  const page = await open(wide);
  const table = 'id;insert;holder;RE\nR1;CNMG 120408;PCLNL 2525M 12;0,8\nX;;;';
  await drop(page, 'crib.csv', table);
  await page.getByText('crib.csv is a tool library: open or start a part first').waitFor();
  await choose(page, 'pump-shaft');
  await drop(page, 'crib.csv', 'insert;RE\nCNMG 120408');
  await page.getByText('line 2: 1 cells').waitFor();
  await drop(page, 'crib.csv', table);
  await page.getByText('The life is not said').waitFor();
  await page.getByText('Its insert is not said').waitFor();
  assert.deepEqual((await documentOf(page)).tools.map((t) => t.id), ['R1']);
  await look(page, 'tool-library');
  await press(page, 'Undo');
  assert.equal((await documentOf(page)).tools, undefined);
  await page.context().close();
}

async function broken() {
  const page = await open(wide);
  const many = { material: 'C45', outer: Array.from({ length: 5000 }, (_, i) => ({ id: `e${i}`, kind: 'cylinder', length_mm: 1, diameter_mm: 20 })) };
  for (const document of [{}, { outer: 'none', inner: 7, edges: {}, milling: [null], faces: [1], setups: [null], tools: {}, stock: [] }, { outer: [null, 3, {}], tolerances: [null] }, many]) {
    await drop(page, 'odd.json', JSON.stringify(document));
    await page.getByRole('alert').waitFor();
    await page.getByRole('button', { name: /^Plan/ }).waitFor();
    assert.deepEqual(page.faults.splice(0), []);
  }
  await page.getByText('and 4850 more').waitFor();
  // A problem leads to its field, also in a section that is closed.
  await drop(page, 'wrong.json', JSON.stringify({
    material: 'C45', stock: { kind: 'bar', diameter_mm: 35, length_mm: 34 }, outer: [{ id: 'd1', kind: 'cylinder', length_mm: 30, diameter_mm: 32 }],
    faces: [{ id: 'left', Ra_um: -1 }],
  }));
  await press(page, '/faces/0/Ra_um');
  assert.equal(await page.evaluate(() => document.activeElement.getAttribute('aria-invalid')), 'true');
  // Loaded anew while it plans: it says so.
  await page.route('**/v1/plan', () => {});
  await choose(page, 'bearing-seat');
  await page.keyboard.press('Control+Enter');
  await page.getByRole('button', { name: 'Cancel' }).waitFor();
  await page.reload();
  await page.getByText('Planning was interrupted').waitFor();
  await look(page, 'interrupted');
  await page.context().close();
}

/** Two tabs with one draft follow each other; what one had is an undo away in the other. */
async function tabs() {
  const one = await open(wide);
  await begin(one, 'Shared', 'C45');
  const id = await one.evaluate(() => sessionStorage.getItem('turnwright-draft'));
  const two = await one.context().newPage();
  await two.goto(base);
  await two.getByLabel('Part', { exact: true }).selectOption(id);
  await write(two, 'Length of d1', '77');
  await one.waitForFunction(() => JSON.parse(document.getElementById('json').value).outer[0].length_mm === 77);
  await press(one, 'Undo');
  await two.waitForFunction(() => JSON.parse(document.getElementById('json').value).outer[0].length_mm === 30);
  // Another draft in one tab leaves the other alone.
  await press(two, 'Copy');
  await write(two, 'Length of d1', '55');
  assert.equal((await documentOf(one)).outer[0].length_mm, 30);
  await press(two, 'Forget');
  await two.getByRole('button', { name: /^Bring back/ }).click();
  assert.equal((await documentOf(two)).outer[0].length_mm, 55);
  await one.context().close();
}

/** An own tool and several machines: they stand in the document. */
async function means() {
  const page = await open(wide);
  await choose(page, 'pump-shaft');
  await page.getByText('Machine and tools').click();
  await page.getByRole('checkbox', { name: /lathe-small/ }).check();
  assert.equal((await documentOf(page)).choose.machine.length, 2);
  await field(page, 'Search the tools').fill('PDJNL');
  await press(page, 'Edit PDJNL-DNMG150604-PF');
  await page.getByText(/PDJNL 2525 finishing tool.*the part’s own/).click();
  await page.getByText('geometry', { exact: true }).first().click();
  await page.locator('[data-pointer$="/geometry/re_mm"] input').last().fill('-0.4');
  await page.keyboard.press('Tab');
  await page.getByText('got -0.4').first().waitFor();
  assert.equal(await page.locator('[data-pointer$="/geometry/re_mm"] input').last().getAttribute('aria-invalid'), 'true');
  await look(page, 'own-tool');
  await press(page, 'All');
  assert.equal((await documentOf(page)).tools, 'all');
  await press(page, 'The shop’s');
  assert.equal((await documentOf(page)).tools, undefined);
  await page.context().close();
}

await Promise.all([inTurn(dropped, libraries, tabs), inTurn(broken, means)]);
await close();
