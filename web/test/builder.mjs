// A newcomer builds four drawings from nothing, by keyboard and mouse: a motor shaft with
// thread, keyway and two undercuts, a flanged bush with an oil groove, a hydraulic piston with
// two seal grooves; and a plug with a reamed hole and an inch thread. Every one is planned and is still there after the page was loaded anew.
//
// Usage: node test/builder.mjs TURNWRIGHT FOLDER [PAGE]
import assert from 'node:assert/strict';
import { begin, cost, documentOf, drawn, field, inTurn, picture, plan, press, stage, wide, write } from './stage.mjs';

const { open, pictured, look, close } = await stage();

/** Types into the field that has the focus, and into those behind it. */
async function types(page, ...values) {
  for (const value of values) {
    if (value) await page.keyboard.type(value);
    await page.keyboard.press('Tab');
  }
}
/** Loads the page anew: the document, and the plan if there was one, are as before. */
async function reloaded(page) {
  const before = await documentOf(page), was = await cost(page);
  await page.reload();
  await picture(page).waitFor();
  assert.deepEqual(await documentOf(page), before);
  assert.equal(await cost(page), was);
  assert.equal(await page.getByText('The document has changed since').count(), 0);
}
/** A picture at 400 px, where results come first. */
async function narrowed(page, name, seen = pictured) {
  await page.setViewportSize({ width: 400, height: 800 });
  // Speed, feed and depth of the first operation are seen without scrolling sideways.
  for (const column of [1, 2, 3]) {
    const box = await page.locator('.results tbody td').nth(column).boundingBox();
    assert.ok(box.x + box.width <= 400, `${name}: column ${column} ends at ${box.x + box.width}`);
  }
  const [contour, results] = await Promise.all(['[aria-label="Contour"]', '.results'].map((place) => page.locator(place).boundingBox()));
  assert.ok(results.y < contour.y, 'what is planned stands before what is edited');
  await seen(page, name);
  await page.setViewportSize(wide.viewport);
}

/** By keyboard alone once the part is begun: the focus is where the next word is typed. */
async function shaft() {
  const page = await open(wide);
  await begin(page, 'Motor shaft', '42CrMo4-A');
  await write(page, 'Length of d1', '25');
  await write(page, 'Diameter of d1', '30');
  await field(page, 'Kind of d1').selectOption('thread');
  await write(page, 'Length of d2', '4');
  await field(page, 'Kind of d2').selectOption('groove');
  await write(page, 'Floor diameter of d2', '27.6');
  await page.getByRole('button', { name: 'Add at the right end' }).focus();
  // length, diameter, knurl, fit or limits, Ra, Rz, for grinding; then the button that inserts the next one
  for (const [values, last] of [
    [['31', '32', '', 'h8', '1.6', '', '']], [['35', '40', '', 'k6', '0.8', '', '0.3']], [['170', '50', '', '0/-0.1', '3.2', '', '']],
    [['35', '40', '', 'k6', '0.8', '', '']], [['60', '35', '', 'h8', '1.6', '', ''], true],
  ]) {
    await page.keyboard.press('Enter');
    await types(page, ...values);
    if (last) break;
  }
  for (const [edge, kind] of [['left end', 'Chamfer'], ['d4 to d5', 'Chamfer'], ['d4 to d5', 'Undercut'],
    ['d5 to d6', 'Undercut'], ['d5 to d6', 'Chamfer'], ['right end', 'Chamfer']]) {
    await page.getByRole('button', { name: `${kind} at ${edge}` }).focus();
    await page.keyboard.press('Enter');
  }
  await write(page, 'Chamfer of left end [mm]', '1.5');
  await page.getByText('Centre holes', { exact: true }).click();
  await field(page, 'Centre hole in the left end').selectOption('B2.5/8');
  await field(page, 'Centre hole in the right end').selectOption('A4/8.5');
  await field(page, 'Centre hole in the right end').selectOption('none');
  await page.getByText('Milled: keyways').click();
  await picture(page).getByRole('button', { name: /^d7, cylinder/ }).focus();
  await page.keyboard.press('Enter');
  await press(page, '+ Keyway on d7');
  await write(page, 'Length of k1 [mm]', '40');
  await write(page, 'Left end z of k1 [mm]', '310');
  await press(page, 'Add a tolerance of d7');
  const tolerance = page.getByRole('group', { name: 'Tolerance t1' });
  await tolerance.getByLabel('Kind').selectOption('total-radial-runout');
  await tolerance.getByLabel('Of').selectOption('d5');
  await tolerance.getByLabel('Datum').selectOption('d4');
  await page.getByText('Machine and tools').click();
  await page.getByRole('checkbox', { name: /turn-mill/ }).check();
  await drawn(page);
  await press(page, 'Set them here');
  for (const setup of [1, 2]) {
    const held = page.getByRole('group', { name: `Setup ${setup}` });
    await held.getByRole('checkbox', { name: 'chuck', exact: true }).uncheck();
  }
  await drawn(page);
  const part = await documentOf(page);
  assert.deepEqual(part.outer.map((e) => [e.kind, e.length_mm, e.diameter_mm, e.fit ?? e.limits_mm]), [
    ['thread', 25, 30, undefined], ['groove', 4, 27.6, undefined], ['cylinder', 31, 32, 'h8'], ['cylinder', 35, 40, 'k6'],
    ['cylinder', 170, 50, [-0.1, 0]], ['cylinder', 35, 40, 'k6'], ['cylinder', 60, 35, 'h8']]);
  assert.deepEqual(part.outer.flatMap((e) => ('grinding_allowance_mm' in e ? [e.id, e.grinding_allowance_mm] : [])), ['d4', 0.3]);
  assert.deepEqual(part.centre_holes, [{ at: 'left', designation: 'B2.5/8' }]);
  assert.deepEqual(part.stock, { kind: 'bar', diameter_mm: 52, length_mm: 364, left_allowance_mm: 2 });
  for (const text of ['B2.5/8', 'M30×1.5', '⌀50 0/−0.1', '⌀35 h8', 'keyway 10×5×40', '170', '360', 'A ⌀10.6'])
    assert.ok(await picture(page).getByText(text, { exact: true }).count(), text);
  await drags(page);
  await plan(page);
  await look(page, 'shaft-1400');
  await narrowed(page, 'shaft-400', look);
  await reloaded(page);
  await page.context().close();
}

