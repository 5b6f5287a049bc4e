// The ground: a grid in metres, walls, and links between those that hear each other.
import { BoxGeometry, BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, InstancedMesh, LineBasicMaterial, LineSegments, MeshBasicMaterial, MeshLambertMaterial, Object3D } from "three";
import { colour } from "../colours.js";

/** The round step [m] of which `px` pixels or more are one. */
export function stepOf(scale, px = 70) {
  const least = px / scale;
  const power = 10 ** Math.floor(Math.log10(least));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= least * 0.999);
}

const f = Math.fround;

/** Line segments whose number changes: begin(), add(...), end(). Nothing is made but when there is no room. */
export function createSegments(scene, { opacity = 1, depth = true } = {}) {
  let room = 256;
  const geometry = new BufferGeometry();
  const attribute = (name) => {
    const made = new BufferAttribute(new Float32Array(room * 6), 3).setUsage(DynamicDrawUsage);
    geometry.setAttribute(name, made);
    return made;
  };
  let place = attribute("position");
  let shade = attribute("color");
  const lines = new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true, transparent: opacity < 1, opacity, depthTest: depth, depthWrite: false }));
  lines.frustumCulled = false;
  scene.add(lines);
  let count = 0;
  let before = 0;
  let isNew = true;
  const grow = () => {
    const [places, shades] = [place.array, shade.array];
    room *= 2;
    geometry.dispose(); //  or the old buffers stay on the graphics card
    place = attribute("position");
    shade = attribute("color");
    place.array.set(places);
    shade.array.set(shades);
  };
  return {
    lines,
    begin() { count = 0; },
    add(x0, y0, z0, x1, y1, z1, a, b = a) {
      if (count === room) grow();
      const k = count++ * 6;
      const p = place.array;
      const c = shade.array;
      // Stored as 32 bit: compared as such.
      isNew ||= p[k] !== f(x0) || p[k + 1] !== f(y0) || p[k + 3] !== f(x1) || p[k + 4] !== f(y1) || c[k] !== f(a.r) || c[k + 1] !== f(a.g) || c[k + 3] !== f(b.r);
      p[k] = x0; p[k + 1] = y0; p[k + 2] = z0; p[k + 3] = x1; p[k + 4] = y1; p[k + 5] = z1;
      c[k] = a.r; c[k + 1] = a.g; c[k + 2] = a.b; c[k + 3] = b.r; c[k + 4] = b.g; c[k + 5] = b.b;
    },
    /** Whether anything is another than before: only then it is sent to the graphics card. */
    end() {
      const changed = isNew || count !== before;
      isNew = false;
      before = count;
      if (!changed) return false;
      geometry.setDrawRange(0, count * 2);
      lines.visible = count > 0;
      place.clearUpdateRanges();
      shade.clearUpdateRanges();
      place.addUpdateRange(0, count * 6);
      shade.addUpdateRange(0, count * 6);
      place.needsUpdate = true;
      shade.needsUpdate = true;
      return true;
    },
  };
}

const along = (from, to, share) => from + share * (to - from);

/** The grid of what the camera sees; its step for the labels. */
export function createGrid(scene) {
  const segments = createSegments(scene);
  segments.lines.renderOrder = -10;
  const shade = new Color();
  let drawn = "";
  const grid = {
    step: 1, x0: 0, x1: 0, y0: 0, y1: 0,
    recolour() { shade.set(colour("grid")); drawn = ""; },
    draw(camera) {
      const { map, orbit, mode2d, width, height } = camera;
      const centre = mode2d ? map : orbit;
      const scale = mode2d ? width / map.span : height / (0.83 * orbit.distance);
      const step = stepOf(scale);
      const [w, h] = mode2d ? [map.span / 2, (map.span * height) / width / 2] : [orbit.distance * 3, orbit.distance * 3];
      const part = (low) => Math.floor(low / step) * step;
      Object.assign(grid, { step, x0: part(centre.x - w), x1: centre.x + w + step, y0: part(centre.y - h), y1: centre.y + h + step });
      const key = [step, grid.x0, grid.x1, grid.y0, grid.y1, mode2d].join();
      if (key === drawn) return false;
      drawn = key;
      segments.begin();
      // In the free view in parts: what is behind the eye is then left out as a whole.
      const parts = mode2d ? 1 : 12;
      for (let k = Math.round(grid.x0 / step); k * step <= grid.x1; k++) {
        for (let j = 0; j < parts; j++) segments.add(k * step, along(grid.y0, grid.y1, j / parts), 0, k * step, along(grid.y0, grid.y1, (j + 1) / parts), 0, shade);
      }
      for (let k = Math.round(grid.y0 / step); k * step <= grid.y1; k++) {
        for (let j = 0; j < parts; j++) segments.add(along(grid.x0, grid.x1, j / parts), k * step, 0, along(grid.x0, grid.x1, (j + 1) / parts), k * step, 0, shade);
      }
      return segments.end();
    },
  };
  return grid;
}

export function createWalls(scene, walls) {
  const geometry = new BoxGeometry(1, 1, 1);
  const looks = { map: new MeshBasicMaterial(), free: new MeshLambertMaterial() };
  // One mesh for all of them: a map has thousands.
  const mesh = new InstancedMesh(geometry, looks.map, walls.length);
  mesh.frustumCulled = false;
  const place = new Object3D();
  for (const [i, wall] of walls.entries()) {
    const high = wall.height || 1;
    place.position.set(wall.x, wall.y, high / 2);
    place.rotation.z = wall.yaw;
    place.scale.set(wall.length_x, wall.length_y, high);
    place.updateMatrix();
    mesh.setMatrixAt(i, place.matrix);
  }
  scene.add(mesh);
  return {
    recolour() { for (const look of Object.values(looks)) look.color.set(colour("wall")); },
    draw({ mode2d }) { mesh.material = mode2d ? looks.map : looks.free; },
  };
}
