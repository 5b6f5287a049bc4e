// The time axis: one scale for all lanes, from microseconds to hours. Wheel zooms, drag pans, a click sets
// the time or chooses what it hits; the strip of the axis is for scrubbing. The lanes are drawn again only
// when something else than the time has changed: the head is an element of its own.
import { colour } from "../colours.js";
import { paper } from "../paper.js";
import { drawHears, drawNav, drawSends, drawStates, drawSteps, drawTooMany, stateSpans } from "./agent_lanes.js";
import { drawFrames } from "./frame_lane.js";
import { lanesOf } from "./lane_list.js";
import { pointer } from "./lane_pointer.js";
import { drawEvents, drawMessages, drawSeries } from "./message_lane.js";
import { createScale, exact, ticksOf } from "./scale.js";

const gutter = 118;
const axisHeight = 22;
const narrow = 86; //  of the gutter, on a phone
const again = 300; //  ms: rows of a live run that were not written yet are looked for so often
const longestFrame = 2e7; //  ns: one that began so long before the axis still reaches into it

/** How each kind of lane is drawn. @return what stands below its name, if anything */
const draws = {
  frames: ({ ctx, box, scale, frames, hits, names, chosen }) => drawFrames(ctx, box, scale, frames(), hits, names, chosen),
  messages: ({ ctx, box, scale, rows, hits, chosen }) => drawMessages(ctx, box, scale, rows("messages"), hits, chosen),
  events: ({ ctx, box, scale, rows, hits }) => drawEvents(ctx, box, scale, rows("events"), hits),
  sends: ({ ctx, box, scale, frames, lane, hits }) => drawSends(ctx, box, scale, frames(), lane.agent, hits),
  hears: ({ ctx, box, scale, frames, lane, hits, names }) => drawHears(ctx, box, scale, frames(), lane.agent, hits, names),
  nav: ({ ctx, box, scale, frames, lane }) => drawNav(ctx, box, scale, frames(), lane.agent),
  queue({ ctx, box, scale, rows, lane }) { return `0 … ${drawSteps(ctx, box, scale, rows("queues"), lane.agent, "frames")}`; },
  state({ ctx, box, scale, rows, lane, run }) {
    drawTooMany(ctx, box, scale, rows("states"));
    const spans = stateSpans(rows("states"), lane.agent, Math.max(0, scale.from), Math.min(scale.to, run.end));
    drawStates(ctx, box, scale, spans, run.world.states);
    run.world.isBehind ||= spans.some(({ state }) => !run.world.states.includes(state)); //  see live.js
  },
  series({ ctx, box, scale, rows, lane }) {
    const reach = drawSeries(ctx, box, scale, rows(`series:${lane.index}`));
    return reach ? `${Number(reach[0].toPrecision(4))} … ${Number(reach[1].toPrecision(4))}` : "no values here";
  },
};

/**
 * A name in at most so many lines of a width, parted at spaces and dots. What does not fit loses what stands before
 * its last dot, or else its end, to "…".
 * @param measure  a text to px
 */
export function linesOf(name, width, measure, most) {
  const lines = brokenAt(name, width, measure, most);
  const short = name.replace(/[^ ]+\.(?=[^ ])/, "…");
  return lines.some((line) => line.endsWith("…")) && short !== name ? brokenAt(short, width, measure, most) : lines;
}

function brokenAt(name, width, measure, most) {
  const parts = name.split(/(?<=[ .])/);
  const lines = [""];
  for (const part of parts) {
    const last = lines[lines.length - 1];
    if (!last || measure((last + part).trimEnd()) <= width) lines[lines.length - 1] += part;
    else lines.push(part);
  }
  const kept = lines.slice(0, most);
  if (lines.length > most) kept[most - 1] = lines.slice(most - 1).join("");
  return kept.map((line) => {
    let text = line.trimEnd();
    if (measure(text) <= width) return text;
    while (text.length > 1 && measure(`${text}…`) > width) text = text.slice(0, -1);
    return `${text}…`;
  });
}

