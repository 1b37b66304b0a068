import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load, part, projectFile } from './load.mjs';

const { ends, entries, freshId, grindable, inserted, moved, places, removed, renamed, knurlable, knurls, reshaped, threaded } = await load('elements');

const stepped = () => ({
  own: { kept: true },
  outer: [
    { id: 'd1', kind: 'cylinder', length_mm: 10, diameter_mm: 30, note: 'mine' },
    { id: 'd2', kind: 'cylinder', length_mm: 20, diameter_mm: 40 },
    { id: 'd3', kind: 'cylinder', length_mm: 30, diameter_mm: 50 },
  ],
  edges: [{ at: 'd1|d2', chamfer_mm: 1 }, { at: 'd2|d3', undercut: 'E0.8x0.3' }, { at: 'left', chamfer_mm: 1 }],
  faces: [{ id: 'd2|d3', Ra_um: 1.6 }],
  tolerances: [{ id: 't1', kind: 'coaxiality', of: 'd3', datum: 'd1', value_mm: 0.01 }, { id: 't2', kind: 'length', between: ['left', 'd1|d2'], limits_mm: [-1, 1] }],
  milling: [{ id: 'k1', kind: 'keyway', on: 'd2', z_mm: 12 }],
});
const at = (p) => p.edges.map((e) => e.at);

test('an insertion keeps every demand: the step goes on with the element behind', () => {
  const { part: next, id, lost } = inserted(stepped(), 'outer', 1, 'cylinder');
  assert.equal(id, 'd4');
  assert.deepEqual(next.outer.map((e) => e.id), ['d1', 'd4', 'd2', 'd3']);
  assert.equal(next.outer[1].diameter_mm, 30);
  assert.deepEqual(at(next), ['d4|d2', 'd2|d3', 'left']);
  assert.deepEqual(next.tolerances[1].between, ['left', 'd4|d2']);
  assert.deepEqual(lost, []);
});

test('an insertion that divides a step takes its edge away and says so', () => {
  const { part: next, lost } = inserted(stepped(), 'outer', 1, 'groove');
  assert.deepEqual(at(next), ['d2|d3', 'left']);
  assert.deepEqual(lost, ['chamfer d1|d2', 'tolerance t2']);
});

test('a removal takes along what named the element, and nothing else', () => {
  const { part: next, lost } = removed(stepped(), 'outer', 1);
  assert.deepEqual(next.outer.map((e) => e.id), ['d1', 'd3']);
  assert.deepEqual(lost, ['chamfer d1|d2', 'undercut d2|d3', 'roughness of d2|d3', 'tolerance t2', 'keyway k1']);
  assert.deepEqual(at(next), ['left']);
  assert.deepEqual(next.tolerances.map((t) => t.id), ['t1']);
  assert.deepEqual(next.own, { kept: true });
});

test('documents are never changed in place', () => {
  const before = stepped(), text = JSON.stringify(before);
  inserted(before, 'outer', 1, 'cylinder');
  removed(before, 'outer', 0);
  moved(before, 'outer', 0, 1);
  renamed(before, 'outer', 0, 'neck');
  reshaped(before, 'outer', 0, 'thread');
  assert.equal(JSON.stringify(before), text);
});

test('there and back again is the same contour', () => {
  const there = moved(stepped(), 'outer', 0, 1);
  assert.deepEqual(there.part.outer.map((e) => e.id), ['d2', 'd1', 'd3']);
  assert.deepEqual(moved(there.part, 'outer', 1, -1).part.outer, stepped().outer);
  assert.deepEqual(moved(stepped(), 'outer', 0, -1).part, stepped());
  assert.deepEqual(moved(stepped(), 'outer', 2, 1).part, stepped());
});

test('a move loses only edges of neighbours that are no more', () => {
  const { part: next, lost } = moved(stepped(), 'outer', 0, 1);
  assert.deepEqual(at(next), ['left']);
  assert.deepEqual(lost, ['chamfer d1|d2', 'undercut d2|d3', 'roughness of d2|d3', 'tolerance t2']);
  assert.deepEqual(next.milling, stepped().milling);
});

