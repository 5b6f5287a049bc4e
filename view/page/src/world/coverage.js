// The radio coverage of the access points: a coloured grid on the ground, and its legend.
import { DataTexture, Mesh, MeshBasicMaterial, NearestFilter, PlaneGeometry, SRGBColorSpace } from "three";
import { pixelsOf } from "./coverage_pixels.js";

export function createCoverage(scene, run) {
  let mesh = null;
  let drawn = null;

  function make(map) {
    const [width, height] = [map.columns * map.step, map.rows * map.step];
    mesh = new Mesh(new PlaneGeometry(width, height), new MeshBasicMaterial({ transparent: true, opacity: 0.8, depthWrite: false }));
    mesh.position.set(map.x + width / 2, map.y + height / 2, 0.002);
    mesh.renderOrder = -9;
    scene.add(mesh);
  }

  function paint(map, layer) {
    const texture = new DataTexture(pixelsOf(map, layer), map.columns, map.rows);
    texture.magFilter = texture.minFilter = NearestFilter;
    texture.colorSpace = SRGBColorSpace;
    texture.needsUpdate = true;
    mesh.material.map?.dispose();
    mesh.material.map = texture;
    mesh.material.needsUpdate = true;
  }

  const coverage = {
    layer: "rssi", //  which of the map's layers is shown
    /** The map; {error} if there is none; null until it has come. */
    map: () => run.coverage(),
    /** Whether it looks another than before. */
    draw({ layers }) {
      const map = layers.coverage ? coverage.map() : null;
      const layer = map?.layers?.find(({ name }) => name === coverage.layer) ?? null;
      if (layer === drawn) return false;
      drawn = layer;
      if (layer && !mesh) make(map);
      if (layer) paint(map, layer);
      if (mesh) mesh.visible = layer !== null;
      return true;
    },
  };
  return coverage;
}

/** The legend over the pane: which layer, what its colours mean. @return  draw(state) */
export function createLegend(pane, coverage, store) {
  const box = document.createElement("div");
  box.className = "coverage";
  box.hidden = true;
  pane.append(box);
  let told = null;

  function entry(label, shade) {
    const row = document.createElement("div");
    const sample = document.createElement("i");
    sample.style.background = shade;
    row.append(sample, label);
    box.append(row);
  }

  function tell(map) {
    box.replaceChildren();
    if (map.error) { box.append(map.error); return; }
    const select = document.createElement("select");
    for (const { name, title } of map.layers) select.add(new Option(title, name, false, name === coverage.layer));
    select.title = `${map.height} m above the ground; mean power, no interference`;
    select.addEventListener("change", () => {
      coverage.layer = select.value;
      told = null;
      store.set({ layers: { ...store.state.layers } });
    });
    box.append(select);
    const { classes, cells } = map.layers.find(({ name }) => name === coverage.layer);
    const used = new Set(cells);
    for (let which = classes.length - 1; which >= 0; which--) {
      if (used.has(which)) entry(classes[which].label, classes[which].colour);
    }
    if (used.has(-1)) entry("not covered", "transparent");
  }

  return ({ layers }) => {
    const map = layers.coverage ? coverage.map() : null;
    box.hidden = !map;
    if (!map || told === map) return;
    told = map;
    tell(map);
  };
}
