// An arrow from one node to another, given in px.
export function arrow(context, x0, y0, x1, y1, width, gap) {
  const length = Math.hypot(x1 - x0, y1 - y0);
  if (length < 2 * gap + 4) return;
  const ux = (x1 - x0) / length;
  const uy = (y1 - y0) / length;
  const head = Math.min(8 + width * 1.1, length - 2 * gap);
  const wing = 3.5 + width * 0.9;
  const h = width / 2;
  const at = (along, aside) => [x0 + ux * along - uy * aside, y0 + uy * along + ux * aside];
  const end = length - gap;
  const corners = [at(gap, h), at(end - head, h), at(end - head, wing), at(end, 0), at(end - head, -wing), at(end - head, -h), at(gap, -h)];
  context.beginPath();
  corners.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
  context.closePath();
  context.fill();
}
