// The colours of style.css for what is drawn by script; read again when the theme changes.
const read = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
let known = new Map();

export const colour = (name) => {
  if (!known.has(name)) known.set(name, read(`--${name}`));
  return known.get(name);
};
export const forgetColours = () => { known = new Map(); };

/** One flat colour per robot, by its place among the robots. */
export const robotColour = (index) => colour(`robot-${index % 8}`);

/** The colour of a reception's verdict: how frames, lanes and the inspector show it. */
export const verdictColour = (verdict) => colour(
  verdict === "delivered" ? "delivered" : verdict === "collision" || verdict === "interference" ? "collision"
    : verdict === "sensed" ? "sensed" : "lost");
