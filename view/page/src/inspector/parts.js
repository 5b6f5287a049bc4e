// Pieces of the panel.
export const made = (tag, text, properties = {}) => Object.assign(document.createElement(tag), { textContent: text ?? "" }, properties);

/** A section with a heading, in `parent`. */
export function part(parent, title) {
  const section = parent.appendChild(document.createElement("section"));
  if (title) section.appendChild(made("h3", title));
  return section;
}

/** Names and values side by side; null values are left out. */
export function facts(parent, rows) {
  const table = parent.appendChild(made("table", "", { className: "facts" }));
  for (const [name, value] of rows) {
    if (value === null || value === undefined || value === "") continue;
    const row = table.insertRow();
    row.appendChild(made("th", name, { scope: "row" }));
    const cell = row.insertCell();
    if (value instanceof Node) cell.appendChild(value); else cell.textContent = value;
  }
  return table;
}

/** A table with a line of names. @param onClick  of a row, told its index; may be left out */
export function list(parent, names, rows, onClick) {
  const table = parent.appendChild(made("table", "", { className: "list" }));
  const head = table.createTHead().insertRow();
  for (const name of names) head.appendChild(made("th", name, { scope: "col" }));
  const body = table.createTBody();
  rows.forEach((values, i) => {
    const row = body.insertRow();
    for (const value of values) row.insertCell().textContent = value ?? "";
    if (!onClick) return;
    row.className = "choice";
    row.tabIndex = 0;
    row.addEventListener("click", () => onClick(i));
    row.addEventListener("keydown", (event) => { if (event.key === "Enter") onClick(i); });
  });
  return table;
}

/** Something to press that reads like a word. */
export function link(text, action) {
  const button = made("button", text, { type: "button", className: "word" });
  button.addEventListener("click", action);
  return button;
}

export const number = (value, digits = 4) => (value === null || value === undefined ? "" : String(Number(Number(value).toPrecision(digits))));
/** With so many digits behind the point, and no "-0.00". */
export const fixed = (value, digits) => value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1");
export const nameOf = (run, agent) => (agent >= 65534 ? (agent === 65535 ? "everyone" : "neighbours")
  : run.world.agents.find((one) => one.agent === agent)?.name ?? String(agent));
