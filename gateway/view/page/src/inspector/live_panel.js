// Commands to a run under way: where it shall stop, and robots that are driven by hand.
import { addBreak, clearBreak, drive } from "../live.js";
import { facts, link, made, part } from "./parts.js";

const period = 100; //  ms between two commands to a robot
const kinds = ["state", "message", "loss", "collision", "contact", "time"];

function breaks(parent, run, store) {
  const { live, chosen } = store.state;
  const section = part(parent, "stops at");
  for (const one of live.breaks) {
    const what = [one.on, one.state ?? one.topic ?? (one.at === undefined ? null : `${one.at / 1e9} s`),
      one.agent === undefined ? null : `of ${run.world.agents.find(({ agent }) => agent === one.agent)?.name}`].filter(Boolean).join(" ");
    facts(section, [[what, link("no more", () => clearBreak(store, one.id))]]);
  }
  const kind = section.appendChild(document.createElement("select"));
  kind.setAttribute("aria-label", "what it stops at");
  for (const name of kinds) kind.appendChild(made("option", name));
  const value = section.appendChild(made("input", "", { placeholder: "any; time in s", size: 10 }));
  value.setAttribute("aria-label", "state, class of message, or time");
  section.append(" ", link(`add${chosen?.kind === "agent" ? ", for the chosen agent" : ""}`, () => {
    const wanted = { on: kind.value };
    if (chosen?.kind === "agent" && kind.value !== "time") wanted.agent = chosen.agent;
    if (kind.value === "state") wanted.state = value.value;
    if (kind.value === "message") wanted.topic = value.value;
    if (kind.value === "time") wanted.at = Math.round(Number(value.value) * 1e9);
    addBreak(store, wanted);
  }));
}

/** A pad: up is ahead, sideways turns; at rest as soon as it is let go. */
function pad(parent, agent, store) {
  const section = part(parent, `drive ${agent.name}`);
  const area = section.appendChild(made("div", "", { className: "pad", tabIndex: 0 }));
  area.setAttribute("aria-label", "drive: drag, or the keys w a s d");
  let wanted = null;
  let timer = null;
  const send = () => drive(store, agent.agent, wanted?.vx ?? 0, 0, wanted?.omega ?? 0);
  const use = (next) => {
    wanted = next;
    send();
    clearInterval(timer);
    timer = wanted ? setInterval(send, period) : null;
  };
  const from = (event) => {
    const box = area.getBoundingClientRect();
    const share = (value) => Math.max(-1, Math.min(1, value));
    return { vx: 0.5 * share(1 - 2 * (event.clientY - box.top) / box.height), omega: share(1 - 2 * (event.clientX - box.left) / box.width) };
  };
  area.addEventListener("pointerdown", (event) => { area.setPointerCapture(event.pointerId); use(from(event)); });
  area.addEventListener("pointermove", (event) => { if (wanted) wanted = from(event); });
  for (const name of ["pointerup", "pointercancel", "blur"]) area.addEventListener(name, () => { if (wanted) use(null); });
  const keys = { w: [0.3, 0], s: [-0.3, 0], a: [0, 0.8], d: [0, -0.8] };
  area.addEventListener("keydown", (event) => {
    if (!keys[event.key]) return;
    event.stopPropagation();
    if (!event.repeat) use({ vx: keys[event.key][0], omega: keys[event.key][1] });
  });
  area.addEventListener("keyup", (event) => { if (keys[event.key]) use(null); });
}

export function showLive(parent, run, store) {
  const { live, chosen } = store.state;
  if (!live) return;
  const head = part(parent, live.ended ? `the run has ended: ${live.result}` : live.paused ? "the run waits" : "the run goes on");
  if (live.stoppedBy) head.appendChild(made("p", `stopped: ${live.stoppedBy}`));
  if (live.said) head.appendChild(made("p", live.said, { className: "refused" }));
  if (!live.canCommand && !live.ended) head.appendChild(made("p", "watched only: the address that the run printed has the key to command it"));
  if (!live.canCommand || live.ended) return;
  breaks(parent, run, store);
  const agent = chosen?.kind === "agent" ? run.world.agents.find((one) => one.agent === chosen.agent) : null;
  if (agent?.program === "teleop") pad(parent, agent, store);
}
