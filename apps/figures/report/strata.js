// What strata tell of faults and time: throw and growth at cutoffs, deposition over the section.

/** The least plain number that is not below a rough one. */
function plainStep(rough) {
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].find(s => s * power >= rough) * power;
}

/** Numbers at a plain distance from each other between two ends. */
function plainSteps(low, high, wanted) {
  const step = plainStep((high - low) / wanted), all = [];
  for (let value = Math.ceil(low / step - 1e-9) * step; value <= high + 1e-9 * step; value += step)
    all.push(Math.abs(value) < 1e-9 * step ? 0 : value);
  return all.map(value => ({value, text: String(Number(value.toPrecision(6))).replace("-", "−")}));
}

/** A picture with two axes in the page's colours. x and y: label, low, high; y grows downward if low > high. */
class Axes {
  constructor(host, words, x, y) {
    host.textContent = "";
    this.canvas = host.appendChild(document.createElement("canvas"));
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", words);
    this.ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.width = host.clientWidth || 400;
    this.height = host.clientHeight || 240;
    [this.canvas.width, this.canvas.height] = [this.width * this.ratio, this.height * this.ratio];
    this.pen = this.canvas.getContext("2d");
    this.pen.scale(this.ratio, this.ratio);
    Object.assign(this, {x, y, box: {left: 56, top: 8, right: this.width - 14, bottom: this.height - 36}});
    const style = getComputedStyle(host);
    [this.ink, this.line] = [style.color, style.getPropertyValue("--line")];
    this.draw();
  }

  toX(value) { return this.box.left + (value - this.x.low) / (this.x.high - this.x.low) * (this.box.right - this.box.left); }
  toY(value) { return this.box.bottom - (value - this.y.low) / (this.y.high - this.y.low) * (this.box.bottom - this.box.top); }
  xAt(column) { return this.x.low + (column - this.box.left) / (this.box.right - this.box.left) * (this.x.high - this.x.low); }
  yAt(row) { return this.y.low + (this.box.bottom - row) / (this.box.bottom - this.box.top) * (this.y.high - this.y.low); }

  draw() {
    const {pen, box} = this;
    pen.font = '12px "DejaVu Sans", sans-serif';
    pen.fillStyle = this.ink;
    pen.strokeStyle = this.line;
    pen.lineWidth = 1;
    pen.textAlign = "center";
    for (const {value, text} of plainSteps(this.x.low, this.x.high, Math.max(this.width / 90, 2))) {
      this.rule(this.toX(value), box.top, this.toX(value), box.bottom);
      pen.fillText(text, this.toX(value), box.bottom + 15);
    }
    pen.fillText(this.x.label, (box.left + box.right) / 2, box.bottom + 31);
    pen.textAlign = "right";
    for (const {value, text} of plainSteps(Math.min(this.y.low, this.y.high), Math.max(this.y.low, this.y.high), 5)) {
      this.rule(box.left, this.toY(value), box.right, this.toY(value));
      pen.fillText(text, box.left - 5, this.toY(value) + 4);
    }
    pen.save();
    pen.translate(12, (box.top + box.bottom) / 2);
    pen.rotate(-Math.PI / 2);
    pen.textAlign = "center";
    pen.fillText(this.y.label, 0, 0);
    pen.restore();
    pen.textAlign = "left";
  }

  rule(x0, y0, x1, y1, ink = this.line, width = 1, dash = []) {
    const {pen} = this;
    pen.beginPath();
    pen.moveTo(x0, y0);
    pen.lineTo(x1, y1);
    [pen.strokeStyle, pen.lineWidth] = [ink, width];
    pen.setLineDash(dash);
    pen.stroke();
    pen.setLineDash([]);
  }

