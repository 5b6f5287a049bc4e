// What at.js says was at a time, on records made by hand.
import assert from "node:assert/strict";
import { test } from "node:test";
import * as at from "../../../../view/page/src/at.js";

const second = 1e9;
const tileOf = (from, to, columns, more = {}) => ({ from, to, until: to, complete: true, columns, ...more });
const piece = (tile) => ({ from: tile.from, to: tile.to, tile });
const poses = (rows, from = 0, to = 100 * second, complete = true) => piece({
  ...tileOf(from, to, Object.fromEntries(["agent", "at", "x", "y", "theta"].map((name, k) => [name, rows.map((row) => row[k])]))), complete });
const near = (a, b, tolerance = 1e-12) => assert.ok(Math.abs(a - b) <= tolerance, `${a} is not ${b}`);

test("A pose between two rows lies on the straight line, the angle goes the short way", () => {
  const pieces = [poses([[1, 0, 0, 0, 3], [1, second, 2, 4, -3]])];
  const pose = at.poseAt(pieces, 1, 0.25 * second, second);
  near(pose.x, 0.5);
  near(pose.y, 1);
  near(pose.theta, 3 + 0.25 * (2 * Math.PI - 6)); // 0.283 rad through pi, not 6 rad through 0
});

test("What stood still for long moves only in the last period before its next row", () => {
  const pieces = [poses([[1, 0, 5, 0, 0], [1, 10 * second, 6, 0, 0]])];
  near(at.poseAt(pieces, 1, 8.9 * second, second).x, 5);
  near(at.poseAt(pieces, 1, 9.5 * second, second).x, 5.5);
});

test("Of a summary, which leaves rows out, a long gap says nothing: it moved all along", () => {
  const pieces = [poses([[1, 0, 5, 0, 0], [1, 10 * second, 6, 0, 0]], 0, 100 * second, false)];
  near(at.poseAt(pieces, 1, 5 * second, second).x, 5.5);
});

test("Before its first row and after its last one an agent is at that row; of another nothing is known", () => {
  const pieces = [poses([[1, second, 5, 0, 0], [1, 2 * second, 6, 0, 0]])];
  near(at.poseAt(pieces, 1, 0, second).x, 5);
  near(at.poseAt(pieces, 1, 50 * second, second).x, 6);
  assert.equal(at.poseAt(pieces, 2, 0, second), null);
});

test("All poses at once are those of one by one, in any order of times and across tiles", () => {
  const rows = [];
  for (let k = 0; k < 100; k++) for (const agent of [7, 3]) rows.push([agent, k * second, agent * k, -k, 0.3 * k]);
  const first = rows.filter((row) => row[1] < 50 * second);
  const later = [...rows.filter((row) => row[1] === 49 * second), ...rows.filter((row) => row[1] >= 50 * second)];
  const pieces = [poses(first, 0, 50 * second), poses(later, 50 * second, 100 * second)];
  const slots = new Map([[3, 0], [7, 1]]);
  const out = at.createPoses([{ x: 0, y: 0, theta: 0 }, { x: 0, y: 0, theta: 0 }]);
  for (const t of [98.5, 0, 49.5, 49.999, 50, 12.25, 50.25, 99].map((s) => s * second)) {
    at.posesAt(pieces, t, second, slots, out);
    for (const [agent, slot] of slots) {
      const one = at.poseAt(pieces, agent, t, second);
      near(out.x[slot], one.x, 1e-9);
      near(out.y[slot], one.y, 1e-9);
      near(at.turn(out.theta[slot], one.theta), 0, 1e-9);
    }
  }
});

test("A wheel rolls by the way of its hub: ahead, sideways and in a turn of the body", () => {
  const right = { x: 0, y: -0.1, heading: Math.PI / 2, radius: 0.05 }; // axle to the left: rolls ahead
  near(at.wheelAngle(right, 1, 0, 0), 20);
  near(at.wheelAngle(right, 0, 1, 0), 0, 1e-12); // along the axle
  near(at.wheelAngle(right, 0, 0, 1), 2); // turning left, the right wheel goes 0.1 m ahead
});

const frames = (rows, verdicts = ["delivered", "collision"]) => {
  const names = ["transmitter", "number", "at", "class", "receiver", "airtime", "nav", "sender", "message", "retry", "ends"];
  return [piece(tileOf(0, 100 * second, Object.fromEntries(names.map((name, k) => [name, rows.map((row) => row[k])])), { verdicts }))];
};

test("A frame is in the air from its begin until its end, which is no more in it", () => {
  const pieces = frames([[1, 1, 1000, "unicast", 2, 500, 0, null, null, 0, []]]);
  assert.equal(at.framesAt(pieces, 999).length, 0);
  assert.equal(at.framesAt(pieces, 1000).length, 1);
  assert.equal(at.framesAt(pieces, 1499).length, 1);
  assert.equal(at.framesAt(pieces, 1500).length, 0);
});

test("An A-MPDU has the frames of its number that one transmitter began at one time", () => {
  const tile = tileOf(0, second, { transmitter: [1, 1, 2, 1], at: [1000, 1000, 1000, 5000], ampdu: [4, 4, 4, 5] });
  assert.equal(at.mpdusOf([piece(tile)], { at: 1000, transmitter: 1, ampdu: 4 }), 2);
  assert.equal(at.mpdusOf([piece(tile)], { at: 5000, transmitter: 1, ampdu: 5 }), 1);
});

