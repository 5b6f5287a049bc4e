// The panel of what is chosen.
export const inspector = (element, store, source) => ({ draw() {} });
