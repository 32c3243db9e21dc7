// A chart of what runs have found so far: a measure of their histories against extension, in the report's words.

const chartColours = ["#1f77a8", "#c96a00", "#5f9fc4", "#d9a066"]; // of the report

/** Columns of history.csv by name; empty cells are no numbers. */
function historyOf(text) {
  const [names, ...rows] = text.trim().split("\n").map(line => line.split(","));
  const column = k => rows.map(row => row[k] === "" ? NaN : Number(row[k]));
  return Object.fromEntries(names.map((name, k) => [name, column(k)]));
}

/** A measure's label as the program declares it. */
function measureWords(name) {
  const text = facts.measures[name.replace("number of ", "")]?.[0] || name.replaceAll("_", " ");
  return text.charAt(0).toUpperCase() + text.slice(1);
}

function measureUnit(name) { return facts.measures[name.replace("number of ", "")]?.[1]; }

/** About so many round numbers from one to another. */
function roundNumbers(low, high, count) {
  const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find(k => k * power >= raw), first = Math.ceil(low / step);
  return Array.from({length: Math.floor(high / step + 1e-3) - first + 1}, (_, k) => (first + k) * step);
}

function svgElement(name, attributes, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

const chartEdges = {left: 58, right: 14, top: 20, bottom: 36, height: 210}; // pixels

/** A measure of several runs, {label, history} each: their points in units for people, and these. */
function chartData(name, series) {
  const clock = series.some(({history}) => "travel_m" in history) ? "travel_m" : "extension_m";
  const sizes = series.flatMap(({history}) => history[name] || []).map(Math.abs).filter(Number.isFinite);
  const [scale, word] = scaleOf(Math.max(0, ...sizes), measureUnit(name)), {metres, name: length} = lengthUnit();
  const lines = series.map(({label, history}) => ({label, points: history[clock]
    .map((travel, k) => [travel / metres, history[name]?.[k] / scale]).filter(point => point.every(Number.isFinite))}));
  return {lines, title: `${measureWords(name)}${word ? ` (${word})` : ""}`,
    clock: `${clock === "travel_m" ? "travel" : "extension"} (${length})`};
}

function drawHistory(host, name, series) {
  const {lines, title, clock} = chartData(name, series), all = lines.flatMap(({points}) => points);
  host.replaceChildren();
  if (!all.length) return;
  const {left, right, top, bottom, height} = chartEdges, width = host.clientWidth || 300, ys = all.map(([, y]) => y);
  const last = Math.max(...all.map(([x]) => x)) || 1, [least, most] = [Math.min(...ys), Math.max(...ys)];
  const slack = (most - least || Math.abs(most) || 1) / 20, low = least - slack, high = most + slack;
  const column = x => left + (width - left - right) * x / last;
  const row = y => height - bottom - (height - top - bottom) * (y - low) / (high - low);
  const text = (x, y, anchor, words) => svgElement("text", {x, y, "text-anchor": anchor}, words);
  const plain = value => String(Number(value.toPrecision(6)));
  host.append(svgElement("svg", {width, height, role: "img", "aria-label": `${title} against ${clock}`},
    ...roundNumbers(low, high, 4).flatMap(y => [text(left - 6, row(y) + 4, "end", plain(y)),
      svgElement("path", {d: `M${left} ${row(y)}H${width - right}`, class: "grid"})]),
    ...roundNumbers(0, last, Math.max(2, Math.floor(width / 110))).map(x =>
      text(column(x), height - bottom + 16, "middle", plain(x))),
    text(width - right, height - 4, "end", clock), text(4, 12, "start", title),
    ...lines.flatMap((line, k) => linesOfChart(line, k, column, row))));
  if (lines.length > 1) host.append(element("p", {className: "faint"}, ...lines.map(legendOfLine)));
}

function linesOfChart({label, points}, k, column, row) {
  const stroke = chartColours[k % chartColours.length], dashes = k < chartColours.length ? "none" : "5 3";
  const places = points.map(([x, y]) => [column(x).toFixed(1), row(y).toFixed(1)]);
  const d = `M${places.map(place => place.join(" ")).join("L")}`;
  const title = svgElement("title", {}, label);
  const line = svgElement("path", {d, stroke, "stroke-dasharray": dashes, class: "line"}, title);
  return [line, ...places.map(([cx, cy]) => svgElement("circle", {cx, cy, r: 2, fill: stroke}))];
}

function legendOfLine({label}, k) {
  const entry = element("span", {}, `${k < chartColours.length ? "━" : "┄"} ${label}  `);
  entry.style.color = chartColours[k % chartColours.length];
  return entry;
}