  /** A point with error bars along x, and a word beside it. */
  point(x, y, error, colour, word) {
    const {pen} = this, [column, row] = [this.toX(x), this.toY(y)], [from, to] = [this.toX(x - error), this.toX(x + error)];
    this.rule(from, row, to, row, this.ink, 1.2);
    for (const end of [from, to]) this.rule(end, row - 4, end, row + 4, this.ink, 1.2);
    pen.beginPath();
    pen.arc(column, row, 5, 0, 7);
    pen.fillStyle = colour;
    pen.fill();
    [pen.strokeStyle, pen.lineWidth] = [this.ink, 1.2];
    pen.stroke();
    pen.fillStyle = this.ink;
    pen.fillText(word, Math.min(to + 6, this.box.right - pen.measureText(word).width), row - 6);
  }
}

/** Ends of an axis around values with their errors, and around a number that it has to show. */
function endsOf(values, error, shown) {
  const low = Math.min(shown, ...values) - error, high = Math.max(shown, ...values) + error, room = 0.06 * (high - low || 1);
  return {low: low - room, high: high + room};
}

function stratumName(stratum) { return stratum ? `stratum ${stratum}` : "pre-rift top"; }

/** Names of the horizons of a moment, by number, as far as it has them. */
function horizonNames(lines) { return Object.fromEntries((lines.horizons || []).map(({stratum, name}) => [stratum, name])); }

function horizonName(horizon, names) { return names[horizon] || (horizon < 0 ? `pre-rift layer ${-horizon}` : stratumName(horizon)); }

/** Throws at a fault: horizon, throw with its error, depth of its cutoffs, of horizons that are resolved. */
function throwPoints(cutoffs) {
  return cutoffs.filter(([, , , resolved]) => resolved)
    .map(([horizon, hanging, footwall, , error]) => ({horizon, throw: hanging - footwall, error, depth: (hanging + footwall) / 2}));
}

/** Thickness above the fault over that below it, of strata of three discs or more on both sides. */
function expansionPoints(cutoffs, diameter) {
  const points = [];
  cutoffs.forEach(([stratum, hanging, footwall], n) => {
    if (n === 0 || stratum < 1 || cutoffs[n - 1][0] !== stratum - 1) return;
    const above = cutoffs[n - 1][1] - hanging, below = cutoffs[n - 1][2] - footwall;
    if (above < 3 * diameter || below < 3 * diameter) return;
    const index = above / below;
    points.push({stratum, index, error: index * Math.hypot(diameter / above, diameter / below)});
  });
  return points;
}

function drawThrows(host, fault, cutoffs, names, strata) {
  const points = fault && cutoffs ? throwPoints(cutoffs) : [];
  if (points.length === 0)
    return void (host.textContent = fault ? "Nothing: no horizon meets this fault on both sides so that its throw is known to two discs." : "No fault is active now.");
  const {name, metres} = lengthUnit();
  const depths = endsOf(points.map(p => p.depth / metres), 0.2 * marginUnit() / metres, points[0].depth / metres);
  const axes = new Axes(host, "throw against depth", {label: "throw (m)", ...endsOf(points.flatMap(p => [p.throw - p.error, p.throw + p.error]), 0, 0)},
    {label: `depth (${name})`, low: depths.high, high: depths.low});
  axes.rule(axes.toX(0), axes.box.top, axes.toX(0), axes.box.bottom, axes.ink, 1);
  const table = paletteOf("strata", "figures");
  for (const p of points)
    axes.point(p.throw, p.depth / metres, p.error, p.horizon > 0 ? cssColour(stratumColour(p.horizon, strata, table)) : vocabulary.pre_rift.colours[0],
      horizonName(p.horizon, names));
}

function drawExpansion(host, run, fault, cutoffs, strata) {
  const diameter = 2 * run.head.mean_radius_m, points = fault && cutoffs ? expansionPoints(cutoffs, diameter) : [];
  if (points.length === 0)
    return void (host.textContent = fault ? `Nothing: no stratum is three discs (${metresText(3 * diameter)}) thick on both sides of it.` : "No fault is active now.");
  const axes = new Axes(host, "expansion index by stratum", {label: "thickness above the fault over that below it", ...endsOf(points.flatMap(p =>
    [p.index - p.error, p.index + p.error]), 0, 1)}, {label: "stratum", ...endsOf(points.map(p => p.stratum), 0.5, points[0].stratum)});
  axes.rule(axes.toX(1), axes.box.top, axes.toX(1), axes.box.bottom, axes.ink, 1, [4, 3]);
  const table = paletteOf("strata", "figures");
  for (const p of points) axes.point(p.index, p.stratum, p.error, cssColour(stratumColour(p.stratum, strata, table)), "");
}

