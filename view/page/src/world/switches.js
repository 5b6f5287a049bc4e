// What is shown in the world: map or 3-D, all in sight, layers.
const names = { labels: "names", links: "links", frames: "frames", beams: "sensors", trails: "trails", ranges: "ranges", queues: "queues", coverage: "coverage" };

export function switches(element, store) {
  const box = document.createElement("div");
  box.className = "switches";
  element.append(box);
  const add = (text, title, onClick, where = box) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = text;
    button.title = title;
    button.addEventListener("click", onClick);
    where.append(button);
    return button;
  };
  const free = add("3-D", "map or free view", () => store.set({ mode2d: !store.state.mode2d }));
  add("fit", "all in sight", () => store.set({ map: null, orbit: null, follow: null }));
  const follow = add("follow", "the camera follows the chosen agent", () => {
    const { chosen, follow: followed } = store.state;
    store.set({ follow: followed === null && chosen?.kind === "agent" ? chosen.agent : null });
  });
  // In a narrow pane they would cover the world: then they open on demand.
  const more = document.createElement("details");
  const summary = document.createElement("summary");
  summary.textContent = "layers";
  const list = document.createElement("div");
  more.append(summary, list);
  box.append(more);
  let isWide = null;
  const layers = Object.entries(names).map(([key, text]) => [key, add(text, `show ${text}`, () => {
    store.set({ layers: { ...store.state.layers, [key]: !store.state.layers[key] } });
  }, list)]);
  return {
    draw(state) {
      if (isWide !== element.clientWidth >= 700) {
        isWide = element.clientWidth >= 700;
        more.open = isWide;
        box.classList.toggle("wide", isWide);
      }
      free.setAttribute("aria-pressed", String(!state.mode2d));
      follow.setAttribute("aria-pressed", String(state.follow !== null));
      follow.disabled = state.follow === null && state.chosen?.kind !== "agent";
      for (const [key, button] of layers) button.setAttribute("aria-pressed", String(state.layers[key]));
    },
  };
}
