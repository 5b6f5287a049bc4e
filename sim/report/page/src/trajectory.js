// Fig. 11: where the robots drove, and how they went round the wall.
import { line } from "d3-shape";
import { download, panel, section } from "./page.js";
import { corners, draw_robot, draw_walls, map, square_around } from "./map.js";

const kBodyRadius = 0.185;  // m, of a Robertino

/** Everything that stands or drives in a group. */
function field_window(group) {
  return square_around([...group.nodes.map((n) => [n.x, n.y]), ...group.walls.flatMap(corners),
    ...group.runs.flatMap((r) => r.robots.flatMap((robot) =>
      robot.track.map(([, x, y]) => [x, y])))], 0.06);
}

/** The wall a run passed closest to its middle, with some room around; nothing without walls, or if
 *  the field is hardly larger. */
function close_up_window(group, run, field) {
  const places = run.robots.flatMap((r) => r.track);
  if (!group.walls.length || !places.length) return null;
  const distance = (w) => Math.min(...places.map(([, x, y]) => Math.hypot(x - w.x, y - w.y)));
  const wall = group.walls.reduce((a, b) => (distance(b) < distance(a) ? b : a));
  const window = square_around(corners(wall), 0, 4);
  return window.x1 - window.x0 < (field.x1 - field.x0) / 2 ? window : null;
}

function draw_tracks(on, group, shown) {
  const path = line().x(([, x]) => on.x(x)).y(([, , y]) => on.y(y));
  const ordered = [...group.runs.filter((r) => r !== shown), shown];  // the one shown on top
  for (const run of ordered) {
    on.inside.selectAll(null).data(run.robots).join("path")
      .attr("class", run === shown ? "track shown" : "track other")
      .attr("d", (robot) => path(robot.track))
      .append("title").text((robot) => `${robot.name}, seed ${run.seed}`);
  }
}

/** @param is_labelled  whether the mark at a time [s] gets a label */
function draw_marks(on, run, radius, is_labelled) {
  const ticks = run.robots.flatMap((robot) => robot.ticks);
  on.inside.selectAll(".mark").data(ticks).join("circle").attr("class", "mark").attr("r", radius)
    .attr("cx", ([, x]) => on.x(x)).attr("cy", ([, , y]) => on.y(y))
    .append("title").text(([t, x, y]) => `${t} s: (${x.toFixed(1)}, ${y.toFixed(1)}) m`);
  on.inside.selectAll(".time").data(ticks.filter(([t]) => is_labelled(t))).join("text")
    .attr("class", "halo time").attr("x", ([, x]) => on.x(x) + radius + 4)
    .attr("y", ([, , y]) => on.y(y) - radius - 2).text(([t]) => `${t} s`);
}

function draw_field(parent, group, run, field, close_up) {
  const on = map(parent, `Trajectory, ${group.name}`, field);
  const motes = group.nodes.filter((n) => !n.robot);
  on.inside.selectAll(".node").data(motes).join("circle").attr("class", "node small").attr("r", 3)
    .attr("cx", (n) => on.x(n.x)).attr("cy", (n) => on.y(n.y)).append("title").text((n) => n.name);
  on.above.selectAll(".target").data(motes.filter((n) => n.goal)).join("circle")
    .attr("class", "target").attr("r", 10).attr("cx", (n) => on.x(n.x)).attr("cy", (n) => on.y(n.y));
  draw_tracks(on, group, run);
  draw_walls(on, group.walls);
  draw_marks(on, run, 3, (t) => (close_up ? t > 0 && t % 120 === 0 : t % 60 === 0));
  if (!close_up) return;
  on.above.append("rect").attr("class", "window").attr("x", on.x(close_up.x0))
    .attr("y", on.y(close_up.y1)).attr("width", on.x(close_up.x1) - on.x(close_up.x0))
    .attr("height", on.y(close_up.y0) - on.y(close_up.y1));
}

function draw_close_up(parent, group, run, window) {
  const on = map(parent, `Close-up at the wall, ${group.name}`, window);
  draw_walls(on, group.walls);
  draw_tracks(on, group, run);
  const places = run.robots.flatMap((robot) => robot.track).filter(([, x, y]) =>
    x >= window.x0 && x <= window.x1 && y >= window.y0 && y <= window.y1);
  on.inside.selectAll(".body").data(places).join("circle").attr("class", "body")
    .attr("r", kBodyRadius * on.metre).attr("cx", ([, x]) => on.x(x)).attr("cy", ([, , y]) => on.y(y))
    .append("title").text(([t, x, y]) => `${t.toFixed(1)} s: (${x.toFixed(2)}, ${y.toFixed(2)}) m`);
  draw_marks(on, run, 4, () => true);
  for (const robot of run.robots) {
    if (robot.track.length) draw_robot(on.inside, on.x(robot.track[0][1]), on.y(robot.track[0][2]), robot.name);
  }
}

function draw_panel(panels, group) {
  const { element, head } = panel(panels, group.series, group.name, "");
  const plots = element.append("div").attr("class", "pair");
  const show = (run) => {
    plots.selectAll("*").remove();
    const field = field_window(group);
    const window = close_up_window(group, run, field);
    draw_field(plots.append("div").attr("class", "field"), group, run, field, window);
    if (window) draw_close_up(plots.append("div").attr("class", "close-up"), group, run, window);
  };
  const first = Math.max(0, group.runs.findIndex((run) => run.robots.length));
  const label = head.select("small").append("label").text("run shown: ");
  label.append("select").on("change", (event) => show(group.runs[event.target.value]))
    .selectAll("option").data(group.runs).join("option").attr("value", (_, i) => i)
    .property("selected", (_, i) => i === first)
    .text((run) => `seed ${run.seed}, ${run.result} after ${run.simulated_s.toFixed(0)} s`);
  show(group.runs[first]);
}

export function trajectory(groups) {
  const part = section("trajectory", "Fig. 11 · Trajectory", "Left: the way of the robot, a mark every "
    + "30 s; other runs faint. Right, if the world is much larger than its walls: close-up of the dashed "
    + "square, the robot's body drawn to scale once per second; the diamond is the start, the brown bar "
    + "the wall it has to avoid.", "wide");
  groups.forEach((group) => draw_panel(part.panels, group));
  const rows = (key) => groups.flatMap((g) => g.runs.flatMap((run) => run.robots.flatMap((robot) =>
    robot[key].map((place) => [g.name, run.folder, run.seed, robot.name, ...place]))));
  const columns = ["profile", "run", "seed", "robot", "t_s", "x_m", "y_m"];
  download(part.downloads, "trajectory.csv", columns, rows("track"));
  download(part.downloads, "marks.csv", columns, rows("ticks"));
  download(part.downloads, "walls.csv",
    ["profile", "wall", "x_m", "y_m", "yaw_rad", "length_x_m", "length_y_m"],
    groups.flatMap((g) => g.walls.map((w) =>
      [g.name, w.name, w.x, w.y, w.yaw, w.length_x, w.length_y])));
  return part.element;
}
