import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load, projectFile, random } from './load.mjs';

const { hole, profile, radii, rings } = await load('sheet/contour');
const { calloutRows, lengthRows, textWidth } = await load('sheet/dimensions');
const { centreHoles, countersinks_mm, milledShapes, sizeText } = await load('sheet/features');

const surface = (more) => ({ id: 'd1', side: 'outer', kind: 'cylinder', z_mm: [10, 50], diameters_mm: [30, 30], ...more });
const near = (a, b, what) => assert.ok(Math.abs(a - b) < 1e-9, `${what}: ${a} instead of ${b}`);

test('an arc runs on its circle from end to end, on the side it bulges to', () => {
  for (const convex of [true, false]) {
    const points = profile(surface({ kind: 'arc', radius_mm: 60, convex, diameters_mm: [30, 40] }));
    const [[z0, r0], [z1, r1]] = [points[0], points.at(-1)];
    assert.deepEqual([z0, r0, z1, r1], [10, 15, 50, 20]);
    // The centre is as far from three points as from all others.
    const [zm, rm] = points[Math.floor(points.length / 2)];
    const d = 2 * (z0 * (rm - r1) + zm * (r1 - r0) + z1 * (r0 - rm));
    const s = (z, r) => z * z + r * r;
    const cz = (s(z0, r0) * (rm - r1) + s(zm, rm) * (r1 - r0) + s(z1, r1) * (r0 - rm)) / d;
    const cr = (s(z0, r0) * (z1 - zm) + s(zm, rm) * (z0 - z1) + s(z1, r1) * (zm - z0)) / d;
    for (const [z, r] of points) near(Math.hypot(z - cz, r - cr), 60, 'radius');
    assert.equal(rm > 17.5, convex);
  }
});

test('a rounded edge is a quarter of a circle, in a bore it widens the mouth', () => {
  const apart = ([z, r], [cz, cr]) => Math.hypot(z - cz, r - cr);
  const left = profile(surface({ left_radius_mm: 2 })).slice(0, -1);
  assert.deepEqual([left[0], left.at(-1)].map((p) => p.map((x) => Math.round(1e9 * x) / 1e9)), [[10, 13], [12, 15]]);
  for (const p of left) assert.ok(Math.abs(apart(p, [12, 13]) - 2) < 1e-9);
  for (const p of profile(surface({ side: 'inner', right_radius_mm: 1 })).slice(1)) assert.ok(Math.abs(apart(p, [49, 16]) - 1) < 1e-9);
});

test('a chamfer takes its lengths of the corner, in a bore it widens the mouth', () => {
  assert.deepEqual(profile(surface({ left_chamfer_mm: [2, 1] })), [[10, 14], [12, 15], [50, 15]]);
  assert.deepEqual(profile(surface({ side: 'inner', right_chamfer_mm: [1, 1] })), [[10, 15], [49, 15], [50, 16]]);
});

test('an undercut is as deep and as wide as its designation says and falls at 15 deg', () => {
  const points = profile(surface({ left_undercut: 'E0.8x0.3' }));
  near(Math.min(...points.map((p) => p[1])), 15 - 0.3, 'floor');
  const [[za, ra], [zb, rb]] = points.slice(-3, -1);
  near(zb, 12.5, 'width');
  near(Math.atan((rb - ra) / (zb - za)), Math.PI / 12, 'slope');
  near(points[0][0], 10, 'foot of the wall');
  near(points[0][1], 15 + 0.8 - 0.3, 'end of the radius');
});

test('an undercut of form G goes into the wall as deep as into the surface', () => {
  const points = profile(surface({ left_undercut: 'G0.4x0.2' }));
  near(Math.min(...points.map((p) => p[1])), 15 - 0.2, 'floor');
  assert.ok(Math.abs(Math.min(...points.map((p) => p[0])) - (10 - 0.2)) < 0.005, 'deepest place');
  near(points[0][0], 10, 'back at the wall');
  const [[za, ra], [zb, rb]] = points;
  near(Math.atan((za - zb) / (ra - rb)), (17.5 * Math.PI) / 180, 'way back');
});

test('a knurl stands beside the diameter that it makes', () => {
  assert.equal(sizeText(surface({ knurl: 'RGE1.2', blank_mm: 29.2 })), '⌀30 DIN 82-RGE1.2');
});

