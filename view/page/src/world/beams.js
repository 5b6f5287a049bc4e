// What sensors of ranges see: infrared beams, a sonar's cone, a laser scan, from where the body was when they
// measured.
import { lastRow, poseAt } from "../at.js";
import { colour, robotColour } from "../colours.js";
import { raysOf, reachOf, surfacesOf } from "../sensors.js";

const near = 6; //         px of reach from which a sensor is drawn
const mostRays = 20_000; // of a picture; beyond them the scans that come first are drawn
const infraredHeight = 0.04; // m, where a mount does not say

export function createBeams(run) {
  const { agents } = run.world;
  const kinds = ["scan", "sonar"];
  const sensors = agents.flatMap((agent, slot) => {
    const channels = (run.world.channels?.[agent.channels] ?? []).filter(({ kind }) => kinds.includes(kind));
    const mounts = agent.infrared ?? [];
    const infrared = mounts.length ? [{ name: "infrared", kind: "range", z: mounts[0].z ?? infraredHeight }] : [];
    return [...channels, ...infrared].map((channel) => ({ agent, slot, channel, reach: reachOf(agent, channel) }));
  });
  const robots = agents.filter(({ kind }) => kind === "robot").map(({ agent }) => agent);
  const period = run.world.recorded?.poses_period_ns ?? 0;
  const from = [0, 0, 0];
  const to = [0, 0, 0];

  /** Where a ray begins, or with its length where it ends, in the pane. */
  function project(camera, body, ray, length, z, out) {
    const [c, s] = [Math.cos(body.theta), Math.sin(body.theta)];
    const heading = body.theta + ray.heading;
    camera.project(body.x + ray.x * c - ray.y * s + length * Math.cos(heading), body.y + ray.x * s + ray.y * c + length * Math.sin(heading), z, out);
    return out;
  }

  // As far as something is seen, with a mark where; as far as it reaches, thin, where nothing is.
  function drawInfrared(context, camera, body, rays, { channel, reach, agent }) {
    rays.forEach((ray, k) => {
      const seen = ray.range !== null && ray.range !== undefined;
      const z = agent.infrared[k].z ?? channel.z;
      project(camera, body, ray, 0, z, from);
      project(camera, body, ray, seen ? ray.range : agent.infrared[k].reach ?? reach, z, to);
      context.beginPath();
      context.moveTo(from[0], from[1]);
      context.lineTo(to[0], to[1]);
      context.strokeStyle = colour(seen ? "beam" : "muted");
      context.lineWidth = seen ? 2 : 0.75;
      context.globalAlpha = seen ? 1 : 0.5;
      context.stroke();
      context.globalAlpha = 1;
      if (!seen) return;
      context.beginPath();
      context.arc(to[0], to[1], 3.5, 0, 2 * Math.PI);
      context.fillStyle = colour("beam");
      context.fill();
    });
  }

  // The cone as far as something is in it: its edges, and an arc there.
  function drawSonar(context, camera, body, [ray], { channel, reach }) {
    const length = ray.range ?? reach;
    const steps = 8;
    context.beginPath();
    project(camera, body, ray, 0, channel.z, from);
    context.moveTo(from[0], from[1]);
    for (let k = 0; k <= steps; k++) {
      project(camera, body, { ...ray, heading: ray.heading + channel.first + (channel.step * k) / steps }, length, channel.z, to);
      context.lineTo(to[0], to[1]);
    }
    context.closePath();
    context.fillStyle = context.strokeStyle = colour(ray.range === null ? "muted" : "beam");
    context.globalAlpha = ray.range === null ? 0.06 : 0.14;
    context.fill();
    context.globalAlpha = ray.range === null ? 0.3 : 0.8;
    context.lineWidth = 1;
    context.stroke();
    context.globalAlpha = 1;
  }

  // The space that is free, pale, in the robot's colour; what was hit, as points and, where they are on one surface, a line.
  function drawScan(context, camera, body, rays, { channel, agent }) {
    const shade = agent.kind === "robot" ? robotColour(robots.indexOf(agent.agent)) : colour("beam");
    context.beginPath();
    project(camera, body, rays[0], 0, channel.z, from);
    context.moveTo(from[0], from[1]);
    for (const ray of rays) {
      if (ray.range === null) { context.lineTo(from[0], from[1]); continue; }
      project(camera, body, ray, ray.range, channel.z, to);
      context.lineTo(to[0], to[1]);
    }
    context.closePath();
    context.fillStyle = context.strokeStyle = shade;
    context.globalAlpha = 0.07;
    context.fill();
    context.globalAlpha = 1;
    context.lineWidth = 1.5;
    context.beginPath();
    for (const surface of surfacesOf(rays)) {
      surface.forEach((k, nth) => {
        project(camera, body, rays[k], rays[k].range, channel.z, to);
        if (nth) context.lineTo(to[0], to[1]); else context.moveTo(to[0], to[1]);
      });
    }
    context.stroke();
    for (const ray of rays) {
      if (ray.range === null) continue;
      project(camera, body, ray, ray.range, channel.z, to);
      context.fillRect(to[0] - 1.25, to[1] - 1.25, 2.5, 2.5);
    }
  }
  const draws = { range: drawInfrared, sonar: drawSonar, scan: drawScan };

  /** What each sensor in sight said last by t: [{sensor, body, rays}]; `body`: where it was then. */
  function seen(marks, camera, t) {
    const shown = sensors.filter(({ slot, reach }) => reach * marks.sizes[slot] > near && marks.isInside(camera, slot, Math.max(200, reach * marks.sizes[slot])));
    if (!shown.length) return [];
    const pieces = run.rows("readings", t, t + 1);
    const poses = run.rows("poses", Math.max(0, t - 2e9), t + 1);
    const all = [];
    let left = mostRays;
    for (const sensor of shown) {
      const { agent, channel } = sensor;
      const row = lastRow(pieces, agent.agent, t, (columns, at) => columns.channel[at] === channel.name);
      const values = row && row.tile.columns.values[row.row];
      const rays = values && raysOf(agent, channel, values);
      if (!rays?.length || (left -= rays.length) < 0) continue;
      const body = poseAt(poses, agent.agent, row.tile.columns.at[row.row], period) ?? agent;
      all.push({ sensor, body, rays });
    }
    return all;
  }

  return {
    seen,
    draw(context, camera, marks, t) {
      for (const { sensor, body, rays } of seen(marks, camera, t)) draws[sensor.channel.kind](context, camera, body, rays, sensor);
    },
    /** Where scans have hit, for tests: [{agent, channel, x, y}], m in the world. */
    hits(marks, camera, t) {
      return seen(marks, camera, t).flatMap(({ sensor, body, rays }) => rays.filter(({ range }) => range !== null).map((ray) => {
        const [c, s] = [Math.cos(body.theta), Math.sin(body.theta)];
        const heading = body.theta + ray.heading;
        return { agent: sensor.agent.agent, channel: sensor.channel.name, x: body.x + ray.x * c - ray.y * s + ray.range * Math.cos(heading),
          y: body.y + ray.x * s + ray.y * c + ray.range * Math.sin(heading) };
      }));
    },
  };
}
