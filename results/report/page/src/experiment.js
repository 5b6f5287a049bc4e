// The experiment: what was varied, and each plot that was asked for. The drawings come ready made.
import { download, plural, section, table } from "./page.js";

function add_plot(part, plot) {
  const element = part.panels.append("div").attr("class", "panel plot").attr("data-plot", plot.name);
  if (plot.svg) {
    const drawing = element.append("div").attr("class", "drawing").html(plot.svg).select("svg");
    drawing.attr("width", null).attr("height", null);
  }
  const [columns, ...rows] = plot.rows;
  const list = element.append("details").attr("open", plot.svg ? null : "");
  list.append("summary").text(plot.svg ? "as a table" : plot.title);
  table(list, columns, rows);
  for (const note of plot.notes) element.append("p").attr("class", "caption note").text(note);
  download(part.downloads, `${plot.name}.csv`, columns, rows);
  if (!plot.svg) return;
  part.downloads.append("a").attr("download", `${plot.name}.svg`)
    .attr("href", `data:image/svg+xml;charset=utf-8,${encodeURIComponent(plot.svg)}`).text(`${plot.name}.svg`);
}

/** Nothing where there is nothing to show. */
export function experiment(figures, number) {
  if (!figures.plots.length) return null;
  const varied = figures.factors.length ? ` of ${figures.factors.join(", ")}` : "";
  const part = section(`experiment-${number}`, "Experiment", `${plural(figures.settings, "setting")}${varied}, `
    + `${plural(figures.runs, "run")}. Marks and lines are means over the runs of one setting, bars and bands their `
    + "95 % intervals; runs of different settings are never pooled."
    + (figures.left_out.length ? ` Left out: ${figures.left_out.join("; ")}.` : ""), "experiment");
  figures.plots.forEach((plot) => add_plot(part, plot));
  return part.element;
}
