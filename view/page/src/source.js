// The record of the runs, in tiles: what the server answers at /api/runs/R/KIND/LEVEL/INDEX, or what an
// exported page has in it (window.BARAKA_TILES, URL to answer).
//   const source = await openSource(onArrival);
//   source.runs[0].world.agents                       what does not change
//   for (const piece of source.runs[0].rows("states", from, to)) …     what is there now
// A piece is {from, to, tile}: the part of the span for which this tile is the best there is. Pieces do not
// overlap and are in order; a span that nothing has come for yet has none. `rows(...).complete` tells
// whether everything has come; what has not is asked for, and onArrival() is called when it comes.
// rows(kind, from, to, {summary: true, tiles}) is content with summaries, of so many tiles and one more.
// tile.columns are the rows (numbers as Float64Array); of a summary (tile.complete false) see the server.
// Times are ns.
import { ask as askServer } from "./server.js";

const least = 4;
const most = 17;
const size = (level) => 8 ** level;
const limit = 150e6; //   bytes of answers that are kept
const again = 250; //     ms between two questions for the same tile of a live run
const retry = 3000; //    ms before what could not be had is asked for again
const few = 600; //       rows: below this the next larger tile is asked for next time

/** The level at which `count` tiles or fewer, and one more for the edges, cover a span. */
export function levelFor(span, count = 8) {
  let level = least;
  while (level < most && size(level) * count < span) level++;
  return level;
}

// Rows as numbers side by side: a tenth of the memory of boxed ones, and quick to walk.
function packed(columns) {
  for (const [name, column] of Object.entries(columns)) {
    if (column.length && column.every((value) => typeof value === "number")) columns[name] = Float64Array.from(column);
  }
  return columns;
}

/** Where answers come from: the page itself, or the server that served it. */
function answers() {
  const inlined = globalThis.BARAKA_TILES;
  if (inlined) {
    // Which tiles have a tile of the export below them, so that nobody looks where there is nothing.
    const above = new Set();
    for (const url of Object.keys(inlined)) {
      const match = /^(.*)\/(\d+)\/(\d+)$/.exec(url);
      if (!match) continue;
      let index = Number(match[3]);
      for (let level = Number(match[2]) + 1; level <= most; level++) {
        index = Math.floor(index / 8);
        above.add(`${match[1]}/${level}/${index}`);
      }
    }
    return {
      inlined,
      hasBelow: (url) => above.has(url),
      get: async (url) => ({ answer: inlined[url] ?? null, bytes: 0 }),
    };
  }
  return {
    hasBelow: () => true,
    async get(url) {
      const response = await askServer(url).catch(() => { throw new Error("The server does not answer. Shown is what arrived before."); });
      const text = await response.text();
      if (!response.ok) throw new Error(`${url}: ${response.status} ${text.slice(0, 200)}`);
      return { answer: JSON.parse(text), bytes: text.length };
    },
  };
}

