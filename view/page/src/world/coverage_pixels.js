// The colours of a map of coverage, as the server answers it at /api/runs/R/coverage.

/** RGBA of the cells of a layer, row by row from the lower corner; transparent where nothing is received. */
export function pixelsOf({ columns, rows }, { classes, cells }) {
  const pixels = new Uint8Array(4 * columns * rows);
  const colours = classes.map(({ colour }) => [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16)));
  cells.forEach((which, cell) => {
    if (which >= 0) pixels.set([...colours[which], 255], 4 * cell);
  });
  return pixels;
}
