// Tables of faults and of measures.

function cell(row, text, title) {
  const made = row.appendChild(document.createElement("td"));
  made.textContent = text;
  if (title) made.title = title;
}

function head(table, names, titles = {}) {
  const row = table.appendChild(document.createElement("thead")).appendChild(document.createElement("tr"));
  for (const name of names) {
    const made = row.appendChild(document.createElement("th"));
    made.textContent = name;
    made.scope = "col";
    if (titles[name]) made.title = titles[name];
  }
}

function plain(value) {
  if (typeof value !== "number") return value === null || value === undefined ? "" : String(value);
  if (!Number.isFinite(value)) return "";
  return Number.isInteger(value) ? String(value) : Math.abs(value) >= 1e5 || Math.abs(value) < 1e-3
    ? value.toExponential(3) : String(Number(value.toPrecision(5)));
}

function drawFaultTable(table, faults, chosen, choose) {
  table.textContent = "";
  const columns = page.data.fault_columns;
  head(table, columns.map(column => column.label), Object.fromEntries(columns.map(column => [column.label, column.doc])));
  const body = table.appendChild(document.createElement("tbody"));
  faults.forEach((fault, index) => {
    const row = body.appendChild(document.createElement("tr"));
    row.tabIndex = 0;
    row.classList.toggle("chosen", index === chosen);
    for (const {name} of columns) cell(row, plain(fault[name]));
    row.addEventListener("click", () => choose(index));
    row.addEventListener("keydown", event => { if (event.key === "Enter") choose(index); });
  });
  if (faults.length === 0) cell(body.appendChild(document.createElement("tr")), "none is active");
}

/** Numbers of summary.json by their names, of objects as object.name. */
function numbersOf(summary, before = "") {
  const numbers = {};
  for (const [name, value] of Object.entries(summary || {}))
    if (typeof value === "number" || typeof value === "boolean" || name === "state_hash") numbers[before + name] = value;
    else if (value && typeof value === "object" && !Array.isArray(value))
      Object.assign(numbers, numbersOf(value, `${before}${name}.`));
  return numbers;
}

function drawMeasures(table, runs, definitions) {
  table.textContent = "";
  const numbers = runs.map(run => numbersOf(run.head.summary));
  const names = [...new Set(numbers.flatMap(Object.keys))];
  if (names.length === 0) return void (table.textContent = page.data.lacks.length ? "They are missing: see above." : "The run has not ended yet.");
  head(table, runs.length > 1 ? ["measure", "A", "B", "B − A"] : ["measure", "value"]);
  const body = table.appendChild(document.createElement("tbody"));
  for (const name of names) {
    const row = body.appendChild(document.createElement("tr"));
    cell(row, name, definitions[name] || definitions[name.split(".")[0]]);
    for (const values of numbers) cell(row, plain(values[name]));
    if (runs.length > 1) {
      const [a, b] = numbers.map(values => values[name]);
      cell(row, typeof a === "number" && typeof b === "number" ? plain(b - a) : a === b ? "equal" : "");
    }
  }
}
