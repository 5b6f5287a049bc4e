// Why frames were lost: what became of each at each other radio.
import { create } from "d3-selection";
import { max, sum } from "d3-array";
import { scaleLinear } from "d3-scale";
import { download, panel, section, thousands } from "./page.js";

const kRow = 24, kLabel = 150, kBars = 300, kWidth = 560;

/** What became of frames at the radios that they were for, most first. */
function of_addressed(group) {
  const counts = new Map();
  for (const row of group.verdicts.filter((one) => one.addressed)) {
    counts.set(row.verdict, (counts.get(row.verdict) ?? 0) + row.count);
  }
  return [...counts].map(([verdict, count]) => ({ verdict, count })).sort((a, b) => b.count - a.count);
}

function draw(parent, rows, total) {
  const svg = create("svg").attr("viewBox", `0 0 ${kWidth} ${kRow * rows.length + 6}`).attr("role", "img");
  const width = scaleLinear([0, max(rows, (row) => row.count)], [0, kBars]);
  const row = svg.selectAll("g").data(rows).join("g").attr("transform", (_, i) => `translate(0 ${kRow * i + 3})`);
  row.append("text").attr("x", kLabel - 8).attr("y", 15).attr("text-anchor", "end").text((one) => one.verdict);
  row.append("rect").attr("class", "bar verdict").attr("data-count", (one) => one.count).attr("x", kLabel)
    .attr("y", 3).attr("height", kRow - 8).attr("width", (one) => Math.max(1, width(one.count)))
    .append("title").text((one) => `${one.verdict}: ${thousands(one.count)}`);
  row.append("text").attr("class", "muted").attr("x", (one) => kLabel + width(one.count) + 8).attr("y", 15)
    .text((one) => `${(100 * one.count / total).toPrecision(3)} %`);
  parent.append(() => svg.node());
}

export function losses(groups) {
  const part = section("losses", "Why frames were lost", "Each frame at each other radio that it was for, its "
    + "receiver or everyone, and what became of it there: in sum, all that was sent. Below sensitivity: the radio "
    + "did not notice it. The files have overheard frames, too, and every link that ever carried something.",
    groups.length > 1 ? "" : "single");
  for (const group of groups) {
    const rows = of_addressed(group);
    const total = sum(rows, (row) => row.count);
    draw(panel(part.panels, group.series, group.name, `${thousands(total)} frames times radios`).element, rows, total);
  }
  download(part.downloads, "verdicts.csv", ["profile", "class", "addressed", "verdict", "count"],
    groups.flatMap((g) => g.verdicts.map((row) =>
      [g.name, row.class, Number(row.addressed), row.verdict, row.count])));
  download(part.downloads, "link_verdicts.csv", ["profile", "from", "to", "verdict", "count"],
    groups.flatMap((g) => g.link_verdicts.flatMap(([from, to, verdicts]) => Object.entries(verdicts)
      .map(([verdict, count]) => [g.name, g.nodes[from].name, g.nodes[to].name, verdict, count]))));
  return part.element;
}
