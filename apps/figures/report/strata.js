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

  /** A point with error bars along x. Returns where it is, for words. */
  point(x, y, error, colour) {
    const {pen} = this, [column, row] = [this.toX(x), this.toY(y)], [from, to] = [this.toX(x - error), this.toX(x + error)];
    this.rule(from, row, to, row, this.ink, 1.2);
    for (const end of [from, to]) this.rule(end, row - 4, end, row + 4, this.ink, 1.2);
    pen.beginPath();
    pen.arc(column, row, 5, 0, 7);
    pen.fillStyle = colour;
    pen.fill();
    [pen.strokeStyle, pen.lineWidth] = [this.ink, 1.2];
    pen.stroke();
    return {row, from: Math.min(from, column - 5), to: Math.max(to, column + 5)};
  }

  /** Words beside points, with a line to those that stand further away. */
  words(marks) {
    const {pen} = this;
    pen.fillStyle = this.ink;
    placeWords(marks.map(mark => ({...mark, width: pen.measureText(mark.word).width})), this.box).forEach((at, n) => {
      if (!at) return;
      const {from, to, row, word} = marks[n], middle = at.top + 0.5 * wordHeight, isRight = at.left > from;
      if (Math.abs(middle - row) > 0.5 * wordHeight) this.rule(isRight ? to : from, row, isRight ? at.left - 2 : at.right + 2, middle, this.ink, 0.5);
      pen.fillText(word, at.left, middle + 4);
    });
  }
}

const wordHeight = 13; // of a line of words in a chart, pixels

/** Where words of a width stand beside marks: as near as there is room, to the right if possible; undefined: nowhere. */
function placeWords(marks, box) {
  const taken = marks.map(({from, to, row}) => ({left: from, right: to, top: row - 5, bottom: row + 5}));
  const isFree = a => a.left >= box.left && a.right <= box.right && a.top >= box.top && a.bottom <= box.bottom &&
    taken.every(b => a.left >= b.right || a.right <= b.left || a.top >= b.bottom || a.bottom <= b.top);
  const words = [];
  for (const n of marks.map((_, n) => n).sort((m, n) => marks[m].row - marks[n].row)) {
    const {from, to, row, width} = marks[n], places = [];
    for (let away = 0; away < box.bottom - box.top; away += 3)
      for (const middle of away ? [row - away, row + away] : [row])
        for (const left of [to + 6 + away / 2, from - 6 - away / 2 - width])
          places.push({left, right: left + width, top: middle - 0.5 * wordHeight, bottom: middle + 0.5 * wordHeight});
    if (words[n] = places.find(isFree)) taken.push(words[n]);
  }
  return words;
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
  axes.words(points.map(p => ({word: horizonName(p.horizon, names), ...axes.point(p.throw, p.depth / metres, p.error,
    p.horizon > 0 ? cssColour(stratumColour(p.horizon, strata, table)) : vocabulary.pre_rift.colours[0])})));
}

function drawExpansion(host, run, fault, cutoffs, strata) {
  const diameter = 2 * run.head.mean_radius_m, points = fault && cutoffs ? expansionPoints(cutoffs, diameter) : [];
  if (points.length === 0)
    return void (host.textContent = fault ? `Nothing: no stratum is three discs (${metresText(3 * diameter)}) thick on both sides of it.` : "No fault is active now.");
  const axes = new Axes(host, "expansion index by stratum", {label: "thickness above the fault over that below it", ...endsOf(points.flatMap(p =>
    [p.index - p.error, p.index + p.error]), 0, 1)}, {label: "stratum", ...endsOf(points.map(p => p.stratum), 0.5, points[0].stratum)});
  axes.rule(axes.toX(1), axes.box.top, axes.toX(1), axes.box.bottom, axes.ink, 1, [4, 3]);
  const table = paletteOf("strata", "figures");
  for (const p of points) axes.point(p.index, p.stratum, p.error, cssColour(stratumColour(p.stratum, strata, table)));
}

