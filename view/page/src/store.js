// The page's only state. Drawing is a function of this and of the record; nothing else is kept.
//   const store = createStore(startOf(location.hash));
//   store.set({ t: 5e9 }); store.state.t; store.subscribe((state, patch) => …)
// Times are ns of simulated time.
const fresh = () => ({
  t: 0, //                    what is shown
  playing: false,
  speed: 1, //                simulated seconds per second; 1e-6 … 100
  view: null, //              [t0, t1] of the axis; null: the whole run
  run: 0, //                  index of the run that the inspector and the lanes are about
  chosen: null, //            {kind: "agent", run, agent} | {kind: "frame", run, transmitter, number, at} |
  //                          {kind: "message", run, sender, id, at} | {kind: "link", run, a, b}
  route: null, //             {topic, destination}: arrows of the chosen agent's table
  follow: null, //            agent that the camera stays on
  followed: null, //          {run, sender, id, at}: message that is followed over its hops
  layers: { labels: true, links: true, frames: true, beams: true, trails: true, ranges: false, queues: true, coverage: false },
  mode2d: true, //            map (north up) or free 3-D
  map: null, //               {x, y, span}: middle and width of the map [m]; null: all
  orbit: null, //             {x, y, distance [m], yaw, pitch [rad]}: the free view; null: about what the map shows
  theme: null, //             "light" | "dark"; null: as the system has it
  charts: [], //              indices of world.series that have a lane
  lanes: "", //              names of agents, or parts of them, that have a lane; empty: all
  help: false, //             the sheet of keys
  live: null, //              what the server last said of a live run, see live.js
});

const few = 20; //  agents up to which the world is seen in 3-D at first: more are told apart on a map

/** What a bookmark that tells nothing is of. @param agents  of the run that has most */
export const unmarked = (agents = few + 1) => {
  const { playing, help, live, ...state } = fresh();
  return { ...state, mode2d: agents > few };
};

