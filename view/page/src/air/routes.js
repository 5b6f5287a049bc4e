// The routing table of the chosen node to one destination, as arrows to the next hops: as wide as the
// probability with which a message takes each (equation 1 of the paper).
import { tableAt } from "../at.js";
import { colour } from "../colours.js";
import { arrow } from "./arrows.js";

const widest = 16; //  px of an arrow that every message takes

/** The arrows of a table: those of a topic to a destination; rows without probability share equally. */
export function arrowsOf(table, from, { topic, destination }) {
  const rows = table.filter((row) => row.topic === topic && row.destination === destination);
  return rows.map((row) => {
    const probability = row.probability ?? 1 / rows.length;
    return { from, to: row.next_hop, probability, width: widest * probability };
  });
}

export function createRoutes(run, slots) {
  const a = [0, 0, 0];
  const b = [0, 0, 0];
  const current = (state) => {
    const { chosen, route } = state;
    if (!route || chosen?.kind !== "agent" || chosen.run !== run.index) return [];
    const changes = run.routes(chosen.agent);
    return changes ? arrowsOf(tableAt(changes, state.t), chosen.agent, route) : [];
  };
  return {
    arrows: current,
    draw(context, camera, poses, state) {
      context.fillStyle = colour("route");
      context.globalAlpha = 0.85;
      for (const { from, to, width, probability } of current(state)) {
        const p = slots.get(from);
        const q = slots.get(to);
        if (p === undefined || q === undefined) continue;
        camera.project(poses.x[p], poses.y[p], 0, a);
        camera.project(poses.x[q], poses.y[q], 0, b);
        if (!a[2] || !b[2]) continue;
        arrow(context, a[0], a[1], b[0], b[1], width, 10);
        share(context, (a[0] + b[0]) / 2, (a[1] + b[1]) / 2, probability);
      }
      context.globalAlpha = 1;
      const end = state.route && state.chosen?.kind === "agent" && state.chosen.run === run.index ? slots.get(state.route.destination) : undefined;
      if (end === undefined) return;
      camera.project(poses.x[end], poses.y[end], 0, a);
      context.beginPath();
      context.arc(a[0], a[1], 13, 0, 2 * Math.PI);
      context.strokeStyle = colour("route");
      context.lineWidth = 2.5;
      context.stroke();
    },
  };

  function share(context, x, y, probability) {
    const text = `${(100 * probability).toFixed(probability < 0.1 ? 1 : 0)} %`;
    context.font = "600 11px system-ui, 'Liberation Sans', sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineWidth = 3;
    context.strokeStyle = colour("ground");
    context.strokeText(text, x, y);
    context.fillText(text, x, y);
    context.textAlign = "left";
  }
}
