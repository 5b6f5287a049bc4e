// What was at a time: pure functions of the record's pieces (source.js) and t.
// Times are ns, places m, angles rad.

/** The index of the last value of a sorted column that is not greater; -1: all are. */
export function lastAt(column, t) {
  let low = 0;
  let high = column.length;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (column[middle] <= t) low = middle + 1; else high = middle;
  }
  return low - 1;
}

/** The way from angle a to angle b that is half a turn or less [rad]. */
export const turn = (a, b) => {
  const way = (b - a) % (2 * Math.PI);
  return way > Math.PI ? way - 2 * Math.PI : way < -Math.PI ? way + 2 * Math.PI : way;
};

/** The piece that a time lies in; of a time between pieces or at the very end the one before it. */
export function pieceAt(pieces, t) {
  let best = null;
  for (const piece of pieces) if (piece.from <= t) best = piece;
  return best;
}

// Rows of a tile by agent, or by movable, in order of time; kept as long as the tile is.
const indices = new WeakMap();
function rowsByAgent(tile) {
  let index = indices.get(tile);
  if (!index) {
    index = new Map();
    const agents = tile.columns.agent ?? tile.columns.movable;
    for (let row = 0; row < agents.length; row++) {
      const rows = index.get(agents[row]);
      if (rows) rows.push(row); else index.set(agents[row], [row]);
    }
    indices.set(tile, index);
  }
  return index;
}

/** An agent's last row at or before t: {tile, row}, or null. For states, readings (with `where`), queues. */
export function lastRow(pieces, agent, t, where = () => true) {
  for (let k = pieces.length - 1; k >= 0; k--) {
    const { tile } = pieces[k];
    if (pieces[k].from > t || !tile.columns?.at) continue;
    const rows = rowsByAgent(tile).get(agent) ?? [];
    for (let nth = rows.length - 1; nth >= 0; nth--) {
      const row = rows[nth];
      if (tile.columns.at[row] <= t && where(tile.columns, row)) return { tile, row };
    }
  }
  return null;
}

/** The state that an agent's controller named last; null: none yet. */
export function stateAt(pieces, agent, t) {
  const found = lastRow(pieces, agent, t);
  return found && found.tile.columns.state[found.row];
}

/** What a channel of an agent read: an array with null for nothing; null: nothing yet. */
export function readingAt(pieces, agent, channel, t) {
  const found = lastRow(pieces, agent, t, (columns, row) => columns.channel[row] === channel);
  return found && found.tile.columns.values[found.row];
}

/** An agent's routing table at t from all its changes: rows {topic, destination, next_hop, hops, …}. */
export function tableAt(changes, t) {
  const table = new Map();
  const { at, topic, destination, next_hop: nextHop, removed } = changes.columns;
  const names = Object.keys(changes.columns).filter((name) => name !== "removed");
  for (let row = 0; row < at.length && at[row] <= t; row++) {
    const key = `${destination[row]} ${nextHop[row]} ${topic[row]}`;
    table.delete(key);
    if (removed[row]) continue;
    table.set(key, Object.fromEntries(names.map((name) => [name, changes.columns[name][row]])));
  }
  return [...table.values()].sort((a, b) => (a.topic < b.topic ? -1 : a.topic > b.topic ? 1
    : a.destination - b.destination || a.next_hop - b.next_hop));
}

// The rows around t of an agent or a movable: {before, after}, each {tile, row, at} or null.
function rowsAround(pieces, agent, t) {
  let before = null;
  let after = null;
  for (const { tile, from } of pieces) {
    const { at } = tile.columns;
    for (const row of rowsByAgent(tile).get(agent) ?? []) {
      if (at[row] <= t) { if (!before || at[row] >= before.at) before = { tile, row, at: at[row] }; }
      else if (!after || at[row] < after.at) after = { tile, row, at: at[row] };
    }
    if (after && from > t) break;
  }
  return { before, after };
}