test('a fillet is tangent to wall and surface', () => {
  const points = profile(surface({ right_fillet_mm: 2 })).slice(1);
  near(points[0][0], 48, 'on the surface');
  near(points.at(-1)[1], 17, 'on the wall');
  for (const [z, r] of points) near(Math.hypot(z - 48, r - 17), 2, 'radius');
});

test('the hole of a tube goes on where no bore is, a blind bore ends in the drill’s point', () => {
  const bore = surface({ id: 'b', side: 'inner', z_mm: [60, 100], diameters_mm: [20, 20] });
  const tube = hole({ length_mm: 100, stock: { inner_mm: 12 } }, [bore]);
  assert.deepEqual(tube, [[0, 6], [60, 6], [60, 10], [100, 10]]);
  const bar = hole({ length_mm: 100, stock: { inner_mm: 0 } }, [bore]);
  const tip = bar[1];
  near(Math.atan2(10, 60 - tip[0]), (59 * Math.PI) / 180, 'half the point');
  assert.deepEqual([bar[0], tip[1]], [[0, 0], 0]);
});

test('a step shows one edge, as large as its larger side; no step shows none', () => {
  const a = surface({ z_mm: [0, 10] }), b = surface({ z_mm: [10, 20], diameters_mm: [40, 40] });
  assert.deepEqual(rings([a, b]), [[0, 15], [10, 20], [20, 20]]);
  assert.deepEqual(rings([a, { ...b, diameters_mm: [30, 30] }]), [[0, 15], [20, 15]]);
});

test('an inner thread is bored to its minor diameter', () => {
  // M20 x 1.5: 18.376 mm in every table of ISO 724.
  const [r] = radii(surface({ side: 'inner', kind: 'thread', diameters_mm: [20, 20], pitch_mm: 1.5 }));
  assert.ok(Math.abs(2 * r - 18.376) < 5e-4);
});

test('no dimension runs over another, the shorter stand nearer', () => {
  const next = random(1);
  for (let round = 0; round < 200; ++round) {
    const width = 300 + 700 * next();
    const spans = Array.from({ length: 1 + Math.floor(12 * next()) }, (_, id) => {
      const [a, b] = [next() * width, next() * width].sort((p, q) => p - q);
      return { id: String(id), from: a, to: b + 1, text: (100 * next()).toFixed(2) };
    });
    const laid = lengthRows(spans, width);
    assert.equal(laid.length, spans.length);
    const box = (s) => [Math.min(s.from, s.at - textWidth(s.text) / 2), Math.max(s.to, s.at + textWidth(s.text) / 2)];
    for (const s of laid) for (const t of laid) {
      if (s === t || s.row !== t.row) continue;
      const [a, b] = [box(s), box(t)];
      assert.ok(a[1] <= b[0] + 1 || b[1] <= a[0] + 1, `${a} over ${b}`);
    }
  }
});

test('no callout lies over another and no line runs through a text', () => {
  const next = random(2);
  for (let round = 0; round < 200; ++round) {
    const width = 200 + 800 * next();
    const all = Array.from({ length: 20 }, (_, id) => ({
      id: String(id), rank: Math.floor(3 * next()), text: '⌀'.padEnd(3 + Math.floor(9 * next()), '8'), xs: [next() * width, next() * width],
    }));
    const laid = calloutRows(all, width, 4);
    assert.ok(laid.length > 3);
    for (const c of laid) {
      assert.ok(c.from >= 0 && c.to <= width + 1e-9 && c.row < 4 && c.xs.includes(c.x));
      for (const o of laid) {
        if (o === c) continue;
        if (o.row === c.row) assert.ok(o.to < c.from || c.to < o.from, 'texts');
        if (o.row > c.row) assert.ok(o.x < c.from || o.x > c.to, 'a line through a text');
      }
    }
  }
});

test('countersinks are those of the catalogue', () => {
  assert.deepEqual(countersinks_mm, JSON.parse(projectFile('tools/fixed/DIN333-A.json')).sizes_mm);
});

