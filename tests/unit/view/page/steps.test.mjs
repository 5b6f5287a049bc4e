import assert from "node:assert/strict";
import test from "node:test";
import { frame, message, page, piece, runOf } from "./record.mjs";

const { stepTime } = await import(new URL("steps.js", page));
const source = { idle: async () => {} };
const run = runOf({
  frames: [piece([frame({ at: 5e8 }), frame({ at: 5e8 + 1 }), frame({ at: 9e9 })])],
  states: [piece([{ agent: 1, at: 2e9, state: "GO" }, { agent: 2, at: 3e9, state: "GO" }])],
  events: [piece([{ agent: 1, at: 6e9, kind: "contact", text: "" }])],
  messages: [piece([message({ sender: 1, sent: 4e9, deliveries: [[2, 4.5e9, 5e8, 1]] })])],
});
const step = (of, t, way, agent = null) => stepTime(source, run, of, t, way, agent);

test("frames, one by one, forwards and backwards, near and far", async () => {
  assert.equal(await step("frame", 0, 1), 5e8);
  assert.equal(await step("frame", 5e8, 1), 5e8 + 1);
  assert.equal(await step("frame", 5e8 + 1, 1), 9e9);
  assert.equal(await step("frame", 9e9, 1), null);
  assert.equal(await step("frame", 9e9, -1), 5e8 + 1);
  assert.equal(await step("frame", 5e8, -1), null);
});

test("control cycles", async () => {
  assert.deepEqual(await Promise.all([[0, 1], [1, 1], [1e8, 1], [1.5e8, -1], [1e8, -1], [0, -1], [1e10, 1]].map(([t, way]) => step("cycle", t, way))),
    [1e8, 1e8, 2e8, 1e8, 0, null, null]);
});

test("events of the chosen agent are its states, what befell it, and messages that it sent or got", async () => {
  const all = async (agent) => {
    const times = [];
    for (let t = await step("event", 0, 1, agent); t !== null; t = await step("event", t, 1, agent)) times.push(t / 1e9);
    return times;
  };
  assert.deepEqual(await all(1), [2, 4, 6]);
  assert.deepEqual(await all(2), [3, 4.5]);
  assert.deepEqual(await all(null), [2, 3, 4, 4.5, 6]);
  assert.equal(await step("event", 4e9, -1, 2), 3e9);
});
