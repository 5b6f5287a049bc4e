import { select } from "d3-selection";
import { air } from "./air.js";
import { losses } from "./losses.js";
import { network } from "./network.js";
import { packets } from "./packets.js";
import { download, plural, section, table } from "./page.js";
import { profiles, times } from "./times.js";
import { trajectory } from "./trajectory.js";

const kSeries = 4;  // colours

function head(main, figures) {
  const complete = figures.groups.reduce((count, g) => count + g.runs.length, 0);
  const left_out = figures.groups.reduce((count, g) => count + g.left_out, 0);
  main.append("h1").text("BARAKA report");
  main.append("p").attr("class", "lead").text(`${plural(complete, "complete run")} of `
    + `${figures.groups.map((g) => g.name).join(", ")}${left_out ? `; ${left_out} broken off, left out` : ""}. `
    + (figures.paper ? "The paper: T. H. Labella, I. Dietrich, F. Dressler, “Hybrid simulation of Sensor and Actor "
    + "Networks with BARAKA”, 2009." : ""));
  for (const g of figures.groups.filter((one) => one.not_the_papers)) {
    main.append("p").attr("class", "caption").text(
      `${g.name}: not the paper's case study: ${g.not_the_papers}.`);
  }
}

function comparison(figures) {
  const title = figures.paper ? "The paper's figures beside ours" : "Figures";
  const part = section("comparison", title, "Pooled over the runs of the same settings but for the "
    + "seed. Quartiles are of type 7; delays are of messages to one agent, waiting for a route "
    + "included; replica score: mean |ln(ours / paper's)| of the six quartiles, 0 is equal.", "wide");
  const paper = (text) => (figures.paper ? [text] : []);
  const columns = ["figure", ...paper("paper"), ...figures.groups.map((g) => g.name)];
  const rows = figures.comparison.map((row) => [row.figure, ...paper(row.paper), ...row.ours]);
  table(part.panels, columns, rows, ["", ...paper("paper")]);
  download(part.downloads, "comparison.csv", columns, rows);
  return part.element;
}

function differences(figures) {
  const part = section("differences", "Settings in which they differ", "Runs are pooled only where "
    + "nothing but the seed differs.", "wide");
  const columns = ["setting", ...figures.groups.map((g) => g.name)];
  const rows = figures.differences.map((one) => [one.key, ...one.values]);
  table(part.panels, columns, rows);
  download(part.downloads, "differences.csv", columns, rows);
  return part.element;
}

function runs(groups) {
  const part = section("runs", "Runs", "Complete runs, in the order given.", "wide");
  const columns = ["run", "profile", "seed", "result", "simulated s"];
  const rows = groups.flatMap((g) => g.runs.map((run) =>
    [run.folder, g.name, run.seed, run.result, run.simulated_s.toFixed(1)]));
  const list = part.panels.append("details").attr("open", rows.length <= 12 ? "" : null);
  list.append("summary").text(plural(rows.length, "run"));
  table(list, columns, rows);
  download(part.downloads, "runs.csv", columns, rows);
  return part.element;
}

function draw(figures) {
  const main = select("main");
  figures.groups.forEach((group, i) => { group.series = i % kSeries; });
  head(main, figures);
  const groups = figures.groups.filter((g) => g.runs.length);
  const parts = [comparison(figures)];
  if (figures.groups.length > 1) parts.push(differences(figures));
  // Each figure shows the groups that have something to show, or is left out.
  const add = (plot, is_there) => {
    const shown = groups.filter(is_there);
    if (shown.length) parts.push(plot(shown));
  };
  if (groups.length > 1) parts.push(profiles(groups, figures));
  add(network, (g) => g.nodes.length);
  add(trajectory, (g) => g.runs.some((run) => run.robots.length));
  add((shown) => packets(shown, figures.paper), (g) => g.nodes.some((n) => !n.robot));
  add(losses, (g) => g.verdicts.some((row) => row.addressed));
  add(air, (g) => g.air.kinds.length);
  add((shown) => times("discovery", "Fig. 13 · Time to discover a route", "time to discover a route",
    "Searches that found a route.", shown, figures), (g) => g.discovery.quantiles);
  add((shown) => times("delay", "Fig. 14 · End-to-end delay", "end-to-end delay",
    "Messages to one agent that arrived, waiting for a route included.", shown, figures),
  (g) => g.delay.quantiles);
  parts.push(runs(groups));
  for (const part of parts) main.append(() => part.node());
  document.documentElement.dataset.drawn = parts.length;
}

draw(JSON.parse(document.getElementById("figures").textContent));
