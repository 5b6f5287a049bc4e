// Markers of very many agents, drawn by the graphics card in one go: flat discs of one size on the pane, with a
// tick ahead of robots. Fewer agents have theirs drawn over the scene (marks.js).
import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Points, ShaderMaterial } from "three";
import { colour, robotColour } from "../colours.js";
import { createSegments } from "./ground.js";

const halo = 1.25; //  px of ground round a disc, so that discs that touch can be told apart
const tick = 3; //     px

const material = () => new ShaderMaterial({
  uniforms: { ground: { value: new Color() }, ratio: { value: 1 } },
  vertexShader: `
    attribute vec3 shade;
    attribute float radius;
    uniform float ratio;
    varying vec3 inside;
    varying float rim;
    void main() {
      inside = shade;
      rim = radius / (radius + ${halo.toFixed(2)});
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      gl_PointSize = 2.0 * ratio * (radius + ${halo.toFixed(2)});
    }`,
  fragmentShader: `
    uniform vec3 ground;
    varying vec3 inside;
    varying float rim;
    void main() {
      float away = 2.0 * length(gl_PointCoord - 0.5);
      if (away > 1.0) discard;
      gl_FragColor = vec4(away > rim ? ground : inside, 1.0);
      #include <colorspace_fragment>
    }`,
  depthTest: false,
  depthWrite: false,
});

export function createDots(scene, world) {
  const agents = world.agents;
  const geometry = new BufferGeometry();
  const attribute = (name, size) => {
    const made = new BufferAttribute(new Float32Array(agents.length * size), size).setUsage(DynamicDrawUsage);
    geometry.setAttribute(name, made);
    return made;
  };
  const place = attribute("position", 3);
  const shade = attribute("shade", 3);
  const radius = attribute("radius", 1);
  const points = new Points(geometry, material());
  points.frustumCulled = false;
  points.renderOrder = 5;
  scene.add(points);
  const ticks = createSegments(scene, { depth: false });
  ticks.lines.renderOrder = 4;
  const ink = new Color();
  const colours = agents.map(() => new Color());
  // Robots are drawn over what stands still.
  const order = agents.map((agent, slot) => slot).sort((a, b) =>
    (agents[a].kind === "robot" ? 1 : 0) - (agents[b].kind === "robot" ? 1 : 0) || a - b);
  let before = 0;

  return {
    recolour() {
      const robots = agents.filter((agent) => agent.kind === "robot");
      const index = new Map(robots.map((agent, k) => [agent.agent, k]));
      agents.forEach((agent, slot) => colours[slot].set(agent.kind === "robot" ? robotColour(index.get(agent.agent)) : colour("mote")));
      ink.set(colour("ink"));
      points.material.uniforms.ground.value.set(colour("ground"));
      before = -1;
    },
    /** Whether anything is to be drawn that is another than before. */
    draw(poses, camera, marks, ratio) {
      points.material.uniforms.ratio.value = ratio;
      let count = 0;
      let changed = false;
      ticks.begin();
      for (const slot of order) {
        if (!marks.isMarked(slot) || !marks.sizes[slot] || !marks.isInside(camera, slot, 12)) continue;
        const [x, y] = [poses.x[slot], poses.y[slot]];
        const k = count * 3;
        changed ||= place.array[k] !== Math.fround(x) || place.array[k + 1] !== Math.fround(y);
        place.array[k] = x;
        place.array[k + 1] = y;
        place.array[k + 2] = 0;
        const c = colours[slot];
        shade.array[k] = c.r;
        shade.array[k + 1] = c.g;
        shade.array[k + 2] = c.b;
        const r = marks.radiusOf(slot);
        radius.array[count++] = r;
        if (agents[slot].kind !== "robot") continue;
        const metre = 1 / marks.sizes[slot];
        const [ux, uy] = [Math.cos(poses.theta[slot]) * metre, Math.sin(poses.theta[slot]) * metre];
        ticks.add(x + ux * r, y + uy * r, 0, x + ux * (r + tick), y + uy * (r + tick), 0, ink);
      }
      changed = ticks.end() || changed || count !== before;
      before = count;
      geometry.setDrawRange(0, count);
      points.visible = count > 0;
      if (changed) for (const one of [place, shade, radius]) one.needsUpdate = true;
      return changed;
    },
  };
}
