// The shop's own data: measured seats in QIF, whose mean and wear are known; programs on the
// part of the tab Plan, what they cut and what is not understood.
//
// Usage: node test/shop.mjs TURNWRIGHT FOLDER [PAGE]
import assert from 'node:assert/strict';
import { program, results } from './files.mjs';
import { choose, inTurn, stage, wide } from './stage.mjs';

const { open, look, close } = await stage();
const file = (name, text) => ({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });

async function measured() {
  const page = await open(wide);
  await page.getByRole('option', { name: 'Pump shaft' }).waitFor({ state: 'attached' });
  await page.getByRole('tab', { name: 'Learn' }).click();
  await look(page, '40-learn-empty');
  await page.getByLabel('They are of the part').uncheck();
  const opened = page.getByLabel('Open results', { exact: true }).last();
  await opened.setInputFiles(file('seat.qif', results()));
  const row = (name) => page.getByRole('row', { name }).locator('td').nth(1);
  await page.getByRole('heading', { name: 'seat' }).waitFor();
  assert.equal(await row(/^mean/).innerText(), '30.00650');
  assert.match(await row(/per part/).first().innerText(), /^(0\.9[5-9]|1\.0[0-5])$/);
  await page.getByText('12 values, M25; 29.98 to 30.02 mm').waitFor();
  await look(page, '41-learned');
  await page.setViewportSize({ width: 400, height: 800 });
  await look(page, '42-learned-narrow');
  await opened.setInputFiles(file('bad.qif', '<QIFDocument>\n<'));
  await page.getByRole('alert').getByText(/qif\/files\/0#line/).waitFor();
  await look(page, '43-learn-refused');
  await page.context().close();
}

async function programs() {
  const page = await open(wide);
  await page.getByRole('option', { name: 'Pump shaft' }).waitFor({ state: 'attached' });
  await page.getByRole('tab', { name: 'Review' }).click();
  await look(page, '44-review-empty');
  const opened = page.getByLabel('Open programs', { exact: true }).last();
  await opened.setInputFiles(file('s1.nc', program));
  await page.getByText('No part is open').waitFor();
  await page.getByRole('tab', { name: 'Plan' }).click();
  await choose(page, 'pump-shaft');
  await page.getByRole('tab', { name: 'Review' }).click();
  await opened.setInputFiles(file('s1.nc', program));
  await page.getByRole('heading', { name: /^Setup 1: / }).waitFor();
  // Three passes of the loop, and one code that no control knows.
  assert.match(await page.getByRole('row', { name: /d4/ }).first().innerText(), /finish\s+T1 PCLNL-CNMG120408-PM\s+3\s/);
  await page.getByText('line 13: G123').waitFor();
  await look(page, '45-reviewed');
  await page.getByLabel(/^Tools that/).fill('none');
  await page.getByRole('button', { name: 'Review', exact: true }).click();
  await page.getByText('No tool: none').waitFor();
  await page.setViewportSize({ width: 400, height: 800 });
  await look(page, '46-review-narrow');
  await page.context().close();
}

await inTurn(measured, programs);
await close();
