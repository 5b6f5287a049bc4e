// A message followed from send() to receive(): each hop that it has made by now, with the time that it took,
// and where and why it was lost.
import { findMessage, hopsOf } from "../at.js";
import { colour, verdictColour } from "../colours.js";
import { arrow } from "./arrows.js";

const longest = 60e9; //  ns after it was sent that its frames are looked for
const least = 1e9; //     … at least

export const duration = (ns) => (ns < 1e3 ? `${ns} ns` : ns < 1e6 ? `${(ns / 1e3).toFixed(1)} µs`
  : ns < 1e9 ? `${(ns / 1e6).toFixed(2)} ms` : `${(ns / 1e9).toFixed(3)} s`);

export function createFollowed(run, slots) {
  const a = [0, 0, 0];
  const b = [0, 0, 0];
  const wanted = (state) => {
    const message = state.followed ?? (state.chosen?.kind === "message" ? state.chosen : null);
    return message && message.run === run.index ? message : null;
  };

  /** {message, hops}; null: nothing is followed, or it has not come. */
  function current(state) {
    const key = wanted(state);
    if (!key) return null;
    const message = findMessage(run.rows("messages", key.at, key.at + 1), key.sender, key.id);
    if (!message) return null;
    const last = Math.max(message.fate_at ?? 0, ...message.deliveries.map((delivery) => delivery.at));
    const to = message.sent + Math.min(longest, Math.max(least, last - message.sent + 1e6));
    return { message, hops: hopsOf(message, run.rows("frames", message.sent, to)) };
  }

  return {
    current,
    draw(context, camera, poses, state) {
      const found = current(state);
      if (!found) return;
      const { message, hops } = found;
      for (const hop of hops) if (hop.began <= state.t && (hop.first || hop.verdict !== "delivered")) one(context, camera, poses, hop, state.t, message);
      const start = slots.get(message.sender);
      if (start === undefined) return;
      camera.project(poses.x[start], poses.y[start], 0, a);
      context.strokeStyle = colour("followed");
      context.lineWidth = 3;
      context.strokeRect(a[0] - 11, a[1] - 11, 22, 22);
    },
  };

  function one(context, camera, poses, hop, t, message) {
    const p = slots.get(hop.from);
    const q = slots.get(hop.to);
    if (p === undefined || q === undefined) return;
    camera.project(poses.x[p], poses.y[p], 0, a);
    camera.project(poses.x[q], poses.y[q], 0, b);
    if (!a[2] || !b[2]) return;
    const isOver = hop.ended !== null && hop.ended <= t;
    const isLost = hop.verdict !== "delivered";
    // Of a flood only what brought it somewhere new is drawn; what was lost on the way is if it was for one.
    if (isLost && message.destination >= 65534) return;
    context.fillStyle = isOver && isLost ? verdictColour(hop.verdict) : colour("followed");
    context.globalAlpha = isOver ? 0.95 : 0.5;
    arrow(context, a[0], a[1], b[0], b[1], isLost ? 1.5 : 3.5, 8);
    context.globalAlpha = 1;
    if (isOver) write(context, isLost ? hop.verdict : duration(hop.ended - message.sent));
  }

  function write(context, text) {
    const x = a[0] + 0.62 * (b[0] - a[0]);
    const y = a[1] + 0.62 * (b[1] - a[1]);
    context.font = "600 11px system-ui, 'Liberation Sans', sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineWidth = 3;
    context.strokeStyle = colour("ground");
    context.strokeText(text, x, y);
    context.fillStyle = colour("ink");
    context.fillText(text, x, y);
    context.textAlign = "left";
  }
}
