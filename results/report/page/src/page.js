// Sections, panels and tables of the page, and the files behind its plots.
import { create } from "d3-selection";

export const thousands = (value) => value.toLocaleString("en");
export const plural = (count, noun) => `${thousands(count)} ${noun}${count === 1 ? "" : "s"}`;

/** A section with a title, a place for panels, a caption and links to its files. */
export function section(id, title, caption, layout = "") {
  const element = create("section").attr("id", id);
  element.append("h2").text(title);
  const panels = element.append("div").attr("class", `panels ${layout}`);
  element.append("p").attr("class", "caption").text(caption);
  const downloads = element.append("p").attr("class", "downloads").text("Data: ");
  return { element, panels, downloads };
}

/** A panel of one group, in its colour. */
export function panel(panels, series, title, note) {
  const element = panels.append("div").attr("class", `panel series-${series}`);
  const head = element.append("h3");
  head.append("span").text(title);
  head.append("small").text(note);
  return { element, head };
}

const cell = (value) => {
  const text = String(value);
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};

/** A link that saves rows as comma-separated values: the file is in the link itself. */
export function download(downloads, name, columns, rows) {
  const text = [columns, ...rows].map((row) => row.map(cell).join(",")).join("\n") + "\n";
  downloads.append("a").attr("download", name).attr("data-rows", rows.length)
    .attr("href", `data:text/csv;charset=utf-8,${encodeURIComponent(text)}`).text(name);
}

/** @param kinds  class of each column */
export function table(parent, columns, rows, kinds = []) {
  const element = parent.append("div").attr("class", "scroll").append("table");
  element.append("thead").append("tr").selectAll("th").data(columns).join("th")
    .attr("class", (_, i) => kinds[i] ?? null).text((text) => text);
  element.append("tbody").selectAll("tr").data(rows).join("tr")
    .selectAll("td").data((row) => row).join("td")
    .attr("class", (_, i) => kinds[i] ?? null).text((text) => text);
  return element;
}
