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

/** An agent's last row at or before t: {tile, row}, or null. For states, readings (with `where`), queues. */
export function lastRow(pieces, agent, t, where = () => true) {
  for (let k = pieces.length - 1; k >= 0; k--) {
    const { tile } = pieces[k];
    if (pieces[k].from > t || !tile.columns?.at) continue;
    const { agent: agents, at } = tile.columns;
    for (let row = lastAt(at, t); row >= 0; row--) {
      if (agents[row] === agent && where(tile.columns, row)) return { tile, row };
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
