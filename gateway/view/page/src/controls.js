// Play, speed, steps.
export const controls = (element, store, source) => ({ draw() {} });