test("The NAV follows frames to others that came whole, not one's own and not lost ones", () => {
  const pieces = frames([
    [1, 1, 1000, "rts", 2, 100, 900, null, null, 0, [[2, 1110, 0], [3, 1110, 0], [4, 1110, 1]]],
    [2, 1, 1200, "cts", 1, 100, 600, null, null, 0, [[3, 1310, 0]]],
  ]);
  assert.deepEqual(at.mediumOf(pieces, 3).nav, [{ from: 1110, to: 2010 }]); // 1310 + 600 ends before: merged
  assert.deepEqual(at.mediumOf(pieces, 2).nav, []); // the receiver of the RTS
  assert.deepEqual(at.mediumOf(pieces, 4).nav, []); // lost it
  assert.deepEqual(at.mediumOf(pieces, 4).sensed, [{ from: 1010, to: 1110 }]);
  assert.deepEqual(at.mediumOf(pieces, 1).sending, [{ from: 1000, to: 1100 }]);
});

test("A message is followed over its hops, with what it waited and where it was lost", () => {
  const message = { sender: 1, id: 9, sent: 500, destination: 3, deliveries: [{ receiver: 3, at: 3100, delay: 2600, transmissions: 3 }] };
  const pieces = frames([
    [1, 1, 1000, "unicast", 2, 100, 0, 1, 9, 0, [[2, 1100, 0], [3, 1100, 0]]],
    [2, 1, 2000, "unicast", 3, 100, 0, 1, 9, 0, [[3, 2100, 1]]],
    [2, 2, 2500, "unicast", 3, 100, 0, 4, 9, 0, [[3, 2600, 0]]], // another sender's message 9
    [2, 3, 3000, "unicast", 3, 100, 0, 1, 9, 1, [[3, 3100, 0]]],
  ]);
  const hops = at.hopsOf(message, pieces);
  assert.deepEqual(hops.map(({ from, to, waited, verdict, delivered }) => [from, to, waited, verdict, delivered]), [
    [1, 2, 500, "delivered", null], [2, 3, 900, "collision", null], [2, 3, 1900, "delivered", 2600]]);
});

test("A frame that its receiver did not even notice was below its sensitivity", () => {
  const message = { sender: 1, id: 9, sent: 500, destination: 3, deliveries: [] };
  const hops = at.hopsOf(message, frames([[1, 1, 1000, "unicast", 3, 100, 0, 1, 9, 0, [[2, 1100, 0]]]]));
  assert.deepEqual(hops.map(({ to, verdict, ended }) => [to, verdict, ended]), [[3, "below sensitivity", null]]);
});

test("A routing table at t has what was told last and was not removed", () => {
  const changes = { columns: {
    at: [1, 2, 3, 4], topic: ["a", "a", "b", "a"], destination: [9, 9, 9, 9], next_hop: [2, 3, 2, 2],
    probability: [1, 0.25, 1, null], removed: [false, false, false, true] } };
  const hops = (t) => at.tableAt(changes, t).map((row) => `${row.topic}${row.next_hop}`);
  assert.deepEqual(hops(0), []);
  assert.deepEqual(hops(3), ["a2", "a3", "b2"]);
  assert.deepEqual(hops(4), ["a3", "b2"]);
});

test("A state is the last one that was named, also in an earlier tile", () => {
  const states = (from, to, rows) => piece(tileOf(from, to, { agent: rows.map((r) => r[0]), at: rows.map((r) => r[1]), state: rows.map((r) => r[2]) }));
  const pieces = [states(0, 10, [[1, 0, "IDLE"], [2, 5, "X"]]), states(10, 20, [[2, 5, "X"], [1, 15, "GO"]])];
  assert.equal(at.stateAt(pieces, 1, 14), "IDLE");
  assert.equal(at.stateAt(pieces, 1, 15), "GO");
  assert.equal(at.stateAt(pieces, 3, 15), null);
});

test("A movable turns and moves between two rows; of a turn and its opposite the nearer one counts", () => {
  const names = ["movable", "at", "x", "y", "z", "qw", "qx", "qy", "qz"];
  const half = Math.SQRT1_2;
  const rows = [[0, 0, 0, 0, 1, 1, 0, 0, 0], [1, 0, 9, 9, 9, 1, 0, 0, 0], [0, second, 4, 0, 2, -half, 0, 0, -half]]; //  a quarter turn about z
  const pieces = [piece(tileOf(0, 100 * second, Object.fromEntries(names.map((name, k) => [name, rows.map((row) => row[k])]))))];
  const pose = at.movableAt(pieces, 0, 0.5 * second, second);
  near(pose.x, 2);
  near(pose.z, 1.5);
  near(pose.q[0], Math.cos(Math.PI / 8)); //  half of the turn, not three quarters the other way
  near(pose.q[3], Math.sin(Math.PI / 8));
  near(at.movableAt(pieces, 0, 5 * second, second).x, 4);
  near(at.movableAt(pieces, 1, 5 * second, second).y, 9);
  assert.equal(at.movableAt(pieces, 2, 0, second), null);
  assert.equal(at.movableAt([piece({ from: 0, to: 1, complete: true })], 0, 0, second), null);
});
