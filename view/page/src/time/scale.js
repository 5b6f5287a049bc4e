// From time to places on the axis, and how times are written. Times are ns, places px.
const units = [["s", 1e9], ["ms", 1e6], ["µs", 1e3], ["ns", 1]];

/** The whole second and ns of a time, as text: "100.000000123". */
export function exact(t) {
  const whole = Math.floor(t / 1e9);
  return `${whole}.${String(Math.round(t - whole * 1e9)).padStart(9, "0")}`;
}

/** A length of time in the unit that suits it: "3.2 ms". @param digits  significant */
export function span(ns, digits = 4) {
  const [unit, size] = units.find(([, one]) => Math.abs(ns) >= one) ?? units[3];
  return `${Number((ns / size).toPrecision(digits))} ${unit}`;
}

/** A length of time to the nanosecond: "3.214567 ms". */
export function spanExact(ns) {
  const [unit, size] = units.find(([, one]) => Math.abs(ns) >= one) ?? units[3];
  return `${size === 1 ? ns : (ns / size).toFixed(Math.log10(size)).replace(/0+$/, "").replace(/\.$/, "")} ${unit}`;
}

/**
 * The time that a text means [ns]: "12.5" or "12.5 s", "300 ms"; with a sign from `now` on: "+20 us". Null: none.
 * The fraction is read digit by digit: 755.400695454 * 1e9 is not a whole number in binary64.
 */
export function timeOf(text, now) {
  const match = /^\s*([+-]?)\s*(\d+)(?:\.(\d+))?\s*(s|ms|us|µs|μs|ns)?\s*$/.exec(text);
  if (!match) return null;
  const [, sign, whole, fraction = "", unit = "s"] = match;
  const digits = { s: 9, ms: 6, ns: 0 }[unit] ?? 3;
  const ns = Number(whole) * 10 ** digits + Number(fraction.padEnd(digits, "0").slice(0, digits) || 0);
  return sign ? now + (sign === "-" ? -ns : ns) : ns;
}

/** A step of 1, 2 or 5 times a power of ten that leaves about `count` of them in a span [ns], 1 at least. */
export function stepOf(length, count) {
  const raw = Math.max(1, length / count);
  const power = 10 ** Math.floor(Math.log10(raw));
  return power * ([1, 2, 5, 10].find((factor) => factor * power >= raw * 0.999) ?? 10);
}

/** Ticks of a span: {base, ticks: [{t, label}]}; with steps below 1 ms they are told from `base` on. */
export function ticksOf([from, to], count) {
  const step = stepOf(to - from, count);
  const first = Math.ceil(from / step) * step;
  const base = step < 1e6 ? Math.floor(first / (step * 100)) * step * 100 : null;
  const digits = Math.max(0, 9 - Math.floor(Math.log10(step)));
  const ticks = [];
  for (let t = first; t <= to && ticks.length < 200; t += step) {
    const label = base === null ? `${(t / 1e9).toFixed(digits)} s` : t === base ? "+0" : `+${span(t - base)}`;
    ticks.push({ t, label });
  }
  return { base, ticks };
}

/** The axis of a view [from, to] between x0 and x1. */
export function createScale([from, to], x0, x1) {
  const perPixel = (to - from) / Math.max(1, x1 - x0);
  return { from, to, x0, x1, perPixel, x: (t) => x0 + (t - from) / perPixel, t: (x) => from + (x - x0) * perPixel };
}

/** A view that is `factor` times as long, with t where it is; 1 µs to a bit more than the whole run. */
export function zoomed([from, to], t, factor, end) {
  const least = 1000;
  const most = Math.max(least, end * 1.02);
  const length = Math.min(most, Math.max(least, (to - from) * factor));
  const share = (t - from) / (to - from);
  return kept([t - share * length, t + (1 - share) * length], end);
}

/** The same length within the run, give or take a margin. */
export function kept([from, to], end) {
  const length = to - from;
  const margin = 0.01 * length;
  const shifted = Math.min(Math.max(from, -margin), Math.max(-margin, end - length + margin));
  return [shifted, shifted + length];
}
