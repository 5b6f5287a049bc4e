// The time axis: one scale for all lanes, from microseconds to hours. Wheel zooms, drag pans, a click sets
// the time or chooses what it hits; the strip of the axis is for scrubbing.
import { paper } from "../paper.js";
import { colour } from "../colours.js";
import { drawMedium, drawStates, drawSteps, stateSpans } from "./agent_lanes.js";
import { drawFrames } from "./frame_lane.js";
import { pointer } from "./lane_pointer.js";
import { drawEvents, drawMessages, drawSeries } from "./message_lane.js";
import { createScale, exact, ticksOf } from "./scale.js";

const gutter = 118;
const axisHeight = 22;
const narrow = 86; //  of the gutter, on a phone

/** What the lanes of a run are, from top to bottom: {name, height, draw}. */
export function lanesOf(run, state) {
  const list = [
    { name: "frames", height: 30, kind: "frames" },
    { name: "messages", height: 44, kind: "messages" },
    { name: "events", height: 18, kind: "events" },
  ];
  const chosen = state.chosen?.kind === "agent" && state.chosen.run === run.index
    ? run.world.agents.find(({ agent }) => agent === state.chosen.agent) : null;
  if (chosen) {
    list.push({ name: `${chosen.name} sends, hears, NAV`, height: 27, kind: "medium", agent: chosen.agent });
    list.push({ name: `${chosen.name} queue`, height: 26, kind: "queue", agent: chosen.agent });
  }
  for (const index of state.charts) {
    const series = run.world.series.find((one) => one.index === index);
    const agent = run.world.agents.find((one) => one.agent === series?.agent);
    if (series) list.push({ name: `${agent ? `${agent.name} ` : ""}${series.name}${series.unit ? ` [${series.unit}]` : ""}`, height: 46, kind: "series", index });
  }
  const said = (kind) => run.world.agents.filter((agent) => agent.program && (agent.kind === "robot") === kind);
  for (const agent of [...said(true), ...said(false)]) list.push({ name: agent.name, height: 15, kind: "state", agent: agent.agent });
  return list;
}

