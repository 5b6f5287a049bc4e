// What agents' sensors say: names and units of readings, and where rays hit. Units: m, rad, ns; body frame: x ahead,
// y left.
const kindsByName = { localisation: "relative_position", infrared: "range", infrared_volts: "voltage" };

/** What is known of an agent's channel: {name, kind, unit, values, x, y, z, heading, first, step, low, high}. */
export function channelOf(world, agent, name) {
  const known = (world.channels?.[agent.channels] ?? []).find((one) => one.name === name);
  return known ?? { name, kind: kindsByName[name] ?? name, unit: "", values: [], x: 0, y: 0, z: 0, heading: 0, first: 0, step: 0, low: 0, high: 0 };
}

/** The channels of an agent that the record may have, as channelOf tells them; odometry is told with the pose. */
export const channelsOf = (world, agent) => (world.channels?.[agent.channels] ?? []).filter(({ kind }) => kind !== "odometry");

const of = (x, y, heading, range) => ({ x, y, heading, range });

/**
 * The rays of a reading of ranges: [{x, y, heading, range}], from where, which way [rad] and how far [m] in the body
 * frame; range null: nothing within reach, or too near. A sonar has one, in the middle of its cone. Null: it
 * measures no ranges, or where it looks is not known.
 */
export function raysOf(agent, channel, values) {
  const { kind, x, y, heading, first, step } = channel;
  if (kind === "scan" && step > 0) return values.map((range, k) => of(x, y, heading + first + k * step, range));
  if (kind === "scan" && values.length === 1) return [of(x, y, heading + first, values[0])];
  if (kind === "sonar") return [of(x, y, heading, values[0])];
  if (kind === "range" && agent.infrared?.length === values.length) {
    return agent.infrared.map((mount, k) => of(mount.x, mount.y, mount.heading, values[k]));
  }
  return null;
}

/** How far a channel of ranges sees [m]; 0: not known. */
export const reachOf = (agent, channel) => (channel.kind === "range"
  ? Math.max(0, ...(agent.infrared ?? []).map(({ reach }) => reach)) : channel.high);

/**
 * Neighbouring hits of a scan that are on one surface, as runs of indices: drawn as a line. A gap is a ray that hit
 * nothing, or a step in range that is greater than a wall seen at a slant of 80 degrees makes.
 */
export function surfacesOf(rays) {
  const runs = [];
  let run = [];
  const close = () => { if (run.length > 1) runs.push(run); run = []; };
  rays.forEach(({ range, heading }, k) => {
    if (range === null) { close(); return; }
    const before = run.length ? rays[run[run.length - 1]] : null;
    if (before) {
      const nearer = Math.min(range, before.range);
      const most = Math.max(0.05, nearer * Math.abs(heading - before.heading) * Math.tan((80 * Math.PI) / 180));
      if (Math.abs(range - before.range) > most) close();
    }
    run.push(k);
  });
  close();
  return runs;
}

const degrees = (angle) => (angle * 180) / Math.PI;
const short = (value, digits = 3) => String(Number(value.toPrecision(digits)));

/** "12° left", "ahead", "behind" of an angle [rad] from ahead. */
export function sideOf(angle) {
  const turned = Math.round(degrees(Math.atan2(Math.sin(angle), Math.cos(angle))));
  if (turned === 0) return "ahead";
  if (Math.abs(turned) === 180) return "behind";
  return `${Math.abs(turned)}° ${turned > 0 ? "left" : "right"}`;
}

/** A value with its unit: angles in degrees, shares without one. */
export function valueText(value, unit) {
  if (value === null || value === undefined) return "none";
  if (unit === "rad") return `${short(degrees(value), 4)}°`;
  return unit && unit !== "1" ? `${short(value, 4)} ${unit}` : short(value, 4);
}

/**
 * A reading as names and texts: [["x", "0.446 m"], …]. Of ranges in short: how many rays, the nearest.
 * @param nameOf  an address to a name
 */
export function readingFacts(agent, channel, values, nameOf) {
  const { kind } = channel;
  if (kind === "relative_position") {
    const rows = [];
    for (let k = 0; k + 2 < values.length; k += 3) {
      const [address, x, y] = values.slice(k, k + 3);
      rows.push([nameOf(address), `${short(Math.hypot(x, y))} m, ${sideOf(Math.atan2(y, x))} (x ${short(x)} m, y ${short(y)} m)`]);
    }
    return rows;
  }
  if (kind === "bumper") return [["touched", values[0] ? "yes" : "no"]];
  if (channel.values.length === values.length) return values.map((value, k) => [channel.values[k][0].replaceAll("_", " "), valueText(value, channel.values[k][1])]);
  if (kind === "voltage") return [["outputs", values.map((value) => (value === null ? "–" : short(value))).join(", ") + " V"]];
  const rays = raysOf(agent, channel, values);
  if (!rays) return values.map((value, k) => [`value ${k}`, valueText(value, channel.unit)]);
  const hits = rays.filter(({ range }) => range !== null);
  const nearest = hits.reduce((best, ray) => (best && best.range <= ray.range ? best : ray), null);
  const told = nearest ? `${short(nearest.range)} m${kind === "sonar" ? "" : `, ${sideOf(nearest.heading)}`}` : "nothing within reach";
  const reach = reachOf(agent, channel);
  return [[rays.length > 1 ? "nearest" : "range", told], ["rays", rays.length > 1 ? `${rays.length}, of which ${hits.length === rays.length ? "all" : hits.length} hit something` : null],
    ["reach", reach > 0 ? (channel.low > 0 ? `${short(channel.low)} … ${short(reach)} m` : `${short(reach)} m`) : null]];
}
