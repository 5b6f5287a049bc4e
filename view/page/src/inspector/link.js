// The air between two agents around t.
import { paper } from "../paper.js";
import { eachRow } from "../at.js";
import { colour, verdictColour } from "../colours.js";
import { exact } from "../time/scale.js";
import { facts, list, nameOf, part } from "./parts.js";

const around = 30e9; //  ns

/** Frames of a to b's radio, and back: {at, from, verdict, rssi}. */
export function heard(pieces, from, to, a, b) {
  const rows = [];
  eachRow(pieces, from, to, (columns, row, tile) => {
    const transmitter = columns.transmitter[row];
    if (transmitter !== a && transmitter !== b) return;
    const other = transmitter === a ? b : a;
    for (const [agent, at, verdict, rssi] of columns.ends[row]) {
      if (agent === other) rows.push({ at, from: transmitter, verdict: tile.verdicts[verdict], rssi });
    }
  });
  return rows;
}

function chart(parent, rows, from, to, a) {
  const canvas = parent.appendChild(document.createElement("canvas"));
  [canvas.width, canvas.height] = [296, 90];
  const ctx = paper(canvas);
  const levels = rows.map(({ rssi }) => rssi).filter((rssi) => rssi !== null);
  if (!levels.length) return;
  const [low, high] = [Math.min(...levels) - 1, Math.max(...levels) + 1];
  ctx.fillStyle = colour("muted");
  ctx.fillText(`${high.toFixed(0)} dBm`, 2, 10);
  ctx.fillText(`${low.toFixed(0)} dBm`, 2, 88);
  ctx.textAlign = "right";
  ctx.fillText(`${exact(from).slice(0, -8)} … ${exact(to).slice(0, -8)} s`, 294, 88);
  for (const row of rows) {
    if (row.rssi === null) continue;
    ctx.fillStyle = verdictColour(row.verdict);
    const x = 296 * (row.at - from) / (to - from);
    const y = 88 - 84 * (row.rssi - low) / (high - low);
    ctx.strokeStyle = ctx.fillStyle;
    if (row.from === a) ctx.fillRect(x - 1.5, y - 1.5, 3, 3); else ctx.strokeRect(x - 1.5, y - 1.5, 3, 3);
  }
}

export function showLink(parent, run, store) {
  const { chosen: { a, b }, t } = store.state;
  const [from, to] = [Math.max(0, t - around), t + 1];
  const rows = heard(run.rows("frames", from, to), from, to, a, b);
  const head = part(parent);
  head.appendChild(document.createElement("h2")).textContent = `${nameOf(run, a)} – ${nameOf(run, b)}`;
  const ends = run.world.agents.filter(({ agent }) => agent === a || agent === b);
  facts(head, [["at the start", ends.length === 2 ? `${Math.hypot(ends[0].x - ends[1].x, ends[0].y - ends[1].y).toFixed(2)} m apart` : null]]);
  const section = part(parent, "frames heard, the last 30 s");
  for (const [source, sink] of [[a, b], [b, a]]) {
    const counts = new Map();
    for (const row of rows) if (row.from === source) counts.set(row.verdict, (counts.get(row.verdict) ?? 0) + 1);
    list(section, [`${nameOf(run, source)} → ${nameOf(run, sink)}`, "frames"], [...counts].sort((x, y) => y[1] - x[1]));
  }
  chart(part(parent, `RSSI; filled: from ${nameOf(run, a)}`), rows, from, to, a);
}
