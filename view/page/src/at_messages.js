// Messages of the record's pieces (source.js): each of them once, the way of one over its hops, and where
// it was lost. Times are ns.
import { hopsOf } from "./at.js";

export { hopsOf };

/** Calls visit(columns, row) once per message: tiles also tell those that were sent shortly before them. */
export function eachMessage(pieces, visit) {
  const seen = new Set();
  for (const { tile } of pieces) {
    const columns = tile.complete ? tile.columns : null;
    for (let row = 0; row < (columns?.id?.length ?? 0); row++) {
      const key = `${columns.sender[row]} ${columns.id[row]}`;
      if (seen.has(key)) continue;
      seen.add(key);
      visit(columns, row);
    }
  }
}

/**
 * The hops that took a message to where it came first, one per radio: {from, to, tries, queued, trying, air,
 * ended}. `queued`: from when `from` had it to the first try; `trying`: from there to the try that came;
 * `air`: of that try, to its end at `to`. Their sum is what the hop took, and a chain's that of the delivery.
 */
export function wayOf(hops) {
  const way = [];
  for (const hop of hops.filter((one) => one.first)) {
    const tries = hops.filter((one) => one.from === hop.from && one.to === hop.to && one.began <= hop.began);
    const first = tries.reduce((best, one) => (one.began < best.began ? one : best));
    way.push({ from: hop.from, to: hop.to, tries: tries.length, queued: first.waited, trying: hop.began - first.began,
      air: hop.ended - hop.began, ended: hop.ended });
  }
  return way;
}

/** Of a way the hops that lead to one receiver, in order; empty: no way to it is known. */
export function chainTo(way, sender, receiver) {
  const chain = [];
  for (let node = receiver; node !== sender;) {
    const hop = way.find(({ to }) => to === node);
    if (!hop || chain.includes(hop)) return [];
    chain.unshift(hop);
    node = hop.from;
  }
  return chain;
}

/** What a chain of hops took [ns]. */
export const lengthOf = (chain) => chain.reduce((sum, { queued, trying, air }) => sum + queued + trying + air, 0);

/**
 * Where a message ended that was not delivered: {holder, since, to, tries, verdict, at}: who had it last and
 * since when; to whom it tried to pass it on, how often, and how and when the last try ended (`to` null: it
 * was never tried). Null: it was delivered, or it is on its way.
 */
export function lossOf(message, hops) {
  if (message.verdict === null || message.verdict === "delivered") return null;
  const came = hops.filter(({ first }) => first);
  const last = came.reduce((best, one) => (best && best.ended >= one.ended ? best : one), null);
  const holder = last ? last.to : message.sender;
  const since = last ? last.ended : message.sent;
  const tries = hops.filter((one) => one.from === holder && one.began >= since && !one.first);
  const end = tries[tries.length - 1];
  return { holder, since, to: end?.to ?? null, tries: tries.length, verdict: end?.verdict ?? null, at: end ? end.ended ?? end.began : null };
}