/** Jaws by mouse and by keys; a step of each is one step of undo. */
async function drags(page) {
  await press(page, 'Setup 2');
  const jaws = page.getByRole('slider', { name: 'Length gripped in setup 2' });
  const grip = async () => (await documentOf(page)).setups[1].grip_mm ?? 0; // 0: the planner's choice
  const before = await grip();
  await picture(page).scrollIntoViewIfNeeded();
  const box = await jaws.locator('.grab').first().boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x - 40, box.y + 5, { steps: 4 });
  await page.mouse.up();
  assert.ok((await grip()) > 5, 'dragged into the part');
  await jaws.focus();
  await page.keyboard.press('PageDown');
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  assert.equal(await grip(), before);
  await press(page, 'Finished part');
}

async function bush() {
  const page = await open(wide);
  await begin(page, 'Flanged bush', 'C45');
  for (const [label, value] of [['Length of d1', '14'], ['Diameter of d1', '80'], ['Length of d2', '56'], ['Diameter of d2', '60'], ['Fit or limits of d2', 'k6']])
    await write(page, label, value);
  await page.getByText('Bores, from their end inwards').click();
  for (const [values, kind] of [[['20', '42', 'H7', '1.6']], [['5', '45', '', ''], 'groove'], [['45', '42', 'H7', '1.6']]]) {
    await press(page, 'Add a bore from the right');
    await types(page, ...values);
    const id = (await documentOf(page)).inner.at(-1).id;
    if (kind) {
      await field(page, `Kind of ${id}`).selectOption(kind);
      await write(page, `Floor diameter of ${id}`, values[1]);
    }
  }
  await page.getByLabel('Kind of stock').selectOption('tube');
  await write(page, 'Outer diameter of stock [mm]', '85');
  await write(page, 'Inner diameter of stock [mm]', '35');
  await press(page, 'Chamfer all 7 sharp edges 1 × 45°');
  await page.getByText('Faces', { exact: false }).last().click();
  await write(page, 'Ra of face d1|d2 [µm]', '1.6');
  await press(page, 'Set them here');
  await page.getByRole('group', { name: 'Setup 1' }).getByLabel(/^Gripped/).fill('12');
  await page.keyboard.press('Tab');
  await page.getByRole('group', { name: 'Setup 2' }).getByLabel(/^Gripped/).fill('40');
  await page.keyboard.press('Tab');
  await drawn(page);
  const part = await documentOf(page);
  assert.deepEqual(part.inner.map((e) => [e.kind, e.from, e.length_mm, e.diameter_mm]), [
    ['cylinder', 'right', 20, 42], ['groove', 'right', 5, 45], ['cylinder', 'right', 45, 42]]);
  assert.deepEqual(part.faces, [{ id: 'd1|d2', Ra_um: 1.6 }]);
  await plan(page);
  await look(page, 'bush-1400');
  await narrowed(page, 'bush-400');
  await reloaded(page);
  await page.context().close();
}

