// Fig. 12: packets received by each node.
import { extent } from "d3-array";
import { scaleLinear } from "d3-scale";
import { download, panel, plural, section, thousands } from "./page.js";
import { map, square_around } from "./map.js";

let gradients = 0;

const nearest = (node, motes) => Math.min(...motes.filter((m) => m !== node)
  .map((m) => Math.hypot(m.x - node.x, m.y - node.y)));

/** Dark in the middle, nothing at the rim. */
function fuzzy(svg) {
  const id = `fuzzy-${gradients++}`;
  const gradient = svg.append("radialGradient").attr("id", id);
  for (const [offset, opacity] of [[0, 1], [0.55, 0.9], [1, 0]]) {
    gradient.append("stop").attr("offset", offset).attr("stop-color", "currentColor")
      .attr("stop-opacity", opacity);
  }
  return `url(#${id})`;
}

function draw(parent, group) {
  const motes = group.nodes.filter((n) => !n.robot);
  const places = motes.map((n) => [n.x, n.y]);
  const on = map(parent, `Packets received, ${group.name}`, square_around(places, 0.15, 5));
  const shade = scaleLinear(extent(motes, (n) => n.packets), [0.12, 1]);
  const step = motes.length > 1 ? Math.min(...motes.map((n) => nearest(n, motes))) * on.metre : 90;
  const radius = Math.min(30, Math.max(6, 0.33 * step));
  const fill = fuzzy(on.svg);
  const runs = group.runs.length;
  on.above.selectAll(".packets").data(motes).join("circle").attr("class", "packets")
    .attr("r", radius).attr("fill", fill).attr("opacity", (n) => shade(n.packets))
    .attr("cx", (n) => on.x(n.x)).attr("cy", (n) => on.y(n.y))
    .append("title").text((n) => `${n.name}: ${thousands(n.packets)}`);
  const label = (kind, down, text) => on.above.selectAll(`.${kind}`).data(motes).join("text")
    .attr("class", `halo ${kind}`).attr("text-anchor", "middle").attr("x", (n) => on.x(n.x))
    .attr("y", (n) => on.y(n.y) + radius + down).text(text);
  label("total", 6, (n) => thousands(n.packets)).attr("font-weight", 600);
  label("mean muted", 19, (n) => `${n.name}: ${(n.packets / runs).toFixed(1)}`);
}

function note(group) {
  const motes = group.nodes.filter((n) => !n.robot);
  const by = [...motes].sort((a, b) => a.packets - b.packets);
  const [least, most] = [by[0], by[by.length - 1]];
  const robots = group.nodes.filter((n) => n.robot)
    .map((n) => `; ${n.name} (driving) ${thousands(n.packets)}`).join("");
  return `most ${most.name} ${thousands(most.packets)}, least ${least.name} `
    + `${thousands(least.packets)}${robots}`;
}

export function packets(groups, paper, title) {
  const part = section("packets", title, "Frames whose payload went "
    + "up to the network layer: the stronger the colour, the more. Bold: total of the runs; below: the "
    + "mean per run."
    + (paper ? ` The paper, mean of ${paper.runs} runs: most ${paper.most_packets / paper.runs} (second `
      + `row from the top, third column), least ${paper.least_packets / paper.runs} (lower right).` : ""),
    groups.length > 1 ? "" : "single");
  groups.forEach((group) => {
    draw(panel(part.panels, group.series, `${group.name}, ${plural(group.runs.length, "run")}`,
      note(group)).element, group);
  });
  download(part.downloads, "packets.csv", ["profile", "node", "x_m", "y_m", "total", "runs", "mean"],
    groups.flatMap((g) => g.nodes.map((n) =>
      [g.name, n.name, n.x, n.y, n.packets, g.runs.length, n.packets / g.runs.length])));
  return part.element;
}
