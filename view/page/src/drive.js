// Driving a robot by hand: what keys and the pad mean, and commands that keep coming as long as it is driven.
const ahead = 0.5; //   m/s, at full
const aside = 0.3; //   m/s
const turning = 1; //   rad/s, left is positive
const period = 100; //  ms between two commands; a robot that hears none for its command_timeout stops

const meanings = { w: [1, 0, 0], s: [-1, 0, 0], a: [0, 0, 1], d: [0, 0, -1], q: [0, 1, 0], e: [0, -1, 0],
  arrowup: [1, 0, 0], arrowdown: [-1, 0, 0], arrowleft: [0, 0, 1], arrowright: [0, 0, -1] };
export const drives = (key) => key.toLowerCase() in meanings;

const share = (value) => Math.max(-1, Math.min(1, value));
const velocity = (x, y, turn) => ({ vx: ahead * share(x), vy: aside * share(y), omega: turning * share(turn) });

/** The velocity that held keys mean; opposite ones cancel out. */
export function velocityOfKeys(keys) {
  const sum = [0, 0, 0];
  for (const key of new Set([...keys].map((one) => one.toLowerCase()))) meanings[key]?.forEach((value, i) => { sum[i] += value; });
  return velocity(...sum);
}

/** The velocity that a place on the pad means: (-1, -1) is its left top. Up is ahead, sideways turns. */
export const velocityOfPad = (x, y) => velocity(-y, 0, -x);

/**
 * Sends what is wanted ten times a second, one command at a time, and a last one of rest.
 *   const driver = createDriver((agent, {vx, vy, omega}) => promise);
 *   driver.use(26, velocity); driver.rest();
 */
export function createDriver(send) {
  let wanted = null; //   {agent, velocity}
  let resting = null; //  agent that is to be told to rest
  let timer = null;
  let isUnderway = false;
  async function go() {
    if (isUnderway || (resting === null && !wanted)) return;
    isUnderway = true;
    const [agent, what] = resting === null ? [wanted.agent, wanted.velocity] : [resting, velocity(0, 0, 0)];
    resting = null;
    try { await send(agent, what); } catch { /* the next one tells */ }
    isUnderway = false;
    if (resting !== null) go(); //  nothing that was wanted before may come after it
  }
  const driver = {
    use(agent, next) {
      if (wanted && wanted.agent !== agent) driver.rest();
      const begins = !wanted;
      wanted = { agent, velocity: next };
      if (!begins) return;
      timer = setInterval(go, period);
      go();
    },
    rest() {
      if (!wanted) return;
      clearInterval(timer);
      resting = wanted.agent;
      wanted = null;
      go();
    },
    get agent() { return wanted?.agent ?? null; },
  };
  return driver;
}
