// Where those that move came from: the last stretch of time, fading.
import { Color } from "three";
import { colour, robotColour } from "../colours.js";
import { createSegments } from "./ground.js";

const stretch = 60e9; //  ns at normal speed and below
const many = 200; //      moving agents from which only the chosen one has a trail

export function createTrails(scene, run, slots) {
  const segments = createSegments(scene);
  segments.lines.renderOrder = -3;
  const robots = run.world.agents.filter((agent) => agent.kind === "robot").map((agent) => agent.agent);
  const shades = run.world.agents.map(() => new Color());
  const fading = new Color();
  const older = new Color();
  const ground = new Color();
  const last = { at: new Float64Array(slots.size), x: new Float64Array(slots.size), y: new Float64Array(slots.size) };
  return {
    recolour() {
      ground.set(colour("ground"));
      run.world.agents.forEach((agent, slot) => {
        shades[slot].set(agent.kind === "robot" ? robotColour(robots.indexOf(agent.agent)) : colour("mote"));
      });
    },
    /** @param chosen  slot whose trail is drawn where those of all would be too many. */
    draw(state, poses, chosen) {
      segments.begin();
      const isMany = robots.length > many;
      if (state.layers.trails && robots.length && !(isMany && chosen === undefined)) {
        const span = isMany ? stretch / 4 : stretch * Math.max(1, Math.min(10, state.speed));
        const from = Math.max(0, state.t - span);
        trail(run.rows("poses", from, state.t + 1, { summary: true, tiles: 1 }), from, state.t, poses, isMany ? chosen : null);
      }
      return segments.end();
    },
  };

  function shadeAt(slot, at, from, t, to) {
    const age = (t - at) / Math.max(1, t - from);
    return to.copy(shades[slot]).lerp(ground, 0.2 + 0.8 * Math.min(1, Math.max(0, age)));
  }

  function addPart(slot, at, x, y, from, t) {
    shadeAt(slot, last.at[slot], from, t, older);
    shadeAt(slot, at, from, t, fading);
    segments.add(last.x[slot], last.y[slot], 0.012, x, y, 0.012, older, fading);
  }

  function trail(pieces, from, t, poses, only) {
    last.at.fill(-1);
    for (const { tile } of pieces) {
      const { agent, at, x, y } = tile.columns;
      for (let row = 0; row < at.length && at[row] <= t; row++) {
        const slot = slots.get(agent[row]);
        if (slot === undefined || at[row] <= last.at[slot] || (only !== null && slot !== only)) continue;
        if (last.at[slot] >= 0 && at[row] >= from) addPart(slot, at[row], x[row], y[row], from, t);
        last.at[slot] = at[row];
        last.x[slot] = x[row];
        last.y[slot] = y[row];
      }
    }
    for (let slot = 0; slot < slots.size; slot++) {
      if (last.at[slot] >= from) addPart(slot, t, poses.x[slot], poses.y[slot], from, t);
    }
  }
}
