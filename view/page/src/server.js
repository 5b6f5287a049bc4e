// Questions to the server that served this page, with the token of the address that `baraka run --view` prints.
const tokenKey = "baraka-token";

export const token = () => globalThis.sessionStorage?.getItem(tokenKey) ?? null;

/** Takes the token out of the page's address and keeps it for this tab. */
export function takeToken() {
  const match = /(?:^#|&)token=([^&]*)/.exec(location.hash);
  if (!match) return;
  sessionStorage.setItem(tokenKey, match[1]);
  history.replaceState(null, "", `#${location.hash.slice(1).replace(/&?token=[^&]*/, "").replace(/^&/, "")}`);
}

/** fetch() with the token, if there is one. */
export function ask(url, options = {}) {
  const known = token();
  return fetch(url, { cache: "no-store", ...options, headers: { ...options.headers, ...(known === null ? {} : { "X-Baraka-Token": known }) } });
}