test('another name stands wherever the old one stood', () => {
  const next = renamed(stepped(), 'outer', 1, 'seat');
  assert.ok(!JSON.stringify(next).includes('d2'));
  assert.deepEqual(at(next), ['d1|seat', 'seat|d3', 'left']);
  assert.equal(next.milling[0].on, 'seat');
  assert.equal(JSON.stringify(renamed(next, 'outer', 1, 'd2')), JSON.stringify(stepped()));
});

test('names that the contour never had are left for the planner to refuse', () => {
  const odd = { ...stepped(), edges: [{ at: 'x|y', chamfer_mm: 1 }, null, 7] };
  assert.deepEqual(removed(odd, 'outer', 0).part.edges, odd.edges);
});

test('another kind keeps name, length, roughness and unknown members, not the old shape', () => {
  const cone = reshaped(stepped(), 'outer', 0, 'cone').outer[0];
  assert.deepEqual(Object.keys(cone).sort(), ['id', 'kind', 'left_mm', 'length_mm', 'note', 'right_mm']);
  const thread = reshaped({ outer: [{ id: 'a', kind: 'cylinder', length_mm: 5, diameter_mm: 20, fit: 'h7' }] }, 'outer', 0, 'thread').outer[0];
  assert.deepEqual(thread, { id: 'a', kind: 'thread', length_mm: 5, diameter_mm: 20, pitch_mm: 1.5 });
});

test('what turning leaves for grinding goes with the kinds that the planner lets be ground', () => {
  const schema = JSON.parse(projectFile('schemas/part.json'));
  for (const side of ['outer', 'inner'])
    for (const of of schema.definitions[side].oneOf) {
      const kind = of.properties.kind.const;
      assert.equal(grindable({ kind }), 'grinding_allowance_mm' in of.properties, `${side} ${kind}`);
      const one = { [side]: [{ id: 'a', kind: 'cylinder', from: 'left', length_mm: 5, diameter_mm: 20, fit: 'h7', grinding_allowance_mm: 0.3 }] };
      const next = reshaped(one, side, 0, kind)[side][0];
      for (const key of Object.keys(next)) assert.ok(key in of.properties || (side === 'outer' && key === 'from'), `${kind}: ${key}`);
      assert.equal(next.grinding_allowance_mm, grindable({ kind }) ? 0.3 : undefined);
    }
});

test('knurls are those of the planner and stay with outer cylinders', () => {
  const source = projectFile('src/part/cut.cpp');
  const types = [...source.matchAll(/\{"(R[A-Z]{2})", KnurlType::/g)].map((m) => m[1]);
  const pitches = source.match(/kKnurlPitches_mm\{([^}]*)\}/)[1].split(',').map(Number);
  assert.deepEqual(knurls, types.flatMap((t) => pitches.map((p) => `${t}${p}`)));
  const schema = JSON.parse(projectFile('schemas/part.json'));
  for (const side of ['outer', 'inner'])
    for (const of of schema.definitions[side].oneOf)
      assert.equal(knurlable({ kind: of.properties.kind.const }, side), 'knurl' in of.properties);
  const part = { outer: [{ id: 'a', kind: 'cylinder', length_mm: 5, diameter_mm: 20, knurl: 'RAA0.8' }] };
  assert.equal('knurl' in reshaped(part, 'outer', 0, 'cone').outer[0], false);
});

test('what stays as the stock is has its diameter, through the corners of a hexagon, and nothing else of its own', () => {
  const bar = { stock: { kind: 'hexagon', across_flats_mm: 27 }, outer: [{ id: 'd1', kind: 'cylinder', length_mm: 8, diameter_mm: 20, fit: 'h7', Ra_um: 1.6 }] };
  const kept = reshaped(bar, 'outer', 0, 'as-stock');
  assert.deepEqual(kept.outer[0], { id: 'd1', kind: 'as-stock', length_mm: 8 });
  assert.ok(Math.abs(ends(entries(kept, 'outer')[0])[0] - 31.1769) < 1e-4);
  assert.equal(ends(entries({ ...kept, stock: { kind: 'bar', diameter_mm: 30 } }, 'outer')[0])[0], 30);
  assert.equal(Math.round(reshaped(kept, 'outer', 0, 'cylinder').outer[0].diameter_mm), 31);
});

