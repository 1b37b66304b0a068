import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load, projectFile } from './load.mjs';

const { controlOf, controls, learnRequest, partOnDesk, readTurret, reviewRequest } = await load('foreign');

test('controls are those of the planner, in its words', () => {
  const source = projectFile('src/gcode/dialect.cpp');
  const ids = [...source.matchAll(/\.id = "([^"]+)"/g)].map(([, id]) => id);
  const names = [...source.matchAll(/\.name = "([^"]+)"/g)].map(([, name]) => name);
  assert.equal(ids.length, 7);
  assert.deepEqual(controls.map((c) => c.id), ids);
  assert.deepEqual(controls.map((c) => c.name), names);
});

test('a program is taken for the control that its file is called for', () => {
  const of = Object.fromEntries(['a.ngc', 'B.MPF', 'c.min', 'd.nc', 'O1234', 'e.txt'].map((name) => [name, controlOf(name)]));
  assert.deepEqual(of, { 'a.ngc': 'linuxcnc', 'B.MPF': 'siemens', 'c.min': 'okuma', 'd.nc': 'fanuc', O1234: 'fanuc', 'e.txt': 'fanuc' });
});

test('a turret is a number, an id and a size in each line', () => {
  assert.deepEqual(readTurret('1 PCLNL-CNMG120408-PM\n\n T2=DRILL-HM-5D 19 mm\n3: GROOVE-EXT 2,5'), {
    tools: [
      { number: 1, id: 'PCLNL-CNMG120408-PM' }, { number: 2, id: 'DRILL-HM-5D', size_mm: 19 },
      { number: 3, id: 'GROOVE-EXT', size_mm: 2.5 },
    ],
    wrong: [],
  });
  assert.deepEqual(readTurret('one PCLNL\n4').wrong, ['one PCLNL', '4']);
});

test('programs are of setups that follow each other', () => {
  const part = { name: 'pin' };
  const two = [{ name: 'a', text: 'G0' }, { name: 'b', text: 'G1' }];
  assert.deepEqual(reviewRequest(part, 'haas', two, [], 1), {
    part, control: 'haas', programs: [{ setup: 1, text: 'G0' }, { setup: 2, text: 'G1' }],
  });
  assert.deepEqual(reviewRequest(part, 'haas', two, [{ number: 1, id: 'T' }]).tools, [{ number: 1, id: 'T' }]);
});

test('results are one table, or files of QIF', () => {
  const table = { name: 'pin.csv', text: 'part,d1\n1,2\n' };
  const qif = { name: 'pin.qif', text: '<QIFDocument/>' };
  const part = { name: 'pin' };
  assert.deepEqual(learnRequest([table], part), { request: { part, csv: table.text } });
  assert.deepEqual(learnRequest([qif, { name: 'b.xml', text: ' <a/>' }]), { request: { qif: { files: [qif.text, ' <a/>'] } } });
  assert.match(learnRequest([table, qif]).why, /two requests/);
  assert.match(learnRequest([table, table]).why, /2 tables/);
});

test('the part is the draft of this tab', () => {
  const store = (entries) => ({ getItem: (key) => entries[key] ?? null });
  const kept = store({ 'turnwright-draft:x': JSON.stringify({ id: 'x', changed: 1, part: { name: 'pin' } }) });
  assert.deepEqual(partOnDesk(kept, store({ 'turnwright-draft': 'x' })), { name: 'pin' });
  assert.equal(partOnDesk(kept, store({})), undefined);
  assert.equal(partOnDesk(store({}), store({ 'turnwright-draft': 'x' })), undefined);
});
