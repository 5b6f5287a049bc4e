// The panel of what is chosen, beside what the run is and what was not recorded of it.
import { showAgent } from "./agent.js";
import { showFrame } from "./frame.js";
import { showLink } from "./link.js";
import { isPresent } from "../live.js";
import { livePanel } from "./live_panel.js";
import { showMessage } from "./message.js";
import { facts, link, list, made, part } from "./parts.js";
import { seriesName } from "../time/lane_list.js";
import { exact } from "../time/scale.js";

const shows = { agent: showAgent, frame: showFrame, message: showMessage, link: showLink };
const least = 120; //  ms between two pictures of the panel

function showRun(parent, run, store, source) {
  const { world } = run;
  const { state } = store;
  const head = part(parent);
  head.appendChild(made("h2", world.name ?? run.name));
  facts(head, [["result", state.live?.gone && world.result === "running" ? "not known" : world.result], ["radio", world.profile], ["seed", world.seed], ["fingerprint", world.fingerprint], ["simulated", run.end > 0 ? `${exact(run.end)} s` : null]]);
  for (const warning of world.warnings ?? []) head.appendChild(made("p", warning, { className: "refused" }));
  if (world.series?.length) {
    const select = part(parent, "chart lanes").appendChild(document.createElement("select"));
    select.setAttribute("aria-label", "add a chart lane");
    select.appendChild(made("option", "add …", { value: "" }));
    for (const series of world.series) select.appendChild(made("option", seriesName(world, series), { value: series.index }));
    select.addEventListener("change", () => { if (select.value !== "") store.set({ charts: [...new Set([...store.state.charts, Number(select.value)])] }); });
    const shown = store.state.charts.map((index) => world.series.find((one) => one.index === index)).filter(Boolean);
    facts(select.parentElement, shown.map((series) => [seriesName(world, series),
      link("remove", () => store.set({ charts: store.state.charts.filter((one) => one !== series.index) }))])).classList.add("charts");
  }
  if (world.missing?.length) list(part(parent, "not recorded"), ["what", "key that records it"], world.missing.map(({ what, line }) => [what, line])).classList.add("words");
  list(part(parent, "agents"), ["name", "kind", "controller"], world.agents.slice(0, 200).map((one) => [one.name, one.kind, one.program]),
    (i) => store.set({ chosen: { kind: "agent", run: run.index, agent: world.agents[i].agent } }));
  if (source.runs.length > 1) {
    list(part(parent, "runs"), ["name"], source.runs.map(({ name }) => [name]), (i) => store.set({ run: source.runs[i].index }));
  }
}

export function inspector(element, store, source) {
  const panel = livePanel(element.appendChild(document.createElement("div")), store, source);
  const body = element.appendChild(document.createElement("div"));
  let shown = null;
  let shownLive = null;
  let at = -Infinity;
  let stale = false;
  let late = false;
  return {
    /** Something is still to be drawn, though nobody uses the panel. */
    get isLate() { return late; },
    // What came too soon after the last picture is drawn a little later.
    animates: (now) => stale && now - at >= least,
    draw(now) {
      const { state } = store;
      // The run is the same at all times.
      const key = [state.chosen ? state.t : null, state.chosen, state.run, state.charts, state.follow, state.followed, state.chosen || state.live ? source.arrivals : null, source.end, state.live?.gone];
      const same = shown && key.every((value, i) => value === shown[i]);
      // Nothing is redrawn under a finger or a cursor that uses it.
      const isUsed = element.contains(document.activeElement) && /^(INPUT|SELECT)$/.test(document.activeElement.tagName);
      stale = !same && (now - at < least || isUsed);
      late = stale && !isUsed;
      const run = source.runs.find(({ index }) => index === (state.chosen?.run ?? state.run)) ?? source.runs[0];
      const liveKey = state.live && JSON.stringify([state.live.can_hold, state.live.paused, state.live.ended, state.live.gone, state.live.stoppedBy, state.live.said, state.live.breaks, state.chosen, isPresent(store, source)]);
      if (liveKey !== shownLive && !isUsed) {
        shownLive = liveKey;
        panel.draw(run);
      }
      if (same || stale) return;
      shown = key;
      at = now;
      const next = document.createElement("div");
      const open = body.querySelector("details")?.open;
      if (state.chosen) {
        next.appendChild(link("‹ the run", () => store.set({ chosen: null })));
        shows[state.chosen.kind](next, run, store);
      } else showRun(next, run, store, source);
      const details = next.querySelector("details");
      if (details && open) details.open = true;
      body.replaceChildren(next);
    },
  };
}
