// Links by quality: who hears whom, shaded by the share of the frames that came over a link lately.
import { Color } from "three";
import { eachRow } from "../at.js";
import { colour } from "../colours.js";
import { createSegments } from "./ground.js";

const lately = 10e9; //  ns before t that are counted
const most = 2000; //    links that are known and drawn; where there are more, those of the chosen agent only
const pair = (a, b) => Math.min(a, b) * 65536 + Math.max(a, b);

export function createLinks(scene, run, slots) {
  const segments = createSegments(scene);
  segments.lines.renderOrder = -5;
  // Those of the start, then those over which something was heard: [slot, slot] and by pair their places.
  const links = [];
  const known = new Map();
  const came = [];
  const lost = [];
  const mixed = [];
  const add = (a, b) => {
    const k = links.length;
    known.set(pair(a, b), k);
    links.push([a, b]);
    came.push(0);
    lost.push(0);
    mixed.push(new Color());
    return k;
  };
  const isMany = run.world.links.length > most;
  if (!isMany) for (const [a, b] of run.world.links) add(slots.get(a), slots.get(b));
  const atStart = links.length;
  const agents = run.world.agents;
  const shades = { quiet: new Color(), good: new Color(), bad: new Color() };
  let counted = "";
  let only; //  slot whose links are counted, if there are very many

  // Frames are counted anew each second of simulated time, not each picture.
  function count(t, chosen) {
    const to = Math.ceil(t / 1e9) * 1e9;
    if (isMany && chosen !== only) forget(chosen);
    if (isMany && only === undefined) return;
    const pieces = run.rows("frames", Math.max(0, to - lately), to);
    const key = `${to} ${pieces.length} ${pieces.complete}`;
    if (key === counted) return;
    counted = key;
    came.fill(0);
    lost.fill(0);
    eachRow(pieces, to - lately, t, (columns, row, tile) => {
      const from = slots.get(columns.transmitter[row]);
      for (const [agent, , verdict] of columns.ends[row]) {
        const hearer = slots.get(agent);
        if (isMany && from !== only && hearer !== only) continue;
        let k = known.get(pair(from, hearer));
        if (k === undefined && links.length < most) k = add(from, hearer);
        if (k !== undefined) (tile.verdicts[verdict] === "delivered" ? came : lost)[k]++;
      }
    });
    shade();
  }

  // Of very many links only one agent's are counted.
  function forget(chosen) {
    only = chosen;
    counted = "";
    for (const list of [links, came, lost, mixed]) list.length = 0;
    known.clear();
  }

  // A link of the start that nothing was heard over is shown while its ends are within range.
  function isShown(k, poses) {
    if (came[k] + lost[k] > 0) return true;
    if (k >= atStart) return false;
    const [a, b] = links[k];
    const range = Math.max(agents[a].range_m ?? Infinity, agents[b].range_m ?? Infinity);
    return Math.hypot(poses.x[a] - poses.x[b], poses.y[a] - poses.y[b]) <= range;
  }

  function shade() {
    for (let k = 0; k < links.length; k++) {
      const heard = came[k] + lost[k];
      if (!heard) mixed[k].copy(shades.quiet);
      else mixed[k].copy(shades.bad).lerp(shades.good, came[k] / heard);
    }
  }

  return {
    /** Frames that came and that were lost over a link lately: [came, lost]. */
    quality(a, b) {
      const k = known.get(pair(slots.get(a), slots.get(b)));
      return k === undefined ? null : [came[k], lost[k]];
    },
    /** The link whose line comes nearest to a point of the pane, within `reach` px: {a, b}, or null. */
    near(poses, camera, px, py, reach) {
      let best = null;
      let least = reach;
      const p = [0, 0, 0];
      const q = [0, 0, 0];
      for (const [k, [a, b]] of links.entries()) {
        if (!isShown(k, poses)) continue;
        camera.project(poses.x[a], poses.y[a], 0, p);
        camera.project(poses.x[b], poses.y[b], 0, q);
        const [dx, dy] = [q[0] - p[0], q[1] - p[1]];
        const f = Math.min(1, Math.max(0, ((px - p[0]) * dx + (py - p[1]) * dy) / (dx * dx + dy * dy || 1)));
        const away = Math.hypot(px - p[0] - f * dx, py - p[1] - f * dy);
        if (away < least) { least = away; best = { a: agents[a].agent, b: agents[b].agent }; }
      }
      return best;
    },
    recolour() {
      const ground = new Color(colour("ground"));
      shades.quiet.set(colour("link")).lerp(ground, 0.6);
      shades.good.set(colour("delivered")).lerp(ground, 0.25);
      shades.bad.set(colour("collision"));
      shade();
    },
    draw(state, poses, chosen) {
      segments.begin();
      if (state.layers.links) {
        count(state.t, chosen);
        for (let k = 0; k < links.length; k++) {
          if (!isShown(k, poses)) continue;
          const [a, b] = links[k];
          segments.add(poses.x[a], poses.y[a], 0.01, poses.x[b], poses.y[b], 0.01, mixed[k]);
        }
      }
      return segments.end();
    },
  };
}
