// Which lanes a run has, from top to bottom.
const heights = { frames: 30, messages: 44, events: 18, sends: 13, hears: 15, nav: 13, queue: 26, series: 46, state: 15 };

const lane = (kind, name, more = {}) => ({ kind, name, height: heights[kind], ...more });

/** Whether an agent's name holds the text, whatever its case; a text with commas: one of its parts. */
export function isNamed(name, text) {
  const parts = text.toLowerCase().split(",").map((part) => part.trim()).filter(Boolean);
  return !parts.length || parts.some((part) => name.toLowerCase().includes(part));
}

/** A recorded series as it is called everywhere: whose, what, and its unit where it has one. */
export function seriesName({ agents }, { agent, name, unit }) {
  const whose = agents.find((one) => one.agent === agent)?.name;
  return `${whose ? `${whose} ` : ""}${name}${unit && unit !== "1" ? ` [${unit}]` : ""}`;
}

/**
 * The lanes: {kind, name, height}, of an agent `agent`, of a series `index`.
 * @param title  of the run, where there are several
 */
export function lanesOf(run, state, title = "") {
  const { agents, series } = run.world;
  const list = [lane("frames", title ? `${title}: frames` : "frames"), lane("messages", "messages"), lane("events", "events")];
  const chosen = state.chosen?.kind === "agent" && state.chosen.run === run.index ? agents.find(({ agent }) => agent === state.chosen.agent) : null;
  if (chosen) {
    for (const [kind, name] of [["sends", "sends"], ["hears", "hears"], ["nav", "NAV"], ["queue", "queue"]]) {
      list.push(lane(kind, `${chosen.name} ${name}`, { agent: chosen.agent }));
    }
  }
  for (const index of state.charts) {
    const one = series.find((of) => of.index === index);
    if (one) list.push(lane("series", seriesName(run.world, one), { index }));
  }
  const said = agents.filter(({ program, name }) => program && isNamed(name, state.lanes));
  const isRobot = ({ kind }) => kind === "robot";
  for (const agent of [...said.filter(isRobot), ...said.filter((one) => !isRobot(one))]) list.push(lane("state", agent.name, { agent: agent.agent }));
  return list;
}
