// The keyboard, and the sheet that tells it.
import { actions } from "./controls.js";

const sheet = [
  ["space", "play, pause; with a live run: continue, pause; in its past: play up to the present"], ["← →", "move by a hundredth of the axis"],
  ["f, Shift+f", "next, previous frame"], ["c, Shift+c", "next, previous control cycle"],
  ["e, Shift+e", "next, previous event of the chosen agent"], ["[ ]", "slower, faster"],
  ["+ −", "zoom the axis"], ["a", "the whole run on the axis"], ["u", "zoom in on this instant"], ["Home, End", "start, end"], ["g", "go to a time: 12.5, 300 ms, +20 us"], ["l", "copy the address of this view"],
  ["n, Shift+n", "next, previous agent"], ["r", "lanes and panel of the next run"], ["o", "the camera follows the chosen agent"],
  ["d", "map or free 3-D"], ["t", "light or dark"], ["Esc", "clear the selection"], ["?", "list of keys"],
];

export function keys(store, source) {
  const act = actions(store, source);
  const dialog = document.body.appendChild(document.createElement("div"));
  dialog.id = "keys";
  dialog.hidden = true;
  dialog.setAttribute("role", "dialog");
  dialog.setAttribute("aria-label", "keys");
  const table = dialog.appendChild(document.createElement("table"));
  for (const [key, what] of sheet) {
    const row = table.insertRow();
    row.appendChild(document.createElement("th")).textContent = key;
    row.insertCell().textContent = what;
  }
  dialog.addEventListener("click", () => store.set({ help: false }));

  const shift = (share) => {
    const [from, to] = store.state.view ?? [0, source.end];
    act.at(store.state.t + share * (to - from));
  };
  const nextAgent = (way) => {
    const run = source.runs.find(({ index }) => index === store.state.run) ?? source.runs[0];
    const { agents } = run.world;
    const now = agents.findIndex(({ agent }) => store.state.chosen?.kind === "agent" && agent === store.state.chosen.agent);
    const { agent } = agents[(now + way + agents.length + (now < 0 && way < 0 ? 1 : 0)) % agents.length];
    store.set({ chosen: { kind: "agent", run: run.index, agent } });
  };
  // The same agent in the next run: what they are side by side for.
  const nextRun = () => {
    const place = source.runs.findIndex(({ index }) => index === store.state.run);
    const run = source.runs[(place + 1) % source.runs.length];
    const { chosen } = store.state;
    const isThere = chosen?.kind === "link" || (chosen?.kind === "agent" && run.world.agents.some(({ agent }) => agent === chosen.agent));
    store.set({ run: run.index, chosen: isThere ? { ...chosen, run: run.index } : null });
  };
  const handlers = {
    " ": act.play, ArrowLeft: () => shift(-0.01), ArrowRight: () => shift(0.01),
    f: () => act.step("frame", 1), F: () => act.step("frame", -1), c: () => act.step("cycle", 1), C: () => act.step("cycle", -1),
    e: () => act.step("event", 1), E: () => act.step("event", -1), "[": () => act.faster(-1), "]": () => act.faster(1),
    "+": () => act.zoom(0.5), "=": () => act.zoom(0.5), "-": () => act.zoom(2), a: act.all, u: act.close,
    g: () => document.querySelector("#controls .clock").focus(), l: () => document.querySelector("#controls .copy").click(),
    Home: () => act.at(0), End: () => act.at(source.end), r: () => nextRun(), n: () => nextAgent(1), N: () => nextAgent(-1), o: act.follow,
    d: () => store.set({ mode2d: !store.state.mode2d }), t: act.theme,
    Escape: () => store.set({ chosen: null, route: null, followed: null, help: false }), "?": () => store.set({ help: !store.state.help }),
  };
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName)) return;
    const handler = handlers[event.key];
    if (!handler || (event.target.tagName === "BUTTON" && event.key === " ")) return;
    event.preventDefault();
    handler();
  });
  return { draw() { dialog.hidden = !store.state.help; } };
}
