import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load } from './load.mjs';

const { draftKey, draftNames, drafts, forgetDraft, keepDraft, loadDraft } = await load('drafts');
const { largest_bytes, readDropped } = await load('dropped');

class Store {
  all = new Map();
  get length() { return this.all.size; }
  key(i) { return [...this.all.keys()][i] ?? null; }
  getItem(key) { return this.all.get(key) ?? null; }
  setItem(key, value) { this.all.set(key, value); }
  removeItem(key) { this.all.delete(key); }
}
const draft = (id, changed, name) => ({ id, changed, part: { name } });

test('drafts come back as they were kept, the last changed first', () => {
  const store = new Store();
  for (const d of [draft('a', 1, 'Pin'), draft('b', 3, 'Bush'), draft('c', 2, 'Pin')]) assert.ok(keepDraft(store, d));
  assert.deepEqual(drafts(store), [draft('b', 3, 'Bush'), draft('c', 2, 'Pin'), draft('a', 1, 'Pin')]);
  assert.deepEqual(draftNames(drafts(store)).map((d) => d.name), ['Bush', 'Pin', 'Pin (2)']);
  forgetDraft(store, 'c');
  assert.equal(loadDraft(store, 'c'), undefined);
});

test('what others have written into the store is passed over', () => {
  const store = new Store();
  store.setItem('turnwright-theme', 'dark');
  for (const [i, text] of ['', '{', 'null', '[]', '{"id":"x"}', '{"id":"x","changed":1,"part":[]}', '{"id":1,"changed":1,"part":{}}'].entries())
    store.setItem(`${draftKey}${i}`, text);
  assert.deepEqual(drafts(store), []);
});

test('a store that is full says so', () => {
  const full = new Store();
  full.setItem = () => { throw new Error('QuotaExceededError'); };
  assert.equal(keepDraft(full, draft('a', 1, '')), false);
});

const bytes = (text) => new TextEncoder().encode(text);

test('JSON is a document, everything else a drawing', () => {
  assert.deepEqual(readDropped('p.json', bytes('\uFEFF {"outer": []}')), { kind: 'part', part: { outer: [] } });
  assert.deepEqual(readDropped('line.txt', bytes('d50 x 40')), { kind: 'drawing', request: { text: 'd50 x 40' } });
  assert.equal(readDropped('p.STEP', bytes('ISO-10303-21;')).kind, 'drawing');
});

test('what is no part document is refused with its name and the reason', () => {
  for (const [text, why] of [['{"outer": [}', /bad.json is no JSON/], ['[1, 2]', /expected an object/], ['{"format": "turnwright-tool/1"}', /turnwright-tool/], ['', /is empty/]]) {
    const { kind, why: said } = readDropped('bad.json', bytes(text));
    assert.equal(kind, 'refused');
    assert.match(said, why);
  }
  assert.match(readDropped('big.step', { length: largest_bytes + 1 }).why, /more than 100 MB/);
});

test('bytes that are no UTF-8 come through whole', () => {
  const latin = Uint8Array.from({ length: 70_000 }, (_, i) => i % 256);
  const { request } = readDropped('old.stp', latin);
  assert.deepEqual(new Uint8Array(Buffer.from(request.base64, 'base64')), latin);
});
