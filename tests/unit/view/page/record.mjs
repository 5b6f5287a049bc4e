// A record for the tests of the page: rows as the server answers them, in one tile or several.
export const page = new URL("../../../../view/page/src/", import.meta.url);
export const verdicts = ["delivered", "collision", "preamble missed"];
export const [delivered, collision, missed] = [0, 1, 2];
export const everyone = 65535;

/** Rows as objects to columns. */
export function columnsOf(rows, names = Object.keys(rows[0] ?? {})) {
  return Object.fromEntries(names.map((name) => [name, rows.map((row) => row[name] ?? null)]));
}

/** One complete piece that is all of [from, to). */
export const piece = (rows, from = 0, to = 1e12, names = undefined) => (
  { from, to, tile: { from, to, until: to, complete: true, verdicts, columns: columnsOf(rows, names) } });

/** A frame of 100 µs; what a test is about is given. */
export const frame = (given) => ({ transmitter: 1, number: 1, at: 0, class: "unicast", receiver: 2, sequence: 0, retry: 0, bits: 800,
  airtime: 100_000, nav: 0, rate: 2e6, sender: null, message: null, packet: null, ends: [], ...given });

/** A message of class "help" that was delivered unless told otherwise. */
export const message = (given) => ({ sender: 1, id: 1, destination: 3, topic: "help", bytes: 5, sent: 0, fate: null, fate_at: null,
  verdict: "delivered", deliveries: [], ...given });

/** A run whose record is given by kind: {frames: [pieces], …}. What is not given has no rows. */
export const runOf = (kinds, world = {}, end = 1e10) => ({
  index: 0, end, world: { control_period: 1e8, agents: [], series: [], states: [], ...world },
  rows: (kind) => Object.assign([...(kinds[kind] ?? [])], { complete: true }),
});
