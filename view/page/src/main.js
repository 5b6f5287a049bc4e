// Wires the parts, and draws them when something changed.
import { forgetColours } from "./colours.js";
import { controls } from "./controls.js";
import { inspector } from "./inspector/inspector.js";
import { keys } from "./keys.js";
import { isLed, live, togglePause } from "./live.js";
import { hasGraphicsCard } from "./paper.js";
import { takeToken } from "./server.js";
import { openSource } from "./source.js";
import { bookmark, createStore, startOf, unmarked } from "./store.js";
import { lanes } from "./time/lanes.js";
import { world } from "./world/world.js";

const element = (id) => document.getElementById(id);
const say = (text) => { const notice = element("notice"); notice.textContent = text; notice.hidden = !text; };
element("notice").addEventListener("click", () => say(""));

async function main() {
  if (location.protocol !== "file:") takeToken();
  const store = createStore(startOf(location.hash));
  let dirty = true;
  const source = await openSource(() => { dirty = true; }, (error) => say(error.message));
  const most = Math.max(...source.runs.map((run) => run.world.agents.length));
  store.set({ ...unmarked(most), ...startOf(location.hash) });
  document.title = `${source.runs.map((run) => run.title).join(", ")} - BARAKA view`;

  const alive = live(store, source);
  const parts = [
    world(element("world"), store, source),
    lanes(element("lanes"), store, source),
    inspector(element("inspector"), store, source),
    controls(element("controls"), store, source),
    keys(store, source),
  ].filter(Boolean);

  const theme = () => {
    const chosen = store.state.theme;
    if (chosen) document.documentElement.dataset.theme = chosen; else delete document.documentElement.dataset.theme;
    forgetColours();
    for (const part of parts) part.recolour?.();
    dirty = true;
  };
  let eager = true; //    something else than the clock changed
  let ticking = false; // the clock is being moved by the loop below
  store.subscribe((state, patch) => {
    dirty = true;
    eager ||= !ticking;
    if ("theme" in patch) theme();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", theme);
  addEventListener("resize", () => { dirty = true; });
  new ResizeObserver(() => { dirty = true; }).observe(document.body);
  theme();

  // The address follows the state, but not sixty times a second: browsers refuse that.
  let written = location.hash;
  let writtenAt = 0;
  const write = (now) => {
    if (now - writtenAt < 400 || store.state.playing) return;
    const next = `#${bookmark(store.state)}`;
    if (next === written) return;
    written = next;
    writtenAt = now;
    history.replaceState(null, "", next);
  };
  addEventListener("hashchange", () => {
    if (location.hash === written) return;
    takeToken();
    written = location.hash;
    store.set({ ...unmarked(most), ...startOf(location.hash) });
  });

  let last = performance.now();
  let drawn = 0;
  let drawnAt = 0;
  let touched = false; //  by somebody, not by the run
  for (const kind of ["pointerdown", "pointermove", "wheel", "keydown"]) addEventListener(kind, () => { touched = true; }, { passive: true });
  const recent = []; //  when the last frames were drawn
  const afterDraw = [];

  // While time runs, what stands beside the world is drawn as often as it has time for, ten times a second at least.
  let besideAt = 0;
  let besideTakes = 0;
  const drawBeside = (now, playing) => {
    const pause = hasGraphicsCard() ? Math.min(100, 4 * besideTakes) : 100;
    if (playing && !eager && now - besideAt < pause) return;
    eager = false;
    besideAt = now;
    const began = performance.now();
    for (const part of parts.slice(1)) part.draw?.(now);
    besideTakes = performance.now() - began;
  };

  const frame = (now) => {
    requestAnimationFrame(frame);
    const { playing, speed, t } = store.state;
    if (playing) {
      // A tab that was hidden goes on where it was. What is live never runs ahead of its record.
      const next = Math.min(source.end, t + Math.min(now - last, 250) * 1e6 * speed);
      ticking = true;
      store.set({ t: next, playing: next < source.end || Boolean(store.state.live && !store.state.live.ended && !store.state.live.gone) });
      ticking = false;
      // What was looked back at has been played: the run itself goes on.
      if (next >= source.end && isLed(store)) {
        store.set({ playing: false });
        if (store.state.live.paused) togglePause(store);
      }
    }
    last = now;
    ticking = true;
    const moved = Boolean(alive.goAlong?.(now));
    ticking = false;
    write(now);
    const busy = parts.some((part) => part.animates?.(now));
    if (!dirty && !busy && !playing) return;
    // Where the processor draws, the run that is watched needs it more: twice a second will do.
    const { live: run } = store.state;
    const spares = run && !run.paused && !run.ended && !playing && !hasGraphicsCard();
    if (spares && !touched && now - drawnAt < 500) return;
    touched = false;
    drawnAt = now;
    dirty = false;
    parts[0].draw(now);
    drawBeside(now, playing || moved);
    if (now - recent[recent.length - 1] > 1000) recent.length = 0; //  nothing was to be drawn
    recent.push(now);
    if (recent.length > 120) recent.shift();
    drawn++;
    // What a run writes meanwhile is asked for again and again.
    if (source.asking === 0 || spares) {
      document.documentElement.dataset.drawn = String(drawn);
      const isWhole = !dirty && !parts.some((part) => part.isLate);
      if (isWhole || spares) for (const resolve of afterDraw.splice(0)) resolve();
    }
  };
  requestAnimationFrame(frame);

  const [view] = parts;
  globalThis.baraka = {
    store, source,
    project: (x, y, run = 0) => view.project(x, y, run),
    arrows: (run = store.state.run) => view.arrows(run),
    hops: () => view.hops(),
    seen: (run = store.state.run) => view.hits(run),
    idle: async () => {
      await source.idle();
      dirty = true;
      await new Promise((resolve) => afterDraw.push(resolve));
    },
    fps: () => (recent.length < 2 ? 0 : (recent.length - 1) * 1000 / (recent[recent.length - 1] - recent[0])),
  };
}

main().catch((error) => { say(`${error.message ?? error}`); throw error; });
