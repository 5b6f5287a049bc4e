// A bookmark is of the state that it was made of.
import assert from "node:assert/strict";
import { test } from "node:test";
import { bookmark, createStore, startOf, unmarked } from "../../../../view/page/src/store.js";

const kept = ["t", "speed", "view", "run", "chosen", "route", "follow", "followed", "layers", "mode2d", "map", "orbit", "theme", "charts", "lanes"];
const given = {
  t: 755400695454, speed: 1e-6, view: [1000000001, 2000000003], run: 1, chosen: { kind: "frame", run: 1, transmitter: 26, number: 7, at: 12345 },
  route: { topic: "a,b=c&d +", destination: 18 }, follow: 26, followed: { run: 1, sender: 18, id: 1, at: 1000000000 },
  layers: { labels: false, links: true, frames: true, beams: true, trails: true, ranges: true, queues: true }, mode2d: false,
  map: { x: 1.5, y: -2.25, span: 30 }, orbit: { x: 1, y: 2, distance: 3, yaw: -1.5, pitch: 0.5 }, theme: "dark", charts: [0, 3], lanes: "r, m1&2=#",
};
const marked = (state) => Object.fromEntries(kept.map((key) => [key, state[key]]));

test("What is in a bookmark comes out of it, to the nanosecond", () => {
  const { state } = createStore(given);
  assert.deepEqual(marked(createStore(startOf(`#${bookmark(state)}`)).state), marked(state));
});

test("All kinds of what is chosen come out of it", () => {
  for (const chosen of [{ kind: "agent", run: 0, agent: 3 }, { kind: "message", run: 0, sender: 1, id: 2, at: 3 }, { kind: "link", run: 0, a: 1, b: 2 }]) {
    assert.deepEqual(startOf(bookmark(createStore({ chosen }).state)).chosen, chosen);
  }
});

test("An empty bookmark is of the usual state", () => {
  assert.deepEqual(createStore(startOf("")).state, createStore().state);
});

test("A few are seen in 3-D at first, many on a map, unless the address says otherwise", () => {
  assert.deepEqual([2, 20, 21].map((agents) => unmarked(agents).mode2d), [false, false, true]);
  const again = (state) => ({ ...unmarked(2), ...startOf(bookmark(createStore(state).state)) }).mode2d;
  assert.equal(again({ mode2d: true }), true);
  assert.equal(again({ mode2d: true, map: { x: 0, y: 0, span: 3 } }), true);
  assert.equal(again({ mode2d: false }), false);
  assert.equal({ ...unmarked(2), ...startOf("#t=5.0") }.mode2d, false);
});

test("Nonsense is left out, not believed", () => {
  const start = startOf("#t=-5&speed=x&view=3,1&agent=1,2&map=1,2,-3&3d=1,2&layers=+nothing&theme=pink&%zz=%zz&followed=1,2,y");
  const { state } = createStore(start);
  assert.deepEqual({ ...state, mode2d: true }, createStore().state);
});

test("Listeners hear of what changed only", () => {
  const store = createStore();
  let heard = 0;
  const stop = store.subscribe(() => heard++);
  store.set({ t: 0 });
  store.set({ t: 5 });
  stop();
  store.set({ t: 6 });
  assert.equal(heard, 1);
});
