// Figs. 13 and 14: how long it took to find a route, and to deliver a message.
import { axisBottom, axisLeft } from "d3-axis";
import { max, sum } from "d3-array";
import { scaleLinear, scaleLog } from "d3-scale";
import { create } from "d3-selection";
import { download, panel, plural, section, table, thousands } from "./page.js";

const kWidth = 1100;  // px of the view box
const kMargin = { right: 70, bottom: 42 };
const kBeside = 46;  // px from the middle of the column for zeros to the axis beside it
const kRow = 22;   // px, of a box plot
const kQuantiles = ["min", "q1", "median", "q3", "max"];

export function duration(seconds) {
  if (seconds === 0) return "0";
  const [value, unit] = seconds < 1 ? [seconds * 1e3, "ms"] : [seconds, "s"];
  return `${Number(value.toPrecision(4))} ${unit}`;
}

/** An empty plot with a logarithmic axis of times, and a place for zeros beside it.
 *  @param zero  px, middle of that place */
function time_plot(parent, label, height, histogram, zero) {
  const left = zero + kBeside;
  const total = height + kMargin.bottom;
  const svg = parent.append(() => create("svg").node())
    .attr("viewBox", `0 0 ${kWidth} ${total}`).attr("role", "img").attr("aria-label", label);
  const x = scaleLog([histogram.low_s, histogram.high_s], [left, kWidth - kMargin.right]);
  const decades = [1e-4, 1e-3, 1e-2, 1e-1, 1, 10, 100];
  const axis = svg.append("g").attr("transform", `translate(0,${height})`);
  axis.call(axisBottom(x).tickValues(x.ticks()).tickSize(4).tickSizeOuter(0).tickFormat(""));
  axis.append("g").call(axisBottom(x).tickValues(decades).tickSize(8).tickSizeOuter(0).tickFormat(duration));
  axis.append("line").attr("stroke", "currentColor").attr("class", "whisker")
    .attr("x1", zero - 11).attr("x2", zero + 11);
  axis.append("text").attr("class", "muted").attr("text-anchor", "middle").attr("x", zero)
    .attr("y", 19).text("0");
  svg.append("text").attr("class", "muted").attr("text-anchor", "middle")
    .attr("x", (left + kWidth - kMargin.right) / 2).attr("y", total - 4).text(label);
  const place = (time) => (time <= 0 ? zero
    : Math.min(Math.max(x(time), left - 12), kWidth - kMargin.right + 12));
  return { svg, axis, x, place, zero, left };
}

/** Minimum, quartiles, maximum as a box with whiskers. */
function draw_box(on, y, name, series, quantiles) {
  const row = on.svg.append("g").attr("class", `box-row series-${series}`)
    .attr("color", "var(--series)");
  row.append("text").attr("class", "muted").attr("text-anchor", "end").attr("x", on.zero - 20)
    .attr("y", y + 4).text(name);
  if (!quantiles) return;
  const [least, q1, median, q3, most] = kQuantiles.map((key) => on.place(quantiles[key]));
  const bar = (from, to, kind) => row.append("line").attr("class", kind)
    .attr("x1", from).attr("x2", to);
  bar(least, q1, "whisker").attr("y1", y).attr("y2", y);
  bar(q3, most, "whisker").attr("y1", y).attr("y2", y);
  for (const end of [least, most]) bar(end, end, "whisker").attr("y1", y - 4).attr("y2", y + 4);
  row.append("rect").attr("class", "box").attr("x", q1).attr("y", y - 7)
    .attr("width", Math.max(1, q3 - q1)).attr("height", 14);
  bar(median, median, "median").attr("y1", y - 7).attr("y2", y + 7);
  row.append("title").text(`${name}: ${kQuantiles.map((k) => `${k} ${duration(quantiles[k])}`).join(", ")}`);
}

/** The columns of a histogram: [left, right, count, title, kind]. */
function columns(on, times, histogram) {
  const ratio = histogram.high_s / histogram.low_s;
  const edge = (i) => histogram.low_s * ratio ** (i / times.bins.length);
  const bars = times.bins.map((count, i) => [on.x(edge(i)) + 0.5, on.x(edge(i + 1)) - 0.5, count,
    `${duration(edge(i))} to ${duration(edge(i + 1))}`, "inside"]);
  const right = kWidth - kMargin.right;
  bars.push([on.zero - 9, on.zero + 9, times.zeros, "0", "beside"],
    [on.left - 18, on.left - 2, times.below, "below 0.1 ms", "beside"],
    [right + 2, right + 18, times.above, "above 100 s", "beside"]);
  return bars.filter(([, , count]) => count > 0);
}

