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

/** Colours and dashes tell robots apart: the first eight by colour alone, with any colour vision. */
const kColours = 8;
const colour = (i) => `var(--robot-${i % kColours})`;
const dashes = (i) => ["none", "7 3", "2 2"][Math.floor(i / kColours) % 3];
const is_team = (run) => run.robots.length > 1;

function draw_tracks(on, group, shown) {
  const path = line().x(([, x]) => on.x(x)).y(([, , y]) => on.y(y));
  // The one shown on top; beside many robots other runs would hide them.
  const ordered = is_team(shown) ? [shown] : [...group.runs.filter((r) => r !== shown), shown];
  for (const run of ordered) {
    const tracks = on.inside.selectAll(null).data(run.robots).join("path")
      .attr("class", run === shown ? "track shown" : "track other").attr("d", (robot) => path(robot.track));
    if (is_team(run)) tracks.style("color", (_, i) => colour(i)).attr("stroke-dasharray", (_, i) => dashes(i));
    tracks.append("title").text((robot) => `${robot.name}, seed ${run.seed}`);
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

function draw_legend(parent, run) {
  const entries = parent.append("p").attr("class", "legend").selectAll("span").data(run.robots).join("span")
    .attr("class", "entry").style("color", (_, i) => colour(i));
  entries.append("svg").attr("viewBox", "0 0 24 8").append("path").attr("d", "M0,4H24").attr("class", "track")
    .attr("stroke-dasharray", (_, i) => dashes(i));
  entries.append("b").text((robot) => robot.name);
}

const length_of = (track) => track.slice(1).reduce((sum, [, x, y], i) =>
  sum + Math.hypot(x - track[i][1], y - track[i][2]), 0);

/** Each robot of a team alone, the others faint behind it. */
function draw_multiples(parent, group, run, field) {
  run.robots.forEach((robot, i) => {
    const one = parent.append("div").attr("class", "multiple");
    one.append("h4").style("color", colour(i)).text(robot.name).append("small")
      .text(` ${length_of(robot.track).toFixed(0)} m in ${run.simulated_s.toFixed(0)} s`);
    const on = map(one, `Trajectory of ${robot.name}`, field);
    const path = line().x(([, x]) => on.x(x)).y(([, , y]) => on.y(y));
    draw_walls(on, group.walls);
    on.inside.selectAll(".other").data(run.robots.filter((r) => r !== robot)).join("path").attr("class", "track other")
      .attr("d", (r) => path(r.track));
    on.inside.append("path").attr("class", "track alone").style("color", colour(i)).attr("d", path(robot.track));
    on.inside.selectAll(".mark").data(robot.ticks).join("circle").attr("class", "mark").style("color", colour(i))
      .attr("r", 2.5).attr("cx", ([, x]) => on.x(x)).attr("cy", ([, , y]) => on.y(y))
      .append("title").text(([t, x, y]) => `${t} s: (${x.toFixed(1)}, ${y.toFixed(1)}) m`);
    if (robot.track.length) draw_robot(on.above, on.x(robot.track[0][1]), on.y(robot.track[0][2]), robot.name);
  });
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
  if (is_team(run)) {
    run.robots.filter((r) => r.track.length).forEach((r) => draw_robot(on.above, on.x(r.track[0][1]), on.y(r.track[0][2]), r.name));
    draw_legend(parent, run);
    return;
  }
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
  const multiples = element.append("div").attr("class", "multiples");
  const show = (run) => {
    plots.selectAll("*").remove();
    multiples.selectAll("*").remove();
    const field = field_window(group);
    const window = is_team(run) ? null : close_up_window(group, run, field);
    draw_field(plots.append("div").attr("class", "field"), group, run, field, window);
    if (window) draw_close_up(plots.append("div").attr("class", "close-up"), group, run, window);
    if (is_team(run)) draw_multiples(multiples, group, run, field);
  };
  const first = Math.max(0, group.runs.findIndex((run) => run.robots.length));
  const label = head.select("small").append("label").text("run shown: ");
  label.append("select").on("change", (event) => show(group.runs[event.target.value]))
    .selectAll("option").data(group.runs).join("option").attr("value", (_, i) => i)
    .property("selected", (_, i) => i === first)
    .text((run) => `seed ${run.seed}, ${run.result} after ${run.simulated_s.toFixed(0)} s`);
  show(group.runs[first]);
}

export function trajectory(groups, title) {
  const has_team = groups.some((g) => g.runs.some(is_team));
  const part = section("trajectory", title, "The way of each robot, diamonds at the starts, brown bars for walls. "
    + (has_team ? "Of several robots: all of one run together, each in its colour; then each alone, with a mark every "
      + "30 s, the others faint behind it. " : "")
    + "Of one robot: a mark every 30 s, other runs faint; beside it, if the world is much larger than its walls, a "
    + "close-up of the dashed square, the robot's body drawn to scale once per second.", "wide");
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
