// Commands to a run under way: where it shall stop, and robots that are driven by hand.
import { addBreak, clearBreak, isPresent } from "../live.js";
import { timeOf } from "../time/scale.js";
import { facts, link, made, part } from "./parts.js";
import { pad } from "./pad.js";

/** What a break may be on, and what may be written beside it; null: nothing. */
const kinds = { state: "any state", message: "any class", loss: null, collision: null, contact: null, time: "12.5, +300 ms" };

/** The command for a break; a text: why there is none. */
export function breakOf(on, { text, agent, now }) {
  const wanted = { on };
  const name = text.trim();
  if (agent !== null && on !== "time") wanted.agent = agent;
  if (on === "state" && name) wanted.state = name;
  if (on === "message" && name) wanted.topic = name;
  if (on !== "time") return wanted;
  const at = timeOf(text, now);
  return at === null ? `a time, such as ${kinds.time}` : { ...wanted, at };
}

const nameOfBreak = (one, world) => [one.on, one.state ?? one.topic ?? (one.at === undefined ? null : `${one.at / 1e9} s`),
  one.agent === undefined ? null : `of ${world.agents.find(({ agent }) => agent === one.agent)?.name}`].filter(Boolean).join(" ");

function breaks(parent, run, store) {
  const { live, chosen } = store.state;
  const section = part(parent, "stops at");
  for (const one of live.breaks) facts(section, [[nameOfBreak(one, run.world), link("remove", () => clearBreak(store, one.id))]]);
  const form = section.appendChild(made("form", "", { className: "breaks" }));
  const kind = form.appendChild(made("select"));
  kind.setAttribute("aria-label", "kind of breakpoint");
  for (const name of Object.keys(kinds)) kind.appendChild(made("option", name));
  const field = form.appendChild(made("input", "", { size: 12, autocomplete: "off" }));
  field.setAttribute("aria-label", "state, message class or time of the breakpoint");
  field.setAttribute("list", "break-names");
  const names = form.appendChild(made("datalist", "", { id: "break-names" }));
  const agent = chosen?.kind === "agent" ? chosen.agent : null;
  const of = agent === null ? "" : ` for ${run.world.agents.find((one) => one.agent === agent)?.name}`;
  const add = form.appendChild(made("button", "add", { type: "submit" }));
  const why = form.appendChild(made("p", "", { className: "refused" }));
  const offer = () => {
    const known = { state: run.world.states, message: run.world.topics }[kind.value] ?? [];
    names.replaceChildren(...known.map((name) => made("option", "", { value: name })));
    field.hidden = kinds[kind.value] === null;
    field.placeholder = kinds[kind.value] ?? "";
    add.textContent = kind.value === "time" ? "add" : `add${of}`;
    why.textContent = "";
  };
  kind.addEventListener("change", offer);
  offer();
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const wanted = breakOf(kind.value, { text: field.hidden ? "" : field.value, agent, now: store.state.live.now });
    document.activeElement?.blur(); //  the panel may be drawn anew
    if (typeof wanted === "string") why.textContent = wanted; else addBreak(store, wanted);
  });
}

/** What the page knows of the run, for people. */
export function headline(live) {
  if (live.ended) return `the run has ended: ${live.result}`;
  if (live.gone) return "the run does not answer any more";
  return live.paused ? "the run waits" : "the run goes on";
}

const gone = "Its server has ended. Shown is what arrived before; baraka view shows all that was recorded.";

/** The part of the panel that is about a run under way; draw() when its state or what is chosen changed. */
export function livePanel(parent, store, source) {
  const body = parent.appendChild(document.createElement("div"));
  const drive = pad(parent, store);
  return {
    draw(run) {
      const { live, chosen } = store.state;
      body.replaceChildren();
      if (!live) return;
      const isOver = live.ended || live.gone;
      const head = part(body, headline(live));
      if (live.stoppedBy) head.appendChild(made("p", `stopped: ${live.stoppedBy}`));
      if (live.said) head.appendChild(made("p", live.said, { className: "refused" }));
      if (live.gone) head.appendChild(made("p", gone, { className: "refused" }));
      if (live.can_hold === false && !isOver) head.appendChild(made("p", "it keeps real time, so it can be watched but not paused, stepped or slowed"));
      else if (!live.canCommand && !isOver) head.appendChild(made("p", "it can be watched only: to command it, open the address that the run printed"));
      if (!isOver && !isPresent(store, source)) {
        head.append("shown is an earlier time; ", link("show the present", () => store.set({ t: source.end, playing: false })));
      }
      const mayCommand = live.canCommand && !isOver;
      if (mayCommand && live.can_hold !== false) breaks(body, run, store);
      const agent = chosen?.kind === "agent" ? run.world.agents.find((one) => one.agent === chosen.agent) : null;
      drive.show(mayCommand && agent?.program === "teleop" ? agent : null);
    },
  };
}
