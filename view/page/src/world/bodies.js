// Bodies as instances: one mesh per solid of a shape and per kind of wheel, however many agents have it.
// world.shapes[NAME] is {radius, height, cylinders, boxes, wheels}, as the robot files describe them: upright,
// body frame, m and rad, z of the middle.
import { BoxGeometry, Color, CylinderGeometry, Float32BufferAttribute, InstancedMesh, Matrix4, MeshBasicMaterial, MeshLambertMaterial } from "three";
import { wheelAngle } from "../at.js";
import { colour, robotColour } from "../colours.js";

const many = 200; //     agents from which bodies have fewer corners
const withWheels = 7; //  px of radius from which wheels are seen to turn

// What a shape is made of, each with the matrix that brings the unit solid into the body's frame.
function solidsOf({ cylinders = [], boxes = [], radius, height }) {
  const solid = (kind, { x, y, z, yaw = 0 }, scale) => ({
    kind, matrix: new Matrix4().makeTranslation(x, y, z).multiply(new Matrix4().makeRotationZ(yaw)).multiply(scale),
  });
  const round = (one) => solid("cylinder", one, new Matrix4().makeScale(one.radius, one.radius, one.height));
  const made = [...cylinders.map(round),
    ...boxes.map((one) => solid("box", one, new Matrix4().makeScale(one.length_x, one.length_y, one.length_z)))];
  return made.length ? made : [round({ x: 0, y: 0, z: height / 2, radius, height })];
}

const cylinder = (sides) => new CylinderGeometry(1, 1, 1, sides).rotateX(Math.PI / 2); //  axis up

// A drum of dark and light sectors, so that its turning is seen.
function drum() {
  const geometry = cylinder(12).toNonIndexed();
  const place = geometry.getAttribute("position");
  const colours = [];
  for (let face = 0; face < place.count; face += 3) {
    let x = 0;
    let y = 0;
    for (let k = face; k < face + 3; k++) { x += place.getX(k); y += place.getY(k); }
    const sector = Math.floor(((Math.atan2(y, x) + Math.PI) * 12) / (2 * Math.PI)) % 4 < 2;
    for (let k = 0; k < 9; k++) colours.push(sector ? 0.12 : 0.9);
  }
  geometry.setAttribute("color", new Float32BufferAttribute(colours, 3));
  return geometry;
}
const geometries = { cylinder: cylinder(28), plain: cylinder(10), box: new BoxGeometry(1, 1, 1), wheel: drum() };

// On the map a body is one flat colour, with its wheels drawn over it as on a plan; in the free view it has
// light and shade, and near by it is glass, because many robots' wheels are inside.
const materials = {
  map: { body: new MeshBasicMaterial(), wheel: new MeshBasicMaterial({ vertexColors: true, depthTest: false }) },
  far: { body: new MeshLambertMaterial(), wheel: new MeshLambertMaterial({ vertexColors: true }) },
  near: { body: new MeshLambertMaterial({ transparent: true, opacity: 0.75, depthWrite: false }),
    wheel: new MeshLambertMaterial({ vertexColors: true }) },
};

export function createBodies(scene, world) {
  const groups = [];
  const robots = world.agents.filter((agent) => agent.kind === "robot").map((agent) => agent.agent);
  for (const [name, shape] of Object.entries(world.shapes ?? {})) {
    const slots = world.agents.flatMap((agent, slot) => (agent.shape === name ? [slot] : []));
    if (!slots.length) continue;
    const add = (kind, count) => {
      const mesh = new InstancedMesh(geometries[kind === "cylinder" && world.agents.length > many ? "plain" : kind], materials.map.body, count);
      mesh.frustumCulled = false; //  its instances are all over the place
      mesh.count = 0;
      scene.add(mesh);
      return mesh;
    };
    const wheels = (shape.wheels ?? []).filter((wheel) => wheel.radius > 0);
    const solids = solidsOf(shape).map((solid) => ({ ...solid, mesh: add(solid.kind, slots.length) }));
    groups.push({ drawn: 0, shape, slots, solids, wheels, rims: wheels.length ? add("wheel", slots.length * wheels.length) : null });
  }
  const colours = world.agents.map(() => new Color());

  const pose = new Matrix4();
  const made = new Matrix4();
  const part = new Matrix4();

  function setPose(poses, slot) {
    const c = Math.cos(poses.theta[slot]);
    const s = Math.sin(poses.theta[slot]);
    pose.set(c, -s, 0, poses.x[slot], s, c, 0, poses.y[slot], 0, 0, 1, 0, 0, 0, 0, 1);
  }

  // Columns: two spokes and the axle. Turning by a positive angle about the axle, right-handed, the top of the
  // wheel goes where it rolls: to the right of the axle.
  function setWheel({ x, y, heading, radius: r, width }, angle) {
    const [c, s] = [Math.cos(heading), Math.sin(heading)];
    const [a, b] = [r * Math.cos(angle), r * Math.sin(angle)];
    part.set(a * s, -b * s, width * c, x, -a * c, b * c, width * s, y, -b, -a, 0, r, 0, 0, 0, 1);
  }

  function drawGroup(group, poses, camera, marks) {
    let bodies = 0;
    let rims = 0;
    for (const slot of group.slots) {
      if (marks.isMarked(slot) || !marks.isInside(camera, slot, marks.radiusOf(slot) * 4)) continue;
      const radius = marks.radiusOf(slot);
      setPose(poses, slot);
      for (const { mesh, matrix } of group.solids) {
        mesh.setMatrixAt(bodies, made.multiplyMatrices(pose, matrix));
        mesh.setColorAt(bodies, colours[slot]);
      }
      bodies++;
      if (radius < withWheels) continue;
      for (const wheel of group.wheels) {
        setWheel(wheel, wheelAngle(wheel, poses.ahead[slot], poses.aside[slot], poses.turned[slot]));
        group.rims.setMatrixAt(rims++, made.multiplyMatrices(pose, part));
      }
    }
    const look = materials[camera.mode2d ? "map" : rims > 0 && bodies <= 12 ? "near" : "far"];
    for (const { mesh } of group.solids) update(mesh, bodies, look.body, 0);
    if (group.rims) update(group.rims, rims, look.wheel, camera.mode2d ? 1 : -1);
    const changed = bodies + group.drawn > 0;
    group.drawn = bodies;
    return changed;
  }

  function update(mesh, count, material, order) {
    mesh.material = material;
    mesh.renderOrder = order;
    mesh.count = count;
    mesh.visible = count > 0;
    if (!count) return;
    mesh.instanceMatrix.needsUpdate = true;
    if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
  }

  return {
    recolour() {
      world.agents.forEach((agent, slot) => {
        colours[slot].set(agent.kind === "robot" ? robotColour(robots.indexOf(agent.agent)) : colour("mote"));
      });
    },
    /** @param marks  tell where agents are in the pane, and which are so small that a marker stands for them. */
    draw(poses, camera, marks) {
      let changed = false;
      for (const group of groups) changed = drawGroup(group, poses, camera, marks) || changed;
      return changed;
    },
  };
}
