import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load, projectFile } from './load.mjs';

const { centreAt, centreIndex, centreOf, centres, centresFor, centreText, isHollow, withCentre } = await load('centres');

const pin = (d = 40) => ({ outer: [{ id: 'd1', kind: 'cylinder', length_mm: 30, diameter_mm: d }, { id: 'd2', kind: 'thread', length_mm: 20, designation: 'M12' }] });

test('centre holes are those of the planner', () => {
  const source = projectFile('src/part/drawing.cpp');
  const number = '([\\d.]+)';
  const from = source.slice(source.indexOf('kCentreHoles{'), source.indexOf('kThreadUndercuts'));
  const table = [...from.matchAll(new RegExp(`\\{${[number, number, number, number].join(',\\s*')}\\}`, 'g'))].map(([, ...row]) => row.map(Number));
  assert.equal(table.length, 14);
  assert.equal(centres.length, 14 + 11 + 11);
  for (const [pilot, a, b] of table)
    for (const [form, widest] of b > 0 ? [['A', a], ['B', b], ['R', a]] : [['A', a]])
      assert.deepEqual(centreOf(`${form}${pilot}/${widest}`), { form, pilot, widest });
});

test('a designation is read in the words that the planner takes', () => {
  for (const text of ['A4/8.5', 'ISO 6411-A4/8.5', 'ISO6411 - A 4 / 8,5', 'DIN 332-A4x8.5', ' A4×8.5 '])
    assert.equal(centreText(centreOf(text)), 'A4/8.5', text);
  for (const text of ['B4/8.5', 'C4/8.5', 'A4', 'A4/8.6', 'M12', undefined, 7]) assert.equal(centreOf(text), undefined, text);
});

test('an end gets, changes and loses its centre hole; the other end and unknown members stay', () => {
  const one = withCentre(pin(), 'right', 'A2/4.25');
  assert.deepEqual(one.centre_holes, [{ at: 'right', designation: 'A2/4.25' }]);
  const two = withCentre({ ...one, centre_holes: [{ ...one.centre_holes[0], note: 'mine' }] }, 'left', 'B4/12.5');
  assert.equal(centreIndex(two, 'left'), 1);
  assert.deepEqual(withCentre(two, 'right', 'R2/4.25').centre_holes[0], { at: 'right', designation: 'R2/4.25', note: 'mine' });
  const left = withCentre(two, 'right', undefined);
  assert.deepEqual(left.centre_holes, [{ at: 'left', designation: 'B4/12.5' }]);
  assert.deepEqual(withCentre(left, 'left', undefined), pin());
  assert.deepEqual(withCentre(pin(), 'left', undefined), pin());
});

test('what an import or a hand has written is shown as the table has it, other texts as they stand', () => {
  assert.equal(centreAt({ centre_holes: [{ at: 'left', designation: 'ISO 6411-B2.5/8' }] }, 'left'), 'B2.5/8');
  assert.equal(centreAt({ centre_holes: [{ at: 'left', designation: 'Z9' }] }, 'left'), 'Z9');
  for (const odd of [undefined, null, 7, [null, 7, {}]]) assert.equal(centreAt({ centre_holes: odd }, 'left'), undefined);
});

test('those are offered that are less wide than their end', () => {
  const widest = (end, d) => Math.max(...centresFor(pin(d), end).map((text) => centreOf(text).widest));
  assert.equal(widest('left', 40), 28);
  assert.equal(widest('left', 28), 22.4);
  assert.equal(widest('right'), 10.6);
  assert.equal(centresFor({}, 'left').length, 36);
});

test('an end is hollow where a bore opens, and of a tube', () => {
  const bored = (length) => ({ ...pin(), inner: [{ id: 'b1', kind: 'cylinder', from: 'right', length_mm: length, diameter_mm: 5 }] });
  assert.deepEqual(['left', 'right'].map((end) => isHollow(bored(10), end)), [false, true]);
  assert.deepEqual(['left', 'right'].map((end) => isHollow(bored(50), end)), [true, true]);
  assert.ok(isHollow({ ...pin(), stock: { kind: 'tube' } }, 'left'));
});
