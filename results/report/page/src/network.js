// Fig. 2: the nodes and who can hear whom at the start.
import { download, panel, plural, section } from "./page.js";
import { corners, draw_robot, draw_walls, map, square_around } from "./map.js";

/** Whether a third node stands on the line between two. */
function passes_a_node(nodes, a, b) {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const length = Math.hypot(dx, dy);
  return nodes.some((n) => {
    if (n === a || n === b || n.robot) return false;
    const along = ((n.x - a.x) * dx + (n.y - a.y) * dy) / length;
    const across = ((n.x - a.x) * dy - (n.y - a.y) * dx) / length;
    return along > 0 && along < length && Math.abs(across) < 0.03 * length;
  });
}

/** Straight, or bent round the nodes that stand between. */
function link_path(on, nodes, a, b) {
  const [x0, y0, x1, y1] = [on.x(a.x), on.y(a.y), on.x(b.x), on.y(b.y)];
  if (!passes_a_node(nodes, a, b)) return `M${x0},${y0}L${x1},${y1}`;
  const bend = 0.2;
  const [cx, cy] = [(x0 + x1) / 2 + bend * (y1 - y0), (y0 + y1) / 2 - bend * (x1 - x0)];
  return `M${x0},${y0}Q${cx},${cy} ${x1},${y1}`;
}

function draw(parent, group) {
  const { nodes, links } = group;
  const places = [...nodes.map((n) => [n.x, n.y]), ...group.walls.flatMap(corners)];
  const on = map(parent, `Network of ${group.name}`, square_around(places, 0.11));
  draw_walls(on, group.walls);
  on.inside.selectAll(".link").data(links).join("path").attr("class", "link")
    .attr("opacity", links.length > 150 ? 0.3 : 0.55)
    .attr("d", ([a, b]) => link_path(on, nodes, nodes[a], nodes[b]))
    .append("title").text(([a, b]) => `${nodes[a].name} – ${nodes[b].name}`);
  const motes = nodes.filter((n) => !n.robot);
  on.above.selectAll(".node").data(motes).join("circle").attr("class", "node").attr("r", 6)
    .attr("cx", (n) => on.x(n.x)).attr("cy", (n) => on.y(n.y))
    .append("title").text((n) => `${n.name} at (${n.x}, ${n.y}) m`);
  on.above.selectAll(".target").data(nodes.filter((n) => n.goal)).join("circle")
    .attr("class", "target").attr("r", 13).attr("cx", (n) => on.x(n.x)).attr("cy", (n) => on.y(n.y));
  for (const robot of nodes.filter((n) => n.robot)) {
    draw_robot(on.above, on.x(robot.x), on.y(robot.y), robot.name);
  }
  on.above.selectAll(".name").data(nodes).join("text").attr("class", "halo name")
    .attr("x", (n) => on.x(n.x) + (n.robot ? 10 : n.goal ? 14 : 8))
    .attr("y", (n) => on.y(n.y) + (n.robot ? -6 : 18)).text((n) => n.name);
}

export function network(groups, title) {
  const part = section("network", title, "Motes (circles) and robots (diamonds) at the "
    + "start; a line joins two that can hear each other, in both directions; it bends where a third "
    + "node stands between. The circled mote is the one that ended the run: the robot's target.",
    groups.length > 1 ? "" : "single");
  groups.forEach((group) => {
    const { nodes, links } = group;
    const of_robots = links.filter(([a, b]) => nodes[a].robot || nodes[b].robot).length;
    draw(panel(part.panels, group.series, group.name,
      `${plural(links.length - of_robots, "link")} between motes, ${of_robots} to robots`).element, group);
  });
  download(part.downloads, "nodes.csv", ["profile", "node", "kind", "x_m", "y_m", "target"],
    groups.flatMap((g) => g.nodes.map((n) =>
      [g.name, n.name, n.robot ? "robot" : "mote", n.x, n.y, n.goal ? 1 : 0])));
  download(part.downloads, "links.csv", ["profile", "a", "b"],
    groups.flatMap((g) => g.links.map(([a, b]) => [g.name, g.nodes[a].name, g.nodes[b].name])));
  return part.element;
}