async function piston() {
  const page = await open(wide);
  await begin(page, 'Hydraulic piston 63', '42CrMo4-QT');
  await press(page, 'Remove d2');
  await write(page, 'Length of d1', '10');
  await write(page, 'Diameter of d1', '63');
  await write(page, 'Fit or limits of d1', 'f7');
  const add = async (kind, length, diameter, fit) => {
    await press(page, 'Add at the right end');
    const id = (await documentOf(page)).outer.at(-1).id;
    if (kind !== 'cylinder') await field(page, `Kind of ${id}`).selectOption(kind);
    await write(page, `${kind === 'groove' ? 'Width' : 'Length'} of ${id}`, length);
    await write(page, `${kind === 'groove' ? 'Floor diameter' : 'Diameter'} of ${id}`, diameter);
    if (fit) await write(page, `Fit or limits of ${id}`, fit);
  };
  await add('groove', '6.3', '53');
  await add('cylinder', '29.4', '63', 'f7');
  await add('groove', '6.3', '53');
  await add('cylinder', '10', '63', 'f7');
  await page.getByText('Bores, from their end inwards').click();
  await press(page, 'Add a bore from the right');
  await types(page, '12', '35', '', '3.2');
  await press(page, 'Add a bore from the right');
  await types(page, '50', '25', 'H7', '1.6');
  await press(page, 'Chamfer at bore b1 at the right');
  await write(page, 'Batch [parts]', '20');
  await drawn(page);
  await page.getByText('Faces', { exact: false }).last().click();
  await write(page, 'Ra of face b1|b2 [µm]', '3.2'); // the bottom of the counterbore
  await drawn(page);
  const part = await documentOf(page);
  assert.deepEqual(part.faces, [{ id: 'b1|b2', Ra_um: 3.2 }]);
  assert.deepEqual(part.outer.map((e) => [e.kind, e.length_mm, e.diameter_mm]), [
    ['cylinder', 10, 63], ['groove', 6.3, 53], ['cylinder', 29.4, 63], ['groove', 6.3, 53], ['cylinder', 10, 63]]);
  assert.deepEqual(part.edges, [{ at: 'right|b1', chamfer_mm: 1 }]);
  await page.keyboard.press('Control+Enter');
  await page.getByRole('heading', { name: 'Operations' }).waitFor();
  await look(page, 'piston-1400');
  await narrowed(page, 'piston-400');
  await reloaded(page);
  await page.context().close();
}

/** Holes that tools of a fixed size make: reamed from the right, tapped from the left. */
async function plug() {
  const page = await open(wide);
  await begin(page, 'Drilled plug', 'C45');
  for (const [label, value] of [['Length of d1', '40'], ['Diameter of d1', '50'], ['Length of d2', '30'], ['Diameter of d2', '40'],
    ['Fit or limits of d2', 'h6'], ['Ra of d2', '0.4'], ['Grinding allowance of d2', '0.25']])
    await write(page, label, value);
  await page.getByText('Bores, from their end inwards').click();
  await press(page, 'Add a bore from the right');
  await types(page, '22', '8', 'H7', '1.6');
  await field(page, 'Kind of b1').selectOption('hole');
  await press(page, 'Chamfer at bore b1 at the right');
  await press(page, 'Add a bore from the left');
  await types(page, '16', '10');
  await field(page, 'Kind of b2').selectOption('thread');
  await write(page, 'Diameter of b2', '3/8-16 UNC');
  await drawn(page);
  await page.getByText('Centre holes', { exact: true }).click();
  assert.equal(await page.getByText(/^The (left|right) end is hollow/).count(), 2);
  const part = await documentOf(page);
  assert.deepEqual(part.inner, [
    { id: 'b1', kind: 'hole', from: 'right', length_mm: 22, fit: 'H7', Ra_um: 1.6, diameter_mm: 8 },
    { id: 'b2', kind: 'thread', from: 'left', length_mm: 16, designation: '3/8-16 UNC' }]);
  assert.equal(part.outer[1].grinding_allowance_mm, 0.25);
  assert.deepEqual(part.edges, [{ at: 'right|b1', chamfer_mm: 1 }]);
  await plan(page);
  for (const tool of ['REAM-HSS-H7', 'TAP-HSS-2B', 'CSINK-HSS-90']) assert.ok(await page.getByText(tool).count(), tool);
  await look(page, 'plug-1400');
  await narrowed(page, 'plug-400');
  await reloaded(page);
  await page.context().close();
}

await Promise.all([inTurn(shaft), inTurn(bush, piston, plug)]);
await close();
