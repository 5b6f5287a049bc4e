// An agent as it is at t.
import { lastRow, poseAt, readingAt, stateAt, tableAt } from "../at.js";
import { eachMessage } from "../at_messages.js";
import { exact, span } from "../time/scale.js";
import { facts, fixed, link, list, nameOf, part } from "./parts.js";
import { showReadings } from "./readings.js";

const aroundLog = 30e9; //  ns: log lines and messages of that long before t

/** The share of each next hop by equation 1, of rows with weights; null where the protocol chooses otherwise. */
export function shares(rows) {
  const weights = rows.map((row) => row.probability ?? row.weight ?? null);
  const sum = weights.reduce((total, weight) => total + (weight ?? 0), 0);
  return weights.map((weight) => (weight === null || sum <= 0 ? null : weight / sum));
}

function pose(parent, run, agent, state) {
  const t = state.t;
  const at = poseAt(run.rows("poses", Math.max(0, t - 2e9), t + 2e9), agent.agent, t, run.world.recorded?.poses_period_ns ?? 1e9) ?? agent;
  const readings = run.rows("readings", Math.max(0, t - 1), t);
  const odometry = readingAt(readings, agent.agent, "odometry", t);
  const degrees = (angle) => `${fixed((angle * 180) / Math.PI, 2)}°`;
  const place = ({ x, y, theta }) => `x ${fixed(x, 3)} m, y ${fixed(y, 3)} m, ${degrees(theta)}`;
  const believed = odometry && inWorld(agent, odometry);
  facts(parent, [
    ["true pose", place(at)],
    ["by odometry", believed && place(believed)],
    ["off by", believed && `${fixed(Math.hypot(at.x - believed.x, at.y - believed.y), 4)} m`],
    ["from its start", odometry && place({ x: odometry[0], y: odometry[1], theta: odometry[2] })],
  ]);
  return readings;
}

/** Odometry counts from where the robot started, in the frame that it had there: the same in the world. */
export function inWorld(start, [x, y, theta]) {
  const [c, s] = [Math.cos(start.theta), Math.sin(start.theta)];
  const heading = start.theta + theta;
  return { x: start.x + c * x - s * y, y: start.y + s * x + c * y, theta: Math.atan2(Math.sin(heading), Math.cos(heading)) };
}

function routes(parent, run, agent, store) {
  if (run.world.isPlan) return;
  const changes = run.routes(agent.agent);
  const section = part(parent, "routes");
  if (!changes) { section.append(store.state.live?.gone ? "not asked for before the server ended" : "…"); return; }
  const table = tableAt(changes, store.state.t);
  if (!table.length) { section.append(run.world.recorded?.routes === "none" ? "not recorded" : "none now"); return; }
  const rows = [];
  const keys = [...new Set(table.map((row) => `${row.topic}\n${row.destination}`))];
  for (const key of keys) {
    const same = table.filter((row) => `${row.topic}\n${row.destination}` === key);
    shares(same).forEach((share, i) => rows.push({ ...same[i], share }));
  }
  list(section, ["to", "via", "hops", "delay", "share", "class"], rows.map((row) => [nameOf(run, row.destination), nameOf(run, row.next_hop),
    row.hops, span(row.delay, 3), row.share === null ? "" : row.share.toFixed(3), row.topic]),
  (i) => store.set({ route: { topic: rows[i].topic, destination: rows[i].destination } }));
}

// What had become of a message by t; null: it was on its way.
function endBy(columns, row, t) {
  const ended = Math.max(columns.fate_at[row] ?? 0, ...columns.deliveries[row].map(([, at]) => at));
  return ended <= t ? columns.verdict[row] : null;
}

function messages(parent, run, agent, store) {
  const { t } = store.state;
  const rows = [];
  eachMessage(run.rows("messages", Math.max(0, t - aroundLog), t + 1), (columns, row) => {
    const got = columns.deliveries[row].some(([receiver, at]) => receiver === agent.agent && at <= t);
    if (columns.sent[row] > t || columns.sent[row] < t - aroundLog || (columns.sender[row] !== agent.agent && !got)) return;
    rows.push({ sender: columns.sender[row], id: columns.id[row], at: columns.sent[row], to: columns.destination[row], topic: columns.topic[row],
      verdict: endBy(columns, row, t) });
  });
  if (!rows.length) return;
  const latest = rows.sort((a, b) => b.at - a.at).slice(0, 12);
  list(part(parent, "messages, the last 30 s"), ["sent", "from", "to", "class", "end"],
    latest.map((row) => [exact(row.at).slice(0, -6), nameOf(run, row.sender), nameOf(run, row.to), row.topic, row.verdict ?? "on its way"]),
    (i) => {
      const { sender, id, at } = latest[i];
      store.set({ chosen: { kind: "message", run: run.index, sender, id, at }, followed: { run: run.index, sender, id, at } });
    });
}

function log(parent, run, agent, t) {
  const lines = [];
  for (const { tile } of run.rows("log", Math.max(0, t - aroundLog), t + 1)) {
    const columns = tile.columns;
    columns?.at?.forEach?.((at, row) => { if (at <= t && columns.source[row] === agent.name) lines.push([exact(at).slice(0, -6), columns.text[row]]); });
  }
  if (lines.length) list(part(parent, "log, the last 30 s"), ["s", ""], lines.slice(-15));
}

function totals(parent, run, agent) {
  const answer = run.totals(agent.agent);
  if (!answer) return;
  const details = parent.appendChild(document.createElement("details"));
  details.appendChild(document.createElement("summary")).textContent = "counters of the whole run";
  for (const [name, value] of Object.entries(answer)) {
    if (value === null || ["from", "to", "until"].includes(name)) continue;
    if (typeof value !== "object") { facts(details, [[name, value]]); continue; }
    facts(part(details, name), Object.entries(value).map(([key, count]) => [key, typeof count === "object" ? JSON.stringify(count) : count]));
  }
}

export function showAgent(parent, run, store) {
  const { t, chosen } = store.state;
  const agent = run.world.agents.find((one) => one.agent === chosen.agent);
  if (!agent) {
    part(parent).append(`No agent of this run has address ${chosen.agent}.`);
    return;
  }
  const head = part(parent);
  head.appendChild(document.createElement("h2")).textContent = agent.name;
  const states = run.rows("states", Math.max(0, t - 1), t + 1);
  const queue = lastRow(run.rows("queues", Math.max(0, t - 1), t + 1), agent.agent, t);
  facts(head, [
    ["kind", `${agent.kind}, address ${agent.agent}`], ["controller", agent.program], ["state", stateAt(states, agent.agent, t)],
    ["queue", queue ? `${queue.tile.columns.frames[queue.row]} frames` : run.world.recorded?.queues === "none" ? null : "0 frames"],
    ["camera", link(store.state.follow === agent.agent ? "stop following" : "follow", () => store.set({ follow: store.state.follow === agent.agent ? null : agent.agent }))],
  ]);
  const readings = pose(head, run, agent, store.state);
  showReadings(parent, run, agent, readings, t);
  routes(parent, run, agent, store);
  messages(parent, run, agent, store);
  log(parent, run, agent, t);
  const parameters = Object.entries(agent.parameters ?? {});
  if (parameters.length) facts(part(parent, "parameters"), parameters);
  totals(parent, run, agent);
}
