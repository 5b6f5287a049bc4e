// Links by quality: who hears whom, shaded by the share of the frames that came over a link lately.
import { Color } from "three";
import { eachRow } from "../at.js";
import { colour } from "../colours.js";
import { createSegments } from "./ground.js";

const lately = 10e9; //  ns before t that are counted
const most = 20000; //   links that are drawn

export function createLinks(scene, run, slots) {
  const segments = createSegments(scene);
  segments.lines.renderOrder = -5;
  const links = run.world.links.slice(0, most).map(([a, b]) => [slots.get(a), slots.get(b)]);
  const known = new Map(links.map(([a, b], k) => [a * 65536 + b, k]));
  const came = new Int32Array(links.length);
  const lost = new Int32Array(links.length);
  const shades = { quiet: new Color(), good: new Color(), bad: new Color() };
  const mixed = links.map(() => new Color());
  let counted = "";

  // Frames are counted anew each second of simulated time, not each picture.
  function count(t) {
    const to = Math.ceil(t / 1e9) * 1e9;
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
        const k = known.get(Math.min(from, hearer) * 65536 + Math.max(from, hearer));
        if (k !== undefined) (tile.verdicts[verdict] === "delivered" ? came : lost)[k]++;
      }
    });
    shade();
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
      const [p, q] = [slots.get(a), slots.get(b)];
      const k = known.get(Math.min(p, q) * 65536 + Math.max(p, q));
      return k === undefined ? null : [came[k], lost[k]];
    },
    /** The link whose line comes nearest to a point of the pane, within `reach` px: {a, b}, or null. */
    near(poses, camera, px, py, reach) {
      let best = null;
      let least = reach;
      const p = [0, 0, 0];
      const q = [0, 0, 0];
      for (const [a, b] of links) {
        camera.project(poses.x[a], poses.y[a], 0, p);
        camera.project(poses.x[b], poses.y[b], 0, q);
        const [dx, dy] = [q[0] - p[0], q[1] - p[1]];
        const f = Math.min(1, Math.max(0, ((px - p[0]) * dx + (py - p[1]) * dy) / (dx * dx + dy * dy || 1)));
        const away = Math.hypot(px - p[0] - f * dx, py - p[1] - f * dy);
        if (away < least) { least = away; best = { a: run.world.agents[a].agent, b: run.world.agents[b].agent }; }
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
    draw(state, poses) {
      segments.begin();
      if (state.layers.links) {
        count(state.t);
        for (let k = 0; k < links.length; k++) {
          const [a, b] = links[k];
          segments.add(poses.x[a], poses.y[a], 0.01, poses.x[b], poses.y[b], 0.01, mixed[k]);
        }
      }
      segments.end();
    },
  };
}