export function createStore(start = {}) {
  const listeners = new Set();
  const store = {
    state: { ...fresh(), ...start, layers: { ...fresh().layers, ...start.layers } },
    set(patch) {
      const changed = Object.keys(patch).filter((key) => patch[key] !== store.state[key]);
      if (!changed.length) return;
      store.state = { ...store.state, ...patch };
      for (const listener of listeners) listener(store.state, patch);
    },
    subscribe(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
  };
  return store;
}

const seconds = (ns) => {
  const whole = Math.floor(ns / 1e9);
  const rest = String(Math.round(ns - whole * 1e9)).padStart(9, "0").replace(/0+$/, "");
  return rest ? `${whole}.${rest}` : `${whole}.0`;
};
// By parts: 755.400695454 * 1e9 is not a whole number in binary64.
const nanoseconds = (text) => {
  const match = /^(\d+)(?:\.(\d{1,9}))?$/.exec(text ?? "");
  return match ? Number(match[1]) * 1e9 + Number((match[2] ?? "").padEnd(9, "0")) : null;
};
const numbers = (text) => (text ? text.split(",").map(Number) : []);

/** The bookmark of a state: what follows the # of an address. */
export function bookmark(state) {
  const parts = [["t", seconds(state.t)]];
  const add = (key, value) => parts.push([key, value]);
  if (state.speed !== 1) add("speed", state.speed);
  if (state.view) add("view", state.view.map((t) => seconds(Math.max(0, t))).join(","));
  if (state.run) add("run", state.run);
  const chosen = state.chosen;
  if (chosen?.kind === "agent") add("agent", chosen.agent);
  if (chosen?.kind === "frame") add("frame", [chosen.transmitter, chosen.number, chosen.at].join(","));
  if (chosen?.kind === "message") add("message", [chosen.sender, chosen.id, chosen.at].join(","));
  if (chosen?.kind === "link") add("link", [chosen.a, chosen.b].join(","));
  if (state.route) add("route", `${state.route.destination},${state.route.topic}`);
  if (state.follow !== null) add("follow", state.follow);
  if (state.followed) add("followed", [state.followed.sender, state.followed.id, state.followed.at].join(","));
  const digits = (values) => values.map((v) => Number(v.toPrecision(9))).join(",");
  if (state.mode2d && !state.map) add("2d", 1); //  few bodies are shown in 3-D otherwise
  if (!state.mode2d) {
    const { x, y, distance, yaw, pitch } = state.orbit ?? {};
    add("3d", state.orbit ? digits([x, y, distance, yaw, pitch]) : 1);
  }
  if (state.map) add("map", digits([state.map.x, state.map.y, state.map.span]));
  const { layers: usual } = fresh();
  const switched = Object.keys(usual).filter((name) => usual[name] !== state.layers[name]);
  if (switched.length) add("layers", switched.map((name) => (state.layers[name] ? "+" : "-") + name).join(","));
  if (state.theme) add("theme", state.theme);
  if (state.lanes) add("lanes", state.lanes);
  if (state.charts.length) add("charts", state.charts.join(","));
  return parts.map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll("%2C", ",").replaceAll("%2B", "+")}`).join("&");
}

/** The state that a bookmark is of; what it does not tell, or not rightly, is left out. */
export function startOf(hash) {
  const given = new Map(hash.replace(/^#/, "").split("&").map((part) => {
    const [key, value = ""] = part.split("=");
    try { return [key, decodeURIComponent(value)]; } catch { return [key, ""]; }
  }));
  const state = {};
  const take = (key, name, value) => { if (given.has(key) && value !== null && value !== undefined) state[name] = value; };
  const listed = (key, count) => {
    const list = numbers(given.get(key));
    return list.length === count && list.every(Number.isFinite) ? list : null;
  };
  const one = (key) => listed(key, 1)?.[0] ?? null;
  take("t", "t", nanoseconds(given.get("t")));
  const speed = one("speed");
  if (speed >= 1e-9 && speed <= 1e4) state.speed = speed;
  const view = (given.get("view") ?? "").split(",").map(nanoseconds);
  if (view.length === 2 && view[0] !== null && view[1] > view[0]) state.view = view;
  take("run", "run", one("run"));
  const run = state.run ?? 0;
  const pick = (key, count, make) => { const list = listed(key, count); if (list) state.chosen = { kind: key, run, ...make(...list) }; };
  pick("agent", 1, (agent) => ({ agent }));
  pick("frame", 3, (transmitter, number, at) => ({ transmitter, number, at }));
  pick("message", 3, (sender, id, at) => ({ sender, id, at }));
  pick("link", 2, (a, b) => ({ a, b }));
  const route = /^(\d+),(.*)$/.exec(given.get("route") ?? "");
  if (route) state.route = { destination: Number(route[1]), topic: route[2] };
  take("follow", "follow", one("follow"));
  const followed = listed("followed", 3);
  if (followed) state.followed = { run, sender: followed[0], id: followed[1], at: followed[2] };
  if (given.has("3d")) state.mode2d = false;
  else if (given.has("2d") || given.has("map")) state.mode2d = true;
  const orbit = listed("3d", 5);
  if (orbit && orbit[2] > 0) state.orbit = { x: orbit[0], y: orbit[1], distance: orbit[2], yaw: orbit[3], pitch: orbit[4] };
  const map = listed("map", 3);
  if (map && map[2] > 0) state.map = { x: map[0], y: map[1], span: map[2] };
  if (given.has("layers")) {
    state.layers = { ...fresh().layers };
    for (const part of given.get("layers").split(",")) {
      if (part.slice(1) in fresh().layers) state.layers[part.slice(1)] = part[0] === "+";
    }
  }
  if (["light", "dark"].includes(given.get("theme"))) state.theme = given.get("theme");
  take("lanes", "lanes", given.get("lanes"));
  if (given.has("charts")) state.charts = numbers(given.get("charts")).filter(Number.isInteger);
  return state;
}