/** Thickness of every stratum in columns of the section, m, and when it was laid down, as of moment k. */
function thicknessOf(run, k, width) {
  const solid = 0.83, {present, stratum} = run.codes[k], x = run.values(k, "x_m"), radius = run.values(k, "radius_m");
  const start = run.values(k, "start_travel_m"), columns = Math.ceil((run.head.length_m + run.moments[k].extension_m) / width);
  const strata = [];
  for (let i = 0; i < present.length; ++i) {
    if (!present[i] || stratum[i] < 1) continue;
    const one = strata[stratum[i]] ??= {thickness: new Float64Array(columns), travel: start[i]};
    const column = Math.min(Math.max(Math.floor(x[i] / width), 0), columns - 1);
    one.thickness[column] += Math.PI * radius[i] ** 2 / solid / width;
  }
  return strata;
}

/** Time over the section: what was laid down where, and how thick it is now; white: nothing, or it is gone. */
function drawWheeler(host, run, k) {
  const width = 4 * run.head.mean_radius_m, strata = thicknessOf(run, k, width), numbers = Object.keys(strata).map(Number);
  const tell = text => { $("wheeler_says").textContent = text; };
  tell("");
  if (numbers.length === 0) return void (host.textContent = "Nothing: no sediment has been laid down.");
  const {name, metres} = lengthUnit(), ages = numbers.map(n => timeOf(run, strata[n].travel));
  const step = numbers.length > 1 ? (ages.at(-1) - ages[0]) / (numbers.at(-1) - numbers[0]) : ages[0] || 1;
  const all = numbers.flatMap(n => [...strata[n].thickness]).filter(value => value > 0).sort((a, b) => a - b);
  const top = all[Math.floor(0.99 * (all.length - 1))], table = paletteOf("window", "figures");
  const end = (run.head.length_m + run.moments[k].extension_m) / metres;
  const axes = new Axes(host, "time over the section", {label: `x (${name})`, low: 0, high: end},
    {label: `time (${timeUnit().name})`, low: Math.max(ages[0] - step, 0), high: ages.at(-1)});
  axes.pen.fillStyle = "#fff"; // paper, in the dark, too: dark is thick
  axes.pen.fillRect(axes.box.left, axes.box.top, axes.box.right - axes.box.left, axes.box.bottom - axes.box.top);
  const least = 0.1 * width / 2; // of a disc's diameter: less is no layer
  numbers.forEach((n, row) => strata[n].thickness.forEach((value, column) => {
    if (value < least) return;
    const [x0, x1] = [column, column + 1].map(c => axes.toX(Math.min(c * width / metres, end)));
    const [y1, y0] = [ages[row] - step, ages[row]].map(age => axes.toY(Math.max(age, axes.y.low)));
    axes.pen.fillStyle = cssColour(table[Math.round(25 + 200 * Math.min(value / top, 1))]);
    axes.pen.fillRect(x0, y0, x1 - x0 + 0.5, y1 - y0 + 0.5);
  }));
  tell(`Light: thin; dark: ${valueText(top, "m", run.head.mean_radius_m)} or more, as thick as it is now. Blank: nothing was laid down, or it is gone.`);
  axes.canvas.addEventListener("pointermove", event => {
    const x = axes.xAt(event.offsetX), time = axes.yAt(event.offsetY), row = ages.findIndex(age => age >= time);
    const value = row < 0 ? undefined : strata[numbers[row]].thickness[Math.floor(metres * x / width)];
    if (x >= 0 && x <= end && value !== undefined)
      tell(`x ${x.toFixed(1)} ${name}, ${time.toFixed(3)} ${timeUnit().name}, ${stratumName(numbers[row])}: ${value < least ? "nothing" : valueText(value, "m", run.head.mean_radius_m)}`);
  });
}
