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

/** What a column of faults holds, in the digits that it deserves; its unit stands in its head. */
function faultText(value, name, radius) {
  if (typeof value !== "number") return plain(value);
  if (name.endsWith("_deg")) return value.toFixed(name.startsWith("footwall") ? 1 : 0);
  if (name.endsWith("_m")) return roundedMetres(value, radius);
  if (name.endsWith("_diameters")) return value.toFixed(1);
  return Number.isInteger(value) ? String(value) : digits(value, 2);
}

/** Rows are made anew, and the focus goes to the one in the place of that which had it. */
function drawFaultTable(table, faults, chosen, choose, radius) {
  const focused = [...table.rows].indexOf(document.activeElement);
  table.textContent = "";
  const columns = page.data.fault_columns;
  head(table, columns.map(column => column.label), Object.fromEntries(columns.map(column => [column.label, column.doc])));
  const body = table.appendChild(document.createElement("tbody"));
  faults.forEach((fault, index) => {
    const row = body.appendChild(document.createElement("tr"));
    row.tabIndex = 0;
    row.classList.toggle("chosen", index === chosen);
    for (const {name} of columns) cell(row, faultText(fault[name], name, radius));
    row.addEventListener("click", () => choose(index));
    row.addEventListener("keydown", event => {
      if (event.key !== "Enter" && event.key !== " ") return;
      choose(index);
      event.preventDefault();
    });
  });
  if (faults.length === 0) cell(body.appendChild(document.createElement("tr")), "none is active");
  if (focused >= 0) table.rows[Math.min(focused, table.rows.length - 1)].focus({preventScroll: true});
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

/** Measures in groups of words, the machine's folded away. A row's title has key, exact values and definition. */
function drawMeasures(host, runs) {
  host.textContent = "";
  const numbers = runs.map(run => numbersOf(run.head.summary));
  const names = [...new Set(numbers.flatMap(Object.keys))];
  if (names.length === 0) return void (host.textContent = page.data.lacks.length ? "They are missing: see above." : "The run has not ended yet.");
  const tableOfName = name => page.data.measures[name]?.[0] || page.data.measures[name.split(".")[0]]?.[0] || "run";
  const known = vocabulary.measure_groups.flatMap(group => group.tables);
  const own = [...new Set(names.map(tableOfName))].filter(table => !known.includes(table))
    .map(table => ({label: wordsOf(table), tables: [table]}));
  const groups = [...vocabulary.measure_groups.filter(group => !group.folded), ...own, ...vocabulary.measure_groups.filter(group => group.folded)];
  for (const {label, tables, folded} of groups) {
    const rows = names.filter(name => tables.includes(tableOfName(name)));
    if (rows.length === 0) continue;
    const part = host.appendChild(document.createElement(folded ? "details" : "section"));
    part.appendChild(document.createElement(folded ? "summary" : "h3")).textContent = label;
    drawMeasureRows(part.appendChild(document.createElement("table")), rows, runs, numbers);
  }
}

function drawMeasureRows(table, names, runs, numbers) {
  const errors = runs.map(run => Object.fromEntries((run.head.summary?.known_errors || []).map(one => [one.measure, one])));
  const radius = Math.max(...runs.map(run => run.head.mean_radius_m));
  const rows = names.map(name => {
    const own = name.replace("number of ", ""), parent = name.split(".")[0];
    const [, unit] = page.data.measures[own] || page.data.measures[parent] || [];
    return {name, unit, doc: page.data.definitions[own] || page.data.definitions[parent] || "",
      told: numbers.map((values, r) => valueAndError(values[name], unit, radius, errors[r][name]))};
  });
  const haveErrors = rows.some(({told}) => told.some(([, error]) => error));
  head(table, [...(runs.length > 1 ? ["measure", "A", "B", "B − A"] : ["measure", "value"]), ...(haveErrors ? ["by recorded runs"] : [])]);
  const body = table.appendChild(document.createElement("tbody"));
  for (const {name, unit, doc, told} of rows) {
    const row = body.appendChild(document.createElement("tr"));
    row.dataset.key = name;
    cell(row, wordsOf(name), `${name} = ${numbers.map(values => plain(values[name])).join(" and ")}: ${doc}`);
    for (const [text] of told) cell(row, text);
    if (runs.length > 1) {
      const [a, b] = numbers.map(values => values[name]);
      cell(row, typeof a === "number" && typeof b === "number" ? valueText(b - a, unit, radius) : a === b ? "equal" : "");
    }
    if (!haveErrors) continue;
    const words = told.map(([, error], r) => error && (runs.length > 1 ? `${"AB"[r]}: ${error}` : `(${error})`)).filter(Boolean);
    cell(row, words.join(", "), errorSources(errors[0][name]));
    row.lastChild.className = "error";
  }
}

/** At most ten results, for print: those by which runs are told apart, and the cutoff. */
function drawMainMeasures(table, runs) {
  table.textContent = "";
  const numbers = runs.map(run => mainNumbers(run.head.summary, page.data.headline));
  const names = [...new Set(numbers.flatMap(Object.keys))].slice(0, 10);
  if (names.length) drawMeasureRows(table, names, runs, numbers);
}

/** "Is this run good?": every question with number, bound and words. */
function drawQuality(host, runs) {
  host.textContent = "";
  runs.forEach(run => {
    const checks = run.head.quality || [], bad = checks.filter(({verdict}) => verdict === "doubtful");
    const part = host.appendChild(document.createElement("div"));
    part.className = "verdict";
    const says = part.appendChild(document.createElement("p"));
    const words = checks.length === 0 ? "It is judged when it has ended." : bad.length ? `Doubtful: ${bad.map(({label}) => label.toLowerCase()).join(", ")}.` : "Yes, as far as its own numbers tell. Another seed tells more.";
    says.className = checks.length ? (bad.length ? "doubtful" : "good") : "";
    says.textContent = `${runs.length > 1 ? `${labelOf(run)}. ` : ""}${words}`;
    const list = part.appendChild(document.createElement("div"));
    list.className = "checks";
    list.style.setProperty("--all", checks.length);
    list.style.setProperty("--half", Math.ceil(checks.length / 2));
    for (const check of checks) {
      const card = list.appendChild(document.createElement("div"));
      card.className = `check ${check.verdict}`;
      card.dataset.key = check.key;
      const line = (kind, text) => { const made = card.appendChild(document.createElement(kind)); made.textContent = text; return made; };
      line("b", `${{good: "✓", doubtful: "!", note: "·"}[check.verdict]} ${check.label}`);
      line("span", `${check.value} (${check.bound})`).title = page.data.definitions[check.key] || "";
      line("small", check.words);
    }
  });
}

/** Parameters of two runs that differ. */
function drawDifferences(table) {
  table.textContent = "";
  const differences = page.data.differences || [];
  if (differences.length === 0) return;
  head(table, ["parameter", "A", "B", "unit"]);
  const body = table.appendChild(document.createElement("tbody"));
  for (const [path, a, b, unit] of differences) {
    const row = body.appendChild(document.createElement("tr"));
    for (const text of [path, a, b]) cell(row, text.length > 60 ? `${text.slice(0, 57)}...` : text, text.length > 60 ? text : undefined);
    cell(row, unit === "1" ? "" : unit);
  }
}
