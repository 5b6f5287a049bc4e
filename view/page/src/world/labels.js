// Names that do not overlap: the more important ones first, each where there is room beside its agent.
const high = 15; //  px of a line

export function createLabels() {
  const widths = new Map();
  let taken = new Float64Array(4 * 256);
  let count = 0;
  const isFree = (x, y, w) => {
    for (let k = 0; k < count; k += 4) {
      if (x < taken[k + 2] && x + w > taken[k] && y < taken[k + 3] && y + high > taken[k + 1]) return false;
    }
    return true;
  };
  const take = (x0, y0, x1, y1) => {
    if (count + 4 > taken.length) return;
    taken[count++] = x0; taken[count++] = y0; taken[count++] = x1; taken[count++] = y1;
  };
  return {
    begin() { count = 0; },
    /** Room that no label may have: marks, legends. */
    keep: take,
    /** Draws agents' names. @param order  places in `agents`, the most important first. @param radius  px around a place. */
    draw(context, { width, height }, agents, order, spots, radius, ink, halo) {
      context.font = "12px system-ui, 'Liberation Sans', 'DejaVu Sans', sans-serif";
      context.textBaseline = "middle";
      context.lineJoin = "round";
      context.lineWidth = 3;
      context.strokeStyle = halo;
      context.fillStyle = ink;
      for (const slot of order) {
        const x = spots[slot * 2];
        const y = spots[slot * 2 + 1];
        if (!(x > -20 && y > -20 && x < width + 20 && y < height + 20)) continue;
        const name = agents[slot].name;
        let w = widths.get(name);
        if (w === undefined) widths.set(name, w = Math.ceil(context.measureText(name).width) + 2);
        const r = radius(slot) + 3;
        // Right, left, above, below.
        const at = [[x + r, y - high / 2], [x - r - w, y - high / 2], [x - w / 2, y - r - high], [x - w / 2, y + r]]
          .find(([left, top]) => isFree(left, top, w));
        if (!at) continue;
        take(at[0], at[1], at[0] + w, at[1] + high);
        context.strokeText(name, at[0] + 1, at[1] + high / 2);
        context.fillText(name, at[0] + 1, at[1] + high / 2);
      }
    },
  };
}
