// Plots of the world seen from above: metres along both axes, to one scale.
import { axisBottom, axisLeft } from "d3-axis";
import { extent } from "d3-array";
import { scaleLinear } from "d3-scale";
import { create } from "d3-selection";

const kWidth = 520;  // px of the view box
const kMargin = { top: 10, right: 12, bottom: 40, left: 52 };
let clips = 0;

/** Corners of a wall, as places [[x, y], ...]. */
export const corners = (w) => [[-1, -1], [-1, 1], [1, -1], [1, 1]].map(([i, j]) => {
  const [u, v] = [i * w.length_x / 2, j * w.length_y / 2];
  return [w.x + u * Math.cos(w.yaw) - v * Math.sin(w.yaw),
          w.y + u * Math.sin(w.yaw) + v * Math.cos(w.yaw)];
});

/** The square around places.
 *  @param share  of its side, kept free on each side
 *  @param least  m, kept free at least */
export function square_around(places, share, least = 1) {
  const [x0, x1] = extent(places, (p) => p[0]);
  const [y0, y1] = extent(places, (p) => p[1]);
  const side = Math.max(x1 - x0, y1 - y0);
  const half = side / 2 + Math.max(least, share * side);
  const [x, y] = [(x0 + x1) / 2, (y0 + y1) / 2];
  return { x0: x - half, x1: x + half, y0: y - half, y1: y + half };
}

/** An empty map of a window {x0, x1, y0, y1}: scales x and y, a layer that is cut off at its edges
 *  and one that is not. */
export function map(parent, label, window) {
  const side = kWidth - kMargin.left - kMargin.right;
  const height = side + kMargin.top + kMargin.bottom;
  const svg = parent.append(() => create("svg").node())
    .attr("viewBox", `0 0 ${kWidth} ${height}`).attr("role", "img").attr("aria-label", label);
  const x = scaleLinear([window.x0, window.x1], [kMargin.left, kMargin.left + side]);
  const y = scaleLinear([window.y0, window.y1], [kMargin.top + side, kMargin.top]);
  const bottom = kMargin.top + side;
  svg.append("g").attr("transform", `translate(0,${bottom})`).call(axisBottom(x).ticks(6).tickSizeOuter(0));
  svg.append("g").attr("transform", `translate(${kMargin.left},0)`).call(axisLeft(y).ticks(6).tickSizeOuter(0));
  svg.append("text").attr("class", "muted").attr("text-anchor", "middle")
    .attr("x", kMargin.left + side / 2).attr("y", height - 6).text("x / m");
  svg.append("text").attr("class", "muted").attr("text-anchor", "middle")
    .attr("transform", `translate(13,${kMargin.top + side / 2}) rotate(-90)`).text("y / m");
  const clip = `clip-${clips++}`;
  svg.append("clipPath").attr("id", clip).append("rect").attr("x", kMargin.left)
    .attr("y", kMargin.top).attr("width", side).attr("height", side);
  const inside = svg.append("g").attr("clip-path", `url(#${clip})`);
  const metre = side / (window.x1 - window.x0);  // px
  return { svg, x, y, metre, inside, above: svg.append("g") };
}

export function draw_walls(on, walls) {
  on.inside.selectAll(".wall").data(walls).join("rect").attr("class", "wall")
    .attr("width", (w) => Math.max(2, w.length_x * on.metre))
    .attr("height", (w) => Math.max(2, w.length_y * on.metre))
    .attr("transform", (w) => `translate(${on.x(w.x)},${on.y(w.y)}) rotate(${-w.yaw * 180 / Math.PI})
      translate(${-Math.max(2, w.length_x * on.metre) / 2},${-Math.max(2, w.length_y * on.metre) / 2})`)
    .append("title").text((w) => w.name);
}

export function draw_robot(layer, x, y, name) {
  layer.append("path").attr("class", "robot").attr("d", "M0,-7L7,0L0,7L-7,0Z")
    .attr("transform", `translate(${x},${y})`).append("title").text(name);
}
