// The frames of a span: how many, or, where each is wide enough, one by one with how they ended.
import { colour, verdictColour } from "../colours.js";
import { bar } from "./agent_lanes.js";
import { createDensity, drawDensity } from "./density.js";
import { span } from "./scale.js";

// Told apart by height too, not by colour alone.
const heights = { rts: 0.75, cts: 0.75, ack: 0.6, block_ack: 0.6 };
const classColours = { rts: "sensed", cts: "sensed", ack: "muted", broadcast: "accent", unicast: "followed", beacon: "muted", management: "muted", block_ack: "muted" };
export const frameColour = (name) => colour(classColours[name] ?? "muted");

/** The verdict that counts for a frame as a whole: at the radio that it was for; of a broadcast the worst. */
export function verdictOf(columns, row, tile) {
  const meant = columns.ends[row].filter(([agent]) => agent === columns.receiver[row] || columns.receiver[row] >= 65534);
  const verdicts = meant.map(([, , verdict]) => tile.verdicts[verdict]);
  return verdicts.find((verdict) => verdict !== "delivered") ?? verdicts[0] ?? "below sensitivity";
}

// Of each row of a tile whether it was lost; kept as long as the tile is.
const lostRows = new WeakMap();
function lostOf(tile) {
  let lost = lostRows.get(tile);
  if (!lost) {
    lost = Uint8Array.from(tile.columns.at, (_, row) => (verdictOf(tile.columns, row, tile) === "delivered" ? 0 : 1));
    lostRows.set(tile, lost);
  }
  return lost;
}

/** @param hits  is told what can be clicked. @param chosen  of the store: if it is a frame, that one has a frame around it */
export function drawFrames(ctx, box, scale, pieces, hits, names, chosen) {
  const wide = scale.perPixel < 2e5; //  ns: a frame of 1 ms has 5 px
  const density = createDensity(box, scale);
  for (const { from, to, tile } of pieces) {
    if (!tile.complete) {
      const length = (tile.to - tile.from) / tile.bins.n;
      for (let bin = 0; bin < tile.bins.n; bin++) {
        const t = tile.from + bin * length;
        if (t + length / 2 < from || t + length / 2 >= to) continue;
        density.spread(t, t + length, tile.bins.counts.reduce((sum, of) => sum + of[bin], 0), tile.bins.lost[bin]);
      }
      continue;
    }
    const { at, airtime } = tile.columns;
    for (let row = 0; row < at.length; row++) {
      if (at[row] + airtime[row] < from || at[row] >= to) continue;
      if (wide) drawOne(ctx, box, scale, tile, row, { hits, names, chosen });
      else density.put(at[row], 1, lostOf(tile)[row]);
    }
  }
  drawDensity(ctx, box, density.counts, density.lost, "accent");
}

function drawOne(ctx, box, scale, tile, row, { hits, names, chosen }) {
  const { columns } = tile;
  const x0 = scale.x(columns.at[row]);
  const x1 = Math.max(x0 + 1.5, scale.x(columns.at[row] + columns.airtime[row]));
  if (x1 < box.x || x0 > box.x + box.width) return;
  const verdict = verdictOf(columns, row, tile);
  const of = columns.class[row];
  const what = columns.packet?.[row] ?? of;
  const name = names.get(columns.transmitter[row]) ?? columns.transmitter[row];
  const bottom = box.y + box.height - 5;
  const height = (box.height - 8) * (heights[of] ?? 1);
  const left = Math.max(x0, box.x);
  bar(ctx, [left, bottom - height, Math.max(1, Math.min(x1, box.x + box.width) - left), height], frameColour(of), `${what} ${name}`);
  ctx.fillStyle = verdictColour(verdict);
  ctx.fillRect(x0, bottom, x1 - x0, 3);
  const key = { kind: "frame", transmitter: columns.transmitter[row], number: columns.number[row], at: columns.at[row] };
  if (chosen?.kind === "frame" && chosen.transmitter === key.transmitter && chosen.number === key.number) {
    ctx.strokeStyle = colour("ink");
    ctx.strokeRect(x0 - 1.5, box.y + 1.5, x1 - x0 + 3, box.height - 4);
  }
  hits.push({ x0: x0 - 2, x1: x1 + 2, y0: box.y, y1: box.y + box.height, chosen: key,
    text: `${what} of ${name}, ${span(columns.airtime[row])}: ${verdict}` });
}
