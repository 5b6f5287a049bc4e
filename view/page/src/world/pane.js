// One run's world: what has a size in metres is a three.js scene; marks, names and the network are drawn
// over it.
import { AmbientLight, Color, DirectionalLight, Scene, WebGLRenderer } from "three";
import { createFollowed } from "../air/followed.js";
import { createFrames } from "../air/frames.js";
import { createQueues } from "../air/queues.js";
import { createRoutes } from "../air/routes.js";
import { createPoses, posesAt } from "../at.js";
import { colour } from "../colours.js";
import { paper } from "../paper.js";
import { createBodies } from "./bodies.js";
import { createCamera } from "./camera.js";
import { createCoverage, createLegend } from "./coverage.js";
import { createDots } from "./dots.js";
import { createGrid, createWalls } from "./ground.js";
import { createLinks } from "./links.js";
import { createMarks, many } from "./marks.js";
import { createMovables } from "./movables.js";
import { pointer } from "./pointer.js";
import { createTrails } from "./trails.js";

const make = (parent, tag, name) => {
  const element = document.createElement(tag);
  if (name) element.className = name;
  parent.append(element);
  return element;
};

// The graphics card's view of the world, or none: then the network is still drawn.
function renderer(canvas, smooth) {
  try {
    const made = new WebGLRenderer({ canvas, antialias: smooth, powerPreference: "high-performance", stencil: false });
    made.info.autoReset = true;
    return made;
  } catch {
    return null;
  }
}

function createScene(run, slots) {
  const scene = new Scene();
  scene.background = new Color();
  const sun = new DirectionalLight(0xffffff, 1.6);
  sun.position.set(-0.4, -0.7, 1);
  scene.add(new AmbientLight(0xffffff, 1.7), sun);
  const grid = createGrid(scene);
  const walls = createWalls(scene, run.world.walls ?? []);
  const movables = createMovables(scene, run.world.movables ?? []);
  const coverage = createCoverage(scene, run);
  const links = createLinks(scene, run, slots);
  const trails = createTrails(scene, run, slots);
  const bodies = createBodies(scene, run.world);
  const dots = run.world.agents.length > many ? createDots(scene, run.world) : null;
  return { scene, grid, coverage, walls, movables, links, trails, bodies, dots,
    recolour() {
      scene.background.set(colour("ground"));
      for (const part of [grid, walls, movables, links, trails, bodies, dots]) part?.recolour();
    } };
}

function titleOf(pane, run) {
  const title = make(pane, "h2");
  title.append(run.title);
  const small = make(title, "small");
  let shown = null;
  // The result of a run under way comes later; if its server ends before that, it is not known.
  return ({ live }) => {
    const { result, profile } = run.world;
    const end = live?.gone && !live.ended ? "does not answer" : live?.ended ? live.result : result;
    const text = [profile && ` · ${profile}`, end && ` · ${end}`].filter(Boolean).join("");
    if (text !== shown) small.textContent = shown = text;
  };
}

// What was not recorded is listed beside the run, in the inspector; over the map only what misleads there.
function tellMissing(pane, run) {
  const missing = (run.world.missing ?? []).filter(({ what }) => /^(poses|frames)/.test(what));
  const warnings = run.world.warnings ?? [];
  if (!missing.length && !warnings.length) return null;
  const box = make(pane, "details", "missing");
  const count = [warnings.length && `${warnings.length} warning${warnings.length > 1 ? "s" : ""}`, missing.length && "partly recorded"];
  make(box, "summary").textContent = count.filter(Boolean).join(", ");
  for (const text of warnings) make(box, "p").textContent = text;
  for (const { what, line } of missing) {
    const row = make(box, "p");
    row.append(`${what}: `);
    make(row, "code").textContent = line;
  }
  box.open = warnings.length > 0;
  return box;
}

