// The server and the browser in which the page's rounds are played, and what every round does.
import { spawn } from 'node:child_process';
import { mkdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { createInterface } from 'node:readline';
import assert from 'node:assert/strict';
import { chromium } from 'playwright-core';

/** Starts both, the server with more arguments; those of the round are TURNWRIGHT FOLDER [PAGE]. */
export async function stage(...more) {
  const [program, folder, own] = process.argv.slice(2);
  const browserPath = process.env.CHROMIUM ?? '/usr/bin/chromium';
  const axeSource = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
  mkdirSync(folder, { recursive: true });

  const server = spawn(program, ['serve', '--port', '0', ...(own ? ['--page', own] : []), ...more], {
    stdio: ['ignore', 'pipe', 'ignore'],
    env: { ...process.env, XDG_STATE_HOME: folder },
  });
  const base = await new Promise((resolve, reject) => {
    createInterface({ input: server.stdout }).once('line', (line) => resolve(line.split(' ').pop()));
    server.once('exit', (code) => reject(new Error(`turnwright serve ended with ${code}`)));
  });

  const browser = await chromium.launch({ executablePath: browserPath, args: ['--no-sandbox'] });
  let checks = 0;

  async function open(options, query = '') {
    const context = await browser.newContext({ acceptDownloads: true, ...options });
    const page = await context.newPage();
    const faults = (page.faults = []);
    page.setDefaultTimeout(Number(process.env.PATIENCE ?? 90_000));
    page.on('request', (request) => {
      const url = request.url();
      if (!/^(data|blob):/.test(url) && !url.startsWith(base)) faults.push(`left the host: ${url}`);
    });
    page.on('pageerror', (error) => faults.push(`the page threw: ${error}`));
    page.on('console', (message) => {
      // What is refused or fails is shown to the planner; the console has it too.
      const refused = /Failed to load resource/.test(message.text());
      if (message.type() === 'error' && !refused) faults.push(`console: ${message.text()}`);
    });
    await page.goto(base + query);
    return page;
  }

  /** A picture of the state, nothing wider than the window, no fault. */
  async function pictured(page, name) {
    await page.evaluate(() => scrollTo(0, 0));
    await page.screenshot({ path: `${folder}/${name}.png`, fullPage: true });
    const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(over <= 0, `${name} is ${over} px wider than its window`);
    assert.deepEqual(page.faults?.splice(0) ?? [], [], name);
    checks += 1;
  }

  /** The same, and no violation of axe-core, the rules of `without` left aside. */
  async function look(page, name, without = []) {
    await pictured(page, name);
    const rules = Object.fromEntries(without.map((rule) => [rule, { enabled: false }]));
    const run = `${axeSource}; axe.run(${JSON.stringify({ rules })})`; // by DevTools: no CSP in its way
    const found = await page.evaluate(run);
    assert.deepEqual(
      found.violations.map((v) => `${v.id}: ${v.nodes.slice(0, 4).map((n) => n.target.join(' ')).join(', ')}`), [], name);
  }

  async function close() {
    await browser.close();
    server.kill('SIGTERM');
    console.log(`${checks} states looked at, ${failed} rounds failed`);
    process.exitCode = failed ? 1 : 0;
  }
  return { base, browser, folder, open, pictured, look, close };
}

export const wide = { viewport: { width: 1400, height: 900 } };
export const field = (page, label) => page.getByLabel(label, { exact: true });
export const press = (page, name) => page.getByRole('button', { name, exact: true }).click();
export const documentOf = async (page) => JSON.parse(await page.locator('#json').inputValue());
export const picture = (page) => page.getByRole('group', { name: /^Drawing of/ });

export async function write(page, label, value) {
  await field(page, label).fill(value);
  await field(page, label).press('Tab');
}
/** The server has read the document as it is now, and draws it. */
export async function drawn(page) {
  const answer = await page.waitForResponse((r) => r.url().endsWith('/v1/drawing'));
  assert.equal(answer.status(), 200, await answer.text().catch(() => ''));
}
/** Opens a new part with two cylinders; the form wants a name and a material. */
export async function begin(page, name, material) {
  await press(page, 'Start a new one');
  await picture(page).waitFor();
  await write(page, 'Name', name);
  await field(page, 'Material').selectOption(material);
}
export const cost = (page) => page.locator('[data-test=cost]').innerText().then(Number);

export async function choose(page, part) {
  await page.getByLabel('Part', { exact: true }).selectOption(part);
  await page.getByRole('group', { name: /^Drawing of/ }).waitFor();
}

export async function plan(page) {
  const done = page.waitForResponse((r) => r.url().endsWith('/v1/plan'));
  await page.getByRole('button', { name: /^Plan/ }).click();
  await done;
  await page.getByRole('heading', { name: 'Operations' }).waitFor();
}

let failed = 0;
export async function inTurn(...rounds) {
  for (const round of rounds) {
    const began = Date.now();
    try {
      await round();
      console.log(`passed: ${round.name}, ${((Date.now() - began) / 1000).toFixed(1)} s`);
    } catch (error) {
      failed += 1;
      console.error(`FAILED: ${round.name}\n${error.stack}`);
    }
  }
}
