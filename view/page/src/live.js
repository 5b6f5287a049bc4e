// A run under way: what the server says of it, and, with the token of the printed address, commands to it.
import { ask, token } from "./server.js";

const often = 5000; //  ms between two looks at what a run has named
const soon = 300; //    ms, if the page has seen a state that it was not told of
const pause = 200; //   ms between an answer of the run's clock and the next question
const beat = 1000; //   ms between two words that the page is open
const silent = 3; //    of them without an answer: the server has ended
const slow = 20; //     simulated s per s up to which the page moves smoothly between two looks
const lag = 0.6; //     s that it is behind then, as the run shows its record twice a second

/** Whether the run cannot go on: it has ended, or its server has. */
const isOver = ({ live }) => Boolean(live?.ended || live?.gone);

/** Whether this page may hold and step the run. */
export const isLed = (store) => Boolean(store.state.live?.canCommand && store.state.live.can_hold !== false && !isOver(store.state));

async function command(store, body) {
  const response = await ask("/api/control", {
    method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body),
  });
  const answer = await response.json().catch(() => ({}));
  store.set({ live: { ...store.state.live, said: response.ok ? null : answer.error ?? `refused (${response.status})` } });
  return response.ok ? answer : null;
}

export const togglePause = (store) => command(store, { command: store.state.live.paused ? "resume" : "pause" });
export const stepLive = (store, of, agent) => command(store, { command: "step", count: 1, of, ...(agent === null ? {} : { agent }) });
export const useSpeed = (store, factor) => command(store, { command: "speed", factor });
export const drive = (store, agent, vx, vy, omega) => command(store, { command: "drive", agent, vx, vy, omega });
export async function addBreak(store, wanted) {
  const answer = await command(store, { command: "break", ...wanted });
  if (answer) store.set({ live: { ...store.state.live, breaks: [...store.state.live.breaks, { ...wanted, id: answer.id }] } });
}
export async function clearBreak(store, id) {
  await command(store, { command: "clear", id });
  store.set({ live: { ...store.state.live, breaks: store.state.live.breaks.filter((one) => one.id !== id) } });
}

/** Whether what is shown is the run's own present, or on the way to it. */
export const isPresent = (store, source) => store.state.t >= source.end - 1 || (!isOver(store.state) && store.state.live?.shown === store.state.t);

/**
 * The time to be shown of a run that is gone along with [ns], `passed` s after `t` was: it moves as fast as the run
 * does, a little faster or slower to stay `lag` behind what has been recorded.
 * @param speed  simulated s per s; 0: as fast as it can
 */
export function alongWith(t, end, { speed, paused }, passed) {
  const behind = (end - t) / 1e9;
  if (!(speed > 0) || speed > slow || paused || behind > 4 * lag * speed) return end;
  const rate = speed * Math.min(2, Math.max(0.5, behind / (lag * speed)));
  return Math.min(end, Math.round(t + passed * rate * 1e9));
}

// Whoever has the page open says so, hidden or not, and hears of the end of the server; by a worker, for browsers
// let the clocks of hidden pages go slowly.
const worker = `onmessage = ({ data: { url, headers, beat } }) => {
  let missed = 0;
  const say = async () => {
    let heard = false;
    try { heard = (await fetch(url, { cache: "no-store", headers })).ok; } catch { /* told below */ }
    missed = heard ? 0 : missed + 1;
    postMessage(missed);
    setTimeout(say, beat);
  };
  say();
};`;

function sayOpen(onAnswer) {
  const speaker = new Worker(URL.createObjectURL(new Blob([worker], { type: "text/javascript" })));
  speaker.onmessage = ({ data: missed }) => onAnswer(missed);
  speaker.postMessage({ url: new URL("/api/open", location.href).href, headers: token() === null ? {} : { "X-Baraka-Token": token() }, beat });
}
/** Whether play, steps and speed are the run's: who looks back plays the record. */
export const leads = (store, source) => isLed(store) && isPresent(store, source);

export function live(store, source) {
  if (source.view.mode !== "live" || source.exported) return {};
  const canCommand = source.view.can_command && token() !== null;
  store.set({ live: { canCommand, paused: false, ended: false, said: null, breaks: [], speed: 0, now: 0 } });
  // An address that tells no time is of the present.
  if (!/[#&]t=/.test(location.hash)) store.set({ t: source.end });
  let timer = null; //   until the next question
  let asking = false;

  // What a run has named so far: states, classes of messages and series come up while it goes on.
  let namedAt = 0;
  async function readNames(now) {
    namedAt = now;
    for (const run of source.runs) {
      const response = await ask(`/api/runs/${run.index}/world`).catch(() => null);
      if (!response?.ok) continue;
      const { states, topics, series, result, fingerprint, bounds } = await response.json();
      Object.assign(run.world, { states, topics, series, result, fingerprint, bounds, isBehind: false });
      source.touch();
    }
  }

  const go = (t) => store.set({ t, playing: false, live: { ...store.state.live, shown: t } });
  const heard = (said) => {
    const wasPaused = store.state.live.paused;
    const atEnd = isPresent(store, source);
    source.advance(said.until);
    const breaks = store.state.live.breaks.filter((one) => one.on !== "time" || one.at > said.now);
    store.set({ live: { ...store.state.live, ...said, stoppedBy: said.stopped_by, breaks } });
    // The page goes along with the run until somebody looks back.
    if (atEnd) go(alongWith(store.state.t, source.end, { speed: said.speed, paused: said.paused || said.ended }, 0));
    const stopped = said.paused && !wasPaused;
    const since = performance.now() - namedAt;
    const isBehind = source.runs.some(({ world }) => world.isBehind) && since > soon;
    if (stopped || said.ended || isBehind || since > often) readNames(performance.now());
  };
  const look = async () => {
    timer = null;
    asking = true;
    try {
      const response = await ask("/api/clock");
      if (response.ok) heard(await response.json());
    } catch {
      // The server is gone, or too busy: asked again.
    }
    asking = false;
    open();
  };
  const open = () => {
    if (timer !== null || asking || document.hidden || store.state.live.ended) return;
    timer = setTimeout(look, pause);
  };
  const close = () => { clearTimeout(timer); timer = null; };
  // A tab that nobody sees asks for nothing.
  document.addEventListener("visibilitychange", () => (document.hidden ? close() : open()));
  open();
  sayOpen((missed) => {
    const gone = missed >= silent;
    if (gone !== Boolean(store.state.live.gone)) store.set({ live: { ...store.state.live, gone } });
  });
  let movedAt = 0;
  return {
    /** Goes along with the run between two looks. @return whether it moved */
    goAlong(now) {
      const passed = Math.min(0.25, (now - movedAt) / 1000);
      movedAt = now;
      const { t, live: run, playing } = store.state;
      if (playing || isOver(store.state) || t >= source.end || !isPresent(store, source)) return false;
      go(alongWith(t, source.end, run, passed));
      return true;
    },
  };
}
