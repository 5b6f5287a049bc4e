// A page that goes along with a run, and what it says of it.
import assert from "node:assert/strict";
import test from "node:test";
import { page } from "./record.mjs";

const { alongWith, isLed, isPresent } = await import(new URL("live.js", page));
const { headline } = await import(new URL("inspector/live_panel.js", page));
const second = 1e9;

test("at real time the page moves between two looks, and does not run ahead", () => {
  const run = { speed: 1, paused: false };
  let t = 0;
  let end = 0.5 * second;
  let least = Infinity;
  for (let step = 1; step <= 600; step++) { //  ten seconds of pictures, a look at the run every half second
    const next = alongWith(t, end, run, 1 / 60);
    if (step > 120) least = Math.min(least, next - t);
    t = next;
    assert.ok(t <= end);
    if (step % 30 === 0) end += 0.5 * second;
  }
  assert.ok(least > 0.2 * second / 60, `it stands still: ${least}`);
  assert.ok(end - t < 1.2 * second, "it lags behind");
});

test("where it cannot be smooth the page shows the present", () => {
  assert.equal(alongWith(0, second, { speed: 0, paused: false }, 0.01), second);
  assert.equal(alongWith(0, second, { speed: 1e9, paused: false }, 0.01), second);
  assert.equal(alongWith(0, second, { speed: 1, paused: true }, 0.01), second);
  assert.equal(alongWith(0, 9 * second, { speed: 1, paused: false }, 0.01), 9 * second);
});

test("who goes along leads; who looks back does not", () => {
  const store = (t, live) => ({ state: { t, live: { canCommand: true, can_hold: true, ...live } } });
  const source = { end: 10 };
  assert.ok(isPresent(store(10, {}), source));
  assert.ok(isPresent(store(5, { shown: 5 }), source));
  assert.ok(!isPresent(store(5, { shown: 4 }), source));
  assert.ok(!isPresent(store(5, { shown: 5, ended: true }), source));
  assert.ok(isLed(store(0, {})));
  assert.ok(!isLed(store(0, { gone: true })));
});

test("a run whose server has ended is not said to go on", () => {
  assert.equal(headline({ paused: false }), "the run goes on");
  assert.equal(headline({ paused: false, gone: true }), "the run does not answer any more");
  assert.equal(headline({ ended: true, gone: true, result: "done" }), "the run has ended: done");
});
