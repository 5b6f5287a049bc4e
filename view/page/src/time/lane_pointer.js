// What the mouse, the wheel and fingers do on the time axis.
import { exact, kept, zoomed } from "./scale.js";

const moved = 4; //  px: more than that is a drag

export function pointer(canvas, tip, here, store, source, axisHeight) {
  const fingers = new Map();
  let drag = null;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const within = (t) => Math.round(Math.min(Math.max(0, t), source.end));
  const hitAt = (x, y) => here.hits.findLast(({ x0, x1, y0, y1 }) => x >= x0 && x <= x1 && y >= y0 && y <= y1);

  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const [x] = place(event);
    if (x < here.left || event.shiftKey) here.scroll += event.deltaY + event.deltaX;
    else if (Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
      const shift = event.deltaX * here.scale.perPixel;
      store.set({ view: kept(here.view().map((t) => t + shift), source.end) });
      return;
    } else {
      store.set({ view: zoomed(here.view(), here.scale.t(x), 1.0015 ** event.deltaY, source.end) });
      return;
    }
    store.set({ view: [...here.view()] });
  }, { passive: false });

  canvas.addEventListener("pointerdown", (event) => {
    const [x, y] = place(event);
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, x);
    drag = { x, y, view: here.view(), scroll: here.scroll, scale: here.scale, scrubs: y < axisHeight && x >= here.left, far: false,
      apart: fingers.size === 2 ? Math.abs([...fingers.values()].reduce((a, b) => a - b)) : null };
    if (drag.scrubs) store.set({ t: within(here.scale.t(x)), playing: false });
  });

  canvas.addEventListener("pointermove", (event) => {
    const [x, y] = place(event);
    if (!drag) { point(x, y); return; }
    fingers.set(event.pointerId, x);
    drag.far ||= Math.hypot(x - drag.x, y - drag.y) > moved;
    if (!drag.far) return;
    if (drag.scrubs) store.set({ t: within(drag.scale.t(x)), playing: false });
    else if (fingers.size === 2 && drag.apart) {
      const [a, b] = [...fingers.values()];
      store.set({ view: zoomed(drag.view, drag.scale.t((a + b) / 2), drag.apart / Math.max(10, Math.abs(a - b)), source.end) });
    } else {
      here.scroll = drag.scroll - (y - drag.y);
      const shift = (drag.x - x) * drag.scale.perPixel;
      store.set({ view: kept(drag.view.map((t) => t + shift), source.end) });
    }
  });

  const up = (event) => {
    fingers.delete(event.pointerId);
    const [x, y] = place(event);
    if (drag && !drag.far && !drag.scrubs) choose(x, y);
    if (fingers.size === 0) drag = null;
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", () => { fingers.clear(); drag = null; });
  canvas.addEventListener("pointerleave", () => { tip.hidden = true; });

  function choose(x, y) {
    const hit = hitAt(x, y);
    if (hit?.action) hit.action();
    else if (hit?.chosen) {
      const chosen = { ...hit.chosen, run: store.state.run };
      const patch = { chosen };
      if (chosen.kind === "message") patch.followed = { run: chosen.run, sender: chosen.sender, id: chosen.id, at: chosen.at };
      if (chosen.at !== undefined || hit.t !== undefined) Object.assign(patch, { t: hit.t ?? chosen.at, playing: false });
      store.set(patch);
    } else if (x >= here.left) store.set({ t: within(here.scale.t(x)), playing: false });
  }

  function point(x, y) {
    const hit = hitAt(x, y);
    const text = hit?.text ?? (x >= here.left && here.scale ? `${exact(within(here.scale.t(x)))} s` : "");
    canvas.style.cursor = hit?.chosen || hit?.action ? "pointer" : "default";
    tip.hidden = !text;
    tip.textContent = text;
    tip.style.transform = `translate(${Math.min(x + 12, canvas.clientWidth - 180)}px, ${Math.max(2, y - 26)}px)`;
  }
}