/** A movable's pose at t: {x, y, z, q: [w, x, y, z]}, or null. See posesAt for what is between two rows. */
export function movableAt(pieces, movable, t, period) {
  const { before, after } = rowsAround(pieces.filter(({ tile }) => tile.columns?.movable), movable, t);
  if (!before && !after) return null;
  const pose = ({ tile: { columns: c }, row }) => [c.x[row], c.y[row], c.z[row], c.qw[row], c.qx[row], c.qy[row], c.qz[row]];
  const a = pose(before ?? after);
  const b = pose(after ?? before);
  const f = before && after ? shareOf(before.at, after.at, t, before.tile.complete ? period : 0) : 0;
  // q and -q are the same rotation: the nearer one.
  const side = a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6] < 0 ? -1 : 1;
  const [x, y, z, ...q] = a.map((value, k) => value + f * ((k > 2 ? side : 1) * b[k] - value));
  const length = Math.hypot(...q);
  return { x, y, z, q: q.map((value) => value / length) };
}

/** An agent's pose at t: {x, y, theta}, or null. See posesAt for what is between two rows. */
export function poseAt(pieces, agent, t, period) {
  const { before, after } = rowsAround(pieces, agent, t);
  if (!before && !after) return null;
  const pose = ({ tile: { columns }, row }) => ({ x: columns.x[row], y: columns.y[row], theta: columns.theta[row] });
  if (!before || !after) return pose(before ?? after);
  const a = pose(before);
  const b = pose(after);
  const f = shareOf(before.at, after.at, t, before.tile.complete ? period : 0);
  return { x: a.x + f * (b.x - a.x), y: a.y + f * (b.y - a.y), theta: a.theta + f * turn(a.theta, b.theta) };
}

// How much of the way between two rows is done. Poses are recorded once per period and only of what moved:
// what has a longer gap stood still until one period before the later row. 0: not known, it moved all along.
function shareOf(before, after, t, period) {
  const begin = period > 0 ? Math.max(before, after - period) : before;
  return after > begin ? Math.min(1, Math.max(0, (t - begin) / (after - begin))) : 0;
}

const poseIndices = new WeakMap();

/** A tile's poses side by side per agent, with the way that it came in its own frame, for wheels. */
function poseIndex(tile, slots) {
  let index = poseIndices.get(tile);
  if (index) return index;
  const { agent, at, x, y, theta } = tile.columns;
  const start = new Int32Array(slots.size + 1);
  for (let row = 0; row < agent.length; row++) {
    const slot = slots.get(agent[row]);
    if (slot !== undefined) start[slot + 1]++;
  }
  for (let slot = 0; slot < slots.size; slot++) start[slot + 1] += start[slot];
  const count = start[slots.size];
  index = { start, cursor: start.slice(0, -1), at: new Float64Array(count), x: new Float64Array(count), y: new Float64Array(count),
    theta: new Float64Array(count), ahead: new Float32Array(count), aside: new Float32Array(count), turned: new Float32Array(count) };
  const next = start.slice(0, -1);
  for (let row = 0; row < agent.length; row++) {
    const slot = slots.get(agent[row]);
    if (slot === undefined) continue;
    const k = next[slot]++;
    index.at[k] = at[row];
    index.x[k] = x[row];
    index.y[k] = y[row];
    index.theta[k] = theta[row];
    if (k > start[slot]) addWay(index, k);
  }
  poseIndices.set(tile, index);
  return index;
}

// The way from the row before, in the body's frame: x ahead, y aside, at the mean heading.
function addWay(index, k) {
  const { x, y, theta, ahead, aside, turned } = index;
  const turns = turn(theta[k - 1], theta[k]);
  const heading = theta[k - 1] + turns / 2;
  const dx = x[k] - x[k - 1];
  const dy = y[k] - y[k - 1];
  ahead[k] = ahead[k - 1] + dx * Math.cos(heading) + dy * Math.sin(heading);
  aside[k] = aside[k - 1] - dx * Math.sin(heading) + dy * Math.cos(heading);
  turned[k] = turned[k - 1] + turns;
}

/** Room for posesAt: one number per agent and column. */
export function createPoses(agents) {
  const column = () => new Float64Array(agents.length);
  const poses = { x: column(), y: column(), theta: column(), ahead: column(), aside: column(), turned: column() };
  agents.forEach((agent, slot) => {
    poses.x[slot] = agent.x;
    poses.y[slot] = agent.y;
    poses.theta[slot] = agent.theta;
  });
  return poses;
}

