// The bodies and the network: one pane per run, side by side on one clock, under one camera.
import { createPane } from "./pane.js";
import { switches } from "./switches.js";

export function world(element, store, source) {
  const panes = source.runs.map((run) => createPane(element, run, store));
  const buttons = switches(panes[0].element, store);
  const paneOf = (run) => panes[source.runs.findIndex(({ index }) => index === run)] ?? panes[0];
  return {
    draw(now) {
      for (const pane of panes) pane.draw(store.state, now);
      buttons.draw(store.state);
    },
    recolour() { for (const pane of panes) pane.recolour(); },
    /** Where a place on the ground is in the page [px]. */
    project: (x, y, run) => paneOf(run).project(x, y),
    /** Where sensors of ranges have hit something: {agent, channel, x, y}. */
    hits: (run) => paneOf(run).hits(),
    /** The arrows of the chosen route: {from, to, width [px], probability}. */
    arrows: (run) => paneOf(run).arrows(),
    /** The hops of the followed message, as at.js has them. */
    hops() {
      for (const pane of panes) {
        const found = pane.followed();
        if (found) return found.hops;
      }
      return [];
    },
    /** Of a link's frames lately: [came, lost]; null: no such link. */
    quality: (run, a, b) => paneOf(run).quality(a, b),
  };
}
