// One frame with how it ended at every radio.
import { findFrame } from "../at.js";
import { exact, span, spanExact } from "../time/scale.js";
import { facts, link, list, nameOf, number, part } from "./parts.js";

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
  list(part(parent, "at each radio"), ["radio", "verdict", "RSSI", "SINR", "ended"], frame.ends.map((end) => [
    nameOf(run, end.agent), end.verdict, end.rssi === null ? "" : `${end.rssi.toFixed(1)} dBm`, end.sinr === null ? "" : `${end.sinr.toFixed(1)} dB`,
    `+${span(end.at - frame.at, 6)}`]), (i) => store.set({ chosen: { kind: "agent", run: run.index, agent: frame.ends[i].agent } }));
}