/**
 * All agents' poses at t into `poses`, without making anything: called for each picture.
 * @param slots  agent → place in `poses`. @param period  of the record [ns].
 */
export function posesAt(pieces, t, period, slots, poses) {
  const piece = pieceAt(pieces, t) ?? pieces[0];
  if (!piece?.tile.columns?.at) return;
  const later = pieces[pieces.indexOf(piece) + 1];
  const index = poseIndex(piece.tile, slots);
  const following = later?.tile.columns?.at ? poseIndex(later.tile, slots) : null;
  const known = piece.tile.complete ? period : 0;
  const { start, cursor, at } = index;
  for (let slot = 0; slot < slots.size; slot++) {
    const first = start[slot];
    const end = start[slot + 1];
    if (first === end) continue;
    let k = cursor[slot];
    while (k + 1 < end && at[k + 1] <= t) k++;
    while (k > first && at[k] > t) k--;
    cursor[slot] = k;
    if (k + 1 < end) between(poses, slot, index, k, index, k + 1, shareOf(at[k], at[k + 1], t, known));
    else if (following) across(poses, slot, index, k, following, piece.tile.to, t, known);
    else between(poses, slot, index, k, index, k, 0);
  }
}

// The next row is in the next tile, which begins with one of before itself.
function across(poses, slot, index, k, following, to, t, period) {
  let next = following.start[slot];
  const end = following.start[slot + 1];
  while (next < end && following.at[next] < to) next++;
  if (next === end) between(poses, slot, index, k, index, k, 0);
  else between(poses, slot, index, k, following, next, shareOf(index.at[k], following.at[next], t, period));
}

function between(poses, slot, a, k, b, next, f) {
  poses.x[slot] = a.x[k] + f * (b.x[next] - a.x[k]);
  poses.y[slot] = a.y[k] + f * (b.y[next] - a.y[k]);
  poses.theta[slot] = a.theta[k] + f * turn(a.theta[k], b.theta[next]);
  const same = a === b ? f : 0; //  another tile counts the way from its own begin
  poses.ahead[slot] = a.ahead[k] + same * (b.ahead[next] - a.ahead[k]);
  poses.aside[slot] = a.aside[k] + same * (b.aside[next] - a.aside[k]);
  poses.turned[slot] = a.turned[k] + same * (b.turned[next] - a.turned[k]);
}

/**
 * How far a wheel has turned about its axle [rad] by its robot's way: rolling without slip. `heading` is the
 * axle's; turning right-handed about it rolls to its right.
 */
export const wheelAngle = (wheel, ahead, aside, turned) => {
  const c = Math.cos(wheel.heading);
  const s = Math.sin(wheel.heading);
  return ((ahead - turned * wheel.y) * s - (aside + turned * wheel.x) * c) / wheel.radius;
};

/** Calls visit(columns, row, tile) for each row whose `at` is in [from, to]. */
export function eachRow(pieces, from, to, visit) {
  for (const piece of pieces) {
    const columns = piece.tile.columns;
    const at = columns?.at ?? columns?.sent;
    if (!at || !piece.tile.complete) continue;
    const begin = Math.max(from, piece.from);
    for (let row = lastAt(at, begin - 1) + 1; row < at.length && at[row] <= to && at[row] < piece.tile.to; row++) {
      if (at[row] >= piece.from) visit(columns, row, piece.tile);
    }
  }
}

/** One frame as an object, for the inspector and for tests. Ends as {agent, at, verdict, rssi, sinr}. */
export function frameOf(columns, row, tile) {
  const frame = {};
  for (const name of Object.keys(columns)) frame[name] = columns[name][row];
  frame.ends = frame.ends.map(([agent, at, verdict, rssi, sinr]) => ({ agent, at, verdict: tile.verdicts[verdict], rssi, sinr }));
  return frame;
}

/** A frame by transmitter and its own number; null: not there (yet). */
export function findFrame(pieces, transmitter, number) {
  let found = null;
  eachRow(pieces, 0, Infinity, (columns, row, tile) => {
    if (columns.transmitter[row] === transmitter && columns.number[row] === number) found = frameOf(columns, row, tile);
  });
  return found;
}

