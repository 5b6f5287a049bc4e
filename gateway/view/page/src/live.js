// A run under way: what the server says of it, and, with the token of the printed address, commands to it.
const tokenKey = "baraka-token";
const token = () => globalThis.sessionStorage?.getItem(tokenKey) ?? null;

/** Whether this page may hold and step the run. */
export const isLed = (store) => Boolean(store.state.live?.canCommand && !store.state.live.ended);

async function command(store, body) {
  const response = await fetch("/api/control", {
    method: "POST", headers: { "Content-Type": "application/json", "X-Baraka-Token": token() ?? "" }, body: JSON.stringify(body),
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

export function live(store, source) {
  if (source.view.mode !== "live" || source.exported) return {};
  const canCommand = source.view.can_command && token() !== null;
  store.set({ live: { canCommand, paused: false, ended: false, said: null, breaks: [] } });
  let stream = null;
  let atEnd = true; //  the page goes along with the run until somebody looks back

  let isFirst = true;
  const heard = (event) => {
    const said = JSON.parse(event.data);
    const before = source.end;
    // Who opens the page without a time wants to see what is going on now. Until somebody looked, the server
    // has not told up to when the record is written.
    atEnd = store.state.t >= before - 1 || (isFirst && store.state.t === 0);
    isFirst &&= said.until === 0;
    source.advance(said.until);
    const breaks = store.state.live.breaks.filter((one) => one.on !== "time" || one.at > said.now);
    store.set({ live: { ...store.state.live, ...said, stoppedBy: said.stopped_by, breaks } });
    if (atEnd && said.until > 0) store.set({ t: said.until, playing: false });
    if (said.ended) close();
  };
  const open = () => {
    if (stream || store.state.live.ended) return;
    stream = new EventSource("/api/events");
    stream.onmessage = heard;
  };
  const close = () => { stream?.close(); stream = null; };
  // A tab that nobody sees asks for nothing.
  document.addEventListener("visibilitychange", () => (document.hidden ? close() : open()));
  open();
  return {};
}