export function createPane(parent, run, store) {
  const agents = run.world.agents;
  const slots = new Map(agents.map((agent, slot) => [agent.agent, slot]));
  const element = make(parent, "div", "pane");
  const canvas = make(element, "canvas", "scene");
  const overlay = make(element, "canvas", "overlay");
  const tellTitle = titleOf(element, run);
  const missing = tellMissing(element, run);
  const isMany = agents.length > many;
  const graphics = renderer(canvas, !isMany);
  const context = paper(overlay, isMany);
  const camera = createCamera();
  const poses = createPoses(agents);
  const parts = createScene(run, slots);
  const marks = createMarks(run);
  const legend = createLegend(element, parts.coverage, store);
  const air = { frames: createFrames(run, slots), routes: createRoutes(run, slots), queues: createQueues(run), followed: createFollowed(run, slots) };
  const period = run.world.recorded?.poses_period_ns ?? 0;
  let size = "";
  let over = false; //  what stands over the scene, if it is the same until that changes
  let shades = 0;
  let seen = ""; //  from where, and how large, the scene was drawn last

  function fit() {
    const { clientWidth: width, clientHeight: height } = element;
    const ratio = isMany ? 1 : Math.min(2, devicePixelRatio || 1);
    const now = `${width} ${height} ${ratio}`;
    if (now !== size && width && height) {
      size = now;
      graphics?.setPixelRatio(ratio);
      graphics?.setSize(width, height, false);
      overlay.width = Math.round(width * ratio);
      overlay.height = Math.round(height * ratio);
      camera.clearTop = missing ? missing.offsetTop + missing.querySelector("summary").offsetHeight + 14 : 40;
    }
    return { width, height, ratio };
  }

  function move(state) {
    const ahead = state.playing ? state.speed * 1e9 : 0;
    posesAt(run.rows("poses", state.t, state.t + period + 1), state.t, period, slots, poses);
    if (ahead) run.rows("poses", state.t, state.t + ahead + period); //  asked for before they are needed
  }

  // Without movables nothing is asked for.
  const movableRows = (state) => (parts.movables.count ? run.rows("movables", state.t, state.t + period + 1) : []);

  const chosenSlot = ({ chosen }) => (chosen?.kind === "agent" && chosen.run === run.index ? slots.get(chosen.agent) : undefined);

  function draw(state) {
    const { width, height, ratio } = fit();
    if (!width || !height) return;
    tellTitle(state);
    legend(state);
    move(state);
    const followed = state.follow === null ? undefined : slots.get(state.follow);
    camera.aim(state, width, height, run.world.bounds, followed === undefined ? null : { x: poses.x[followed], y: poses.y[followed] });
    marks.place(poses, camera);
    drawScene(state, ratio);
    drawOver(state, width, height, ratio);
    air.frames.prefetch(state);
  }

  function drawOver(state, width, height, ratio) {
    const slot = chosenSlot(state);
    const frames = air.frames.collect(state);
    // Of very many agents there is often nothing to be drawn over the scene but the metres.
    const quiet = isMany && !state.chosen && !state.followed && !frames && !state.layers.ranges && run.world.recorded?.queues !== "all" &&
      marks.isCrowded(camera) && `${size} ${JSON.stringify(camera.mode2d ? camera.map : camera.orbit)} ${shades}`;
    if (quiet && quiet === over) return;
    over = quiet;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    marks.below(context, camera, poses, state, slot === undefined ? null : agents[slot].agent);
    chosenLink(state);
    air.frames.draw(context, camera, poses, state, frames);
    air.routes.draw(context, camera, poses, state);
    air.followed.draw(context, camera, poses, state);
    marks.above(context, camera, poses, state, parts.grid, slot, ratio);
    air.queues.draw(context, camera, marks, state);
  }

  // Not drawn again if it is what it was: most of the time only marks move, and they are drawn over it.
  function drawScene(state, ratio) {
    const slot = chosenSlot(state);
    const changed = [parts.grid.draw(camera), parts.coverage.draw(state), parts.movables.draw(movableRows(state), state.t, period, camera), parts.links.draw(state, poses, slot), parts.trails.draw(state, poses, slot),
      parts.bodies.draw(poses, camera, marks), parts.dots?.draw(poses, camera, marks, ratio)].includes(true);
    parts.walls.draw(camera);
    const { elements } = camera.eye.matrixWorldInverse;
    const eye = `${size} ${elements.join()} ${camera.eye.projectionMatrix.elements.join()}`;
    if (!changed && eye === seen) return;
    seen = eye;
    graphics?.render(parts.scene, camera.eye);
  }

  function chosenLink({ chosen }) {
    if (chosen?.kind !== "link" || chosen.run !== run.index) return;
    const p = slots.get(chosen.a) * 2;
    const q = slots.get(chosen.b) * 2;
    context.beginPath();
    context.moveTo(marks.spots[p], marks.spots[p + 1]);
    context.lineTo(marks.spots[q], marks.spots[q + 1]);
    context.strokeStyle = colour("ink");
    context.lineWidth = 2.5;
    context.stroke();
  }

  // The agent under a point; else the link beside it; else nothing.
  function choose(x, y) {
    let best = null;
    let least = Infinity;
    for (let slot = 0; slot < agents.length; slot++) {
      const away = Math.hypot(marks.spots[slot * 2] - x, marks.spots[slot * 2 + 1] - y);
      const reach = marks.radiusOf(slot) + 5;
      if (away <= reach && away / reach < least) { least = away / reach; best = { kind: "agent", agent: agents[slot].agent }; }
    }
    if (!best && store.state.layers.links) {
      const link = parts.links.near(poses, camera, x, y, 5);
      if (link) best = { kind: "link", ...link };
    }
    store.set({ chosen: best && { ...best, run: run.index }, run: run.index });
  }
  pointer(canvas, store, camera, choose);
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => { seen = ""; store.set({ layers: { ...store.state.layers } }); });

  return {
    element, camera, draw,
    quality: parts.links.quality,
    recolour() { parts.recolour(); marks.forget(); seen = ""; shades++; },
    project(x, y) {
      const box = canvas.getBoundingClientRect();
      const spot = camera.project(x, y, 0, [0, 0, 0]);
      return [box.left + spot[0], box.top + spot[1]];
    },
    arrows: () => air.routes.arrows(store.state),
    hits: () => marks.hits(camera, store.state.t),
    followed: () => air.followed.current(store.state),
  };
}
