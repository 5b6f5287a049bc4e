// What is drawn over the scene at a size of its own: markers of agents too small to be seen, beams, ranges,
// the scale, names.
import { colour, robotColour } from "../colours.js";
import { paper } from "../paper.js";
import { createBeams } from "./beams.js";
import { createLabels } from "./labels.js";

const headLength = 8; // px of an arrowhead at least
const radii = { robot: 7, mote: 4, station: 4 }; // px of a marker
export const many = 200; // agents from which markers are smaller, and drawn with the scene

/** A circle on the ground as a path: round on the map, as it lies in the free view. */
export function circle(context, camera, x, y, radius) {
  const spot = camera.project(x, y, 0, [0, 0, 0]);
  if (camera.mode2d) {
    context.moveTo(spot[0] + radius * spot[2], spot[1]);
    context.arc(spot[0], spot[1], radius * spot[2], 0, 2 * Math.PI);
    return;
  }
  const corners = 48;
  for (let k = 0; k <= corners; k++) {
    const angle = (k * 2 * Math.PI) / corners;
    camera.project(x + radius * Math.cos(angle), y + radius * Math.sin(angle), 0, spot);
    if (!spot[2]) return;
    if (k) context.lineTo(spot[0], spot[1]); else context.moveTo(spot[0], spot[1]);
  }
}

/** How far a body reaches ahead of its origin [m]: along its x axis. */
export function frontOf({ cylinders = [], boxes = [], radius }) {
  let front = 0;
  for (const { x, y, radius: r } of cylinders) if (Math.abs(y) < r) front = Math.max(front, x + Math.sqrt(r * r - y * y));
  for (const box of boxes) front = Math.max(front, leaves(box));
  return front || radius;
}

// Where the positive x axis leaves a box; 0: it does not meet it.
function leaves({ x, y, yaw = 0, length_x: long, length_y: wide }) {
  const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
  const at = [-(x * c + y * s), x * s - y * c]; //  the body's origin in the box's frame
  let [near, far] = [0, Infinity];
  [[at[0], c, long / 2], [at[1], -s, wide / 2]].forEach(([from, way, half]) => {
    if (Math.abs(way) < 1e-12) { if (Math.abs(from) > half) far = -1; return; }
    const ends = [(-half - from) / way, (half - from) / way].sort((a, b) => a - b);
    near = Math.max(near, ends[0]);
    far = Math.min(far, ends[1]);
  });
  return far >= near ? far : 0;
}

