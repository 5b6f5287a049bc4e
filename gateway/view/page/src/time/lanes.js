// The time axis with its lanes.
export const lanes = (element, store, source) => ({ draw() {} });
