// A message from send() to receive(): its hops with what each took, and, if it was lost, where and why.
import { findMessage } from "../at.js";
import { chainTo, hopsOf, lengthOf, lossOf, wayOf } from "../at_messages.js";
import { exact, span, spanExact } from "../time/scale.js";
import { facts, link, list, made, nameOf, part } from "./parts.js";

const after = 2e8; //  ns: tries of a message whose end is known already, e.g. repeated for a lost acknowledgement
const reach = 120e9; //  ns: a message is looked for on the air so long after it was sent
const most = 40; //  rows of a table

function head(parent, run, store, message) {
  const section = part(parent);
  const is = { run: run.index, sender: message.sender, id: message.id, at: message.sent };
  const { followed } = store.state;
  const isFollowed = followed?.sender === message.sender && followed.id === message.id;
  section.appendChild(made("h2", `message ${message.id} of ${nameOf(run, message.sender)}`));
  facts(section, [
    ["class", message.topic], ["to", nameOf(run, message.destination)], ["payload", `${message.bytes} byte`],
    ["sent", link(`${exact(message.sent)} s`, () => store.set({ t: message.sent, playing: false }))],
    ["reported to its sender", message.fate && `${message.fate}, after ${span(message.fate_at - message.sent)}`],
    ["outcome", message.verdict ?? "on its way"],
    ["in the world", link(isFollowed ? "hide its route" : "draw its route", () => store.set({ followed: isFollowed ? null : is }))],
  ]);
}

// One chain: search for a route, queue and contention, tries that failed, air; below them the sum, which is the delay.
function showChain(parent, run, store, chain, delivery) {
  const names = ["hop", "route, queue, contention", "failed transmissions", "air"];
  const rows = chain.map((hop) => [`${nameOf(run, hop.from)} → ${nameOf(run, hop.to)}`, spanExact(hop.queued),
    hop.tries > 1 ? `${hop.tries - 1}: ${spanExact(hop.trying)}` : "", spanExact(hop.air)]);
  const section = part(parent, `hops to ${nameOf(run, delivery.receiver)}`);
  const table = list(section, names, rows, (i) => store.set({ t: chain[i].ended, playing: false }));
  table.classList.add("hops");
  const sum = lengthOf(chain);
  const cell = table.createTFoot().insertRow().insertCell();
  cell.colSpan = names.length;
  cell.textContent = sum === delivery.delay ? `sum ${spanExact(sum)}, its delay`
    : `sum ${spanExact(sum)}, delay ${spanExact(delivery.delay)}: not every frame is in the record`;
}

function showLoss(parent, run, message, hops) {
  const loss = lossOf(message, hops);
  if (!loss) return;
  const holder = nameOf(run, loss.holder);
  const words = [loss.holder === message.sender ? `It never left ${holder}` : `It reached ${holder}, at ${exact(loss.since)} s`];
  if (loss.tries) {
    words.push(`${loss.tries} ${loss.tries === 1 ? "transmission" : "transmissions"} to ${nameOf(run, loss.to)}, the last at ${exact(loss.at)} s: ${loss.verdict}`);
  }
  part(parent, `lost: ${message.verdict}`).append(`${words.join("; ")}.`);
}

export function showMessage(parent, run, store) {
  const { chosen } = store.state;
  const message = findMessage(run.rows("messages", Math.max(0, chosen.at - 1), chosen.at + 1), chosen.sender, chosen.id);
  if (!message) { part(parent).append("…"); return; }
  head(parent, run, store, message);
  const { deliveries, sent } = message;
  const last = Math.max(sent, message.fate_at ?? 0, ...deliveries.map(({ at }) => at));
  const isRecorded = !["counts", "none"].includes(run.world.recorded?.frames);
  const pieces = isRecorded ? run.rows("frames", sent, Math.min(sent + reach, last + after)) : [];
  const hops = hopsOf(message, pieces);
  const way = wayOf(hops);
  if (deliveries.length > 1) {
    list(part(parent, `received by ${deliveries.length}`), ["by", "after", "hops"],
      deliveries.slice(0, most).map((one) => [nameOf(run, one.receiver), spanExact(one.delay), one.transmissions]),
      (i) => store.set({ t: deliveries[i].at, playing: false }));
  }
  for (const delivery of deliveries.slice(0, 3)) {
    const chain = chainTo(way, message.sender, delivery.receiver);
    if (chain.length) showChain(parent, run, store, chain, delivery);
    else if (deliveries.length === 1) facts(part(parent, "received"), [[nameOf(run, delivery.receiver), `after ${spanExact(delivery.delay)}`], ["hops", delivery.transmissions]]);
  }
  showLoss(parent, run, message, hops);
  if (hops.length) {
    list(part(parent, "frames with this message"), ["s", "from", "to", "ended"], hops.slice(0, most)
      .map((hop) => [exact(hop.began), nameOf(run, hop.from), nameOf(run, hop.to), hop.verdict]),
    (i) => store.set({ t: hops[i].began, playing: false, chosen: { kind: "frame", run: run.index, transmitter: hops[i].from, number: hops[i].number, at: hops[i].began } }));
  } else if (!isRecorded) {
    part(parent, "hops").append("not recorded; ", made("code", "record: {frames: all}"), " records them");
  } else if (pieces.complete && message.verdict === "delivered") {
    part(parent, "hops").append("no frame with this message is in the record; ", made("code", "record: {frames: all}"), " records all");
  }
}