export function createMarks(run) {
  const agents = run.world.agents;
  const labels = createLabels();
  const beams = createBeams(run);
  const robots = agents.filter((agent) => agent.kind === "robot").map((agent) => agent.agent);
  const robotIndex = new Map(robots.map((agent, k) => [agent, k]));
  const isMany = agents.length > many;
  const shrink = isMany ? 0.6 : 1;
  const mostNames = 150; //  agents in sight from which only the chosen one has a name
  const spots = new Float64Array(agents.length * 2); // px, of the last draw
  const sizes = new Float64Array(agents.length); //     px per metre there
  const stamps = new Map(); //                          markers, drawn once
  const spot = [0, 0, 0];
  const bodyRadius = agents.map((agent) => run.world.shapes?.[agent.shape]?.radius ?? 0);
  const bodyHeight = agents.map((agent) => run.world.shapes?.[agent.shape]?.height ?? 0);
  const fronts = agents.map((agent) => (run.world.shapes?.[agent.shape] ? frontOf(run.world.shapes[agent.shape]) : 0));
  const markRadius = agents.map((agent) => (radii[agent.kind] ?? 4) * shrink);

  /** px from an agent's middle to the rim of what is seen of it. */
  const radiusOf = (slot) => Math.max(markRadius[slot], bodyRadius[slot] * sizes[slot]);
  const isMarked = (slot) => bodyRadius[slot] * sizes[slot] < markRadius[slot];

  function place(poses, camera) {
    for (let slot = 0; slot < agents.length; slot++) {
      camera.project(poses.x[slot], poses.y[slot], camera.mode2d ? 0 : bodyHeight[slot] / 2, spot);
      spots[slot * 2] = spot[0];
      spots[slot * 2 + 1] = spot[1];
      sizes[slot] = spot[2];
    }
  }

  // Antialiased discs are dear by the thousand: each colour is drawn once and copied.
  function stamp(fill, radius, ratio) {
    const key = `${fill} ${radius} ${ratio}`;
    let made = stamps.get(key);
    if (!made) {
      const side = Math.ceil(radius + 2) * 2;
      made = document.createElement("canvas");
      made.width = made.height = side * ratio;
      made.side = side;
      const context = paper(made);
      context.scale(ratio, ratio);
      context.beginPath();
      context.arc(side / 2, side / 2, radius + 1.25, 0, 2 * Math.PI);
      context.fillStyle = colour("ground");
      context.fill();
      context.beginPath();
      context.arc(side / 2, side / 2, radius, 0, 2 * Math.PI);
      context.fillStyle = fill;
      context.fill();
      stamps.set(key, made);
    }
    return made;
  }

  function drawMarkers(context, camera, ratio) {
    for (const wanted of ["mote", "robot"]) {
      for (let slot = 0; slot < agents.length; slot++) {
        const isRobot = agents[slot].kind === "robot";
        if (isRobot !== (wanted === "robot") || !isMarked(slot) || !sizes[slot]) continue;
        const x = spots[slot * 2];
        const y = spots[slot * 2 + 1];
        if (!(x > -9 && y > -9 && x < camera.width + 9 && y < camera.height + 9)) continue;
        const disc = stamp(isRobot ? robotColour(robotIndex.get(agents[slot].agent)) : colour("mote"), markRadius[slot], ratio);
        context.drawImage(disc, x - disc.side / 2, y - disc.side / 2, disc.side, disc.side);
      }
    }
  }

  // Which way robots look: an arrowhead on the rim of the body or of its marker, in the plane in which it moves.
  function drawHeadings(context, camera, poses) {
    context.beginPath();
    for (let slot = 0; slot < agents.length; slot++) {
      if (agents[slot].kind !== "robot" || !sizes[slot]) continue;
      const rim = isMarked(slot) ? (markRadius[slot] - 1) / sizes[slot] : fronts[slot];
      const long = Math.max(headLength / sizes[slot], 0.3 * rim);
      const [c, s] = [Math.cos(poses.theta[slot]), Math.sin(poses.theta[slot])];
      const corner = (ahead, aside, how) => {
        camera.project(poses.x[slot] + ahead * c - aside * s, poses.y[slot] + ahead * s + aside * c, camera.mode2d ? 0 : bodyHeight[slot] / 2, spot);
        context[how](spot[0], spot[1]);
      };
      corner(rim, -0.6 * long, "moveTo");
      corner(rim + long, 0, "lineTo");
      corner(rim, 0.6 * long, "lineTo");
      context.closePath();
    }
    context.fillStyle = colour("ink");
    context.fill();
  }

  const isInside = (camera, slot, margin) => spots[slot * 2] > -margin && spots[slot * 2 + 1] > -margin &&
    spots[slot * 2] < camera.width + margin && spots[slot * 2 + 1] < camera.height + margin;

  function drawRanges(context, camera, poses, state, chosen) {
    const shown = agents.map((agent, slot) => slot).filter((slot) => agents[slot].range_m &&
      (state.layers.ranges || agents[slot].agent === chosen)).slice(0, many);
    context.beginPath();
    for (const slot of shown) circle(context, camera, poses.x[slot], poses.y[slot], agents[slot].range_m);
    context.strokeStyle = colour("muted");
    context.lineWidth = 1;
    context.setLineDash([4, 4]);
    context.stroke();
    context.setLineDash([]);
  }

  function drawChosen(context, slot) {
    if (slot === undefined || !sizes[slot]) return;
    context.beginPath();
    context.arc(spots[slot * 2], spots[slot * 2 + 1], radiusOf(slot) + 4.5, 0, 2 * Math.PI);
    context.strokeStyle = colour("ink");
    context.lineWidth = 1.75;
    context.stroke();
  }

  // Metres along the edges of the map, and a scale; in the free view the scale is the grid's step.
  function drawMetres(context, camera, grid) {
    context.font = "11px system-ui, 'Liberation Sans', 'DejaVu Sans', sans-serif";
    context.fillStyle = colour("muted");
    context.textBaseline = "alphabetic";
    const digits = Math.max(0, -Math.floor(Math.log10(grid.step) + 1e-9));
    if (!camera.mode2d) {
      context.fillText(`grid ${grid.step.toFixed(digits)} m`, 8, camera.height - 7);
      labels.keep(0, camera.height - 22, 90, camera.height);
      return;
    }
    context.textAlign = "center";
    for (let k = Math.round(grid.x0 / grid.step); k * grid.step <= grid.x1; k++) {
      const x = camera.project(k * grid.step, 0, 0, spot)[0];
      if (x > 50 && x < camera.width - 30) context.fillText((k * grid.step).toFixed(digits), x, camera.height - 5);
    }
    context.textAlign = "left";
    for (let k = Math.round(grid.y0 / grid.step); k * grid.step <= grid.y1; k++) {
      const y = camera.project(0, k * grid.step, 0, spot)[1];
      if (y > camera.clearTop && y < camera.height - 20) context.fillText((k * grid.step).toFixed(digits), 4, y - 2);
    }
    context.fillText("m", 6, camera.height - 5);
    labels.keep(0, camera.height - 18, camera.width, camera.height);
  }

  function isCrowded(camera) {
    let inSight = 0;
    for (let slot = 0; slot < agents.length && inSight <= mostNames; slot++) inSight += isInside(camera, slot, 0) ? 1 : 0;
    return inSight > mostNames;
  }

  function name(context, camera, order) {
    const clear = (slot) => radiusOf(slot) + (agents[slot].kind === "robot" ? headLength + 1 : 0);
    labels.draw(context, camera, agents, order, spots, clear, colour("ink"), colour("ground"));
  }

  const byImportance = agents.map((agent, slot) => slot).sort((a, b) =>
    (agents[a].kind === "robot" ? 0 : 1) - (agents[b].kind === "robot" ? 0 : 1) || a - b);

  return {
    spots, sizes, radiusOf, isCrowded, isMarked, isInside, place,
    forget() { stamps.clear(); },
    /** Where sensors of ranges have hit something. */
    hits(camera, t) { return beams.hits(this, camera, t); },
    below(context, camera, poses, state, chosen) {
      drawRanges(context, camera, poses, state, chosen);
      if (state.layers.beams) beams.draw(context, camera, this, state.t);
    },
    above(context, camera, poses, state, grid, chosenSlot, ratio) {
      labels.begin();
      drawMetres(context, camera, grid);
      if (!isMany) {
        drawMarkers(context, camera, ratio);
        drawHeadings(context, camera, poses);
      }
      drawChosen(context, chosenSlot);
      if (!state.layers.labels) return;
      if (isCrowded(camera)) {
        if (chosenSlot !== undefined) name(context, camera, [chosenSlot]);
        return;
      }
      for (let slot = 0; slot < agents.length; slot++) {
        const r = radiusOf(slot);
        if (isInside(camera, slot, 0)) labels.keep(spots[slot * 2] - r, spots[slot * 2 + 1] - r, spots[slot * 2] + r, spots[slot * 2 + 1] + r);
      }
      name(context, camera, chosenSlot === undefined ? byImportance : [chosenSlot, ...byImportance.filter((slot) => slot !== chosenSlot)]);
    },
  };
}
