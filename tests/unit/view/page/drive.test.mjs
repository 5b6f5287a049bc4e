// A robot that is driven by hand: what keys and the pad mean, and that it is at rest afterwards.
import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { page } from "./record.mjs";

const { createDriver, drives, velocityOfKeys, velocityOfPad } = await import(new URL("drive.js", page));
const { breakOf } = await import(new URL("inspector/live_panel.js", page));
const settled = () => new Promise((resolve) => setImmediate(resolve));

test("keys are added up, opposite ones cancel out, case does not matter", () => {
  assert.deepEqual(velocityOfKeys(["w"]), { vx: 0.5, vy: 0, omega: 0 });
  assert.deepEqual(velocityOfKeys(["W", "a"]), { vx: 0.5, vy: 0, omega: 1 });
  assert.deepEqual(velocityOfKeys(["w", "ArrowUp", "e"]), { vx: 0.5, vy: -0.3, omega: 0 });
  assert.deepEqual(velocityOfKeys(["w", "s"]), { vx: 0, vy: 0, omega: 0 });
  assert.deepEqual(["q", "ArrowLeft", "x", " "].map(drives), [true, true, false, false]);
});

test("on the pad up is ahead, and left turns left", () => {
  assert.deepEqual(velocityOfPad(0, -1), { vx: 0.5, vy: 0, omega: -0 });
  assert.deepEqual(velocityOfPad(-0.5, 0.5), { vx: -0.25, vy: 0, omega: 0.5 });
  assert.equal(velocityOfPad(9, 0).omega, -1);
});

const half = { vx: 0.25, vy: 0, omega: 0 };
const rest = { vx: 0, vy: 0, omega: 0 };

test("commands come ten times a second while it is driven, and a last one of rest", async () => {
  mock.timers.enable({ apis: ["setInterval"] });
  const sent = [];
  const driver = createDriver(async (agent, velocity) => { sent.push([agent, velocity]); });
  driver.use(26, half);
  for (let k = 0; k < 10; k++) { await settled(); mock.timers.tick(100); }
  await settled();
  assert.equal(sent.length, 11);
  driver.rest();
  await settled();
  mock.timers.tick(1000);
  await settled();
  assert.equal(sent.length, 12);
  assert.deepEqual(sent[11], [26, rest]);
  mock.timers.reset();
});

test("a slow server gets one command at a time, and rest comes last all the same", async () => {
  mock.timers.enable({ apis: ["setInterval"] });
  const sent = [];
  const answers = [];
  const driver = createDriver((agent, velocity) => { sent.push(velocity); return new Promise((resolve) => answers.push(resolve)); });
  driver.use(26, half);
  mock.timers.tick(500);
  assert.equal(sent.length, 1);
  driver.rest();
  assert.equal(sent.length, 1);
  answers[0]();
  await settled();
  assert.deepEqual(sent, [half, rest]);
  answers[1]();
  await settled();
  mock.timers.tick(500);
  assert.equal(sent.length, 2);
  mock.timers.reset();
});

test("a command that fails does not stop the next, and another robot leaves the first at rest", async () => {
  mock.timers.enable({ apis: ["setInterval"] });
  const sent = [];
  const driver = createDriver(async (agent, velocity) => { sent.push([agent, velocity.vx]); throw new Error("refused"); });
  driver.use(26, half);
  await settled();
  driver.use(27, half);
  await settled();
  mock.timers.tick(100);
  await settled();
  driver.rest();
  await settled();
  assert.deepEqual(sent, [[26, 0.25], [26, 0], [27, 0.25], [27, 0]]);
  mock.timers.reset();
});

test("breaks are of the chosen agent, but a time is everybody's", () => {
  const given = { text: "GO", agent: 26, now: 2e9 };
  assert.deepEqual(breakOf("state", given), { on: "state", agent: 26, state: "GO" });
  assert.deepEqual(breakOf("state", { ...given, text: " ", agent: null }), { on: "state" });
  assert.deepEqual(breakOf("message", { ...given, text: "help", agent: null }), { on: "message", topic: "help" });
  assert.deepEqual(breakOf("collision", given), { on: "collision", agent: 26 });
  assert.deepEqual(breakOf("time", { ...given, text: "+1.5" }), { on: "time", at: 3.5e9 });
  assert.equal(typeof breakOf("time", { ...given, text: "soon" }), "string");
});
