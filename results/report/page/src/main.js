import { select } from "d3-selection";
import { air } from "./air.js";
import { queues, relays } from "./queues.js";
import { experiment } from "./experiment.js";
import { losses } from "./losses.js";
import { network } from "./network.js";
import { packets } from "./packets.js";
import { download, panel, plural, section, table } from "./page.js";
import { profiles, times } from "./times.js";
import { trajectory } from "./trajectory.js";

const kSeries = 4;  // colours
const kOpenRows = 40;  // of a table; more are folded up

function head(main, figures) {
  const complete = figures.experiments.reduce((count, one) => count + one.runs, 0);
  const left_out = figures.experiments.reduce((count, one) => count + one.left_out.length, 0);
  const settings = figures.experiments.reduce((count, one) => count + one.settings, 0);
  const names = figures.groups.length && figures.groups.length <= 6
    ? figures.groups.map((g) => g.name).join(", ") : plural(settings, "setting");
  const scenarios = [...new Set(figures.groups.map((g) => g.scenario).filter((name) => name))];
  main.append("h1").text(scenarios.length ? `${scenarios.join(", ")}: BARAKA report` : "BARAKA report");
  main.append("p").attr("class", "lead").text(`${plural(complete, "complete run")} of ${names}`
    + `${left_out ? `; ${left_out} left out` : ""}. `
    + (figures.paper ? "The paper: T. H. Labella, I. Dietrich, F. Dressler, “Hybrid simulation of Sensor and Actor "
    + "Networks with BARAKA”, 2009." : ""));
  for (const g of figures.groups.filter((one) => one.full_name)) {
    main.append("p").attr("class", "caption").text(`${g.name}: ${g.full_name}.`);
  }
  for (const g of figures.groups.filter((one) => one.not_the_papers)) {
    main.append("p").attr("class", "caption").text(
      `${g.name}: not the paper's case study: ${g.not_the_papers}.`);
  }
}

function comparison(figures) {
  const { paper } = figures;
  const part = section("comparison", paper ? "The paper's figures beside ours" : "Figures",
    "Pooled over the runs of the same settings but for the seed. Quartiles are of type 7; delays are of messages to "
    + "one agent, waiting for a route included" + (paper ? "; replica score: mean |ln(ours / paper's)| of the six "
    + `quartiles, 0 is equal. Marked: more than a factor of two off. ${paper.basis}` : "."), "wide");
  const of_paper = (...texts) => (paper ? texts : []);
  const columns = ["figure", ...of_paper("paper", "basis"), ...figures.groups.map((g) => g.name)];
  const rows = figures.comparison.map((row) => [row.figure, ...of_paper(row.paper, row.basis), ...row.ours]);
  const element = table(part.panels, columns, rows, ["", ...of_paper("paper", "paper basis")]);
  const first = columns.length - figures.groups.length;
  element.selectAll("tbody tr").each((_, i, all) => select(all[i]).selectAll("td")
    .classed("far-off", (__, column) => column >= first && figures.comparison[i].far_off[column - first]));
  if (paper) part.panels.append("p").attr("class", "caption no-tail").text(paper.no_tail);
  download(part.downloads, "comparison.csv", columns, rows);
  return part.element;
}

/** What the runs recorded by themselves: values and states of their controllers, observables. */
function recorded(groups) {
  const part = section("recorded", "Recorded", "Over the runs of one setting: values that controllers recorded, states "
    + "that they named, and observables that the scenario asked for.", "wide");
  for (const group of groups) {
    for (const one of group.recorded) {
      const [columns, ...rows] = one.rows;
      const list = panel(part.panels, group.series, group.name, one.title).element.append("details")
        .attr("open", rows.length <= kOpenRows ? "" : null);
      list.append("summary").text(plural(rows.length, "row"));
      table(list, columns, rows);
      download(part.downloads, `${group.name} ${one.file}.csv`, columns, rows);
    }
  }
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
  const fig = (number, title) => (figures.paper ? `Fig. ${number} · ${title}` : title);
  figures.groups.forEach((group, i) => { group.series = i % kSeries; });
  head(main, figures);
  const groups = figures.groups.filter((g) => g.runs.length);
  const parts = figures.experiments.map((one, i) => experiment(one, i)).filter((part) => part);
  const having = groups.filter((g) => g.recorded.length);
  if (having.length && !figures.paper) parts.unshift(recorded(having));
  if (figures.groups.length) parts.push(comparison(figures));
  if (having.length && figures.paper) parts.push(recorded(having));
  if (figures.groups.length > 1) parts.push(differences(figures));
  // Each figure shows the groups that have something to show, or is left out.
  const add = (plot, is_there) => {
    const shown = groups.filter(is_there);
    if (shown.length) parts.push(plot(shown));
  };
  if (groups.length > 1) parts.push(profiles(groups, figures));
  add((shown) => network(shown, fig(2, "Network")), (g) => g.nodes.length);
  add((shown) => trajectory(shown, fig(11, "Trajectory")), (g) => g.runs.some((run) => run.robots.length));
  add((shown) => packets(shown, figures.paper, fig(12, "Packets received by each node")),
    (g) => g.is_the_papers || g.nodes.some((n) => !n.robot && n.packets));
  add(losses, (g) => g.verdicts.some((row) => row.addressed && row.count));
  add(air, (g) => g.air.kinds.length);
  add(relays, (g) => g.relays.length);
  add(queues, (g) => g.queues.length);
  add((shown) => times("discovery", fig(13, "Time to discover a route"), "time to discover a route",
    "Searches that found a route.", shown, figures), (g) => g.discovery.quantiles);
  add((shown) => times("delay", fig(14, "End-to-end delay"), "end-to-end delay",
    "Messages to one agent that arrived, waiting for a route included.", shown, figures),
  (g) => g.delay.quantiles);
  if (groups.length) parts.push(runs(groups));
  for (const part of parts) main.append(() => part.node());
  document.documentElement.dataset.drawn = parts.length;
}

draw(JSON.parse(document.getElementById("figures").textContent));
