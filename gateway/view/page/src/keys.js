// The keyboard, and the sheet that tells it.
export const keys = (store, source) => ({});
