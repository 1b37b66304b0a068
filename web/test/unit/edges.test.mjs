import assert from 'node:assert/strict';
import { readdirSync } from 'node:fs';
import { test } from 'node:test';
import { load, part, projectFile } from './load.mjs';

const { edgeIndex, edgePlaces, threadForms, undercutOf, undercuts, withEdge } = await load('edges');
const parts = readdirSync(process.env.TURNWRIGHT_ROOT ? `${process.env.TURNWRIGHT_ROOT}/parts` : new URL('../../../parts', import.meta.url));

test('every edge of the shipped parts is at a place where it may be', () => {
  let seen = 0;
  for (const file of parts) {
    const document = part(file.replace('.json', '')), all = edgePlaces(document);
    for (const e of document.edges ?? []) {
      const place = all.find((p) => p.at === e.at);
      assert.ok(place, `${file}: ${e.at}`);
      const kind = e.chamfer_mm ? 'chamfer' : e.radius_mm ? 'radius' : e.undercut ? 'undercut' : 'fillet';
      assert.ok(place[kind], `${file}: ${kind} ${e.at}`);
      seen += 1;
    }
  }
  assert.ok(seen >= 15);
});

test('undercuts are those of the planner', () => {
  const number = '([\\d.]+)';
  const row = new RegExp(`Undercut\\{${[number, number, number, number].join(',\\s*')}\\}`, 'g');
  const source = projectFile('src/part/drawing.cpp');
  const rad = (deg) => (deg * Math.PI) / 180;
  const leans = { E: 0, F: 8, G: (90 - 55) / 2, H: (90 - 60) / 2 };
  let seen = 0;
  for (const [name, forms] of Object.entries({ F: 'EF', G: 'G', H: 'H' })) {
    const begins = source.indexOf(`kUndercuts${name}{`);
    const table = [...source.slice(begins, source.indexOf('}};', begins) + 2).matchAll(row)].map(([, ...row]) => row.map(Number));
    for (const form of forms)
      for (const [radius, depth, width, recess] of table) {
        assert.deepEqual(undercuts[`${form}${radius}x${depth}`], {
          radius, depth, width, recess: form === 'E' ? 0 : recess, falls: rad(form === 'G' ? 17.5 : 15), leans: rad(leans[form]) });
        seen += 1;
      }
  }
  assert.equal(seen, 2 * 12 + 3);
  assert.equal(Object.keys(undercuts).length, seen);
});

test('undercuts of threads are those of the planner', () => {
  const number = '([\\d.]+)';
  const source = projectFile('src/part/drawing.cpp');
  const row = new RegExp(`\\{${[number, number, number, number, number].join(',\\s*')}\\}`, 'g');
  const table = [...source.slice(source.indexOf('kThreadUndercuts')).matchAll(row)].map(([, ...row]) => row.map(Number));
  assert.equal(table.length, 18);
  for (const [pitch, reduced, a, b, radius] of table)
    [a, b].forEach((width, k) => assert.deepEqual(undercutOf(threadForms[k], pitch),
      { radius, depth: reduced / 2, width, recess: 0, falls: (30 * Math.PI) / 180, leans: 0 }));
  assert.equal(undercutOf('DIN 76-A', 1.6), undefined);
  assert.equal(undercutOf('E0.8x0.3'), undercuts['E0.8x0.3']);
  const e = (id, kind, d) => ({ id, kind, length_mm: 20, diameter_mm: d });
  const places = edgePlaces({ outer: [e('a', 'cylinder', 30), e('b', 'cylinder', 20), e('t', 'thread', 16)] });
  assert.deepEqual(places.map((p) => Boolean(p.thread)), [false, false, true, false]);
});

test('no edge stands where there is no step, nor at arcs; at grooves only chamfers do', () => {
  const e = (id, kind, d) => ({ id, kind, length_mm: 5, diameter_mm: d });
  const names = edgePlaces({ outer: [e('a', 'cylinder', 20), e('b', 'cylinder', 20), e('g', 'groove', 15), e('c', 'cylinder', 20)] }).map((p) => p.at);
  assert.deepEqual(names, ['left', 'b|g', 'g|c', 'right']);
  const all = edgePlaces({ outer: [e('b', 'cylinder', 20), e('g', 'groove', 15), { ...e('a', 'arc'), left_mm: 20, right_mm: 10 }] });
  assert.deepEqual(all.map((p) => p.at), ['left', 'b|g']);
  assert.deepEqual([all[1].chamfer, all[1].radius, all[1].fillet, all[1].undercut], [true, false, false, false]);
});

