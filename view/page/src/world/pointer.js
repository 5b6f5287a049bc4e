// Mouse and fingers on a pane: drag moves, wheel or pinch zooms, with the right button or shift the free view
// turns, a click chooses.
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

export function pointer(canvas, store, camera, choose) {
  const held = new Map(); //  pointers that are down: id → {x, y}
  let moved = 0;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };

  const pan = (from, to) => {
    const a = camera.unproject(from.x, from.y);
    const b = camera.unproject(to.x, to.y);
    if (!a || !b) return;
    const key = camera.mode2d ? "map" : "orbit";
    // Far away in the free view one pixel is a long way: never more than a few times the distance.
    const most = camera.mode2d ? Infinity : camera.orbit.distance;
    const shift = (v) => clamp(v, -most, most);
    store.set({ [key]: { ...camera[key], x: camera[key].x + shift(a.x - b.x), y: camera[key].y + shift(a.y - b.y) }, follow: null });
  };
  const rotate = (dx, dy) => {
    const orbit = camera.orbit;
    store.set({ orbit: { ...orbit, yaw: orbit.yaw + dx * 0.006, pitch: clamp(orbit.pitch + dy * 0.006, 0.05, 1.55) } });
  };
  const zoom = (factor, at) => {
    if (!camera.mode2d) {
      store.set({ orbit: { ...camera.orbit, distance: clamp(camera.orbit.distance * factor, 0.3, 1e5) } });
      return;
    }
    const map = camera.map;
    const span = clamp(map.span * factor, 0.2, 1e6);
    const fixed = store.state.follow === null ? camera.unproject(at.x, at.y) : map;
    const share = span / map.span;
    store.set({ map: { x: fixed.x + (map.x - fixed.x) * share, y: fixed.y + (map.y - fixed.y) * share, span } });
  };

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, place(event));
    if (held.size === 1) moved = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const from = held.get(event.pointerId);
    if (!from) return;
    const to = place(event);
    moved += Math.abs(to.x - from.x) + Math.abs(to.y - from.y);
    if (moved < 4) return;
    if (held.size === 2) {
      const other = [...held].find(([id]) => id !== event.pointerId)[1];
      const before = Math.hypot(from.x - other.x, from.y - other.y);
      const after = Math.hypot(to.x - other.x, to.y - other.y);
      if (after > 1) zoom(before / after, { x: (to.x + other.x) / 2, y: (to.y + other.y) / 2 });
    } else if (!camera.mode2d && (event.buttons === 2 || event.shiftKey)) {
      rotate(from.x - to.x, to.y - from.y);
    } else {
      pan(from, to);
    }
    held.set(event.pointerId, to);
  });
  const release = (event) => {
    const from = held.get(event.pointerId);
    held.delete(event.pointerId);
    if (from && event.type === "pointerup" && moved < 4) choose(from.x, from.y);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(Math.exp(clamp(event.deltaY, -200, 200) * (event.deltaMode ? 0.05 : 0.0015)), place(event));
  }, { passive: false });
}