const fewestDiscs = 3; // of a cell that is told apart from those around it

/** Discs and thickness of every stratum in columns of the section, m, and when it was laid down, as of moment k. */
function thicknessOf(run, k, width) {
  const solid = 0.83, {present, stratum} = run.codes[k], x = run.values(k, "x_m"), radius = run.values(k, "radius_m");
  const start = run.values(k, "start_travel_m"), columns = Math.ceil((run.head.length_m + run.moments[k].extension_m) / width);
  const strata = [];
  for (let i = 0; i < present.length; ++i) {
    if (!present[i] || stratum[i] < 1) continue;
    const one = strata[stratum[i]] ??= {discs: new Uint16Array(columns), thickness: new Float64Array(columns), travel: start[i]};
    const column = Math.min(Math.max(Math.floor(x[i] / width), 0), columns - 1);
    one.discs[column] += 1;
    one.thickness[column] += Math.PI * radius[i] ** 2 / solid / width;
  }
  return strata;
}

/** Stretches of a column's strata that are empty between ones that are not: [first, last], old to young, ends included. */
function emptyStretches(discs) {
  const found = [];
  discs.forEach((count, row) => {
    if (count) return;
    if (found.length && found.at(-1)[1] === row - 1) found.at(-1)[1] = row;
    else found.push([row, row]);
  });
  return found;
}

/** Discs per stratum beside an empty stretch: of the nearest few on either side, the slower side. */
function rateBeside(discs, [first, last]) {
  const sides = [[first - 1, -1], [last + 1, 1]].map(([row, step]) => {
    let [count, rows] = [0, 0];
    for (; row >= 0 && row < discs.length && count < fewestDiscs && (discs[row] || count); row += step) [count, rows] = [count + discs[row], rows + 1];
    return count ? count / rows : Infinity;
  });
  return Math.min(...sides);
}

/** Cells of a column, from the discs of its strata, old to young: {first, last, discs}; rows in no cell are blank.
 *
 * Strata are merged until they hold three discs. An empty stretch is a hiatus where three discs or more are missing from
 * it at the rate beside it; a shorter one is what a disc is too large for, and not resolved, as is what has fewer. */
function wheelerCells(discs) {
  const rows = discs.length, isBlank = new Array(rows).fill(false);
  for (const [first, last] of emptyStretches(discs))
    if ((last - first + 1) * rateBeside(discs, [first, last]) >= fewestDiscs) isBlank.fill(true, first, last + 1);
  const cells = [];
  for (let first = 0; first < rows; ++first) {
    if (isBlank[first]) continue;
    let [end, inStretch] = [first, []];
    for (; end < rows && !isBlank[end]; ++end) {
      const open = inStretch.at(-1);
      if (open && open.discs < fewestDiscs) [open.last, open.discs] = [end, open.discs + discs[end]];
      else inStretch.push({first: end, last: end, discs: discs[end]});
    }
    const [rest] = inStretch.slice(-1);
    if (rest.discs < fewestDiscs && inStretch.length > 1) {
      inStretch.pop();
      Object.assign(inStretch.at(-1), {last: rest.last, discs: inStretch.at(-1).discs + rest.discs});
    }
    cells.push(...inStretch);
    first = end;
  }
  return cells;
}

