import assert from "node:assert/strict";
import test from "node:test";
import { collision, delivered, frame, missed, page, piece } from "./record.mjs";

const { createPoses, findFrame, framesAt, lastAt, lastRow, mediumOf, poseAt, posesAt, readingAt, stateAt, tableAt, turn, wheelAngle } =
  await import(new URL("at.js", page));
const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-12, `${a} is not ${b}`);

test("the last value that is not greater", () => {
  assert.deepEqual([0, 1, 2, 5, 6].map((t) => lastAt([1, 2, 2, 5], t)), [-1, 0, 2, 3, 3]);
  assert.equal(lastAt([], 1), -1);
});

test("angles turn the short way", () => {
  near(turn(3, -3), 2 * Math.PI - 6);
  near(turn(-3, 3), 6 - 2 * Math.PI);
  near(turn(0, 7 * Math.PI / 2), -Math.PI / 2);
});

const period = 1e9;
const pose = (agent, at, x, theta = 0) => ({ agent, at: at * 1e9, x, y: 2 * x, theta });
const walk = [piece([pose(1, 0, 0, 3), pose(2, 0, 5), pose(1, 1, 10, -3), pose(2, 9, 6)])];

test("a pose lies on the line between its rows, its angle the short way", () => {
  const { x, y, theta } = poseAt(walk, 1, 0.25e9, period);
  near(x, 2.5);
  near(y, 5);
  near(theta, 3 + 0.25 * (2 * Math.PI - 6));
  assert.equal(poseAt(walk, 1, 5e9, period).x, 10);
  assert.equal(poseAt(walk, 7, 5e9, period), null);
});

test("a body of which no rows were written stood still until one period before the next", () => {
  assert.deepEqual([1, 7.9, 8, 8.5, 9].map((t) => poseAt(walk, 2, t * 1e9, period).x), [5, 5, 5, 5.5, 6]);
});

test("all poses at once are those of each, also across two tiles", () => {
  const agents = [{ agent: 1, x: 0, y: 0, theta: 0 }, { agent: 2, x: 5, y: 10, theta: 0 }];
  const slots = new Map(agents.map(({ agent }, slot) => [agent, slot]));
  const split = [piece([pose(1, 0, 0, 3), pose(2, 0, 5), pose(1, 1, 10, -3)], 0, 2e9),
    piece([pose(2, 0, 5), pose(1, 1, 10, -3), pose(1, 3, 20, 0), pose(2, 3, 6)], 2e9, 4e9)];
  const poses = createPoses(agents);
  for (const t of [0, 0.25e9, 1e9, 1.9e9, 2e9, 2.5e9, 3e9, 0.5e9, 1.5e9]) {
    posesAt(split, t, period, slots, poses);
    agents.forEach(({ agent }, slot) => {
      const one = poseAt(split, agent, t, period);
      near(poses.x[slot], one.x);
      near(poses.theta[slot], one.theta);
    });
  }
});

test("a wheel that rolls straight turns by the way over its radius", () => {
  const left = { heading: Math.PI / 2, x: 0, y: 0.2, radius: 0.05 };
  near(wheelAngle(left, 0.1, 0, 0), 2);
  near(wheelAngle(left, 0, 0.1, 0), 0);
  near(wheelAngle(left, 0, 0, 1), -4); //  the body turns left: its left wheel rolls back
});

test("states and readings are those told last", () => {
  const states = [piece([{ agent: 1, at: 0, state: "IDLE" }, { agent: 2, at: 3, state: "AWAY" }, { agent: 1, at: 5, state: "GO" }])];
  assert.deepEqual([0, 4, 5, 9].map((t) => stateAt(states, 1, t)), ["IDLE", "IDLE", "GO", "GO"]);
  assert.equal(stateAt(states, 2, 2), null);
  const readings = [piece([{ agent: 1, at: 0, channel: "infrared", values: [1, null] }, { agent: 1, at: 2, channel: "odometry", values: [0, 0, 0] }])];
  assert.deepEqual(readingAt(readings, 1, "infrared", 5), [1, null]);
  assert.equal(readingAt(readings, 1, "battery", 5), null);
  assert.equal(lastRow([], 1, 5), null);
});

test("a routing table is what its changes have left", () => {
  const row = (at, destination, hop, hops, removed = false) => ({ at, topic: "help", destination, next_hop: hop, hops, probability: 1 / hops, removed });
  const changes = { columns: piece([row(1, 9, 2, 3), row(2, 9, 4, 2), row(3, 9, 2, 1), row(4, 9, 4, null, true), row(4, 8, 4, 5)]).tile.columns };
  const shown = (t) => tableAt(changes, t).map(({ destination, next_hop: hop, hops }) => [destination, hop, hops]);
  assert.deepEqual(shown(0), []);
  assert.deepEqual(shown(2), [[9, 2, 3], [9, 4, 2]]);
  assert.deepEqual(shown(4), [[8, 4, 5], [9, 2, 1]]);
});

// 1 and 2 exchange RTS, CTS and data; 3 hears the RTS and so keeps still, 4 hears a collision.
const exchange = [piece([
  frame({ class: "rts", number: 1, at: 1000, airtime: 100, nav: 500, ends: [[2, 1100, delivered, -60, 30], [3, 1102, delivered, -70, 20], [4, 1103, collision, -85, 0]] }),
  frame({ class: "cts", transmitter: 2, receiver: 1, number: 1, at: 1110, airtime: 90, nav: 400, ends: [[1, 1200, delivered, -60, 30], [3, 1202, missed, -95, null]] }),
  frame({ number: 2, at: 1210, airtime: 300, nav: 0, ends: [[2, 1510, delivered, -60, 30], [3, 1512, delivered, -70, 20]] }),
])];

test("a radio senses what it hears and keeps still as long as received frames to others say", () => {
  const { sending, sensed, nav } = mediumOf(exchange, 3);
  assert.deepEqual(sending, []);
  assert.deepEqual(sensed, [{ from: 1002, to: 1102 }, { from: 1112, to: 1202 }, { from: 1212, to: 1512 }]);
  assert.deepEqual(nav, [{ from: 1102, to: 1602 }]);
  assert.deepEqual(mediumOf(exchange, 4).nav, [], "what collided says nothing");
  assert.deepEqual(mediumOf(exchange, 2).nav, [], "the CTS is its own, the RTS to it");
  assert.deepEqual(mediumOf(exchange, 1).sending, [{ from: 1000, to: 1100 }, { from: 1210, to: 1510 }]);
});

test("frames are found by number and by when they are in the air", () => {
  assert.equal(findFrame(exchange, 2, 1).class, "cts");
  assert.equal(findFrame(exchange, 2, 2), null);
  assert.deepEqual(findFrame(exchange, 1, 1).ends[2], { agent: 4, at: 1103, verdict: "collision", rssi: -85, sinr: 0 });
  assert.deepEqual([999, 1000, 1099, 1100, 1150, 1509, 1510].map((t) => framesAt(exchange, t).map((one) => one.class).join()), ["", "rts", "rts", "", "cts", "unicast", ""]);
});
