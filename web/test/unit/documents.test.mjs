import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load } from './load.mjs';

const { demandOf, demandText } = await load('demand');
const { fitting, stockFollows } = await load('stock');
const { begun, redone, stepped, undone } = await load('history');
const { readDropped } = await load('dropped');
const { machinesOf, shopsTools, ticked, toolsOf, withDocuments, withMachines, withTools } = await load('means');
const { goingThrough, withMilled } = await load('milled');
const { handy, withSetup, written } = await load('setups');
const { at, put } = await load('pointer');
const { reformed } = await load('tolerances');

test('a demand is a fit or limits, as drawings write them', () => {
  const rows = [
    ['k6', { fit: 'k6' }], ['+0.02/-0.01', { limits_mm: [-0.01, 0.02] }], ['0/-0.1', { limits_mm: [-0.1, 0] }],
    ['±0.05', { limits_mm: [-0.05, 0.05] }], ['+-0,05', { limits_mm: [-0.05, 0.05] }], ['-0.02 0.03', { limits_mm: [-0.02, 0.03] }],
    ['', {}], ['rubbish', { fit: 'rubbish' }], ['+0.1/−0.2', { limits_mm: [-0.2, 0.1] }],
  ];
  for (const [text, demand] of rows) assert.deepEqual(demandOf(text), demand, text);
});

test('the text of a demand is read as the same demand', () => {
  for (const demand of [{ fit: 'H7' }, { limits_mm: [-0.1, 0] }, { limits_mm: [-0.05, 0.05] }, { limits_mm: [0.01, 0.03] }, {}])
    assert.deepEqual(demandOf(demandText(demand)), demand);
});

const shaft = (length, diameter) => ({ outer: [{ id: 'd1', kind: 'cylinder', length_mm: length, diameter_mm: diameter }] });

test('stock is what import takes for the same contour', () => {
  // turnwright import of "d50 h7 x 40; 1x45; d30 k6 x 32": bar 52 x 76.
  const part = { outer: [...shaft(40, 50).outer, ...shaft(32, 30).outer] };
  assert.deepEqual(fitting(part), { kind: 'bar', diameter_mm: 52, length_mm: 76, left_allowance_mm: 2 });
  assert.equal(fitting(shaft(10, 300)).diameter_mm, 310);
  assert.equal(fitting({}), undefined);
  const kept = { stock: { kind: 'bar', diameter_mm: 30 }, outer: [{ id: 'd1', kind: 'as-stock', length_mm: 10 }, { id: 'd2', kind: 'cylinder', length_mm: 5, diameter_mm: 20 }] };
  assert.deepEqual(fitting(kept), { length_mm: 19, left_allowance_mm: 2 });
  assert.equal(fitting(shaft(NaN, 20)), undefined);
});

test('stock that fitted follows the contour, stock written by hand stays', () => {
  const fitted = { ...shaft(40, 50), stock: { ...fitting(shaft(40, 50)), price: 7 } };
  assert.deepEqual(stockFollows(fitted, { ...fitted, ...shaft(60, 60) }).stock, { ...fitting(shaft(60, 60)), price: 7 });
  const byHand = { ...fitted.stock, length_mm: 99 };
  assert.equal(stockFollows(fitted, { ...fitted, ...shaft(60, 60), stock: byHand }).stock, byHand);
  const own = { ...shaft(40, 50), stock: { kind: 'bar', diameter_mm: 80, length_mm: 44, left_allowance_mm: 2 } };
  assert.equal(stockFollows(own, { ...own, ...shaft(60, 60) }).stock, own.stock);
});

test('a change at a pointer shares all beside it, makes what is missing, takes members away', () => {
  const before = { a: [{ b: 1 }, { 'c/d': 2 }], e: { f: 3 } };
  const next = put(before, '/a/1/c~1d', 5);
  assert.deepEqual(next, { a: [{ b: 1 }, { 'c/d': 5 }], e: { f: 3 } });
  assert.equal(next.e, before.e);
  assert.equal(next.a[0], before.a[0]);
  assert.equal(before.a[1]['c/d'], 2);
  assert.deepEqual(put(before, '/a/0', undefined).a, [{ 'c/d': 2 }]);
  assert.deepEqual(put({}, '/rates/price', 4), { rates: { price: 4 } });
  assert.equal(at(next, '/a/1/c~1d'), 5);
  assert.equal(at(next, '/a/7/x'), undefined);
});

test('stock follows an edit of one field', () => {
  const fitted = { ...shaft(40, 50), stock: fitting(shaft(40, 50)) };
  assert.equal(stockFollows(fitted, put(fitted, '/outer/0/length_mm', 50)).stock.length_mm, 54);
});

test('undo goes back through every document, redo forth again', () => {
  let h = begun(0);
  for (let i = 1; i <= 5; ++i) h = stepped(h, i);
  const back = Array.from({ length: 7 }, () => (h = undone(h)).now);
  assert.deepEqual(back, [4, 3, 2, 1, 0, 0, 0]);
  const forth = Array.from({ length: 7 }, () => (h = redone(h)).now);
  assert.deepEqual(forth, [1, 2, 3, 4, 5, 5, 5]);
  h = stepped(undone(h), 9);
  assert.deepEqual([h.now, h.future], [9, []]);
});

test('one machine is the part’s, several are left to choose, none is the default', () => {
  const part = { machine: 'a', choose: { setups: 'auto' } };
  const two = withMachines(part, ticked(machinesOf(part), 'b', true));
  assert.deepEqual(two, { choose: { setups: 'auto', machine: ['a', 'b'] } });
  assert.deepEqual(withMachines(two, ticked(machinesOf(two), 'a', false)), { choose: { setups: 'auto' }, machine: 'b' });
  assert.deepEqual(withMachines({ machine: 'a' }, []), {});
});

