// Messages from send() to receive(), and what happened in the world.
import { eachRow } from "../at.js";
import { eachMessage } from "../at_messages.js";
import { colour } from "../colours.js";
import { createDensity, drawDensity } from "./density.js";
import { span } from "./scale.js";

const rowsOf = (sender, id, rows) => (sender * 7 + id) % rows;

const isLost = (columns, row) => columns.verdict[row] !== null && columns.verdict[row] !== "delivered";

/**
 * A message is a line from when it was sent to each delivery; lost: a cross where its fate was told. Where
 * there are more than there is room for, or they are only counted, how many were sent.
 */
export function drawMessages(ctx, box, scale, pieces, hits, chosen) {
  const rows = Math.max(1, Math.floor((box.height - 6) / 5));
  let count = 0;
  eachMessage(pieces, (columns, row) => { count += columns.sent[row] >= scale.from && columns.sent[row] <= scale.to; });
  const dense = count > box.width;
  const density = createDensity(box, scale);
  for (const { tile } of pieces) {
    if (tile.complete) continue;
    const length = (tile.to - tile.from) / tile.bins.n;
    sumOf(tile.bins).forEach((sum, bin) => density.spread(tile.from + bin * length, tile.from + (bin + 1) * length, sum));
  }
  eachMessage(pieces, (columns, row) => {
    if (dense) density.put(columns.sent[row], 1, isLost(columns, row) ? 1 : 0);
    else drawOne(ctx, box, scale, columns, row, box.y + 4 + 5 * rowsOf(columns.sender[row], columns.id[row], rows), { hits, chosen });
  });
  drawDensity(ctx, box, density.counts, density.lost, "delivered");
}

const sumOf = ({ n, counts }) => counts.flat().length === n ? counts.flat() : counts.reduce((sum, of) => sum.map((one, i) => one + of[i]), Array(n).fill(0));

function drawOne(ctx, box, scale, columns, row, y, { hits, chosen }) {
  const sent = columns.sent[row];
  const lost = isLost(columns, row);
  const arrivals = columns.deliveries[row].map(([, at]) => at);
  const last = Math.max(sent, ...arrivals, lost && columns.fate_at[row] !== null ? columns.fate_at[row] : sent);
  const x0 = scale.x(sent);
  const x1 = scale.x(last);
  if (x1 < box.x - 4 || x0 > box.x + box.width + 4) return;
  ctx.strokeStyle = ctx.fillStyle = colour(lost ? "lost" : "delivered");
  ctx.lineWidth = 1.5;
  ctx.beginPath();
  ctx.moveTo(x0, y);
  ctx.lineTo(Math.max(x1, x0 + 1), y);
  ctx.stroke();
  ctx.fillRect(x0 - 1, y - 2.5, 2, 5);
  for (const at of arrivals) {
    ctx.beginPath();
    ctx.arc(scale.x(at), y, 2, 0, 2 * Math.PI);
    ctx.fill();
  }
  if (lost) {
    ctx.beginPath();
    ctx.moveTo(x1 - 3, y - 3); ctx.lineTo(x1 + 3, y + 3); ctx.moveTo(x1 - 3, y + 3); ctx.lineTo(x1 + 3, y - 3);
    ctx.stroke();
  }
  ctx.lineWidth = 1;
  const [sender, id] = [columns.sender[row], columns.id[row]];
  if (chosen?.kind === "message" && chosen.sender === sender && chosen.id === id) {
    ctx.strokeStyle = colour("ink");
    ctx.strokeRect(x0 - 4.5, y - 4.5, Math.max(x1, x0) - x0 + 9, 9);
  }
  hits.push({ x0: x0 - 4, x1: Math.max(x1, x0) + 4, y0: y - 4, y1: y + 4, chosen: { kind: "message", sender, id, at: sent },
    text: `${columns.topic[row]} ${id}: ${columns.verdict[row] ?? "on its way"}${last > sent ? ` after ${span(last - sent)}` : ""}` });
}

