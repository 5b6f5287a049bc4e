// What agents' controllers said of themselves, and what a chosen agent's radio knows of the medium.
import { lastRow, mediumOf } from "../at.js";
import { colour } from "../colours.js";

const places = ["robot-0", "robot-1", "robot-2", "robot-3", "robot-4", "robot-5", "robot-7", "muted"];

/** States have colours by their place among all states of the run. */
export const stateColour = (states, state) => colour(places[Math.max(0, states.indexOf(state)) % places.length]);

/** Rows of one agent's states: [{from, to, state}] within the span. */
export function stateSpans(pieces, agent, from, to) {
  const changes = [];
  const first = lastRow(pieces, agent, from);
  if (first) changes.push({ at: from, state: first.tile.columns.state[first.row] });
  for (const piece of pieces) {
    const columns = piece.tile.columns;
    if (!columns?.at || !piece.tile.complete) continue;
    for (let row = 0; row < columns.at.length; row++) {
      const at = columns.at[row];
      if (columns.agent[row] === agent && at > from && at <= to && at >= piece.from && at < piece.to + 1) {
        changes.push({ at, state: columns.state[row] });
      }
    }
  }
  return changes.map(({ at, state }, i) => ({ from: at, to: changes[i + 1]?.at ?? to, state }));
}

export function drawStates(ctx, box, scale, spans, states) {
  for (const { from, to, state } of spans) {
    const x0 = Math.max(box.x, scale.x(from));
    const x1 = Math.min(box.x + box.width, scale.x(to));
    if (x1 <= x0) continue;
    ctx.globalAlpha = 0.75;
    ctx.fillStyle = stateColour(states, state);
    ctx.fillRect(x0, box.y + 2, Math.max(1, x1 - x0 - 0.5), box.height - 4);
    ctx.globalAlpha = 1;
    if (x1 - x0 > 40) {
      ctx.fillStyle = colour("back");
      ctx.fillText(state, x0 + 4, box.y + box.height / 2, x1 - x0 - 8);
    }
  }
}

/** Strips of a radio: it sends, it hears, it keeps still for others (NAV). */
export function drawMedium(ctx, box, scale, pieces, agent) {
  const complete = pieces.filter(({ tile }) => tile.complete);
  const { sending, sensed, nav } = mediumOf(complete, agent);
  const third = box.height / 3;
  [["followed", sending], ["sensed", sensed], ["lost", nav]].forEach(([name, spans], i) => {
    ctx.fillStyle = colour(name);
    for (const { from, to } of spans) {
      const x0 = Math.max(box.x, scale.x(from));
      const x1 = Math.min(box.x + box.width, scale.x(to));
      if (x1 > box.x && x0 < box.x + box.width) ctx.fillRect(x0, box.y + i * third + 1, Math.max(1, x1 - x0), third - 2);
    }
  });
}

/** A step line of a column over time: queue lengths. */
export function drawSteps(ctx, box, scale, pieces, agent, name) {
  const points = [];
  const before = lastRow(pieces, agent, scale.from);
  points.push([scale.from, before ? before.tile.columns[name][before.row] : 0]);
  for (const { tile } of pieces) {
    const columns = tile.columns;
    for (let row = 0; row < (columns?.at?.length ?? 0); row++) {
      if (columns.agent[row] === agent && columns.at[row] > scale.from && columns.at[row] <= scale.to) points.push([columns.at[row], columns[name][row]]);
    }
  }
  const most = Math.max(1, ...points.map(([, value]) => value));
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
