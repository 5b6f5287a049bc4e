// The bodies and the network, one pane per run.
export const world = (element, store, source) => ({ draw() {}, project: () => [0, 0], arrows: () => [], hops: () => [] });
