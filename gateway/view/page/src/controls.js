// Play, speed, steps, and what time it is. In a live run that waits for us, the same buttons command it.
import { isLed, stepLive, togglePause, useSpeed } from "./live.js";
import { stepTime } from "./steps.js";
import { exact, span, zoomed } from "./time/scale.js";

export const speeds = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 1, 2, 5, 10, 20, 50, 100];
const nearest = (speed) => speeds.reduce((best, one, i) => (Math.abs(Math.log(one / speed)) < Math.abs(Math.log(speeds[best] / speed)) ? i : best), 0);
/** "5 ms/s" */
export const speedText = (speed) => (speed >= 1 ? `${speed}×` : `${span(speed * 1e9)}/s`);

/** What buttons and keys do. */
export function actions(store, source) {
  const run = () => source.runs.find(({ index }) => index === store.state.run) ?? source.runs[0];
  const view = () => store.state.view ?? [0, source.end];
  const at = (t) => {
    const [from, to] = view();
    const patch = { t: Math.round(Math.min(Math.max(0, t), source.end)), playing: false };
    if (store.state.view && (patch.t < from || patch.t > to)) {
      const half = (to - from) / 2;
      patch.view = [patch.t - half, patch.t + half];
    }
    store.set(patch);
  };
  return {
    at,
    async play() {
      if (isLed(store)) { await togglePause(store); return; }
      const { t, playing } = store.state;
      store.set({ playing: !playing, t: !playing && t >= source.end ? 0 : t });
    },
    async step(of, way) {
      const chosen = store.state.chosen?.kind === "agent" ? store.state.chosen.agent : null;
      const isAtEnd = store.state.t >= run().end - 1;
      if (isLed(store) && way > 0 && isAtEnd) { await stepLive(store, of, of === "event" ? chosen : null); return; }
      const t = await stepTime(source, run(), of, store.state.t, way, of === "event" ? chosen : null);
      if (t !== null) at(t);
    },
    faster(by) {
      const speed = speeds[Math.min(speeds.length - 1, Math.max(0, nearest(store.state.speed) + by))];
      store.set({ speed });
      if (isLed(store)) useSpeed(store, speed);
    },
    speed(index) {
      store.set({ speed: speeds[index] });
      if (isLed(store)) useSpeed(store, speeds[index]);
    },
    zoom: (factor) => store.set({ view: zoomed(view(), store.state.t, factor, source.end) }),
    all: () => store.set({ view: null }),
    /** The axis so close that a frame of a millisecond is wide. */
    close: () => store.set({ view: [store.state.t - 4e6, store.state.t + 4e6] }),
    theme() {
      const isDark = store.state.theme ? store.state.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
      store.set({ theme: isDark ? "light" : "dark" });
    },
    follow() {
      const { chosen, follow } = store.state;
      store.set({ follow: follow === null && chosen?.kind === "agent" ? chosen.agent : null });
    },
  };
}

const button = (label, title, action, parent) => {
  const one = parent.appendChild(document.createElement("button"));
  one.textContent = label;
  one.title = title;
  one.setAttribute("aria-label", title);
  one.addEventListener("click", () => { action(); one.blur(); });
  return one;
};

export function controls(element, store, source) {
  const act = actions(store, source);
  const group = () => element.appendChild(Object.assign(document.createElement("span"), { className: "group" }));
  const first = group();
  button("|◀", "to the begin (Home)", () => act.at(0), first);
  const play = button("▶", "play or pause (space)", act.play, first);
  button("▶|", "to the end (End)", () => act.at(source.end), first);
  const steps = group();
  for (const [of, key] of [["event", "e"], ["cycle", "c"], ["frame", "f"]]) {
    button("‹", `the ${of} before (Shift+${key})`, () => act.step(of, -1), steps);
    steps.appendChild(Object.assign(document.createElement("small"), { textContent: of }));
    button("›", `the next ${of} (${key})`, () => act.step(of, 1), steps);
  }
  const pace = group();
  const slider = pace.appendChild(Object.assign(document.createElement("input"),
    { type: "range", min: 0, max: speeds.length - 1, step: 1, title: "speed ([ and ])" }));
  slider.setAttribute("aria-label", "speed");
  slider.addEventListener("input", () => act.speed(Number(slider.value)));
  const speed = pace.appendChild(document.createElement("small"));
  const zoom = group();
  button("−", "zoom out (-)", () => act.zoom(2), zoom);
  button("+", "zoom in (+)", () => act.zoom(0.5), zoom);
  button("all", "the whole run (a)", act.all, zoom);
  button("µs", "close to this instant (u)", act.close, zoom);
  const clock = element.appendChild(document.createElement("output"));
  clock.className = "clock";
  const help = button("?", "keys (?)", () => store.set({ help: !store.state.help }), element);

  return {
    draw() {
      const { state } = store;
      const isOn = isLed(store) ? !state.live.paused : state.playing;
      play.textContent = isOn ? "❚❚" : "▶";
      play.setAttribute("aria-pressed", String(isOn));
      slider.value = nearest(state.speed);
      speed.textContent = speedText(state.speed);
      clock.textContent = `${exact(state.t)} s`;
      help.setAttribute("aria-pressed", String(state.help));
    },
  };
}
