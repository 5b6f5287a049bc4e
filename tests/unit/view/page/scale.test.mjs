import assert from "node:assert/strict";
import test from "node:test";
import { page } from "./record.mjs";

const { createScale, exact, kept, span, spanExact, stepOf, ticksOf, timeOf, zoomed } = await import(new URL("time/scale.js", page));

test("times are written to the nanosecond, also late in a long run", () => {
  assert.equal(exact(0), "0.000000000");
  assert.equal(exact(755_400_695_454), "755.400695454");
  assert.equal(exact(86_400_000_000_001), "86400.000000001");
});

test("lengths are written in the unit that suits them", () => {
  assert.equal(span(1_500_000), "1.5 ms");
  assert.equal(span(2e9), "2 s");
  assert.equal(span(0), "0 ns");
  assert.equal(spanExact(62_846_131), "62.846131 ms");
  assert.equal(spanExact(216_727), "216.727 µs");
  assert.equal(spanExact(999), "999 ns");
  assert.equal(spanExact(3_000_000_001), "3.000000001 s");
});

test("steps are 1, 2 or 5 times a power of ten", () => {
  assert.deepEqual([[1e9, 10], [1e9, 7], [3e9, 10], [7, 10], [4e3, 8]].map(([length, count]) => stepOf(length, count)), [1e8, 2e8, 5e8, 1, 500]);
});

test("ticks below a millisecond are told from a base, to the nanosecond", () => {
  const { base, ticks } = ticksOf([755_400_695_400, 755_400_696_400], 5);
  assert.equal(base, 755_400_680_000);
  assert.deepEqual(ticks.map(({ t }) => t), [755_400_695_400, 755_400_695_600, 755_400_695_800, 755_400_696_000, 755_400_696_200, 755_400_696_400]);
  assert.equal(ticks[0].label, "+15.4 µs");
  assert.equal(ticksOf([0, 700e9], 7).base, null);
});

test("a place on the axis and its time are the same thing", () => {
  const scale = createScale([1e9, 2e9], 100, 1100);
  assert.equal(scale.perPixel, 1e6);
  assert.equal(scale.x(1.5e9), 600);
  assert.equal(scale.t(600), 1.5e9);
});

test("zooming keeps what is under the cursor, from a microsecond to the whole run", () => {
  const end = 7.2e12;
  const [from, to] = zoomed([0, 1e9], 2.5e8, 0.1, end);
  assert.deepEqual([from, to], [2.25e8, 3.25e8]);
  const close = zoomed([5e11, 5e11 + 2000], 5e11 + 1000, 1e-6, end);
  assert.equal(close[1] - close[0], 1000);
  const far = zoomed([5e11, 5e11 + 2000], 5e11, 1e12, end);
  assert.ok(far[0] <= 0 && far[1] >= end, String(far));
});

test("panning stops at the ends of the run", () => {
  assert.deepEqual(kept([-5e9, -4e9], 1e11), [-1e7, 1e9 - 1e7]);
  assert.deepEqual(kept([2e11, 2.01e11], 1e11), [1e11 + 1e7 - 1e9, 1e11 + 1e7]);
});

test("a written time is read to the nanosecond, with a sign from now on", () => {
  const now = 755_400_695_454;
  assert.deepEqual(["755.400695454", "12.5 s", "300ms", "+20 us", "-1.5 µs", "+7 ns", " 0 "].map((text) => timeOf(text, now)),
    [755_400_695_454, 12_500_000_000, 300_000_000, now + 20_000, now - 1500, now + 7, 0]);
  assert.deepEqual(["", "s", "1 h", "1e9", "1.2.3", "0x10"].map((text) => timeOf(text, now)), [null, null, null, null, null, null]);
});
