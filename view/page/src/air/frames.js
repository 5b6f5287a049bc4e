// Frames on the ground of the network. At normal speed each is a stroke to its receiver, a broadcast a ring; in
// slow motion (1 ms/s and below) a ring spreads from the transmitter while the frame is in the air, below
// 10 us/s as fast as light does. Coloured by how it ended; where it was lost there is a mark.
import { eachRow } from "../at.js";
import { colour, verdictColour } from "../colours.js";
import { circle } from "../world/marks.js";

export const everyone = 65534; //  addresses from here on are groups: neighbours, everyone
const shortest = 0.15e9; //       ns of wall time that a frame is seen at least
const slow = 1e-3; //             simulated s per s from which a frame's progress is seen
const asLight = 1e-5; //          … and from which the wave's own is
const light = 0.299792458; //     m/ns
const most = 400; //              frames drawn at once: the latest
const longest = 60e6; //          ns: no frame is in the air longer than this

const dashes = { rts: [7, 3], cts: [2, 3], ack: [1, 2], unicast: [], broadcast: [], beacon: [3, 3], management: [3, 3], block_ack: [1, 2] };
const widths = { rts: 1.75, cts: 1.75, ack: 1.75, unicast: 3, broadcast: 1.5, beacon: 1.25, management: 1.25, block_ack: 1.75 };
const names = { rts: "RTS", cts: "CTS", ack: "ACK", unicast: "data", broadcast: "broadcast", beacon: "beacon", management: "mgmt", block_ack: "block ack" };

