// The eye on the world: a map (orthographic, north up) or free 3-D (an orbit around a place on the ground).
//   const camera = createCamera(); camera.aim(state, width, height, bounds, place); camera.project(x, y, z, out)
// Where it looks stands in the store: `map` {x, y, span [m]} and `orbit` {x, y, distance [m], yaw, pitch}.
import { OrthographicCamera, PerspectiveCamera, Vector3 } from "three";

const fieldOfView = 45; //  degrees, from top to bottom
const up = new Vector3(0, 0, 1);

const frame = { left: 34, right: 44, top: 46, bottom: 32 }; //  px that buttons, names and metres take

const least = 2; //  m across, however little there is

/** The map that shows all, clear of what lies over it. */
export function wholeMap(bounds, width, height) {
  const w = Math.max(bounds.x1 - bounds.x0, least);
  const h = Math.max(bounds.y1 - bounds.y0, least);
  const free = { x: Math.max(50, width - frame.left - frame.right), y: Math.max(50, height - frame.top - frame.bottom) };
  const metres = Math.max(w / free.x, h / free.y); //  per px
  return {
    x: (bounds.x0 + bounds.x1) / 2 + ((frame.right - frame.left) / 2) * metres,
    y: (bounds.y0 + bounds.y1) / 2 + ((frame.top - frame.bottom) / 2) * metres,
    span: metres * width,
  };
}

/**
 * The orbit from the south that shows all, as near as that goes: each corner of what is to be seen is
 * |across| / tan(half the field) in front of the eye at least.
 */
export function wholeOrbit(bounds, width, height) {
  const [yaw, pitch] = [-Math.PI / 2, 0.75];
  const x = (bounds.x0 + bounds.x1) / 2;
  const y = (bounds.y0 + bounds.y1) / 2;
  const [w, h] = [Math.max(bounds.x1 - bounds.x0, least) / 2, Math.max(bounds.y1 - bounds.y0, least) / 2];
  const free = { x: Math.max(50, width - frame.left - frame.right), y: Math.max(50, height - frame.top - frame.bottom) };
  const tangent = Math.tan((fieldOfView * Math.PI) / 360);
  const [across, upwards] = [(tangent * free.x) / height, (tangent * free.y) / height];
  let distance = 0.3;
  for (const north of [-h, h]) {
    const ahead = north * Math.cos(pitch); //  of the middle, as the eye looks
    distance = Math.max(distance, w / across - ahead, (Math.abs(north) * Math.sin(pitch)) / upwards - ahead);
  }
  return { x, y, yaw, pitch, distance };
}

/** The orbit that shows about what a map does. */
export const orbitOf = (map, width, height) => ({
  x: map.x, y: map.y, yaw: -Math.PI / 2, pitch: 0.75,
  distance: (0.95 * map.span * height) / width / (2 * Math.tan((fieldOfView * Math.PI) / 360)),
});

export function createCamera() {
  const flat = new OrthographicCamera();
  const free = new PerspectiveCamera(fieldOfView, 1, 0.1, 1000);
  flat.up.set(0, 1, 0);
  free.up.copy(up);
  const target = new Vector3();
  const camera = {
    eye: flat, width: 1, height: 1, mode2d: true, map: null, orbit: null,
    clearTop: 40, //  px from the top down that words take at the left: no metres are written there

    /** @param place  {x, y} of the agent that is followed, or null. */
    aim(state, width, height, bounds, place) {
      Object.assign(camera, { width, height, mode2d: state.mode2d });
      camera.map = state.map ?? wholeMap(bounds, width, height);
      if (place) camera.map = { ...camera.map, x: place.x, y: place.y };
      camera.orbit = state.orbit ?? (state.map ? orbitOf(camera.map, width, height) : wholeOrbit(bounds, width, height));
      if (place) camera.orbit = { ...camera.orbit, x: place.x, y: place.y };
      if (state.mode2d) aimFlat(camera.map); else aimFree(camera.orbit);
      camera.eye.updateMatrixWorld();
      camera.eye.updateProjectionMatrix();
      if (!state.mode2d) matrix.set(multiply(free.projectionMatrix.elements, free.matrixWorldInverse.elements));
    },

    /** Where a place is in the pane [px]: out[0], out[1]; out[2]: px per metre there, 0 behind the eye. */
    project(x, y, z, out) {
      if (camera.mode2d) {
        const scale = camera.width / camera.map.span;
        out[0] = camera.width / 2 + (x - camera.map.x) * scale;
        out[1] = camera.height / 2 - (y - camera.map.y) * scale;
        out[2] = scale;
        return out;
      }
      const w = matrix[3] * x + matrix[7] * y + matrix[11] * z + matrix[15];
      const seen = w > 0.05;
      out[0] = seen ? (camera.width / 2) * (1 + (matrix[0] * x + matrix[4] * y + matrix[8] * z + matrix[12]) / w) : -1e4;
      out[1] = seen ? (camera.height / 2) * (1 - (matrix[1] * x + matrix[5] * y + matrix[9] * z + matrix[13]) / w) : -1e4;
      out[2] = seen ? camera.height / (2 * Math.tan((fieldOfView * Math.PI) / 360) * w) : 0;
      return out;
    },

    /** The place on the ground under a point of the pane; null: the sky. */
    unproject(px, py) {
      if (camera.mode2d) {
        const scale = camera.width / camera.map.span;
        return { x: camera.map.x + (px - camera.width / 2) / scale, y: camera.map.y - (py - camera.height / 2) / scale };
      }
      const far = new Vector3((2 * px) / camera.width - 1, 1 - (2 * py) / camera.height, 0.5).unproject(free);
      const t = free.position.z / (free.position.z - far.z);
      if (!(t > 0)) return null;
      return { x: free.position.x + t * (far.x - free.position.x), y: free.position.y + t * (far.y - free.position.y) };
    },
  };
  const matrix = new Float64Array(16);

  function aimFlat({ x, y, span }) {
    camera.eye = flat;
    const high = (span * camera.height) / camera.width;
    Object.assign(flat, { left: -span / 2, right: span / 2, top: high / 2, bottom: -high / 2, near: 0.1, far: 2000 });
    flat.position.set(x, y, 1000);
    flat.lookAt(target.set(x, y, 0));
  }

  function aimFree({ x, y, distance, yaw, pitch }) {
    camera.eye = free;
    Object.assign(free, { aspect: camera.width / camera.height, near: Math.max(0.01, distance / 200), far: distance * 60 + 100 });
    // yaw: the direction in which the eye is, seen from what it looks at; -pi/2 is south.
    const away = distance * Math.cos(pitch);
    free.position.set(x + away * Math.cos(yaw), y + away * Math.sin(yaw), distance * Math.sin(pitch));
    free.lookAt(target.set(x, y, 0));
  }

  return camera;
}

function multiply(a, b) {
  const out = new Float64Array(16);
  for (let column = 0; column < 4; column++) {
    for (let row = 0; row < 4; row++) {
      for (let k = 0; k < 4; k++) out[column * 4 + row] += a[k * 4 + row] * b[column * 4 + k];
    }
  }
  return out;
}
