// How many frames wait at a node: a pile beside it.
import { lastRow } from "../at.js";
import { colour } from "../colours.js";

const most = 5; //  squares of a pile; beyond that the number stands over it

export function createQueues(run) {
  const agents = run.world.agents;
  return {
    draw(context, camera, marks, state) {
      if (!state.layers.queues || run.world.recorded?.queues === false) return;
      const pieces = run.rows("queues", state.t, state.t + 1);
      if (!pieces.length) return;
      for (let slot = 0; slot < agents.length; slot++) {
        if (!marks.sizes[slot]) continue;
        const found = lastRow(pieces, agents[slot].agent, state.t);
        const waiting = found ? found.tile.columns.frames[found.row] : 0;
        if (waiting > 0) pile(context, marks, slot, waiting);
      }
    },
  };

  function pile(context, marks, slot, waiting) {
    const x = marks.spots[slot * 2] - marks.radiusOf(slot) - 9;
    const y = marks.spots[slot * 2 + 1] + 4;
    context.fillStyle = colour("ground");
    context.fillRect(x - 1, y - 6 * Math.min(waiting, most) - 1, 7, 6 * Math.min(waiting, most) + 2);
    context.fillStyle = colour("accent");
    for (let k = 1; k <= Math.min(waiting, most); k++) context.fillRect(x, y - 6 * k, 5, 5);
    if (waiting <= most) return;
    context.font = "10px system-ui, 'Liberation Sans', sans-serif";
    context.textBaseline = "alphabetic";
    context.fillText(String(waiting), x, y - 6 * most - 2);
  }
}
