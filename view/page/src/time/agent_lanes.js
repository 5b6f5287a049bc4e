// What agents' controllers said of themselves, and what a chosen agent's radio knows of the medium.
import { eachRow, lastRow, mediumOf } from "../at.js";
import { colour, verdictColour } from "../colours.js";

const places = ["robot-0", "robot-1", "robot-2", "robot-3", "robot-4", "robot-5", "robot-7", "muted"];

/**
 * States have colours by their place among all states of the run, which are told in the order in which they first
 * came: so they keep them while more come. One that the page has not been told of yet has none.
 */
export const placeOf = (states, state) => (states.includes(state) ? places[states.indexOf(state) % places.length] : "mote");
export const stateColour = (states, state) => colour(placeOf(states, state));

/**
 * One agent's states within a span: [{from, to, state}]. Of pieces that are only summaries nothing is known;
 * each complete one begins with the state before it.
 */
export function stateSpans(pieces, agent, from, to) {
  const spans = [];
  const add = (at, end, state) => {
    const last = spans[spans.length - 1];
    if (last && last.to === at && last.state === state) last.to = end;
    else if (end > at) spans.push({ from: at, to: end, state });
  };
  for (const piece of pieces) {
    if (!piece.tile.complete) continue;
    const end = Math.min(to, piece.to);
    let at = Math.max(from, piece.from);
    const before = lastRow([piece], agent, at);
    let state = before && before.tile.columns.state[before.row];
    eachRow([piece], at, end, (columns, row) => {
      if (columns.agent[row] !== agent) return;
      if (state !== null) add(at, columns.at[row], state);
      [at, state] = [columns.at[row], columns.state[row]];
    });
    if (state !== null) add(at, end, state);
  }
  return spans;
}

/** A bar with its name in it, readable on any of the colours: pale, with a full edge below. */
export function bar(ctx, [x0, y, width, height], fill, text) {
  const named = text && width > 34;
  ctx.fillStyle = fill;
  ctx.globalAlpha = named ? 0.35 : 0.85;
  ctx.fillRect(x0, y, width, height);
  ctx.globalAlpha = 1;
  if (!named) return;
  ctx.fillRect(x0, y + height - 2, width, 2);
  ctx.fillRect(x0, y, 2, height);
  ctx.save();
  ctx.beginPath(); ctx.rect(x0, y, width - 2, height); ctx.clip();
  ctx.fillStyle = colour("ink");
  ctx.fillText(text, x0 + 5, y + height / 2);
  ctx.restore();
}

export function drawStates(ctx, box, scale, spans, states) {
  for (const { from, to, state } of spans) {
    const x0 = Math.max(box.x, scale.x(from));
    const x1 = Math.min(box.x + box.width, scale.x(to));
    if (x1 > x0) bar(ctx, [x0, box.y + 1, Math.max(1, x1 - x0 - 0.5), box.height - 3], stateColour(states, state), state);
  }
}

/** Where frames are only counted, single ones cannot be shown. */
export function drawTooMany(ctx, box, scale, pieces) {
  for (const piece of pieces) {
    if (piece.tile.complete) continue;
    const x0 = Math.max(box.x, scale.x(piece.from));
    const width = Math.min(box.x + box.width, scale.x(piece.to)) - x0;
    if (width <= 0) continue;
    ctx.fillStyle = colour("soft");
    ctx.fillRect(x0, box.y, width, box.height - 1);
    ctx.fillStyle = colour("muted");
    if (width > 60) ctx.fillText("zoom in", x0 + 4, box.y + box.height / 2, width - 8);
  }
}

function strip(ctx, box, scale, from, to, fill) {
  const x0 = Math.max(box.x, scale.x(from));
  const x1 = Math.min(box.x + box.width, scale.x(to));
  if (x1 < box.x || x0 > box.x + box.width) return null;
  ctx.fillStyle = fill;
  ctx.fillRect(x0, box.y + 2, Math.max(1, x1 - x0), box.height - 4);
  return { x0: x0 - 2, x1: Math.max(x0 + 1, x1) + 2, y0: box.y, y1: box.y + box.height };
}

const keyOf = (columns, row) => ({ kind: "frame", transmitter: columns.transmitter[row], number: columns.number[row], at: columns.at[row] });

/** The frames that a radio sends. */
export function drawSends(ctx, box, scale, pieces, agent, hits) {
  drawTooMany(ctx, box, scale, pieces);
  eachRow(pieces, 0, scale.to, (columns, row) => {
    if (columns.transmitter[row] !== agent) return;
    const at = columns.at[row];
    const place = strip(ctx, box, scale, at, at + columns.airtime[row], colour("followed"));
    if (place) hits.push({ ...place, chosen: keyOf(columns, row), text: `sends ${columns.packet?.[row] ?? columns.class[row]}` });
  });
}

/** What a radio senses of others: each frame with how it ended there. Below the line: it was not for it. */
export function drawHears(ctx, box, scale, pieces, agent, hits, names) {
  drawTooMany(ctx, box, scale, pieces);
  eachRow(pieces, 0, scale.to, (columns, row, tile) => {
    for (const [hearer, end, verdict] of columns.ends[row]) {
      if (hearer !== agent) continue;
      const word = tile.verdicts[verdict];
      const isMeant = columns.receiver[row] === agent || columns.receiver[row] >= 65534;
      const lower = isMeant ? box : { ...box, y: box.y + box.height / 2 - 1, height: box.height / 2 + 1 };
      const place = strip(ctx, lower, scale, end - columns.airtime[row], end, verdictColour(word));
      const what = `${columns.packet?.[row] ?? columns.class[row]} of ${names.get(columns.transmitter[row])}`;
      if (place) hits.push({ ...place, chosen: keyOf(columns, row), text: `${word}: ${what}${isMeant ? "" : ", for another"}` });
    }
  });
}

/** When a radio keeps still for others. */
export function drawNav(ctx, box, scale, pieces, agent) {
  drawTooMany(ctx, box, scale, pieces);
  for (const { from, to } of mediumOf(pieces, agent).nav) strip(ctx, box, scale, from, to, colour("lost"));
}

/** A step line of a column over time: queue lengths. @return the greatest */
export function drawSteps(ctx, box, scale, pieces, agent, name) {
  const before = lastRow(pieces, agent, scale.from);
  const points = [[scale.from, before ? before.tile.columns[name][before.row] : 0]];
  eachRow(pieces, scale.from, scale.to, (columns, row) => {
    if (columns.agent[row] === agent) points.push([columns.at[row], columns[name][row]]);
  });
  const most = Math.max(1, points.reduce((greatest, [, value]) => Math.max(greatest, value), 0));
  const y = (value) => box.y + box.height - 2 - (box.height - 6) * (value / most);
  ctx.strokeStyle = colour("accent");
  ctx.beginPath();
  points.forEach(([at, value], i) => {
    const x = Math.max(box.x, scale.x(at));
    if (i === 0) ctx.moveTo(x, y(value));
    else { ctx.lineTo(x, y(points[i - 1][1])); ctx.lineTo(x, y(value)); }
  });
  ctx.lineTo(box.x + box.width, y(points[points.length - 1][1]));
  ctx.stroke();
  return most;
}
