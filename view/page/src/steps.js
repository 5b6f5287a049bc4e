// The next frame, control cycle or event after or before a time, wherever in the run it is.
import { eachRow } from "./at.js";

const most = 60; //  questions for one width of the search

/** Rows of a span, all of them: waits until they have come. */
async function allRows(source, run, kind, from, to) {
  let pieces = run.rows(kind, from, to);
  for (let i = 0; i < most && !pieces.complete; i++) {
    await source.idle();
    pieces = run.rows(kind, from, to);
  }
  return pieces;
}

async function timesOf(source, run, of, from, to, agent) {
  const times = [];
  const isMine = (one) => agent === null || one === agent;
  const each = (pieces, name, visit) => eachRow(pieces, from, to, (columns, row) => { if (isMine(columns[name][row])) visit(columns, row); });
  if (of === "frame") {
    each(await allRows(source, run, "frames", from, to), "transmitter", (columns, row) => times.push(columns.at[row]));
    return times;
  }
  each(await allRows(source, run, "states", from, to), "agent", (columns, row) => times.push(columns.at[row]));
  each(await allRows(source, run, "events", from, to), "agent", (columns, row) => times.push(columns.at[row]));
  for (const { tile } of await allRows(source, run, "messages", from, to)) {
    const columns = tile.columns;
    for (let row = 0; row < (columns?.sent?.length ?? 0); row++) {
      if (isMine(columns.sender[row])) times.push(columns.sent[row]);
      for (const [receiver, at] of columns.deliveries[row]) if (isMine(receiver)) times.push(at);
    }
  }
  return times;
}

/**
 * @param of  "frame" | "cycle" | "event". @param way  1: after t, -1: before it. @param agent  null: anyone's.
 * @return the time [ns]; null: there is none.
 */
export async function stepTime(source, run, of, t, way, agent) {
  const period = run.world.control_period;
  if (of === "cycle") {
    const next = way > 0 ? (Math.floor(t / period) + 1) * period : (Math.ceil(t / period) - 1) * period;
    return next >= 0 && next <= run.end ? next : null;
  }
  for (let width = 8 ** 7; ; width *= 8) {
    const from = way > 0 ? t + 1 : Math.max(0, t - width);
    const to = way > 0 ? Math.min(run.end, t + width) : t - 1;
    const times = (await timesOf(source, run, of, from, to, agent)).filter((at) => at >= from && at <= to);
    if (times.length) return way > 0 ? Math.min(...times) : Math.max(...times);
    if (way > 0 ? to >= run.end : from <= 0) return null;
  }
}
