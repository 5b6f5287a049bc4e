// Movables: boxes, cylinders and spheres that are pushed about, as they lie.
import { BoxGeometry, CylinderGeometry, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, Quaternion, SphereGeometry, Vector3 } from "three";
import { movableAt } from "../at.js";
import { colour } from "../colours.js";

// Of size 1 along each axis.
const geometries = {
  box: new BoxGeometry(1, 1, 1),
  cylinder: new CylinderGeometry(0.5, 0.5, 1, 24).rotateX(Math.PI / 2), //  axis up
  sphere: new SphereGeometry(0.5, 24, 16),
};

/** @param movables  world.movables; where the record has no pose they are where they began. */
export function createMovables(scene, movables) {
  const looks = { map: new MeshBasicMaterial({ transparent: true, opacity: 0.8 }), free: new MeshLambertMaterial() };
  const meshes = movables.map((one) => {
    const mesh = new Mesh(geometries[one.form], looks.map);
    mesh.matrixAutoUpdate = false;
    scene.add(mesh);
    return mesh;
  });
  const [place, turn, before] = [new Vector3(), new Quaternion(), new Matrix4()];
  function put(one, mesh, pose) {
    const half = (one.yaw ?? 0) / 2;
    const { x, y, z, q } = pose ?? { x: one.x ?? 0, y: one.y ?? 0, z: one.z ?? 0, q: [Math.cos(half), 0, 0, Math.sin(half)] };
    before.copy(mesh.matrix);
    mesh.matrix.compose(place.set(x, y, z), turn.set(q[1], q[2], q[3], q[0]), mesh.scale.set(one.length_x, one.length_y, one.length_z));
    mesh.matrixWorldNeedsUpdate = true;
    return !before.equals(mesh.matrix);
  }
  return {
    count: meshes.length,
    recolour() { for (const look of Object.values(looks)) look.color.set(colour("wall")); },
    /** @return whether any is where it was not before. */
    draw(pieces, t, period, { mode2d }) {
      let changed = false;
      meshes.forEach((mesh, number) => {
        mesh.material = mode2d ? looks.map : looks.free;
        changed = put(movables[number], mesh, movableAt(pieces, number, t, period)) || changed;
      });
      return changed;
    },
  };
}
