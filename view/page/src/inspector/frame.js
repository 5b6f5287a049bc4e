// One frame with how it ended at every radio.
import { findFrame, mpdusOf } from "../at.js";
import { verdictColour } from "../colours.js";
import { exact, spanExact } from "../time/scale.js";
import { facts, fixed, link, list, nameOf, number, part } from "./parts.js";

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
    ["mode", frame.mode], ["category", frame.category],
    ["A-MPDU", frame.ampdu ? `${frame.ampdu}, of ${mpdusOf(run.rows("frames", frame.at, frame.at + 1), frame)} MPDUs` : null],
    ["A-MSDU of", frame.msdus > 1 ? `${frame.msdus} MSDUs` : null], ["Block Ack", frame.block_ack],
    ["Duration field", frame.nav === null ? null : spanExact(frame.nav)], ["sequence", `${frame.sequence}${frame.retry ? ", sent before" : ""}`],
    ["number", frame.number],
  ]);
  // First the radio that it was for, then the loudest.
  const ends = [...frame.ends].sort((a, b) => (b.agent === frame.receiver) - (a.agent === frame.receiver) || (b.rssi ?? -999) - (a.rssi ?? -999));
  const section = part(parent, ends.length ? `at ${ends.length} ${ends.length === 1 ? "radio" : "radios"}` : "received by no radio");
  if (!ends.length) return;
  const table = list(section, ["radio", "verdict", "RSSI dBm", "SINR dB", "way µs"], ends.map((end) => [
    nameOf(run, end.agent), end.verdict, end.rssi === null ? "" : fixed(end.rssi, 1), end.sinr === null ? "" : fixed(end.sinr, 1),
    ((end.at - frame.at - frame.airtime) / 1e3).toFixed(3)]), (i) => store.set({ chosen: { kind: "agent", run: run.index, agent: ends[i].agent } }));
  ends.forEach((end, i) => {
    const row = table.tBodies[0].rows[i];
    row.classList.toggle("meant", end.agent === frame.receiver);
    row.cells[1].style.color = verdictColour(end.verdict);
  });
  table.classList.add("numbers");
}
