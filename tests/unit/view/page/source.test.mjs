// Which tiles the page asks for, against a server made by hand that counts.
import assert from "node:assert/strict";
import { test } from "node:test";
import { createCache, levelFor, openSource } from "../../../../view/page/src/source.js";

const second = 1e9;

/** Serves rows of kind "events", `most` in a tile at most. @param until  how much of them is written by now. */
function serve(times, { until = () => 100 * second, most = 100 } = {}) {
  const asked = [];
  globalThis.fetch = async (url) => {
    asked.push(url);
    const match = /\/events\/(\d+)\/(\d+)$/.exec(url);
    let answer = { runs: [{ index: 0, name: "r" }] };
    if (url.endsWith("/world")) answer = { end: until(), until: until() };
    if (match) {
      const size = 8 ** Number(match[1]);
      const from = Number(match[2]) * size;
      const at = times.filter((t) => t >= from && t < from + size && t <= until());
      const complete = at.length <= most;
      answer = { from, to: from + size, until: until(), complete, columns: complete ? { at } : { at: [] } };
    }
    return { ok: true, text: async () => JSON.stringify(answer) };
  };
  const tiles = () => asked.filter((url) => url.includes("/events/")).map((url) => url.replace(/.*events\//, ""));
  return { asked, tiles };
}

const seen = (pieces, from, to) => pieces.flatMap((piece) => [...piece.tile.columns.at].filter(
  (t) => t >= Math.max(from, piece.from) && t < Math.min(to, piece.to)));

async function settle(source, look) {
  for (let k = 0; k < 50; k++) {
    const pieces = look();
    if (source.asking === 0) return pieces;
    await source.idle();
  }
  throw new Error("asks without end");
}

test("All rows of a span come, once each, also where tiles are too full", async () => {
  const times = Array.from({ length: 3000 }, (_, k) => 20 * second + k * 1e6);
  serve(times);
  const source = await openSource();
  const [from, to] = [20.5 * second, 21.5 * second];
  const pieces = await settle(source, () => source.runs[0].rows("events", from, to));
  assert.ok(pieces.complete);
  assert.deepEqual(seen(pieces, from, to), times.filter((t) => t >= from && t < to));
  for (let k = 1; k < pieces.length; k++) assert.ok(pieces[k].from >= pieces[k - 1].to);
});

test("A tile that has everything is not asked for in smaller parts", async () => {
  const { tiles } = serve([1 * second, 2 * second]);
  const source = await openSource();
  await settle(source, () => source.runs[0].rows("events", 0, 8 * second));
  const count = tiles().length;
  for (const t of [0.1, 1.5, 3]) await settle(source, () => source.runs[0].rows("events", t * second, t * second + 1000));
  assert.equal(tiles().length, count);
});

test("What is there already is not asked for again as a larger tile", async () => {
  const { tiles } = serve([1 * second]);
  const source = await openSource();
  for (let k = 0; k < 20; k++) await settle(source, () => source.runs[0].rows("events", 0.5 * second, 0.6 * second));
  assert.deepEqual(tiles(), ["11/0"]);
});

test("A summary is asked for at the level of the span, whatever is below", async () => {
  const times = Array.from({ length: 20000 }, (_, k) => k * 5e6);
  const { tiles } = serve(times);
  const source = await openSource();
  const pieces = await settle(source, () => source.runs[0].rows("events", 0, 100 * second, { summary: true }));
  assert.ok(pieces.length > 0);
  assert.ok(tiles().every((tile) => Number(tile.split("/")[0]) >= levelFor(100 * second)), tiles().join());
});

test("Of a live run a tile is asked for again when the record has gone past what it had", async () => {
  let until = 2 * second;
  const times = [1 * second, 3 * second];
  const { tiles } = serve(times, { until: () => until });
  const source = await openSource();
  source.advance(until);
  const look = () => source.runs[0].rows("events", 0, 5 * second);
  assert.deepEqual(seen(await settle(source, look), 0, 5 * second), [1 * second]);
  until = 4 * second;
  source.advance(until);
  await new Promise((resolve) => setTimeout(resolve, 300)); // not more often than four times a second
  assert.deepEqual(seen(await settle(source, look), 0, 5 * second), times);
  const count = tiles().length;
  await new Promise((resolve) => setTimeout(resolve, 300));
  await settle(source, look);
  assert.equal(tiles().length, count); // nothing was written since
});

test("What cannot be had is told, and not asked for without end", async () => {
  const { asked } = serve([]);
  const good = globalThis.fetch;
  globalThis.fetch = async (url) => (url.includes("/events/") ? (asked.push(url), { ok: false, status: 500, text: async () => "broken" }) : good(url));
  const errors = [];
  const source = await openSource(() => {}, (error) => errors.push(error.message));
  await settle(source, () => source.runs[0].rows("events", 0, second));
  await settle(source, () => source.runs[0].rows("events", 0, second));
  assert.match(errors[0], /500 broken/);
  assert.ok(asked.length < 20, `${asked.length} requests`);
});

test("An exported page finds its tiles, coarse or fine, and asks nobody", async () => {
  const { asked } = serve([]);
  const tile = (level, index, complete, at) => [`/api/runs/0/events/${level}/${index}`,
    { from: index * 8 ** level, to: (index + 1) * 8 ** level, until: 60 * second, complete, columns: { at } }];
  globalThis.BARAKA_TILES = Object.fromEntries([["/api/view", { runs: [{ index: 0, name: "r" }] }],
    ["/api/runs/0/world", { end: 60 * second, until: 60 * second }],
    tile(12, 0, false, []), tile(11, 0, true, [1 * second]), tile(11, 1, true, [9 * second])]);
  try {
    const source = await openSource();
    const pieces = await settle(source, () => source.runs[0].rows("events", 0, 12 * second));
    assert.deepEqual(seen(pieces, 0, 12 * second), [1 * second, 9 * second]);
    assert.equal(asked.length, 0);
  } finally {
    delete globalThis.BARAKA_TILES;
  }
});

test("The cache drops what was used least lately, and never more than it must", async () => {
  const cache = createCache(100);
  const put = (url) => cache.ask(url, async () => ({ answer: url, bytes: 40 }), () => {}, assert.fail);
  await put("a");
  await put("b");
  cache.look("a");
  await put("c");
  assert.deepEqual([cache.look("a")?.answer, cache.look("b")?.answer, cache.look("c")?.answer], ["a", undefined, "c"]);
  assert.equal(cache.bytes, 80);
});
