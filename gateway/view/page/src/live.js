// What the server says of a run that is under way, and the commands to it.
export const live = (store, source) => ({});
