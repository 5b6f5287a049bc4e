// What the air was used for: topics of programs, everything by kind, air time per second.
import { axisBottom, axisLeft } from "d3-axis";
import { max, sum } from "d3-array";
import { scaleLinear } from "d3-scale";
import { create } from "d3-selection";
import { download, panel, section, table, thousands } from "./page.js";
import { duration } from "./times.js";

const kWidth = 1100, kHeight = 240;  // px of the view box
const kMargin = { top: 10, right: 170, bottom: 40, left: 62 };
// From the bottom up; how each is drawn: style.css.
const kUses = ["user data", "user control", "SPDP", "SEDP", "liveliness", "builtin", "RTPS", "network", "routing",
  "802.11", "other"];

const seconds = (ns) => (ns * 1e-9).toPrecision(4);
const percent = (part, whole) => (whole ? (100 * part / whole).toPrecision(3) : "–");

/** Bars of one second each, uses on top of each other. @param rows  [second, use, ns] */
function draw(parent, rows) {
  const uses = kUses.filter((use) => rows.some((row) => row[1] === use));
  const last = max(rows, (row) => row[0]) ?? 0;
  const bottom = kHeight - kMargin.bottom;
  const svg = create("svg").attr("viewBox", `0 0 ${kWidth} ${kHeight}`).attr("role", "img")
    .attr("aria-label", "Air time per second by use");
  const heights = new Float64Array(last + 1);
  for (const [second, , ns] of rows) heights[second] += ns * 1e-9;
  const x = scaleLinear([0, last + 1], [kMargin.left, kWidth - kMargin.right]);
  const y = scaleLinear([0, max(heights) || 1], [bottom, kMargin.top]).nice(4);
  svg.append("g").attr("transform", `translate(0,${bottom})`).call(axisBottom(x).ticks(10).tickSizeOuter(0));
  svg.append("g").attr("transform", `translate(${kMargin.left},0)`)
    .call(axisLeft(y).ticks(4).tickSizeOuter(0));
  svg.append("text").attr("class", "muted").attr("text-anchor", "middle")
    .attr("x", (kMargin.left + kWidth - kMargin.right) / 2).attr("y", kHeight - 6).text("simulated time / s");
  svg.append("text").attr("class", "muted").attr("text-anchor", "middle")
    .attr("transform", `translate(13,${(bottom + kMargin.top) / 2}) rotate(-90)`).text("air time / s per s");
  const base = new Float64Array(last + 1);
  uses.forEach((use) => {
    const bars = rows.filter((row) => row[1] === use).map(([second, , ns]) => {
      const from = base[second];
      base[second] += ns * 1e-9;
      return { second, from, to: base[second], ns };
    });
    svg.append("g").attr("class", `use use-${kUses.indexOf(use)}`).selectAll("rect").data(bars).join("rect")
      .attr("data-ns", (bar) => bar.ns).attr("x", (bar) => x(bar.second))
      .attr("width", Math.max(0.5, x(1) - x(0))).attr("y", (bar) => y(bar.to))
      .attr("height", (bar) => Math.max(0, y(bar.from) - y(bar.to)))
      .append("title").text((bar) => `${use}, second ${bar.second}: ${seconds(bar.ns)} s`);
  });
  const legend = svg.append("g").selectAll("g").data([...uses].reverse()).join("g")
    .attr("transform", (_, i) => `translate(${kWidth - kMargin.right + 16},${kMargin.top + 18 * i})`);
  legend.append("rect").attr("class", (use) => `use use-${kUses.indexOf(use)}`).attr("width", 12).attr("height", 12);
  legend.append("text").attr("x", 18).attr("y", 10).text((use) => use);
  parent.append(() => svg.node());
}

function topics_table(parent, group, all) {
  table(parent, ["topic", "samples", "delivered", "first try", "repaired", "latency p50", "p99", "air time s", "share %"],
    group.air.topics.map((one) => [one.topic || "(not announced)", thousands(one.samples), thousands(one.delivered),
      thousands(one.first_try), thousands(one.repaired), one.p50 === null ? "–" : duration(one.p50),
      one.p99 === null ? "–" : duration(one.p99), seconds(one.airtime_ns), percent(one.airtime_ns, all)]));
}

function kinds_table(parent, group, all) {
  const list = parent.append("details");
  list.append("summary").text("everything, by kind");
  table(list, ["purpose", "kind", "port", "frames", "of these retries", "submessages", "bytes", "air time s", "share %"],
    group.air.kinds.map((one) => [one.purpose, one.kind, one.port ?? "–", thousands(one.frames), thousands(one.retries),
      thousands(one.submessages), thousands(Math.floor(one.bits / 8)), seconds(one.airtime_ns),
      percent(one.airtime_ns, all)]));
}

function losses_table(parent, group) {
  if (!group.sample_losses.length) return;
  const list = parent.append("details");
  list.append("summary").text("why samples were not delivered");
  table(list, ["topic", "verdict", "at", "samples"],
    group.sample_losses.map(([topic, verdict, at, count]) => [topic, verdict, at || "–", thousands(count)]));
}

export function air(groups) {
  const part = section("air", "What the air was used for", "Air time of all stations, of each frame shared out over the "
    + "submessages that it carries by their bytes. Samples count once for each agent with a matched reader; latencies "
    + "are from the sender's interface to the receiver's. The bars: the first run. User control: heartbeats, "
    + "acknowledgements and the like of programs' topics.", "wide");
  for (const group of groups) {
    const all = sum(group.air.kinds, (kind) => kind.airtime_ns);
    const { element } = panel(part.panels, group.series, group.name, `${seconds(all)} s of air time`);
    draw(element, group.air.seconds[0]);
    topics_table(element, group, all);
    losses_table(element, group);
    kinds_table(element, group, all);
  }
  download(part.downloads, "air_topics.csv", ["profile", "topic", "samples", "delivered", "first_try", "repaired",
    "p50_s", "p99_s", "airtime_ns"], groups.flatMap((g) => g.air.topics.map((one) => [g.name, one.topic, one.samples,
    one.delivered, one.first_try, one.repaired, one.p50 ?? "", one.p99 ?? "", one.airtime_ns])));
  download(part.downloads, "air_kinds.csv", ["profile", "purpose", "kind", "port", "frames", "retries", "submessages",
    "bits", "airtime_ns"], groups.flatMap((g) => g.air.kinds.map((one) => [g.name, one.purpose, one.kind, one.port ?? "",
    one.frames, one.retries, one.submessages, one.bits, one.airtime_ns])));
  download(part.downloads, "air_seconds.csv", ["profile", "run", "second", "use", "airtime_ns"],
    groups.flatMap((g) => g.air.seconds.flatMap((rows, i) => rows.map((row) => [g.name, g.runs[i].folder, ...row]))));
  return part.element;
}
