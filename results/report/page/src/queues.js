// What access points passed on, by destination, and the queues of agents with one for each receiver.
import { sum } from "d3-array";
import { download, panel, plural, section, table, thousands } from "./page.js";
import { duration } from "./times.js";

const kVerdicts = ["delivered", "transmitted", "over the wire", "queue full", "retry limit", "no route", "expired",
  "queue delay", "radio off", "waiting"];

const came = (one) => sum(Object.values(one.verdicts));

export function relays(groups) {
  const part = section("relays", "What access points passed on", "Data frames of stations that came to an access point "
    + "to be passed on, and how they ended there; retries are not counted. Over the wire: to another access point, which "
    + "counts them again. Most: the frames to one destination that waited at once.", "wide");
  for (const group of groups) {
    const seen = kVerdicts.filter((verdict) => group.relays.some((one) => one.verdicts[verdict]));
    const { element } = panel(part.panels, group.series, group.name, plural(sum(group.relays, came), "frame"));
    table(element, ["access point", "to", "came", ...seen, "most", "mean wait"], group.relays.map((one) => [one.access_point,
      one.destination, thousands(came(one)), ...seen.map((verdict) => thousands(one.verdicts[verdict] ?? 0)),
      thousands(one.most), one.queued ? duration(one.waited_ns * 1e-9 / one.queued) : "–"]));
  }
  download(part.downloads, "relays.csv", ["profile", "access_point", "destination", ...kVerdicts, "queued", "most",
    "waited_ns"], groups.flatMap((g) => g.relays.map((one) => [g.name, one.access_point, one.destination,
    ...kVerdicts.map((verdict) => one.verdicts[verdict] ?? 0), one.queued, one.most, one.waited_ns])));
  return part.element;
}

const kDrops = ["queue full", "queue delay", "expired", "radio off"];
const kFoldedRows = 40;

const waited = (one) => (one.frames ? duration(one.waited_ns * 1e-9 / one.frames) : "–");

export function queues(groups) {
  const part = section("queues", "Queues for receivers and access categories", "Data frames that agents queued, by the next "
    + "receiver and the access category; everyone: group frames or, of an agent that sends through an access point, all. "
    + "Most: the frames and the bytes of payload that waited at once. Dropped: refused, or taken out of the queue.", "wide");
  for (const group of groups) {
    const seen = kDrops.filter((verdict) => group.queues.some((one) => one.drops[verdict]));
    const { element } = panel(part.panels, group.series, group.name, plural(sum(group.queues, (one) => one.frames), "frame"));
    const list = element.append("details").attr("open", group.queues.length <= kFoldedRows ? "" : null);
    list.append("summary").text(plural(group.queues.length, "queue"));
    table(list, ["agent", "to", "category", "frames", "mean wait", "most", "most bytes", "waiting", ...seen],
      group.queues.map((one) => [one.agent, one.receiver, one.category, thousands(one.frames), waited(one), thousands(one.most),
        thousands(one.most_bytes), thousands(one.waiting), ...seen.map((verdict) => thousands(one.drops[verdict] ?? 0))]));
  }
  download(part.downloads, "queues.csv", ["profile", "agent", "receiver", "category", "frames", "waiting", "most", "most_bytes",
    "waited_ns", ...kDrops], groups.flatMap((g) => g.queues.map((one) => [g.name, one.agent, one.receiver, one.category,
    one.frames, one.waiting, one.most, one.most_bytes, one.waited_ns, ...kDrops.map((verdict) => one.drops[verdict] ?? 0)])));
  return part.element;
}