function draw_histogram(parent, name, group, times, theirs, histogram) {
  const top = 2 * kRow + 14;
  const height = top + 190;
  const on = time_plot(parent, name, height, histogram, 88);
  const bars = columns(on, times, histogram);
  const y = scaleLinear([0, max(bars, (b) => b[2]) || 1], [height, top + 8]).nice(4);
  on.svg.append("g").attr("transform", `translate(${on.zero - 20},0)`)
    .call(axisLeft(y).ticks(4).tickSizeOuter(0).tickFormat((v) => (Number.isInteger(v) ? thousands(v) : "")));
  on.svg.append("text").attr("class", "muted").attr("text-anchor", "middle")
    .attr("transform", `translate(13,${(height + top) / 2}) rotate(-90)`).text("count");
  on.svg.selectAll(".bar").data(bars).join("rect").attr("class", (b) => `bar ${b[4]}`)
    .attr("data-count", (b) => b[2]).attr("x", (b) => b[0]).attr("width", (b) => b[1] - b[0])
    .attr("y", (b) => y(b[2])).attr("height", (b) => height - y(b[2]))
    .append("title").text((b) => `${b[3]}: ${thousands(b[2])}`);
  for (const [shown, at, text] of [[times.below, on.left - 10, "<"],
    [times.above, kWidth - kMargin.right + 10, ">"]]) {
    if (shown) on.axis.append("text").attr("class", "muted").attr("text-anchor", "middle")
      .attr("x", at).attr("y", 19).text(text);
  }
  for (const key of times.quantiles ? ["q1", "median", "q3"] : []) {
    const at = on.place(times.quantiles[key]);
    on.svg.append("line").attr("class", "quartile").attr("x1", at).attr("x2", at)
      .attr("y1", top).attr("y2", height);
  }
  on.svg.selectAll(".outside").data(bars.filter((b) => b[4] === "beside")).join("text")
    .attr("class", "halo outside").attr("text-anchor", "middle").attr("x", (b) => (b[0] + b[1]) / 2)
    .attr("y", (b) => y(b[2]) - 4).text((b) => thousands(b[2]));
  draw_box(on, 12, "ours", group.series, times.quantiles);
  if (theirs) draw_box(on, 12 + kRow, "paper", "paper", theirs);
}

function quantile_rows(name, quantiles, count, zeros) {
  return [name, count, ...kQuantiles.map((key) => (quantiles ? duration(quantiles[key]) : "–")), zeros];
}

const kColumns = ["", "times", "minimum", "quartile 1", "median", "quartile 3", "maximum", "zeros"];

function files(part, key, groups, histogram) {
  download(part.downloads, `${key}.csv`, ["profile", "run", "seed", "time_ns"],
    groups.flatMap((g) => g[key].runs_ns.flatMap((times, i) =>
      times.map((ns) => [g.name, g.runs[i].folder, g.runs[i].seed, ns]))));
  const ratio = histogram.high_s / histogram.low_s;
  const edge = (i, n) => (histogram.low_s * ratio ** (i / n)).toPrecision(6);
  download(part.downloads, `${key}_bins.csv`, ["profile", "from_s", "to_s", "count"],
    groups.flatMap((g) => [[g.name, 0, 0, g[key].zeros], [g.name, 0, histogram.low_s, g[key].below],
      ...g[key].bins.map((count, i) =>
        [g.name, edge(i, g[key].bins.length), edge(i + 1, g[key].bins.length), count]),
      [g.name, histogram.high_s, "", g[key].above]]));
}

/** @param key  of the times in a group and in the paper's figures: discovery or delay */
export function times(key, title, label, caption, groups, figures) {
  const part = section(key, title, `${caption} Bins are equally wide on the logarithmic axis; dashed `
    + "lines and the box: our quartiles; whiskers: minimum and maximum" + (figures.paper ? "; grey: the paper's" : "")
    + ". Zeros have no place on such an axis and are counted beside it.", "wide");
  groups.forEach((group) => {
    const sample = group[key];
    const count = sum(sample.runs_ns, (run) => run.length);
    const { element } = panel(part.panels, group.series, group.name,
      `${plural(count, "time")} from ${plural(group.runs.length, "run")}`);
    const theirs = group.is_the_papers ? figures.paper?.[key] : null;
    draw_histogram(element, label, group, sample, theirs, figures.histogram);
    table(element, kColumns, [
      quantile_rows("ours", sample.quantiles, thousands(count), thousands(sample.zeros)),
      ...(theirs ? [quantile_rows("paper", theirs, "–", "–")] : [])]);
  });
  files(part, key, groups, figures.histogram);
  return part.element;
}

/** Box plots of all groups over one axis, the paper's first. */
export function profiles(groups, figures) {
  const part = section("profiles", "What the settings change", "Minimum, quartiles and maximum of "
    + "each column over one axis: what disappears when the radio is a disk or ideal.", "wide");
  for (const [key, label] of [["discovery", "time to discover a route"], ["delay", "end-to-end delay"]]) {
    const on = time_plot(part.panels.append("div").attr("class", "series-paper"), label,
      (groups.length + 1) * 28 + 10, figures.histogram, 24 + 7.5 * max(groups, (g) => g.name.length));
    const shown = [...(figures.paper ? [{ name: "paper", series: "paper", [key]: { quantiles: figures.paper[key] } }]
      : []), ...groups];
    shown.forEach((g, i) => draw_box(on, 18 + 28 * i, g.name, g.series, g[key].quantiles));
  }
  download(part.downloads, "quartiles.csv", ["what", "profile", ...kQuantiles.map((q) => `${q}_s`)],
    ["discovery", "delay"].flatMap((key) => [
      ...(figures.paper ? [{ name: "paper", [key]: { quantiles: figures.paper[key] } }] : []), ...groups].filter((g) => g[key].quantiles)
      .map((g) => [key, g.name, ...kQuantiles.map((q) => g[key].quantiles[q])])));
  return part.element;
}
