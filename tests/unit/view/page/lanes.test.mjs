import assert from "node:assert/strict";
import test from "node:test";
import { collision, delivered, everyone, frame, missed, page, piece, runOf } from "./record.mjs";

const { isNamed, lanesOf, seriesName } = await import(new URL("time/lane_list.js", page));
const { placeOf, stateSpans } = await import(new URL("time/agent_lanes.js", page));
const { verdictOf } = await import(new URL("time/frame_lane.js", page));

const agents = [{ agent: 1, name: "m0", kind: "mote", program: "help_mote" }, { agent: 2, name: "m10", kind: "mote", program: "help_mote" },
  { agent: 26, name: "r0", kind: "robot", program: "help_robot" }, { agent: 30, name: "sniffer", kind: "mote", program: null }];
const run = runOf({}, { agents, series: [{ index: 4294967297, name: "speed", agent: 26, unit: "m/s" }] });
const state = { chosen: null, charts: [], lanes: "" };
const names = (patch) => lanesOf(run, { ...state, ...patch }).map(({ name }) => name);

test("every agent with a controller has a lane, robots first", () => {
  assert.deepEqual(names({}), ["frames", "messages", "events", "r0", "m0", "m10"]);
});

test("a name, or parts of names, leave the others out", () => {
  assert.deepEqual(names({ lanes: "M1" }).slice(3), ["m10"]);
  assert.deepEqual(names({ lanes: "r, m0" }).slice(3), ["r0", "m0"]);
  assert.deepEqual(["", ",", "x"].map((text) => isNamed("r0", text)), [true, true, false]);
});

test("the chosen agent's radio and the chosen series have lanes", () => {
  assert.deepEqual(names({ chosen: { kind: "agent", run: 0, agent: 1 }, charts: [4294967297, 99], lanes: "r" }),
    ["frames", "messages", "events", "m0 sends", "m0 hears", "m0 NAV", "m0 queue", "r0 speed [m/s]", "r0"]);
  assert.deepEqual(names({ chosen: { kind: "agent", run: 1, agent: 1 } }).length, 6, "of another run");
});

test("a series is told with its agent and its unit, wherever it is named", () => {
  const world = { agents };
  assert.equal(seriesName(world, { agent: 1, name: "controllers.known", unit: "" }), "m0 controllers.known");
  assert.equal(seriesName(world, { agent: 2, name: "controllers.known", unit: "1" }), "m10 controllers.known");
  assert.equal(seriesName(world, { agent: 26, name: "goodput", unit: "bit/s" }), "r0 goodput [bit/s]");
});

test("a state keeps its colour while others come after it; one that is not known yet has none", () => {
  const early = ["WAIT", "GO"];
  const late = [...early, "ARRIVED"];
  assert.deepEqual(early.map((state) => placeOf(late, state)), early.map((state) => placeOf(early, state)));
  assert.equal(placeOf(early, "ARRIVED"), "mote");
  assert.notEqual(placeOf(late, "ARRIVED"), "mote");
});

const { linesOf } = await import(new URL("time/lanes.js", page));

test("a name is parted where it may be, and says where it was cut", () => {
  const measure = (text) => text.length;
  assert.deepEqual(linesOf("s0 controllers.sent", 30, measure, 2), ["s0 controllers.sent"]);
  assert.deepEqual(linesOf("s0 controllers.sent", 15, measure, 2), ["s0 controllers.", "sent"]);
  assert.deepEqual(linesOf("s0 controllers.sent", 15, measure, 1), ["s0 …sent"]);
  assert.deepEqual(linesOf("s0 controllers.goodput [bit/s]", 9, measure, 2), ["s0", "…goodput…"]);
  assert.deepEqual(linesOf("averylongname", 6, measure, 2), ["avery…"]);
});

const said = (...rows) => rows.map(([agent, at, word]) => ({ agent, at, state: word }));

test("states hold until the next one, and over the border of two tiles", () => {
  const pieces = [piece(said([1, 0, "IDLE"], [2, 5, "GO"], [1, 10, "GO"]), 0, 64), piece(said([1, 10, "GO"], [2, 5, "GO"], [1, 80, "IDLE"]), 64, 128)];
  assert.deepEqual(stateSpans(pieces, 1, 0, 100), [{ from: 0, to: 10, state: "IDLE" }, { from: 10, to: 80, state: "GO" }, { from: 80, to: 100, state: "IDLE" }]);
  assert.deepEqual(stateSpans(pieces, 1, 20, 30), [{ from: 20, to: 30, state: "GO" }]);
  assert.deepEqual(stateSpans(pieces, 2, 0, 100), [{ from: 5, to: 100, state: "GO" }]);
  assert.deepEqual(stateSpans(pieces, 3, 0, 100), []);
});

test("a summary tells no states; the tile behind it does again", () => {
  const summary = { from: 0, to: 64, tile: { from: 0, to: 64, complete: false, columns: piece(said([1, 0, "IDLE"])).tile.columns } };
  assert.deepEqual(stateSpans([summary, piece(said([1, 50, "GO"]), 64, 128)], 1, 0, 100), [{ from: 64, to: 100, state: "GO" }]);
});

test("a frame ended as it did at the radio that it was for; a broadcast as it did at the worst", () => {
  const verdict = (given) => { const { tile } = piece([frame(given)]); return verdictOf(tile.columns, 0, tile); };
  const ends = [[3, 1, collision, -80, 0], [2, 1, delivered, -60, 30], [4, 1, missed, -95, 0]];
  assert.equal(verdict({ receiver: 2, ends }), "delivered");
  assert.equal(verdict({ receiver: 3, ends }), "collision");
  assert.equal(verdict({ receiver: everyone, ends }), "collision");
  assert.equal(verdict({ receiver: 9, ends }), "below sensitivity");
});

const { createDensity } = await import(new URL("time/density.js", page));
const { createScale } = await import(new URL("time/scale.js", page));

test("a summary's count is spread over its bin's pixels, and nothing gets lost of it", () => {
  const box = { x: 100, y: 0, width: 10, height: 30 };
  const density = createDensity(box, createScale([0, 100], 100, 110));
  density.spread(20, 50, 6, 3);
  density.spread(90, 120, 3); //  reaches beyond the lane
  density.put(25, 1, 1);
  density.put(-5, 1);
  density.put(100, 1);
  assert.deepEqual([...density.counts], [0, 0, 3, 2, 2, 0, 0, 0, 0, 1]);
  assert.deepEqual([...density.lost], [0, 0, 2, 1, 1, 0, 0, 0, 0, 0]);
});