const drawing = (more) => ({
  length_mm: 100, stock: { inner_mm: 0 }, faces: [], elements: [surface({ z_mm: [0, 100] })],
  setups: [{ hold: 'left' }, { hold: 'right' }], ...more,
});

test('a centre hole that is asked for is drawn with its sizes, whatever clamps the part', () => {
  const asked = (designation) => centreHoles({ ...drawing(), faces: [{ id: 'left', z_mm: 0 }, { id: 'right', z_mm: 1, centre_hole: designation }] }, [['chuck'], ['chuck']]);
  const [b] = asked('ISO 6411-B4/12.5');
  assert.deepEqual([b.end, b.text, b.profile[0], b.profile[1][1]], ['right', 'B4/12.5', [0, 6.25], 4.25]);
  // 120 deg and 60 deg: half of what the radius takes, and 1.73 times.
  const near = (x, y) => assert.ok(Math.abs(x - y) < 1e-9, `${x} ${y}`);
  near(b.profile[1][0], 2 * Math.tan(Math.PI / 6));
  near(b.profile[2][0] - b.profile[1][0], 2.25 * Math.sqrt(3));
  assert.equal(asked('A4/8.5')[0].profile.length, 4);
});

test('centre holes are where every clamping has a centre, never in a hollow end', () => {
  const ends = (d, clampings) => centreHoles(d, clampings).map((h) => h.end);
  assert.deepEqual(ends(drawing(), [['between-centres'], ['chuck']]), ['left', 'right']);
  assert.deepEqual(ends(drawing(), [['chuck-tailstock'], ['chuck']]), ['right']);
  assert.deepEqual(ends(drawing(), [['chuck-tailstock', 'chuck'], ['chuck']]), []);
  assert.deepEqual(ends(drawing({ stock: { inner_mm: 10 } }), [['between-centres'], ['chuck']]), []);
  const bored = drawing({ elements: [surface({ z_mm: [0, 100] }), surface({ id: 'b', side: 'inner', z_mm: [80, 100] })] });
  assert.deepEqual(ends(bored, [['between-centres'], ['chuck']]), ['left']);
});

test('a flat is as wide as its chord, places without numbers are not drawn', () => {
  const shapes = (milling) => milledShapes({ milling }, drawing());
  const [flat] = shapes([{ kind: 'flat', on: 'd1', z_mm: 10, length_mm: 20, depth_mm: 3 }]);
  near(flat.half, Math.sqrt(15 ** 2 - 12 ** 2), 'half chord');
  const slot = { kind: 'slot', on: 'd1', z_mm: 80, length_mm: 20, depth_mm: 3, width_mm: 6 };
  assert.deepEqual(shapes([slot])[0].round, [true, false]);
  assert.deepEqual(shapes([{ ...slot, kind: 'keyway' }])[0].round, [true, true]);
  const [hole] = shapes([{ kind: 'cross-hole', on: 'd1', at_mm: 50, diameter_mm: 6, through: 'wall', count: 2, angle_deg: 30 }]);
  assert.deepEqual([hole.z, hole.half, hole.text], [[47, 53], 3, '2 × ⌀6 through wall at 30°']);
  assert.equal(shapes([{ kind: 'cross-hole', on: 'd1', at_mm: 50, diameter_mm: 6, depth_mm: 8 }])[0].text, '⌀6 × 8');
  assert.deepEqual(shapes([{ kind: 'cross-hole', on: 'd1', at_mm: 50, diameter_mm: 6 }]), []);
  assert.deepEqual(shapes([{ ...slot, depth_mm: NaN }, { ...slot, on: 'x' }, null, { kind: 'slot' }]), []);
});

test('sizes are written as on a drawing', () => {
  assert.equal(sizeText(surface({ fit: 'k6', limits_mm: [0.002, 0.015] })), '⌀30 k6');
  assert.equal(sizeText(surface({ limits_mm: [-0.1, 0] })), '⌀30 0/−0.1');
  assert.equal(sizeText(surface({ limits_mm: [-0.05, 0.05] })), '⌀30 ±0.05');
  assert.equal(sizeText(surface({ kind: 'thread', pitch_mm: 1.5 })), 'M30×1.5');
  assert.equal(sizeText(surface({ kind: 'cone', diameters_mm: [30, 40] })), '⌀30–⌀40');
});