export function createFrames(run, slots) {
  const agents = run.world.agents;
  const ranges = agents.map((agent) => agent.range_m || 100);
  const shown = []; //  {columns, row, tile} of the frames that are seen, reused
  const a = [0, 0, 0];
  const b = [0, 0, 0];

  function collect(state) {
    const linger = shortest * state.speed;
    const from = state.t - linger - longest;
    let count = 0;
    const add = (columns, row, tile) => {
      if (columns.at[row] + columns.airtime[row] + linger <= state.t) return;
      const place = count++ % most;
      const seen = shown[place] ?? (shown[place] = {});
      seen.columns = columns;
      seen.row = row;
      seen.tile = tile;
    };
    const pieces = run.rows("frames", from, state.t + Math.max(1, linger));
    eachRow(pieces, from, state.t, add);
    return Math.min(count, most);
  }

  const endAt = (ends, agent) => ends.find((end) => end[0] === agent);

  /** How a frame ended where it was meant to go: a verdict, or of a broadcast "delivered" if anyone got it. */
  function outcome(columns, row, tile) {
    const ends = columns.ends[row];
    const receiver = columns.receiver[row];
    if (receiver < everyone) {
      const end = endAt(ends, receiver);
      return end ? tile.verdicts[end[2]] : "below sensitivity";
    }
    const lost = ends.find((end) => tile.verdicts[end[2]] !== "delivered");
    return !lost || ends.some((end) => tile.verdicts[end[2]] === "delivered") ? "delivered" : tile.verdicts[lost[2]];
  }

  function drawOne(context, camera, poses, state, { columns, row, tile }, tags) {
    const from = slots.get(columns.transmitter[row]);
    if (from === undefined) return;
    const kind = columns.class[row];
    const age = state.t - columns.at[row];
    const airtime = columns.airtime[row];
    const isOver = age > airtime;
    const fade = isOver ? 1 - (age - airtime) / (shortest * state.speed) : 1;
    context.globalAlpha = Math.max(0.08, fade) * 0.95;
    context.lineWidth = widths[kind] ?? 1.5;
    context.setLineDash(dashes[kind] ?? []);
    context.strokeStyle = verdictColour(outcome(columns, row, tile));
    const to = slots.get(columns.receiver[row]);
    if (state.speed <= slow) wave(context, camera, poses, from, age, airtime, state.speed);
    else if (to === undefined) pulse(context, camera, poses, from, Math.min(1, age / (shortest * state.speed)));
    if (to !== undefined) stroke(context, camera, poses, from, to, state.speed <= slow ? Math.min(1, age / airtime) : 1);
    context.setLineDash([]);
    if (isOver || state.speed > slow) losses(context, camera, poses, columns, row, tile, state.t);
    if (tags) tag(context, camera, poses, from, to, kind);
    context.globalAlpha = 1;
  }

  // The ring of a frame that is being sent; as light goes, the rim behind which the air is quiet again too.
  function wave(context, camera, poses, from, age, airtime, speed) {
    const range = ranges[from];
    const front = speed <= asLight ? light * age : (range * age) / airtime;
    const back = speed <= asLight ? light * (age - airtime) : 0;
    context.beginPath();
    if (front < range * 1.5) circle(context, camera, poses.x[from], poses.y[from], Math.min(front, range));
    else if (back <= range) circle(context, camera, poses.x[from], poses.y[from], range);
    if (back > 0 && back < range) circle(context, camera, poses.x[from], poses.y[from], back);
    context.stroke();
    if (age > airtime) return;
    const before = context.globalAlpha;
    context.globalAlpha = 0.08;
    context.fillStyle = context.strokeStyle;
    context.fill();
    context.globalAlpha = before;
  }

  function pulse(context, camera, poses, from, share) {
    context.beginPath();
    circle(context, camera, poses.x[from], poses.y[from], ranges[from] * (0.15 + 0.85 * share));
    context.stroke();
  }

  function stroke(context, camera, poses, from, to, share) {
    camera.project(poses.x[from], poses.y[from], 0, a);
    camera.project(poses.x[to], poses.y[to], 0, b);
    if (!a[2] || !b[2]) return;
    const x = a[0] + share * (b[0] - a[0]);
    const y = a[1] + share * (b[1] - a[1]);
    context.beginPath();
    context.moveTo(a[0], a[1]);
    context.lineTo(x, y);
    context.stroke();
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    const [ux, uy] = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    const gap = share === 1 ? Math.min(9, length / 3) : 0;
    context.setLineDash([]);
    context.beginPath();
    context.moveTo(x - ux * gap, y - uy * gap);
    context.lineTo(x - ux * (gap + 9) - uy * 4.5, y - uy * (gap + 9) + ux * 4.5);
    context.lineTo(x - ux * (gap + 9) + uy * 4.5, y - uy * (gap + 9) - ux * 4.5);
    context.closePath();
    context.fillStyle = context.strokeStyle;
    context.fill();
  }

  // A collision is a cross where it happened: at the radio that lost the frame. Other losses are hollow.
  function losses(context, camera, poses, columns, row, tile, t) {
    const receiver = columns.receiver[row];
    for (const [agent, at, verdict] of columns.ends[row]) {
      const how = tile.verdicts[verdict];
      if (how === "delivered" || at > t || (receiver < everyone && receiver !== agent && how !== "collision")) continue;
      const slot = slots.get(agent);
      if (slot === undefined) continue;
      camera.project(poses.x[slot], poses.y[slot], 0, a);
      if (!a[2]) continue;
      context.strokeStyle = verdictColour(how);
      context.lineWidth = 2;
      const r = receiver === agent || receiver >= everyone ? 9 : 6;
      context.beginPath();
      if (how === "collision" || how === "interference") {
        context.moveTo(a[0] - r, a[1] - r);
        context.lineTo(a[0] + r, a[1] + r);
        context.moveTo(a[0] - r, a[1] + r);
        context.lineTo(a[0] + r, a[1] - r);
      } else {
        context.arc(a[0], a[1], r, 0, 2 * Math.PI);
      }
      context.stroke();
    }
  }

  function tag(context, camera, poses, from, to, kind) {
    camera.project(poses.x[from], poses.y[from], 0, a);
    if (to === undefined) { b[0] = a[0]; b[1] = a[1] - 30; } else camera.project(poses.x[to], poses.y[to], 0, b);
    const x = (a[0] + b[0]) / 2;
    const y = (a[1] + b[1]) / 2;
    context.font = "600 11px system-ui, 'Liberation Sans', sans-serif";
    context.textBaseline = "middle";
    context.textAlign = "center";
    context.lineWidth = 3;
    const text = names[kind] ?? kind;
    const ink = context.strokeStyle;
    context.strokeStyle = colour("ground");
    context.strokeText(text, x, y);
    context.fillStyle = ink;
    context.fillText(text, x, y);
    context.textAlign = "left";
  }

  return {
    /** How many frames are seen now. */
    collect: (state) => (state.layers.frames ? collect(state) : 0),
    draw(context, camera, poses, state, count) {
      for (let k = 0; k < count; k++) drawOne(context, camera, poses, state, shown[k], count <= 6);
      context.globalAlpha = 1;
    },
    /** Rows to have before they are shown. */
    prefetch(state) {
      if (state.playing && state.layers.frames) run.rows("frames", state.t, state.t + state.speed * 1.5e9 + 1);
    },
  };
}