// Told apart by shape too, not by colour alone.
const marks = { discovery: ["accent", "up"], scripted: ["followed", "square"], "lost body": ["lost", "cross"], contact: ["collision", "diamond"],
  association: ["delivered", "circle"], arrival: ["muted", "down"] };
const shapes = { up: [[0, -1], [1, 1], [-1, 1]], down: [[0, 1], [1, -1], [-1, -1]], square: [[-1, -1], [1, -1], [1, 1], [-1, 1]],
  diamond: [[0, -1.2], [1.2, 0], [0, 1.2], [-1.2, 0]],
  cross: [[-1, -0.5], [-0.5, -1], [0, -0.5], [0.5, -1], [1, -0.5], [0.5, 0], [1, 0.5], [0.5, 1], [0, 0.5], [-0.5, 1], [-1, 0.5], [-0.5, 0]] };

function drawMark(ctx, x, y, kind) {
  const [name, shape] = marks[kind] ?? ["muted", "circle"];
  ctx.fillStyle = colour(name);
  ctx.beginPath();
  if (shapes[shape]) for (const [dx, dy] of shapes[shape]) ctx.lineTo(x + 4 * dx, y + 5 * dy);
  else ctx.arc(x, y, 4, 0, 2 * Math.PI);
  ctx.fill();
}

const frequent = ["arrival", "discovery"]; //  drawn first, so that they cover nothing

/** A mark for each event, with what it was to be read when it is pointed at. */
export function drawEvents(ctx, box, scale, pieces, hits) {
  const density = createDensity(box, scale);
  for (const { tile } of pieces) {
    if (tile.complete) continue;
    const length = (tile.to - tile.from) / tile.bins.n;
    sumOf(tile.bins).forEach((sum, bin) => density.spread(tile.from + bin * length, tile.from + (bin + 1) * length, sum));
  }
  drawDensity(ctx, box, density.counts, density.lost, "muted");
  const marked = [[], []];
  eachRow(pieces, scale.from, scale.to, (columns, row) => marked[frequent.includes(columns.kind[row]) ? 0 : 1].push([columns, row]));
  for (const [columns, row] of marked.flat()) {
    const x = scale.x(columns.at[row]);
    drawMark(ctx, x, box.y + box.height / 2, columns.kind[row]);
    hits.push({ x0: x - 4, x1: x + 4, y0: box.y, y1: box.y + box.height, t: columns.at[row],
      text: `${columns.kind[row]}: ${columns.text[row]}`,
      chosen: columns.agent[row] === null ? null : { kind: "agent", agent: columns.agent[row] } });
  }
}

/** A recorded series as a line, or, where there is more than fits, its least and greatest values. */
export function drawSeries(ctx, box, scale, pieces) {
  let [low, high] = [Infinity, -Infinity];
  const each = (visit) => {
    for (const { tile } of pieces) {
      if (tile.complete) tile.columns.at.forEach((at, i) => visit(at, tile.columns.value[i], tile.columns.value[i]));
      else tile.bins.min.forEach((min, i) => { if (min !== null) visit(tile.from + (i + 0.5) * (tile.to - tile.from) / tile.bins.n, min, tile.bins.max[i]); });
    }
  };
  each((at, min, max) => { if (at >= scale.from && at <= scale.to) { low = Math.min(low, min); high = Math.max(high, max); } });
  if (low > high) return null;
  const reach = high > low ? high - low : 1;
  const y = (value) => box.y + box.height - 3 - (box.height - 8) * ((value - low) / reach);
  ctx.strokeStyle = colour("accent");
  ctx.beginPath();
  let begun = false;
  each((at, min, max) => {
    const x = Math.min(Math.max(scale.x(at), box.x), box.x + box.width);
    if (begun) ctx.lineTo(x, y(min)); else ctx.moveTo(x, y(min));
    if (max !== min) ctx.lineTo(x, y(max));
    begun = true;
  });
  ctx.stroke();
  return [low, high];
}