export function lanes(element, store, source) {
  const canvas = element.appendChild(document.createElement("canvas"));
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "time axis; arrow keys move, plus and minus zoom");
  const tip = element.appendChild(document.createElement("div"));
  tip.className = "tip";
  const head = element.appendChild(document.createElement("div"));
  head.className = "head";
  tip.hidden = true;
  const here = { hits: [], scroll: 0, scale: null, height: 0, view: () => store.state.view ?? [0, source.end] };
  pointer(canvas, tip, here, store, source, axisHeight);

  const ctx = paper(canvas);
  const runOf = () => source.runs.find(({ index }) => index === store.state.run) ?? source.runs[0];

  function drawLane(lane, box, run) {
    const { scale, hits } = here;
    const rows = (kind, summary = true) => run.rows(kind, Math.max(0, scale.from), scale.to, { summary });
    const names = new Map(run.world.agents.map(({ agent, name }) => [agent, name]));
    if (lane.kind === "frames") drawFrames(ctx, box, scale, run.rows("frames", Math.max(0, scale.from - 2e7), scale.to, { summary: true }), hits, names);
    else if (lane.kind === "messages") drawMessages(ctx, box, scale, rows("messages"), hits);
    else if (lane.kind === "events") drawEvents(ctx, box, scale, rows("events"), hits);
    else if (lane.kind === "medium") drawMedium(ctx, box, scale, run.rows("frames", Math.max(0, scale.from - 2e7), scale.to, { summary: true }), lane.agent);
    else if (lane.kind === "queue") drawSteps(ctx, box, scale, rows("queues"), lane.agent, "frames");
    else if (lane.kind === "state") drawStates(ctx, box, scale, stateSpans(rows("states"), lane.agent, Math.max(0, scale.from), Math.min(scale.to, run.end)), run.world.states);
    else if (lane.kind === "series") {
      const reach = drawSeries(ctx, box, scale, rows(`series:${lane.index}`));
      if (reach) lane.note = `${Number(reach[0].toPrecision(4))} … ${Number(reach[1].toPrecision(4))}`;
    }
  }

  function drawAxis(width, left) {
    const { scale } = here;
    const { base, ticks } = ticksOf([scale.from, scale.to], Math.max(2, (width - left) / 110));
    ctx.fillStyle = colour("soft");
    ctx.fillRect(0, 0, width, axisHeight);
    ctx.fillStyle = colour("muted");
    ctx.textAlign = "left";
    ctx.fillText(base === null ? "time" : `from ${exact(base)} s`, 6, axisHeight / 2, left - 8);
    ctx.strokeStyle = colour("line");
    for (const { t, label } of ticks) {
      const x = scale.x(t);
      if (x < left) continue;
      ctx.beginPath(); ctx.moveTo(x + 0.5, axisHeight - 5); ctx.lineTo(x + 0.5, here.height); ctx.stroke();
      ctx.fillText(label, x + 4, axisHeight / 2);
    }
  }

  // An element of its own: time goes on without the lanes being painted again.
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

  function paint(width) {
    const left = width < 600 ? narrow : gutter;
    const ratio = globalThis.devicePixelRatio ?? 1;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(here.height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(here.height * ratio);
    }
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.clearRect(0, 0, width, here.height);
    ctx.font = "11px system-ui, 'Liberation Sans', 'DejaVu Sans', sans-serif";
    ctx.textBaseline = "middle";
    here.left = left;
    here.scale = createScale(here.view(), left, width - 8);
    here.hits.length = 0;
    drawAxis(width, left);
    const run = runOf();
    const list = lanesOf(run, store.state);
    const total = list.reduce((sum, lane) => sum + lane.height, 0);
    here.scroll = Math.max(0, Math.min(here.scroll, total - (here.height - axisHeight)));
    let y = axisHeight - here.scroll;
    ctx.save();
    ctx.beginPath(); ctx.rect(0, axisHeight, width, here.height - axisHeight); ctx.clip();
    for (const lane of list) {
      if (y + lane.height > axisHeight && y < here.height) paintLane(lane, { x: left, y, width: Math.max(1, Math.floor(width - 8 - left)), height: lane.height }, run, width);
      y += lane.height;
    }
    ctx.restore();
  }

  function paintLane(lane, box, run, width) {
    const { x: left, y } = box;
    ctx.save();
    ctx.beginPath(); ctx.rect(left, y, box.width, lane.height); ctx.clip();
    drawLane(lane, box, run);
    ctx.restore();
    ctx.fillStyle = colour(lane.kind === "state" ? "ink" : "muted");
    ctx.fillText(lane.name, 6, y + lane.height / 2 - (lane.note ? 6 : 0), left - 10);
    if (lane.note) ctx.fillText(lane.note, 6, y + lane.height / 2 + 7, left - 10);
    ctx.strokeStyle = colour("line");
    ctx.beginPath(); ctx.moveTo(0, y + lane.height - 0.5); ctx.lineTo(width, y + lane.height - 0.5); ctx.stroke();
    if (lane.agent !== undefined) here.hits.unshift({ x0: 0, x1: left, y0: y, y1: y + lane.height, chosen: { kind: "agent", agent: lane.agent } });
  }

  let painted = null;
  return {
    recolour() { painted = null; },
    draw() {
      follow();
      const width = element.clientWidth;
      here.height = element.clientHeight;
      const { view, run, chosen, charts } = store.state;
      const key = [...here.view(), view, width, here.height, run, chosen, charts, here.scroll, source.bytes, source.asking];
      if (!painted || key.some((value, i) => value !== painted[i])) {
        paint(width);
        painted = key;
      }
      moveHead();
    },
  };
}