/** All cells of a moment: column, strata from and to, when, thickness now, and how fast it came, m per unit of time. */
function wheelerChart(run, k, width) {
  const strata = thicknessOf(run, k, width), numbers = Object.keys(strata).map(Number);
  const ages = numbers.map(n => timeOf(run, strata[n].travel));
  const steps = ages.slice(1).map((age, n) => age - ages[n]).sort((a, b) => a - b);
  const step = steps.length ? steps[steps.length >> 1] : ages[0] || 1, cells = [];
  for (let column = 0; numbers.length && column < strata[numbers[0]].discs.length; ++column)
    for (const {first, last, discs} of wheelerCells(numbers.map(n => strata[n].discs[column]))) {
      const thickness = numbers.slice(first, last + 1).reduce((sum, n) => sum + strata[n].thickness[column], 0);
      const from = Math.max(ages[first] - step, 0);
      cells.push({column, discs, thickness, from, to: ages[last], first: numbers[first], last: numbers[last],
        rate: discs < fewestDiscs ? null : thickness / (ages[last] - from)});
    }
  return {cells, from: numbers.length ? Math.max(ages[0] - step, 0) : 0, to: ages.at(-1), isEmpty: numbers.length === 0};
}

/** "12 m", of a cell where the pointer is. */
function wheelerWords(run, cell) {
  if (!cell) return "nothing was laid down, or it is gone";
  const names = cell.first === cell.last ? stratumName(cell.first) : `strata ${cell.first} to ${cell.last}`;
  const count = `${cell.discs} disc${cell.discs === 1 ? "" : "s"}`;
  return cell.rate === null ? `${names}: not resolved (${count})` : `${names}: ${valueText(cell.thickness, "m", run.head.mean_radius_m)}, ${count}`;
}

/** Time over the section: what was laid down where, and how fast, by its thickness now. */
function drawWheeler(host, run, k) {
  const width = 4 * run.head.mean_radius_m, {cells, from, to, isEmpty} = wheelerChart(run, k, width);
  const tell = text => { $("wheeler_says").textContent = text; }, legend = $("wheeler_legend");
  tell(legend.textContent = "");
  if (isEmpty) return void (host.textContent = "Nothing: no sediment has been laid down.");
  const {name, metres} = lengthUnit(), end = (run.head.length_m + run.moments[k].extension_m) / metres;
  const rates = cells.map(cell => cell.rate).filter(rate => rate !== null).sort((a, b) => a - b);
  const top = rates[Math.floor(0.99 * (rates.length - 1))] || 1, table = paletteOf("window", "figures"), {unresolved} = vocabulary.strata;
  const axes = new Axes(host, "time over the section", {label: `x (${name})`, low: 0, high: end}, {label: `time (${timeUnit().name})`, low: from, high: to});
  axes.pen.fillStyle = "#fff"; // paper, in the dark, too: dark is thick
  axes.pen.fillRect(axes.box.left, axes.box.top, axes.box.right - axes.box.left, axes.box.bottom - axes.box.top);
  const ink = rate => rate === null ? unresolved.colour : cssColour(table[Math.round(25 + 200 * Math.min(rate / top, 1))]);
  for (const cell of cells) {
    const [x0, x1] = [cell.column, cell.column + 1].map(c => axes.toX(Math.min(c * width / metres, end)));
    const [y1, y0] = [cell.from, cell.to].map(axes.toY, axes);
    axes.pen.fillStyle = ink(cell.rate);
    axes.pen.fillRect(x0, y0, x1 - x0 + 0.5, y1 - y0 + 0.5);
  }
  for (const [colour, text] of [[ink(0), "slow"], [ink(top), `${Number(top.toPrecision(2))} m per ${timeUnit().name} or more, as thick as it is now`],
    [unresolved.colour, unresolved.label], ["#fff", "nothing was laid down, or it is gone"]]) {
    const entry = legend.appendChild(document.createElement("span"));
    entry.className = "entry";
    addSwatch(entry, colour);
    entry.append(text);
  }
  axes.canvas.addEventListener("pointermove", event => {
    const x = axes.xAt(event.offsetX), time = axes.yAt(event.offsetY), column = Math.floor(metres * x / width);
    if (x >= 0 && x <= end && time >= from && time <= to)
      tell(`x ${x.toFixed(1)} ${name}, ${time.toFixed(3)} ${timeUnit().name}, ` +
        wheelerWords(run, cells.find(cell => cell.column === column && cell.from <= time && time <= cell.to)));
  });
}