/** One run's record. `live()`: up to when the record of a live run is written; null of a finished one. */
function openRun({ index, name, folder, title }, world, from, { onArrival, cache, live, onError }) {
  const base = `/api/runs/${index}`;
  const hint = new Map(); //     kind → level whose tiles were complete lately
  const ceiling = new Map(); //  kind → level above which tiles were seen that were not

  const ask = (url) => cache.ask(url, () => from.get(url).then(({ answer, bytes }) => {
    if (answer?.columns) packed(answer.columns);
    return { answer, bytes };
  }), onArrival, onError);

  // Rows that are written behind the `until` of a tile are in its next answer only.
  const isOld = (entry, to) => {
    const tile = entry.answer;
    const written = live();
    return tile && written !== null && tile.until < Math.min(tile.to, to) && written > tile.until &&
      performance.now() - entry.asked > again;
  };

  function tileNow(kind, level, tileIndex, to) {
    const url = `${base}/${kind}/${level}/${tileIndex}`;
    const entry = cache.look(url);
    if (!entry || (!entry.asking && (isOld(entry, to) || (entry.failed && performance.now() - entry.asked > retry)))) ask(url);
    return entry ?? cache.look(url);
  }

  function rows(kind, start, end, { summary = false, tiles = 8 } = {}) {
    const from_ = Math.max(0, start);
    const to = Math.max(from_ + 1, end);
    const pieces = [];
    pieces.complete = true;
    if (world.isPlan) return pieces; //  nobody has run it
    const finest = summary ? levelFor(to - from_, tiles) : levelFor(to - from_, 64);
    const first = Math.max(finest, from.inlined ? most : hint.get(kind) ?? 11);
    // A larger tile that is complete already spares all smaller ones.
    let level = first;
    for (let up = first + 1; up <= most; up++) {
      if (cache.look(`${base}/${kind}/${up}/${Math.floor(from_ / size(up))}`)?.answer?.complete) level = up;
    }
    const children = (at, tileIndex, call) => {
      const below = size(at - 1);
      const end_ = Math.min(to, (tileIndex + 1) * size(at));
      for (let k = Math.floor(Math.max(from_, tileIndex * size(at)) / below); k * below < end_; k++) call(at - 1, k);
    };
    // Smaller tiles that are there already spare a larger one.
    const isCovered = (at, tileIndex, depth = 3) => {
      if (at <= least || !depth) return false;
      let covered = true;
      children(at, tileIndex, (level_, k) => {
        covered &&= cache.look(`${base}/${kind}/${level_}/${k}`)?.answer?.complete || isCovered(level_, k, depth - 1);
      });
      return covered;
    };
    const visit = (at, tileIndex) => {
      const tileFrom = tileIndex * size(at);
      const tileTo = tileFrom + size(at);
      if (!cache.look(`${base}/${kind}/${at}/${tileIndex}`) && isCovered(at, tileIndex)) {
        children(at, tileIndex, visit);
        return;
      }
      const entry = tileNow(kind, at, tileIndex, to);
      const tile = entry?.answer;
      const piece = tile && { from: Math.max(from_, tileFrom), to: Math.min(to, tileTo), tile };
      if (tile?.complete) {
        note(kind, at, tile);
        if (tile.until < piece.to) piece.to = Math.max(piece.from, tile.until);
        pieces.push(piece);
      } else if (entry?.failed) {
        pieces.complete = false;
      } else if (at <= finest || !(tile ?? from.hasBelow(`${base}/${kind}/${at}/${tileIndex}`))) {
        if (piece) pieces.push(piece);
        if (!tile && !entry?.answered) pieces.complete = false;
        if (tile && !summary) pieces.complete = false;
      } else if (!tile && !entry?.answered) {
        pieces.complete = false; // asked for; whether there is anything finer is not known yet
      } else {
        hint.set(kind, Math.max(finest, at - 1));
        if (tile) ceiling.set(kind, Math.min(at - 1, ceiling.get(kind) ?? most)); // somewhere this was too full: not tried again
        const length = pieces.length;
        children(at, tileIndex, visit);
        if (pieces.length === length && piece) pieces.push(piece); // nothing finer yet: the summary
      }
    };
    for (let k = Math.floor(from_ / size(level)); k * size(level) < to && k * size(level) <= world.endsAt(); k++) visit(level, k);
    return pieces;
  }

  // The level at which to ask next time: one up where tiles are nearly empty.
  function note(kind, level, tile) {
    const count = Object.values(tile.columns ?? {})[0]?.length ?? 0;
    if (count < few && tile.until >= tile.to && level < (ceiling.get(kind) ?? most) && level >= (hint.get(kind) ?? 11)) hint.set(kind, level + 1);
  }

  const whole = (url) => {
    if (world.isPlan) return null;
    const entry = cache.look(url);
    if (!entry || (!entry.asking && live() !== null && live() > (entry.answer?.until ?? entry.live ?? 0) &&
        performance.now() - entry.asked > 4 * again)) {
      ask(url);
      if (cache.look(url)) cache.look(url).live = live();
    }
    return cache.look(url)?.answer ?? null;
  };

  return {
    index, name, folder, title, world, rows,
    /** The tile itself: a promise. */
    tile: (kind, level, tileIndex) => ask(`${base}/${kind}/${level}/${tileIndex}`),
    /** All changes of an agent's routes; null until they have come. */
    routes: (agent) => whole(`${base}/routes/${agent}`),
    /** An agent's counters; null until they have come. */
    totals: (agent) => whole(`${base}/totals/${agent}`),
    /** The radio coverage of the access points; null until it has come. */
    coverage() {
      const url = `${base}/coverage`;
      if (!cache.look(url)) ask(url);
      return cache.look(url)?.answer ?? null;
    },
    get end() { return world.endsAt(); },
  };
}

