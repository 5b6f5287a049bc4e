import assert from "node:assert/strict";
import test from "node:test";
import { page } from "./record.mjs";

const { bookmark, createStore, startOf } = await import(new URL("store.js", page));
const after = (state) => createStore(startOf(`#${bookmark(createStore(state).state)}`)).state;

test("a bookmark reproduces the view, to the nanosecond", () => {
  const state = createStore({
    t: 755_400_695_454, speed: 1e-6, view: [755_400_000_001, 755_401_000_000], run: 1, route: { topic: "help, urgent", destination: 17 }, follow: 26,
    chosen: { kind: "agent", run: 1, agent: 26 }, followed: { run: 1, sender: 26, id: 4, at: 46_200_000_000 }, mode2d: false,
    orbit: { x: 1.25, y: -3, distance: 200, yaw: 0.5, pitch: 1 }, theme: "dark", lanes: "r, m1&2=#", charts: [0, 4_294_967_297], layers: { labels: false, ranges: true },
  }).state;
  assert.deepEqual(after(state), state);
});

test("what is chosen comes back whatever it is", () => {
  for (const chosen of [{ kind: "frame", run: 0, transmitter: 26, number: 281_474_976_710_655, at: 106_234_125_001 },
    { kind: "message", run: 0, sender: 26, id: 4, at: 46_200_000_000 }, { kind: "link", run: 0, a: 3, b: 9 }, { kind: "agent", run: 0, agent: 1 }]) {
    assert.deepEqual(after({ chosen }).chosen, chosen);
  }
});

test("the usual view has a short bookmark", () => assert.equal(bookmark(createStore({ t: 100e9 }).state), "t=100.0"));

test("what a bookmark does not tell rightly is left out", () => {
  const usual = createStore().state;
  for (const hash of ["", "#", "#t=-1", "#t=1e400", "#view=5,3", "#view=x,1", "#frame=1,2", "#speed=0", "#speed=nan", "#3d&3d=1,2",
    "#map=0,0,-1", "#layers=+nonsense", "#theme=blue", "#%E0%A4%A=1", "#charts=x", "#route=help"]) {
    assert.deepEqual(createStore({ ...startOf(hash), mode2d: true }).state, usual, hash);
  }
});

test("listeners hear of changes only", () => {
  const store = createStore({ t: 1 });
  const heard = [];
  const leave = store.subscribe((state, patch) => heard.push([state.t, patch]));
  store.set({ t: 1 });
  store.set({ t: 2 });
  leave();
  store.set({ t: 3 });
  assert.deepEqual(heard, [[2, { t: 2 }]]);
});
