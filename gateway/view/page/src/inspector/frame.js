// One frame with how it ended at every radio, and one message on its way.
import { findFrame, findMessage, hopsOf } from "../at.js";
import { exact, span, spanExact } from "../time/scale.js";
import { facts, link, list, nameOf, number, part } from "./parts.js";

const reach = 120e9; //  ns: a message is looked for on the air so long after it was sent

export function showFrame(parent, run, store) {
  const { chosen } = store.state;
  const frame = findFrame(run.rows("frames", chosen.at, chosen.at + 1), chosen.transmitter, chosen.number);
  const head = part(parent);
  if (!frame) { head.append("…"); return; }
  head.appendChild(document.createElement("h2")).textContent = `${frame.packet ?? frame.class} from ${nameOf(run, frame.transmitter)}`;
  const message = frame.message === null ? null : link(`${frame.message} of ${nameOf(run, frame.sender)}`, () => {
    const of = { run: run.index, sender: frame.sender, id: frame.message, at: frame.at };
    store.set({ chosen: { kind: "message", ...of }, followed: of });
  });
  facts(head, [
    ["class", frame.class], ["routing sent", frame.packet], ["message", message],
    ["from", link(nameOf(run, frame.transmitter), () => store.set({ chosen: { kind: "agent", run: run.index, agent: frame.transmitter } }))],
    ["to", nameOf(run, frame.receiver)], ["begins", `${exact(frame.at)} s`], ["on the air", spanExact(frame.airtime)],
    ["length", `${frame.bits} bit`], ["rate", frame.rate && `${number(frame.rate / 1e6)} Mb/s`],
    ["Duration field", spanExact(frame.nav ?? 0)], ["sequence", `${frame.sequence}${frame.retry ? ", sent before" : ""}`],
    ["number", frame.number],
  ]);
  list(part(parent, "at each radio"), ["radio", "verdict", "RSSI/dBm", "SINR/dB", "ended/µs"], frame.ends.map((end) => [
    nameOf(run, end.agent), end.verdict, end.rssi === null ? "" : end.rssi.toFixed(1), end.sinr === null ? "" : (Math.abs(end.sinr) < 0.05 ? 0 : end.sinr).toFixed(1),
    ((end.at - frame.at) / 1e3).toFixed(3)]), (i) => store.set({ chosen: { kind: "agent", run: run.index, agent: frame.ends[i].agent } }));
}

/** The hops that took a message to where it came first, one per radio, with what each took [ns]. */
export function wayOf(hops) {
  const way = [];
  for (const hop of hops.filter((one) => one.first)) {
    const tries = hops.filter((one) => one.from === hop.from && one.to === hop.to && one.began <= hop.began);
    const first = Math.min(...tries.map((one) => one.began));
    way.push({ from: hop.from, to: hop.to, tries: tries.length, queued: tries.find((one) => one.began === first).waited,
      trying: hop.began - first, air: hop.ended - hop.began, ended: hop.ended });
  }
  return way;
}

export function showMessage(parent, run, store) {
  const { chosen } = store.state;
  const head = part(parent);
  const found = findMessage(run.rows("messages", Math.max(0, chosen.at - 1), chosen.at + 1), chosen.sender, chosen.id);
  if (!found) { head.append("…"); return; }
  const last = Math.max(found.sent, found.fate_at ?? 0, ...found.deliveries.map(({ at }) => at));
  const pieces = run.rows("frames", found.sent, Math.min(found.sent + reach, Math.max(last, found.sent) + 2e8));
  const hops = hopsOf(found, pieces);
  head.appendChild(document.createElement("h2")).textContent = `message ${found.id} of ${nameOf(run, found.sender)}`;
  facts(head, [
    ["class", found.topic], ["to", nameOf(run, found.destination)], ["payload", `${found.bytes} byte`], ["sent", `${exact(found.sent)} s`],
    ["its sender heard", found.fate && `${found.fate}, after ${span(found.fate_at - found.sent)}`], ["it ended", found.verdict ?? "on its way"],
    ["on the way", link(store.state.followed?.id === found.id ? "shown" : "show", () => store.set({ followed: { run: run.index, sender: found.sender, id: found.id, at: found.sent } }))],
  ]);
  if (found.deliveries.length) {
    list(part(parent, "received"), ["by", "after", "sends"], found.deliveries.slice(0, 60)
      .map((one) => [nameOf(run, one.receiver), spanExact(one.delay), one.transmissions]));
  }
  const way = wayOf(hops);
  const isLost = found.verdict !== null && found.verdict !== "delivered";
  if (way.length) {
    list(part(parent, "hops"), ["from", "to", "waited", "tries", "trying", "air"], way.slice(0, 60).map((hop) => [
      nameOf(run, hop.from), nameOf(run, hop.to), spanExact(hop.queued), hop.tries, hop.trying ? spanExact(hop.trying) : "", spanExact(hop.air)]),
    (i) => store.set({ t: way[i].ended, playing: false }));
  } else if (run.world.recorded?.frames === "counts" || run.world.recorded?.frames === "none") {
    part(parent, "hops").append("not recorded: record: {frames: all}");
  }
  if (isLost) {
    const failed = hops.filter((hop) => !hop.first && hop.verdict !== "delivered");
    const where = failed[failed.length - 1];
    part(parent, "lost").append(where ? `${found.verdict}: ${nameOf(run, where.from)} → ${nameOf(run, where.to)}, ${where.verdict} at ${exact(where.began)} s` : found.verdict);
  }
}
