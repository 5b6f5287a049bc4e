import assert from "node:assert/strict";
import test from "node:test";
import { collision, delivered, frame, message, missed, page, piece } from "./record.mjs";

const { chainTo, eachMessage, hopsOf, lengthOf, lossOf, wayOf } = await import(new URL("at_messages.js", page));

// 1 sends to 3 over 2. The first try at 1000 collides; the second comes at 2 at 501 900; 2 passes it on at
// 600 000, it is heard there at 700 050. Propagation takes 50 ns from 2 to 3 and none from 1 to 2.
const of = { sender: 1, message: 7 };
const frames = [
  frame({ ...of, number: 1, at: 1_000, ends: [[2, 101_000, collision, -80, 1], [4, 101_000, delivered, -60, 30]] }),
  frame({ ...of, number: 2, at: 401_900, retry: 1, ends: [[2, 501_900, delivered, -70, 20]] }),
  frame({ transmitter: 9, number: 1, at: 410_000, sender: 9, message: 7, ends: [[2, 510_000, delivered, -70, 20]] }),
  frame({ ...of, transmitter: 2, receiver: 3, number: 1, at: 600_000, ends: [[3, 700_050, delivered, -75, 15]] }),
];
const sent = message({ id: 7, sent: 0, deliveries: [{ receiver: 3, at: 700_050, delay: 700_050, transmissions: 2 }] });

test("hops are the frames that carried the message, with how each ended at the radio that it was for", () => {
  const hops = hopsOf(sent, [piece(frames)]);
  assert.deepEqual(hops.map(({ from, to, began, ended, verdict, first }) => [from, to, began, ended, verdict, first]), [
    [1, 2, 1_000, 101_000, "collision", false],
    [1, 2, 401_900, 501_900, "delivered", true],
    [2, 3, 600_000, 700_050, "delivered", true]]);
  assert.deepEqual(hops.map(({ waited }) => waited), [1_000, 401_900, 98_100]);
  assert.equal(hops[2].delivered, 700_050);
});

test("queue, tries and air of all hops sum up to the delay, to the nanosecond", () => {
  const way = wayOf(hopsOf(sent, [piece(frames)]));
  assert.deepEqual(way, [
    { from: 1, to: 2, tries: 2, queued: 1_000, trying: 400_900, air: 100_000, ended: 501_900 },
    { from: 2, to: 3, tries: 1, queued: 98_100, trying: 0, air: 100_050, ended: 700_050 }]);
  assert.equal(lengthOf(chainTo(way, 1, 3)), sent.deliveries[0].delay);
});

test("a frame whose acknowledgement was lost is repeated, but the message came once", () => {
  const again = frame({ ...of, number: 3, at: 520_000, retry: 1, ends: [[2, 620_000, delivered, -70, 20]] });
  const way = wayOf(hopsOf(sent, [piece([...frames.slice(0, 3), again, frames[3]])]));
  assert.deepEqual(way.map(({ from, to, tries }) => [from, to, tries]), [[1, 2, 2], [2, 3, 1]]);
});

test("of a broadcast the chain leads to the receiver that is asked for", () => {
  const flood = [
    frame({ ...of, at: 10, receiver: 65535, ends: [[2, 100_010, delivered, -70, 20], [4, 100_010, delivered, -70, 20], [5, 100_010, missed, -90, 1]] }),
    frame({ ...of, transmitter: 4, number: 1, at: 200_000, receiver: 65535, ends: [[3, 300_000, delivered, -70, 20], [1, 300_000, delivered, -70, 20]] }),
  ];
  const way = wayOf(hopsOf(sent, [piece(flood)]));
  assert.deepEqual(chainTo(way, 1, 3).map(({ from, to }) => [from, to]), [[1, 4], [4, 3]]);
  assert.deepEqual(chainTo(way, 1, 5), []);
});

test("a loss names who had the message last and how the last try ended", () => {
  const lost = { ...sent, verdict: "retry limit", deliveries: [] };
  const failing = [frames[1], ...[0, 1].map((k) => frame({ ...of, transmitter: 2, receiver: 3, number: k + 1, at: 600_000 + k * 200_000, retry: k,
    ends: [[3, 700_000 + k * 200_000, k ? missed : collision, -90, 0]] }))];
  assert.deepEqual(lossOf(lost, hopsOf(lost, [piece(failing)])),
    { holder: 2, since: 501_900, to: 3, tries: 2, verdict: "preamble missed", at: 900_000 });
  assert.deepEqual(lossOf({ ...lost, verdict: "no route" }, []), { holder: 1, since: 0, to: null, tries: 0, verdict: null, at: null });
  assert.equal(lossOf(sent, []), null);
  assert.equal(lossOf({ ...sent, verdict: null }, []), null);
});

test("a frame that nobody was in reach of has no reception", () => {
  const hops = hopsOf(sent, [piece([frame({ ...of, at: 5, ends: [] })])]);
  assert.deepEqual(hops.map(({ to, ended, verdict }) => [to, ended, verdict]), [[2, null, "below sensitivity"]]);
});

test("messages that two tiles tell are visited once; summaries have none", () => {
  const ids = [];
  const summary = { from: 0, to: 1, tile: { complete: false, bins: { n: 64, topics: [], counts: [] } } };
  eachMessage([summary, piece([message({ id: 1 }), message({ id: 2 })], 0, 10), piece([message({ id: 2 }), message({ id: 2, sender: 4 })], 10, 20)],
    (columns, row) => ids.push([columns.sender[row], columns.id[row]]));
  assert.deepEqual(ids, [[1, 1], [1, 2], [4, 2]]);
});
