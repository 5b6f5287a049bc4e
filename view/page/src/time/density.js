// How many of something there were, for each pixel of a lane.
import { colour } from "../colours.js";

/** Counts by pixel that are filled in by time: put(t, count, lost). */
export function createDensity(box, scale) {
  const counts = new Float64Array(box.width);
  const lost = new Float64Array(box.width);
  return {
    counts, lost,
    put(t, count, ofThemLost = 0) {
      const x = Math.floor(scale.x(t) - box.x);
      if (x < 0 || x >= box.width) return;
      counts[x] += count;
      lost[x] += ofThemLost;
    },
    /** A summary's count of a bin, spread over the pixels that the bin is wide. */
    spread(from, to, count, ofThemLost = 0) {
      const first = Math.floor(scale.x(from) - box.x);
      const last = Math.max(first + 1, Math.floor(scale.x(to) - box.x));
      for (let x = Math.max(0, first); x < Math.min(last, box.width); x++) {
        counts[x] += count / (last - first);
        lost[x] += ofThemLost / (last - first);
      }
    },
  };
}

/** As heights that grow with the root of the count, those that were lost in front. */
export function drawDensity(ctx, box, counts, lost, name) {
  let most = 0;
  for (const count of counts) most = Math.max(most, count);
  if (!most) return;
  const bar = (x, count) => {
    const height = Math.max(1, (box.height - 4) * Math.sqrt(count / most));
    ctx.fillRect(box.x + x, box.y + box.height - height, 1, height);
  };
  for (let x = 0; x < counts.length; x++) {
    if (!counts[x]) continue;
    ctx.fillStyle = colour(name);
    bar(x, counts[x]);
    if (!lost[x]) continue;
    ctx.fillStyle = colour("collision");
    bar(x, Math.min(counts[x], lost[x]));
  }
}