/** Answers by URL, least lately used ones dropped beyond the limit. */
export function createCache(bytesLimit = limit) {
  const entries = new Map(); //  in order of use
  let bytes = 0;
  let asking = 0;
  const cache = {
    look(url) {
      const entry = entries.get(url);
      if (entry) { entries.delete(url); entries.set(url, entry); }
      return entry;
    },
    ask(url, get, onArrival, onError) {
      const known = entries.get(url);
      if (known?.asking) return known.asking;
      const entry = known ?? { answer: null, bytes: 0, answered: false };
      entries.set(url, entry);
      entry.asked = performance.now();
      asking++;
      const done = () => { entry.asking = null; asking--; };
      entry.asking = get().then(({ answer, bytes: length }) => {
        done();
        bytes += length - entry.bytes;
        Object.assign(entry, { answer, bytes: length, answered: true, failed: false });
        if (entries.get(url) !== entry) bytes -= length;
        cache.trim();
        onArrival();
        return answer;
      }, (error) => {
        done();
        Object.assign(entry, { answered: true, failed: true });
        onError(error);
        onArrival();
        return null;
      });
      return entry.asking;
    },
    trim() {
      for (const [url, entry] of entries) {
        if (bytes <= bytesLimit) break;
        if (entry.asking) continue;
        entries.delete(url);
        bytes -= entry.bytes;
      }
    },
    get bytes() { return bytes; },
    get asking() { return asking; },
    get size() { return entries.size; },
  };
  return cache;
}

/** Opens all runs. onArrival() after each answer; onError(error) for what could not be had. */
export async function openSource(onArrival = () => {}, onError = () => {}) {
  const from = answers();
  const cache = createCache();
  const waiting = [];
  let arrivals = 0;
  const arrived = () => {
    arrivals++;
    onArrival();
    if (cache.asking === 0) for (const resolve of waiting.splice(0)) resolve();
  };
  const view = (await from.get("/api/view")).answer;
  let until = null; //  of a live run, as the server tells it
  // Runs of one scenario are told apart by their folders.
  const titleOf = ({ name, folder }) => (folder && view.runs.filter((other) => other.name === name).length > 1
    ? folder.replace(/\/+$/, "").split("/").pop() : name);
  const runs = await Promise.all(view.runs.map(async (told) => {
    const world = (await from.get(`/api/runs/${told.index}/world`)).answer;
    world.isPlan = view.mode === "scenario";
    world.endsAt = () => Math.max(world.until ?? world.end ?? 0, until ?? 0);
    return openRun({ ...told, title: titleOf(told) }, world, from, { onArrival: arrived, cache, live: () => until, onError });
  }));
  return {
    view, runs,
    exported: Boolean(from.inlined),
    /** A live run has been recorded up to here. */
    advance(to) { if (to !== until) { until = to; onArrival(); } },
    get end() { return Math.max(1, ...runs.map((run) => run.end)); },
    get bytes() { return cache.bytes; },
    get asking() { return cache.asking; },
    /** What does not come in tiles has changed. */
    touch() { arrivals++; onArrival(); },
    /** How many answers have come: another number, perhaps other rows. */
    get arrivals() { return arrivals; },
    /** Resolves when everything that was asked for has come. */
    idle: () => (cache.asking === 0 ? Promise.resolve() : new Promise((resolve) => waiting.push(resolve))),
  };
}