test('the shop’s tools are no list, the whole catalogue is a word; documents of the part’s own stay', () => {
  const own = { format: 'turnwright-tool/1', id: 'x' };
  const shop = ['a', 'b'], all = ['a', 'b', 'x'];
  assert.deepEqual(withTools({ tools: ['a'] }, ['b', 'a'], shop, all), {});
  assert.deepEqual(withTools({}, ['x', 'b', 'a'], shop, all), { tools: 'all' });
  assert.deepEqual(toolsOf({}, shop, all), shop);
  assert.deepEqual(toolsOf({ tools: 'all' }, shop, all), all);
  assert.deepEqual(toolsOf(withTools({}, [own, 'b'], shop, all), shop, all), [own, 'b']);
  const shops = [{ id: 'workshop', tools: ['x', 'b'] }, { id: 'bare' }];
  assert.deepEqual(shopsTools({}, shops, all), ['b', 'x']);
  assert.deepEqual(shopsTools({ shop: { id: 'own', tools: ['a'] } }, shops, all), ['a']);
  for (const shop of ['bare', 'unknown']) assert.deepEqual(shopsTools({ shop }, shops, all), all);
  assert.deepEqual(ticked([own, 'b'], 'x', false), ['b']);
});

test('a new keyway lies inside its cylinder', () => {
  for (const [length, diameter] of [[60, 35], [10, 35], [200, 12], [30, 300]]) {
    const part = { outer: [...shaft(17, 20).outer, { ...shaft(length, diameter).outer[0], id: 'd2' }] };
    for (const kind of ['keyway', 'slot', 'flat']) {
      const m = withMilled(part, kind, 'd2').milling[0];
      assert.ok(m.z_mm >= 17 - 0.051 && m.z_mm + m.length_mm <= 17 + length + 0.051, `${kind} on ${length}`);
      assert.equal('width_mm' in m, kind !== 'flat');
    }
  }
  const hole = withMilled({ outer: shaft(60, 35).outer }, 'cross-hole', shaft(60, 35).outer[0].id).milling[0];
  assert.deepEqual([hole.at_mm, hole.diameter_mm, hole.through], [30, 10, 'part']);
  const none = shaft(10, 20);
  assert.equal(withMilled(none, 'flat', 'nowhere'), none);
});

test('a cross hole goes through something or to a depth', () => {
  const hole = { id: 'h1', diameter_mm: 6, through: 'wall' };
  assert.deepEqual(goingThrough(hole, undefined), { id: 'h1', diameter_mm: 6, depth_mm: 6 });
  assert.deepEqual(goingThrough({ id: 'h1', diameter_mm: 6, depth_mm: 9 }, 'part'), { id: 'h1', diameter_mm: 6, through: 'part' });
});

test('jaws that are dragged write the setups that were not written', () => {
  const drawing = { setups: [{ hold: 'left', grip_mm: 15, jaws_z_mm: 13, clampings: ['chuck'] }, { hold: 'right', grip_mm: 20, jaws_z_mm: 60, clampings: ['chuck'] }] };
  const next = withSetup({ choose: { setups: 'auto' }, own: 1 }, drawing, 1, 'grip_mm', 24.5);
  assert.deepEqual(next, { own: 1, setups: [{ hold: 'left' }, { hold: 'right', grip_mm: 24.5 }] });
  assert.equal(written(next, drawing), next);
  assert.deepEqual([handy(3.3, 0.5, 9), handy(-4, 0.5, 9), handy(99, 0.5, 9)], [3.5, 0.5, 9]);
});

test('a tolerance of another kind has that kind’s members', () => {
  const runout = { id: 't', kind: 'total-radial-runout', of: 'd3', datum: 'd2', value_mm: 0.04, own: 1 };
  assert.deepEqual(reformed(runout, 'circularity'), { id: 't', own: 1, kind: 'circularity', of: 'd3', value_mm: 0.04 });
  assert.deepEqual(reformed(runout, 'length'), { id: 't', own: 1, kind: 'length', between: ['left', 'right'], limits_mm: [-0.02, 0.02] });
  assert.deepEqual(reformed(reformed(runout, 'diameter'), 'circularity').value_mm, 0.04);
});

test('tools of a library take the place of those of their ids', () => {
  const part = withDocuments({ tools: ['A', 'B', { id: 'C', n: 1 }] }, [{ id: 'C', n: 2 }, { id: 'A' }]);
  assert.deepEqual(part.tools, ['B', { id: 'C', n: 2 }, { id: 'A' }]);
  assert.deepEqual(withDocuments({ name: 'x' }, [{ id: 'T' }]), { name: 'x', tools: [{ id: 'T' }] });
});

test('tool libraries are told from parts and drawings', () => {
  const kind = (name, text) => readDropped(name, typeof text === 'string' ? new TextEncoder().encode(text) : text).kind;
  assert.equal(kind('crib.json', '{"data": [], "version": 1}'), 'library');
  assert.equal(kind('bit.json', '{"parameter": {}}'), 'library');
  assert.equal(kind('crib.csv', 'insert;RE'), 'library');
  assert.deepEqual(readDropped('crib.tools', new Uint8Array([0x50, 0x4b, 3, 4, 0xff])), { kind: 'library', request: { base64: 'UEsDBP8=' } });
  assert.equal(kind('part.json', '{"name": "x"}'), 'part');
  assert.equal(kind('line.txt', 'd50 x 40'), 'drawing');
});
