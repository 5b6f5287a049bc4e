// What readings mean: rays and where they go, names, units.
import assert from "node:assert/strict";
import test from "node:test";
import { page } from "./record.mjs";

const { channelOf, raysOf, reachOf, readingFacts, sideOf, surfacesOf, valueText } = await import(new URL("sensors.js", page));
const { inWorld } = await import(new URL("inspector/agent.js", page));
const { ringStep } = await import(new URL("inspector/readings.js", page));

const scan = { name: "lidar", kind: "scan", unit: "m", values: [], x: -0.03, y: 0, z: 0.18, heading: Math.PI / 2, first: -0.2, step: 0.1, low: 0.12, high: 3.5 };
const imu = { name: "imu", kind: "imu", unit: "rad/s, m/s^2", values: [["rate_x", "rad/s"], ["force_z", "m/s^2"]] };
const pose = { name: "pose", kind: "pose", unit: "m, rad", values: [["x", "m"], ["y", "m"], ["yaw", "rad"]] };
const world = { channels: { channels0: [scan, imu, pose] } };
const agent = { agent: 1, channels: "channels0", infrared: [{ x: 0.1, y: 0, heading: 0, reach: 0.8 }, { x: 0, y: 0.1, heading: 1, reach: 0.8 }] };
const nameOf = (address) => `n${address}`;

test("a channel is as the world tells it; of an older record as its name says", () => {
  assert.equal(channelOf(world, agent, "lidar"), scan);
  assert.deepEqual(["infrared", "infrared_volts", "localisation", "scan"].map((name) => channelOf({}, agent, name).kind), ["range", "voltage", "relative_position", "scan"]);
});

test("a scan's rays go from its heading on, a step apart; infrared beams as they are mounted", () => {
  const rays = raysOf(agent, scan, [1, null, 3]);
  assert.deepEqual(rays.map(({ range }) => range), [1, null, 3]);
  rays.forEach(({ x, heading }, k) => { assert.equal(x, -0.03); assert.ok(Math.abs(heading - (Math.PI / 2 - 0.2 + 0.1 * k)) < 1e-12); });
  const infrared = channelOf({}, agent, "infrared");
  assert.deepEqual(raysOf(agent, infrared, [0.5, null]), [{ x: 0.1, y: 0, heading: 0, range: 0.5 }, { x: 0, y: 0.1, heading: 1, range: null }]);
  assert.equal(raysOf(agent, infrared, [0.5]), null, "of another number");
  assert.equal(raysOf(agent, imu, [1, 2]), null);
  assert.deepEqual([reachOf(agent, scan), reachOf(agent, infrared)], [3.5, 0.8]);
});

test("a surface ends where nothing was hit, and where the range leaps", () => {
  const rays = [1, 1.01, 1.02, null, 2, 2.01, 3.5, 3.5].map((range, k) => ({ x: 0, y: 0, heading: 0.01 * k, range }));
  assert.deepEqual(surfacesOf(rays), [[0, 1, 2], [4, 5], [6, 7]]);
});

test("sides are told from ahead", () => {
  assert.deepEqual([0, Math.PI / 2, -Math.PI / 6, Math.PI, 2 * Math.PI + 0.1].map(sideOf), ["ahead", "90° left", "30° right", "behind", "6° left"]);
});

test("values have names and units, angles are in degrees", () => {
  assert.deepEqual(readingFacts(agent, pose, [-1.25, 0.5, Math.PI / 2], nameOf), [["x", "-1.25 m"], ["y", "0.5 m"], ["yaw", "90°"]]);
  assert.deepEqual(readingFacts(agent, imu, [0.01, 9.81], nameOf), [["rate x", "0.01 rad/s"], ["force z", "9.81 m/s^2"]]);
  assert.deepEqual([valueText(0.5, "1"), valueText(null, "m")], ["0.5", "none"]);
  assert.deepEqual(readingFacts(agent, { kind: "bumper", values: [["touched", "1"]] }, [1], nameOf), [["touched", "yes"]]);
});

test("others are told by name, with their distance and side", () => {
  const localisation = channelOf({}, agent, "localisation");
  assert.deepEqual(readingFacts(agent, localisation, [2, -3, 4, 7, 1, 0], nameOf),
    [["n2", "5 m, 127° left (x -3 m, y 4 m)"], ["n7", "1 m, ahead (x 1 m, y 0 m)"]]);
  assert.deepEqual(readingFacts(agent, localisation, [], nameOf), []);
});

test("a scan in words: the nearest, how many rays, the reach", () => {
  const facts = Object.fromEntries(readingFacts(agent, { ...scan, heading: 0 }, [2, 0.5, null], nameOf));
  assert.deepEqual(facts, { nearest: "0.5 m, 6° right", rays: "3, of which 2 hit something", reach: "0.12 … 3.5 m" });
});

test("odometry in the world is where the robot believes to be", () => {
  const start = { x: 1, y: 2, theta: Math.PI / 2 };
  const { x, y, theta } = inWorld(start, [3, 1, Math.PI]);
  for (const [value, wanted] of [[x, 0], [y, 5], [theta, -Math.PI / 2]]) assert.ok(Math.abs(value - wanted) < 1e-12);
});

test("at most four rings are a reach", () => {
  for (const reach of [0.1, 0.8, 3.5, 6, 30]) assert.ok(reach / ringStep(reach) <= 4 && reach / ringStep(reach) > 1, String(reach));
});
