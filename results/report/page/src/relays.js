// What access points passed on, by destination.
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
