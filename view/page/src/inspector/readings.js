// What an agent's sensors say at t: numbers with names and units; ranges as seen from above, ahead up.
import { readingAt } from "../at.js";
import { colour } from "../colours.js";
import { paper } from "../paper.js";
import { channelOf, channelsOf, raysOf, reachOf, readingFacts, surfacesOf } from "../sensors.js";
import { facts, made, nameOf, part } from "./parts.js";

const side = 200; //  px of a plot

/** A round step [m] of which at most four are a reach. */
export const ringStep = (reach) => [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50].find((step) => reach / step <= 4) ?? reach / 4;

function plot(parent, rays, reach, title) {
  const canvas = parent.appendChild(made("canvas", "", { className: "polar", title }));
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", title);
  const ratio = Math.min(2, globalThis.devicePixelRatio || 1);
  canvas.width = canvas.height = side * ratio;
  const context = paper(canvas);
  context.scale(ratio, ratio);
  context.translate(side / 2, side / 2);
  const most = Math.max(reach, 1e-6, ...rays.map(({ x, y, range }) => (range ?? 0) + Math.hypot(x, y)));
  const scale = (side / 2 - 4) / most;
  const step = ringStep(most);
  context.font = "10px system-ui, 'Liberation Sans', 'DejaVu Sans', sans-serif";
  context.strokeStyle = colour("line");
  context.fillStyle = colour("muted");
  for (let k = 1; k * step <= most; k++) {
    context.beginPath();
    context.arc(0, 0, k * step * scale, 0, 2 * Math.PI);
    context.stroke();
    context.fillText(`${Number((k * step).toPrecision(6))} m`, 2, -k * step * scale + 10);
  }
  // Ahead is up, left is left.
  const spot = ({ x, y, heading, range }, far) => {
    const length = range ?? far;
    return [-(y + length * Math.sin(heading)) * scale, -(x + length * Math.cos(heading)) * scale];
  };
  if (rays.length <= 16) {
    for (const ray of rays) {
      context.beginPath();
      context.moveTo(-ray.y * scale, -ray.x * scale);
      context.lineTo(...spot(ray, reach));
      context.strokeStyle = colour(ray.range === null ? "line" : "beam");
      context.lineWidth = ray.range === null ? 1 : 2;
      context.stroke();
    }
  }
  context.lineWidth = 1.5;
  context.strokeStyle = context.fillStyle = colour("beam");
  if (rays.length > 16) {
    for (const run of surfacesOf(rays)) {
      context.beginPath();
      for (const k of run) context.lineTo(...spot(rays[k], reach));
      context.stroke();
    }
  }
  const size = rays.length > 16 ? 2 : 5;
  for (const ray of rays) {
    if (ray.range === null) continue;
    const [x, y] = spot(ray, reach);
    context.fillRect(x - size / 2, y - size / 2, size, size);
  }
  context.fillStyle = colour("ink");
  context.beginPath();
  context.moveTo(0, -7); context.lineTo(4.5, 5); context.lineTo(-4.5, 5);
  context.fill();
}

/** A part for each channel that has said something by t; for one that is not recorded, the line that records it. */
export function showReadings(parent, run, agent, readings, t) {
  const said = new Set();
  for (const { tile } of readings) {
    tile.columns?.agent?.forEach?.((one, row) => { if (one === agent.agent) said.add(tile.columns.channel[row]); });
  }
  said.delete("odometry");
  for (const name of [...said].sort()) {
    const values = readingAt(readings, agent.agent, name, t);
    if (!values) continue;
    const channel = channelOf(run.world, agent, name);
    const section = part(parent, name);
    const rays = raysOf(agent, channel, values);
    if (rays && rays.length > 1) plot(section, rays, reachOf(agent, channel), `${name} as seen from above, ahead is up`);
    facts(section, readingFacts(agent, channel, values, (address) => nameOf(run, address)));
    if (!values.length) section.append("nobody within reach");
  }
  tellSilent(parent, run, agent, said);
}

// A scan with many rays is left out of the record unless it is asked for.
function tellSilent(parent, run, agent, said) {
  if (run.world.isPlan || run.world.recorded?.readings === "all") return;
  const kinds = ["scan", "pose", "imu", "battery"];
  const silent = channelsOf(run.world, agent).filter(({ name, kind }) => !said.has(name) && kinds.includes(kind));
  if (!silent.length) return;
  const section = part(parent, silent.map(({ name }) => name).join(", "));
  section.append("not recorded; ", made("code", "record: {readings: all}"), " records all sensors");
}
