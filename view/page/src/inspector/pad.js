// The pad that a robot is driven by. It stays while the panel around it is drawn anew, and whatever ends
// the driving (a key or a finger let go, another tab, another agent chosen) leaves the robot at rest.
import { createDriver, drives, velocityOfKeys, velocityOfPad } from "../drive.js";
import { drive } from "../live.js";
import { made, part } from "./parts.js";

export function pad(parent, store) {
  const section = part(parent);
  section.hidden = true;
  const title = section.appendChild(made("h3"));
  const area = section.appendChild(made("div", "", { className: "pad", tabIndex: 0 }));
  area.setAttribute("role", "application");
  area.setAttribute("aria-label", "pad: drag, or hold the keys w a s d, q and e for sideways");
  const knob = area.appendChild(made("i"));
  section.appendChild(made("p", "drag, or click it and hold w a s d (q, e: sideways)"));
  const driver = createDriver((agent, { vx, vy, omega }) => drive(store, agent, vx, vy, omega));
  const held = new Set();
  let agent = null;
  let finger = null;

  const place = (x, y) => { knob.style.transform = `translate(${45 * x}px, ${45 * y}px)`; };
  const rest = () => {
    held.clear();
    finger = null;
    place(0, 0);
    driver.rest();
  };
  const follow = (event) => {
    const box = area.getBoundingClientRect();
    const clip = (value) => Math.max(-1, Math.min(1, value));
    const x = clip(2 * (event.clientX - box.left) / box.width - 1);
    const y = clip(2 * (event.clientY - box.top) / box.height - 1);
    place(x, y);
    driver.use(agent, velocityOfPad(x, y));
  };
  area.addEventListener("pointerdown", (event) => { finger = event.pointerId; area.setPointerCapture(finger); follow(event); });
  area.addEventListener("pointermove", (event) => { if (event.pointerId === finger) follow(event); });
  for (const name of ["pointerup", "pointercancel", "lostpointercapture", "blur"]) area.addEventListener(name, rest);
  addEventListener("blur", rest);
  document.addEventListener("visibilitychange", rest);

  const byKeys = () => {
    if (!held.size) { rest(); return; }
    const velocity = velocityOfKeys(held);
    place(-velocity.omega, -2 * velocity.vx);
    driver.use(agent, velocity);
  };
  area.addEventListener("keydown", (event) => {
    if (!drives(event.key) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation(); //  these keys have other meanings elsewhere
    if (event.repeat) return;
    held.add(event.key.toLowerCase());
    byKeys();
  });
  area.addEventListener("keyup", (event) => { if (held.delete(event.key.toLowerCase())) byKeys(); });

  return {
    /** @param next  the robot that may be driven; null: none */
    show(next) {
      if ((next?.agent ?? null) === agent) return;
      rest();
      agent = next?.agent ?? null;
      section.hidden = !next;
      title.textContent = next ? `drive ${next.name}` : "";
    },
  };
}