/** The text that agents' lanes are chosen by. */
function filterField(element, store) {
  const field = element.appendChild(Object.assign(document.createElement("input"),
    { type: "search", placeholder: "agents …", title: "lanes of agents whose name contains this; several with commas between" }));
  field.setAttribute("aria-label", "names of the agents that have a lane");
  field.addEventListener("input", () => store.set({ lanes: field.value }));
  field.addEventListener("keydown", (event) => { if (event.key === "Escape" || event.key === "Enter") field.blur(); });
  return field;
}

/** Makes a canvas as large as its element, and empties it. */
function clear(canvas, ctx, width, height) {
  const ratio = globalThis.devicePixelRatio ?? 1;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.clearRect(0, 0, width, height);
  ctx.font = "11px system-ui, 'Liberation Sans', 'DejaVu Sans', sans-serif";
  ctx.textBaseline = "middle";
}

export function lanes(element, store, source) {
  const canvas = element.appendChild(document.createElement("canvas"));
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "time axis with lanes; arrow keys move the time, plus and minus zoom");
  const ctx = paper(canvas);
  const head = element.appendChild(Object.assign(document.createElement("div"), { className: "head" }));
  const field = filterField(element, store);
  const tip = element.appendChild(document.createElement("div"));
  tip.className = "tip";
  tip.hidden = true;
  const here = { hits: [], scroll: 0, scale: null, height: 0, view: () => store.state.view ?? [0, source.end] };
  pointer(canvas, tip, here, store, source, axisHeight);
  const runOf = () => source.runs.find(({ index }) => index === store.state.run) ?? source.runs[0];
  let shown = null; //  what the lanes were drawn of
  let shownAt = 0; //  ms
  let isBehind = false; //  the run goes on, and what was drawn is older than its record
  let theme = 0;

  function drawAxis(width) {
    ctx.fillStyle = colour("soft");
    ctx.fillRect(0, 0, width, axisHeight);
    const { scale, left } = here;
    const { base, ticks } = ticksOf([Math.max(0, scale.from), Math.min(scale.to, source.end)], Math.max(2, (width - left) / 110));
    const baseText = base === null ? "" : `+ ${exact(base)} s`;
    const free = width - 12 - (baseText ? ctx.measureText(baseText).width + 8 : 0);
    ctx.strokeStyle = colour("line");
    for (const { t, label } of ticks) {
      const x = scale.x(t);
      if (x < left) continue;
      ctx.beginPath(); ctx.moveTo(x + 0.5, axisHeight - 5); ctx.lineTo(x + 0.5, here.height); ctx.stroke();
      ctx.fillStyle = colour("muted");
      if (x + 4 + ctx.measureText(label).width < free) ctx.fillText(label, x + 4, axisHeight / 2);
    }
    ctx.fillStyle = colour("ink");
    if (baseText) ctx.fillText(baseText, free + 12, axisHeight / 2);
  }

  function drawName(lane, y, note, width) {
    const { left } = here;
    const middle = y + lane.height / 2;
    const room = left - (lane.kind === "series" ? 24 : 10);
    ctx.fillStyle = colour(lane.kind === "state" ? "ink" : "muted");
    const lines = [...linesOf(lane.name, room, (text) => ctx.measureText(text).width, note || lane.height < 26 ? 1 : 2), ...(note ? [note] : [])];
    if (lane.height >= 40 && note) lines.splice(0, 1, ...linesOf(lane.name, room, (text) => ctx.measureText(text).width, 2));
    lines.forEach((line, k) => ctx.fillText(line, 6, middle + 13 * (k - (lines.length - 1) / 2), room));
    if (lines.some((line) => line.includes("…"))) here.hits.unshift({ x0: 0, x1: left - (lane.kind === "series" ? 22 : 0), y0: y, y1: y + lane.height, text: lane.name });
    ctx.strokeStyle = colour("line");
    ctx.beginPath(); ctx.moveTo(0, y + lane.height - 0.5); ctx.lineTo(width, y + lane.height - 0.5); ctx.stroke();
    if (lane.agent !== undefined) here.hits.unshift({ x0: 0, x1: left, y0: y, y1: y + lane.height, chosen: { kind: "agent", agent: lane.agent } });
    if (lane.kind !== "series") return;
    ctx.fillText("✕", left - 16, middle);
    const without = () => store.set({ charts: store.state.charts.filter((index) => index !== lane.index) });
    here.hits.push({ x0: left - 22, x1: left, y0: y, y1: y + lane.height, text: `remove ${lane.name}`, action: without });
  }

  function drawLanes(width, run) {
    const { scale, hits, left } = here;
    const list = lanesOf(run, store.state, source.runs.length > 1 ? run.title : "");
    const total = list.reduce((sum, { height }) => sum + height, 0);
    here.scroll = Math.max(0, Math.min(here.scroll, total - (here.height - axisHeight)));
    const kept = new Map(); //  rows of this picture, by kind
    const rowsOf = (kind, from) => {
      if (!kept.has(kind)) kept.set(kind, run.rows(kind, Math.max(0, from), scale.to, { summary: true }));
      return kept.get(kind);
    };
    const what = { ctx, scale, hits, run, chosen: store.state.chosen, names: new Map(run.world.agents.map(({ agent, name }) => [agent, name])),
      rows: (kind) => rowsOf(kind, scale.from), frames: () => rowsOf("frames", scale.from - longestFrame) };
    let y = axisHeight - here.scroll;
    ctx.save();
    ctx.beginPath(); ctx.rect(0, axisHeight, width, here.height - axisHeight); ctx.clip();
    for (const lane of list) {
      const box = { x: left, y, width: Math.max(1, Math.floor(width - 8 - left)), height: lane.height };
      if (y + lane.height > axisHeight && y < here.height) {
        ctx.save();
        ctx.beginPath(); ctx.rect(left, y, box.width, lane.height); ctx.clip();
        const note = draws[lane.kind]({ ...what, lane, box });
        ctx.restore();
        drawName(lane, y, note, width);
      }
      y += lane.height;
    }
    ctx.restore();
    const end = Math.min(scale.to, run.end);
    isBehind = source.view.mode === "live" && [...kept.values()].some((pieces) => pieces.some(({ tile }) => tile.until < Math.min(tile.to, end)));
  }

  function moveHead() {
    const x = here.scale.x(store.state.t);
    head.hidden = x < here.left - 1 || x > here.scale.x1 + 1;
    head.style.transform = `translateX(${x}px)`;
  }

  // While it plays, the axis goes along.
  function follow() {
    const { playing, t, view } = store.state;
    if (!playing || !view || (t >= view[0] && t <= view[1])) return;
    const length = view[1] - view[0];
    store.set({ view: [t - 0.1 * length, t + 0.9 * length] });
  }

  return {
    recolour() { theme++; },
    animates: (now) => isBehind && now - shownAt > again,
    draw(now) {
      follow();
      const { state } = store;
      const [width, height] = [element.clientWidth, element.clientHeight];
      const view = here.view();
      const key = [...view, width, height, globalThis.devicePixelRatio, theme, source.arrivals, source.end, here.scroll, state.run, state.chosen, state.charts, state.lanes];
      if (!shown || this.animates(now) || key.some((value, i) => value !== shown[i])) {
        shown = key;
        shownAt = now;
        here.height = height;
        here.left = width < 600 ? narrow : gutter;
        here.scale = createScale(view, here.left, width - 8);
        here.hits.length = 0;
        clear(canvas, ctx, width, height);
        drawAxis(width);
        drawLanes(width, runOf());
        field.style.width = `${here.left - 6}px`;
        if (field !== document.activeElement && field.value !== state.lanes) field.value = state.lanes;
      }
      moveHead();
    },
  };
}