test('a hole that was bored keeps its class', () => {
  const bored = { inner: [{ id: 'b1', kind: 'cylinder', from: 'left', length_mm: 5, diameter_mm: 10, fit: 'H7' }] };
  assert.equal(reshaped(bored, 'inner', 0, 'hole').inner[0].fit, 'H7');
  assert.equal(reshaped(bored, 'inner', 0, 'thread').inner[0].fit, undefined);
});

test('a thread is typed as a diameter or as its designation', () => {
  const screw = { outer: [{ id: 't', kind: 'thread', length_mm: 20, diameter_mm: 24, pitch_mm: 1.5, fit: '6g' }] };
  const typed = (part, size) => threaded(part, 'outer', 0, size).outer[0];
  const rest = { id: 't', kind: 'thread', length_mm: 20, fit: '6g' };
  assert.deepEqual(typed(screw, '30,5'), { ...rest, diameter_mm: 30.5, pitch_mm: 1.5 });
  for (const text of ['M24x2', '1/2-13 UNC', '#10-24 UNC']) {
    const named = threaded(screw, 'outer', 0, text);
    assert.deepEqual(named.outer[0], { ...rest, designation: text });
    assert.deepEqual(typed(named, '30'), { ...rest, diameter_mm: 30 });
  }
  assert.deepEqual(typed(screw, undefined), { ...rest, pitch_mm: 1.5 });
});

test('a first element, a first bore and a first groove need nothing before them', () => {
  const one = inserted({}, 'outer', 0, 'cylinder').part;
  assert.equal(one.outer[0].diameter_mm, 30);
  const bored = inserted(one, 'inner', 0, 'cylinder', 'left').part;
  assert.deepEqual([bored.inner[0].from, bored.inner[0].diameter_mm], ['left', 15]);
  assert.equal(inserted(one, 'outer', 1, 'groove').part.outer[1].diameter_mm, 27);
});

test('new names are free, whatever else has one', () => {
  assert.equal(freshId({ outer: [{ id: 'd1' }, { id: 'd3' }, null], tolerances: [{ id: 'd2' }] }, 'd'), 'd4');
});

test('diameters come from every kind', () => {
  assert.deepEqual(ends({ designation: 'M30x1.5' }), [30, 30]);
  // ASME B1.1: 1/2 in; 1 1/4 in; number 10 is 0.190 in; 0.25 in
  for (const [text, mm] of [['1/2-13 UNC', 12.7], ['1-1/4-7', 31.75], ['1 1/4-7 UNC', 31.75], ['#10-24 UNC', 4.826], ['.25-20', 6.35], ['1-8 UNC-2A', 25.4]])
    assert.deepEqual(ends({ designation: text }), [mm, mm], text);
  assert.deepEqual(ends({ designation: 'Tr20x4' }), [NaN, NaN]);
  assert.deepEqual(ends({ left_mm: 3, right_mm: 4 }), [3, 4]);
  assert.deepEqual(ends({}), [NaN, NaN]);
});

test('every name that the shipped parts use is a place', () => {
  for (const id of ['motor-shaft', 'flanged-bush', 'drilled-bush', 'iron-hub', 'threaded-spindle']) {
    const document = part(id), all = places(document);
    const named = [...(document.edges ?? []).map((e) => e.at), ...(document.faces ?? []).map((f) => f.id),
      ...(document.tolerances ?? []).flatMap((t) => [t.of, t.datum, ...(t.between ?? [])])].filter(Boolean);
    for (const name of named) assert.ok(all.has(name), `${id}: ${name}`);
  }
});