test('edges of cylinders may be rounded, those of threads and holes not', () => {
  const e = (id, kind, d) => ({ id, kind, length_mm: 20, diameter_mm: d });
  const places = edgePlaces({ outer: [e('a', 'thread', 20), e('b', 'cylinder', 30)], inner: [{ ...e('h', 'hole', 8), from: 'right' }] });
  assert.deepEqual(places.map((p) => [p.at, p.radius]), [['left', false], ['a|b', true], ['right', true], ['right|h', false]]);
});

test('a radius stands beside nothing else in its entry and goes with it', () => {
  const rounded = withEdge({ edges: [] }, 'a|b', 'radius_mm', 2);
  assert.deepEqual(rounded.edges, [{ at: 'a|b', radius_mm: 2 }]);
  assert.equal(edgeIndex(rounded, 'b|a', 'radius_mm'), 0);
  assert.deepEqual(withEdge(rounded, 'a|b', 'radius_mm', undefined).edges, []);
});

test('a hole that is drilled has a chamfer where it begins', () => {
  const outer = [{ id: 'a', kind: 'cylinder', length_mm: 40, diameter_mm: 40 }];
  const hole = (kind) => ({ outer, inner: [{ id: 'b', kind: 'cylinder', from: 'right', length_mm: 10, diameter_mm: 20 }, { id: 'h', kind, from: 'right', length_mm: 10, diameter_mm: 8 }] });
  const chamfers = (kind) => edgePlaces(hole(kind)).filter((p) => p.chamfer).map((p) => p.at);
  assert.deepEqual(chamfers('hole'), ['left', 'right', 'h|b', 'right|b']);
  assert.deepEqual(chamfers('groove'), ['left', 'right', 'right|b']);
  assert.ok(edgePlaces({ outer, inner: [hole('hole').inner[1]] }).some((p) => p.at === 'right|h' && p.chamfer));
});

test('holes of both ends share an edge only where they meet', () => {
  const bore = (id, from, d, length) => ({ id, kind: 'cylinder', from, length_mm: length, diameter_mm: d });
  const part = (length) => ({ outer: [{ id: 'a', kind: 'cylinder', length_mm: 40, diameter_mm: 40 }], inner: [bore('l', 'left', 20, 10), bore('r', 'right', 16, length)] });
  const inside = (length) => edgePlaces(part(length)).map((p) => p.at).slice(2);
  assert.deepEqual(inside(29), ['left|l', 'right|r']);
  assert.deepEqual(inside(30), ['left|l', 'l|r', 'right|r']);
});

test('the chamfer is on what stands: out of the larger shaft, into the smaller bore', () => {
  const e = (id, kind, d, from) => ({ id, kind, length_mm: 5, from, ...(kind === 'cone' ? { left_mm: d, right_mm: d } : { diameter_mm: d }) });
  const shaft = edgePlaces({ outer: [e('a', 'cone', 30), e('b', 'cylinder', 20)] }).find((p) => p.at === 'a|b');
  assert.deepEqual([shaft.chamfer, shaft.undercut], [false, true]);
  const bore = edgePlaces({ outer: [e('a', 'cylinder', 90), e('z', 'cylinder', 90)], inner: [e('b', 'cylinder', 30, 'right'), e('c', 'cone', 20, 'right')] });
  assert.deepEqual(bore.filter((p) => p.at === 'c|b').map((p) => [p.chamfer, p.undercut]), [[false, false]]);
});

test('an edge is written, changed and taken away, and its neighbours stay', () => {
  const before = { edges: [{ at: 'd1|d2', fillet_mm: 0.8 }] };
  const one = withEdge(before, 'd1|d2', 'chamfer_mm', 1);
  assert.deepEqual(one.edges, [{ at: 'd1|d2', fillet_mm: 0.8 }, { at: 'd1|d2', chamfer_mm: 1 }]);
  const steep = withEdge(one, 'd1|d2', 'angle_deg', 30);
  assert.deepEqual(steep.edges[1], { at: 'd1|d2', chamfer_mm: 1, angle_deg: 30 });
  assert.deepEqual(withEdge(steep, 'd1|d2', 'angle_deg', undefined), one);
  assert.deepEqual(withEdge(one, 'd1|d2', 'chamfer_mm', undefined), before);
  assert.deepEqual(withEdge({}, 'left', 'angle_deg', 30), {});
});

test('bores may be named from either side', () => {
  const document = { edges: [{ at: 'cb|bore', chamfer_mm: 1 }] };
  assert.equal(edgeIndex(document, 'bore|cb', 'chamfer_mm'), 0);
});
