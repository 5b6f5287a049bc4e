// A run under way: what the server says of it, and, with the token of the printed address, commands to it.
import { ask, token } from "./server.js";

const often = 5000; //  ms between two looks at what a run has named
const pause = 200; //   ms between an answer of the run's clock and the next question

/** Whether this page may hold and step the run. */
export const isLed = (store) => Boolean(store.state.live?.canCommand && store.state.live.can_hold !== false && !store.state.live.ended);

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

/** Whether what is shown is the run's own present. */
export const isPresent = (store, source) => store.state.t >= source.end - 1;
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
      const { states, topics, series, result, fingerprint } = await response.json();
      Object.assign(run.world, { states, topics, series, result, fingerprint });
      source.touch();
    }
  }

  const heard = (said) => {
    const wasPaused = store.state.live.paused;
    const atEnd = isPresent(store, source);
    source.advance(said.until);
    const breaks = store.state.live.breaks.filter((one) => one.on !== "time" || one.at > said.now);
    store.set({ live: { ...store.state.live, ...said, stoppedBy: said.stopped_by, breaks } });
    // The page goes along with the run until somebody looks back.
    if (atEnd) store.set({ t: source.end, playing: false });
    const stopped = said.paused && !wasPaused;
    if (stopped || said.ended || performance.now() - namedAt > often) readNames(performance.now());
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
  return {};
}
