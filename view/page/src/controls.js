// Play, speed, steps, and what time it is. In a live run that waits for us, the same buttons command it.
import { leads, stepLive, togglePause, useSpeed } from "./live.js";
import { stepTime } from "./steps.js";
import { exact, span, timeOf, zoomed } from "./time/scale.js";
import { bookmark } from "./store.js";

export const speeds = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 1, 2, 5, 10, 20, 50, 100];
const fastest = 1e4; //  simulated s per s beyond which a live run is said to go as fast as it can
const nearest = (speed) => speeds.reduce((best, one, i) => (Math.abs(Math.log(one / speed)) < Math.abs(Math.log(speeds[best] / speed)) ? i : best), 0);
// Drawn, not written: not every system's fonts have these signs.
const icons = {
  begin: "M3 3h2v10H3zM13 3v10L6 8z", play: "M4 2.5v11L13 8z", pause: "M4 3h3v10H4zM9 3h3v10H9z", end: "M11 3h2v10h-2zM3 3v10l7-5z",
};
const icon = (name) => `<svg viewBox="0 0 16 16" width="14" height="14" aria-hidden="true"><path fill="currentColor" d="${icons[name]}"/></svg>`;

/** "5 ms/s" */
export const speedText = (speed) => (speed >= 1 ? `${speed}×` : `${span(speed * 1e9)}/s`);

/** The place of the speed among speeds; of a live run that goes as fast as it can, behind them. */
function speedIndex(store, source) {
  const { speed, live } = store.state;
  if (!leads(store, source)) return nearest(speed);
  return live.speed > 0 && live.speed <= fastest ? nearest(live.speed) : speeds.length;
}

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
  const act = {
    at,
    async play() {
      if (leads(store, source)) { await togglePause(store); return; }
      const { t, playing } = store.state;
      store.set({ playing: !playing, t: !playing && t >= source.end ? 0 : t });
    },
    async step(of, way) {
      const chosen = store.state.chosen?.kind === "agent" ? store.state.chosen.agent : null;
      if (leads(store, source) && way > 0) { await stepLive(store, of, of === "event" ? chosen : null); return; }
      const t = await stepTime(source, run(), of, store.state.t, way, of === "event" ? chosen : null);
      if (t !== null) at(t);
    },
    faster(by) { act.speed(Math.max(0, speedIndex(store, source) + by)); },
    /** @param index  into speeds; behind them, in a live run: as fast as it can */
    speed(index) {
      if (leads(store, source)) useSpeed(store, speeds[index] ?? 0);
      else store.set({ speed: speeds[Math.min(index, speeds.length - 1)] });
    },
    /** An address that shows what is shown now. */
    async link() {
      const address = `${location.href.split("#")[0]}#${bookmark(store.state)}`;
      await navigator.clipboard.writeText(address);
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
  return act;
}

const button = (label, title, action, parent) => {
  const one = parent.appendChild(document.createElement("button"));
  if (label.startsWith("<svg")) one.innerHTML = label; else one.textContent = label;
  one.title = title;
  one.setAttribute("aria-label", title);
  // After a click the keys are the page's again; who came by the keyboard stays where they are.
  one.addEventListener("click", (event) => { action(); if (event.detail) one.blur(); });
  return one;
};

/** The time to the nanosecond; written over, it is gone to. */
function clockField(element, store, act) {
  const field = element.appendChild(Object.assign(document.createElement("input"),
    { className: "clock", spellcheck: false, autocomplete: "off", title: "go to a time (g): 12.5, 300 ms, +20 us" }));
  field.setAttribute("aria-label", "time; type one to go there");
  field.addEventListener("focus", () => field.select());
  field.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== "Escape") return;
    const t = event.key === "Enter" ? timeOf(field.value, store.state.t) : null;
    field.blur();
    if (t !== null) act.at(t);
    else field.value = `${exact(store.state.t)} s`;
  });
  return field;
}

export function controls(element, store, source) {
  const act = actions(store, source);
  const group = () => element.appendChild(Object.assign(document.createElement("span"), { className: "group" }));
  const first = group();
  button(icon("begin"), "to the start (Home)", () => act.at(0), first);
  const play = button(icon("play"), "play or pause (space)", act.play, first);
  button(icon("end"), "to the end (End)", () => act.at(source.end), first);
  const steps = group();
  for (const [of, key] of [["event", "e"], ["cycle", "c"], ["frame", "f"]]) {
    button("‹", `previous ${of} (Shift+${key})`, () => act.step(of, -1), steps);
    steps.appendChild(Object.assign(document.createElement("small"), { textContent: of }));
    button("›", `next ${of} (${key})`, () => act.step(of, 1), steps);
  }
  const pace = group();
  const slider = pace.appendChild(Object.assign(document.createElement("input"),
    { type: "range", min: 0, max: speeds.length - (source.view.mode === "live" ? 0 : 1), step: 1, title: "speed ([ and ])" }));
  slider.setAttribute("aria-label", "speed");
  slider.addEventListener("input", () => act.speed(Number(slider.value)));
  const speed = pace.appendChild(document.createElement("small"));
  const zoom = group();
  button("−", "zoom out (-)", () => act.zoom(2), zoom);
  button("+", "zoom in (+)", () => act.zoom(0.5), zoom);
  button("all", "the whole run on the axis (a)", act.all, zoom);
  button("µs", "zoom in on this instant (u)", act.close, zoom);
  const clock = clockField(element, store, act);
  const copy = button("copy URL", "copy the address of this view (l)", async () => {
    try { await act.link(); copy.textContent = "copied"; } catch { copy.textContent = "it is in the address bar"; }
    setTimeout(() => { copy.textContent = "copy URL"; }, 1500);
  }, element);
  copy.className = "copy"; //  the key l presses it too
  const help = button("?", "keys (?)", () => store.set({ help: !store.state.help }), element);

  return {
    draw() {
      const { state } = store;
      const isOn = leads(store, source) ? !state.live.paused : state.playing;
      if (play.getAttribute("aria-pressed") !== String(isOn)) {
        play.innerHTML = icon(isOn ? "pause" : "play");
        play.setAttribute("aria-pressed", String(isOn));
      }
      const index = speedIndex(store, source);
      slider.value = index;
      speed.textContent = index < speeds.length ? speedText(leads(store, source) ? state.live.speed : state.speed) : "full";
      if (clock !== document.activeElement) clock.value = `${exact(state.t)} s`;
      help.setAttribute("aria-pressed", String(state.help));
    },
  };
}