/** How many frames the A-MPDU of a frame has; they begin at one time. */
export function mpdusOf(pieces, frame) {
  let count = 0;
  eachRow(pieces, frame.at, frame.at, (columns, row) => {
    if (columns.transmitter[row] === frame.transmitter && columns.ampdu[row] === frame.ampdu) count++;
  });
  return count;
}

/** The frames that are in the air at t. */
export function framesAt(pieces, t) {
  const frames = [];
  eachRow(pieces, 0, t, (columns, row, tile) => {
    if (columns.at[row] + columns.airtime[row] > t) frames.push(frameOf(columns, row, tile));
  });
  return frames;
}

const merged = (spans) => {
  const result = [];
  for (const span of spans.sort((a, b) => a.from - b.from)) {
    const last = result[result.length - 1];
    if (last && span.from <= last.to) last.to = Math.max(last.to, span.to); else result.push({ ...span });
  }
  return result;
};

/**
 * What a node's radio knows of the medium: {sending, sensed, nav}, each a list of {from, to}.
 * The NAV follows the Duration fields of frames to others that it received (IEEE Std 802.11-2016, 10.3.2.4);
 * that it may be cleared after an RTS nobody answered is not in the record.
 */
export function mediumOf(pieces, agent) {
  const sending = [];
  const sensed = [];
  const nav = [];
  eachRow(pieces, 0, Infinity, (columns, row, tile) => {
    const { at, airtime } = columns;
    if (columns.transmitter[row] === agent) sending.push({ from: at[row], to: at[row] + airtime[row] });
    for (const [hearer, end, verdict] of columns.ends[row]) {
      if (hearer !== agent) continue;
      sensed.push({ from: end - airtime[row], to: end });
      if (tile.verdicts[verdict] === "delivered" && columns.receiver[row] !== agent && columns.nav[row] > 0) {
        nav.push({ from: end, to: end + columns.nav[row] });
      }
    }
  });
  return { sending: merged(sending), sensed: merged(sensed), nav: merged(nav) };
}

/** A message by sender and id; null: not there (yet). Deliveries as {receiver, at, delay, transmissions}. */
export function findMessage(pieces, sender, id) {
  for (const { tile } of pieces) {
    const columns = tile.columns;
    for (let row = 0; row < (columns?.id?.length ?? 0); row++) {
      if (columns.sender[row] !== sender || columns.id[row] !== id) continue;
      const message = Object.fromEntries(Object.keys(columns).map((name) => [name, columns[name][row]]));
      message.deliveries = message.deliveries.map(([receiver, at, delay, transmissions]) => ({ receiver, at, delay, transmissions }));
      return message;
    }
  }
  return null;
}

/**
 * The way of a message over the air: one entry per frame that carried it and per radio that it was for:
 * {from, to, number, began, ended, waited, verdict, retry, delivered}. `waited`: since it was sent or had come
 * to `from`; `ended`: when the frame ended at `to`; `delivered`: the delay of the delivery that it made [ns].
 */
export function hopsOf(message, pieces) {
  const frames = [];
  eachRow(pieces, message.sent, Infinity, (columns, row, tile) => {
    if (columns.message[row] === message.id && columns.sender[row] === message.sender) frames.push(frameOf(columns, row, tile));
  });
  const cameTo = new Map([[message.sender, message.sent]]);
  const hops = [];
  for (const frame of frames.sort((a, b) => a.at - b.at)) {
    const waited = frame.at - (cameTo.get(frame.transmitter) ?? message.sent);
    const meant = frame.ends.filter((end) => end.agent === frame.receiver || frame.receiver >= 65534);
    for (const end of meant) {
      const isFirst = end.verdict === "delivered" && !cameTo.has(end.agent);
      if (isFirst) cameTo.set(end.agent, end.at);
      const made = isFirst ? message.deliveries.find((delivery) => delivery.receiver === end.agent) : null;
      hops.push({ from: frame.transmitter, to: end.agent, number: frame.number, began: frame.at, ended: end.at, waited,
        verdict: end.verdict, retry: frame.retry, first: isFirst, delivered: made ? made.delay : null });
    }
    if (!meant.length) {
      hops.push({ from: frame.transmitter, to: frame.receiver, number: frame.number, began: frame.at, ended: null, waited,
        verdict: "below sensitivity", retry: frame.retry, first: false, delivered: null });
    }
  }
  return hops;
}
