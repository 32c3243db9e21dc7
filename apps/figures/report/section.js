// One run's section: discs as an image, everything else as lines over it.

/** Whether a run has what a layer of the vocabulary shows; what is not named here every run has. */
const isIn = {
  bonds: run => run.has("bonds_left"),
  unbent: run => run.known.base.length > 0,
  footwall: run => Boolean(run.known.footwall),
  target: run => run.known.surfaces.some(line => line.name === "target line"),
  predictions: run => run.has("start_x_m"),
  seismic: run => Boolean(run.known.seismic),
  picks: run => Boolean(run.head.picks),
  underlay: () => Boolean(page.data.underlay),
};

/** Layers that a run of these has, by name: those of every run, and what its effects declare. */
function hasDetachment(run) { return run.head.has_detachment !== false; }

function layersOf(runs) {
  const own = runs.flatMap(run => run.head.layers).map(layer => [layer.name, {...layer, on: layer.kind !== "discs"}]);
  const known = Object.entries(vocabulary.layers).filter(([name]) => runs.some(isIn[name] || (() => true)));
  const layers = Object.fromEntries([...known, ...own]);
  if (!runs.some(hasDetachment)) layers.detachment = {...layers.detachment, label: "base"};
  return layers;
}

/** Layers of a kind that a run's effects declare, as far as they are shown. */
function shownLayers(run, kind, shown) {
  return run.head.layers.filter(layer => layer.kind === kind && shown.has(layer.name)).map(layer => [layer.name, layer]);
}

const otherInk = "#b35900"; // of faults of the other run
const pickedInk = "#d4006a";

function inkOf(name) { return vocabulary.layers[name].ink; }

function rowsOf(numbers, columns) {
  return Array.from({length: numbers.length / columns}, (_, k) => numbers.slice(columns * k, columns * (k + 1)));
}

/** Amplitudes of a moment as a picture; nothing where there is no reflection. */
function seismicCanvas({traces, samples, values}) {
  const letters = atob(values), table = palettes[vocabulary.layers.seismic.palette];
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [traces, samples];
  const context = canvas.getContext("2d"), image = context.createImageData(traces, samples);
  const pixels = new Uint32Array(image.data.buffer);
  for (let trace = 0; trace < traces; ++trace)
    for (let k = 0; k < samples; ++k)
      pixels[k * traces + trace] = table[(letters.charCodeAt(trace * samples + k) + 128) & 255];
  context.putImageData(image, 0, 0);
  return canvas;
}

class Section {
  constructor(run, host) {
    this.run = run;
    this.host = host;
    this.discCanvas = host.appendChild(document.createElement("canvas"));
    this.lineCanvas = host.appendChild(document.createElement("canvas"));
    this.lineCanvas.tabIndex = 0;
    this.lineCanvas.setAttribute("role", "img");
    this.painter = new Painter(this.discCanvas);
    this.pen = this.lineCanvas.getContext("2d");
    this.readout = host.appendChild(document.createElement("div"));
    this.readout.className = "readout";
    this.readout.hidden = true;
  }

  get ratio() { return this.discCanvas.width / this.host.clientWidth; }

  resize(width, height) {
    this.painter.resize(width, height);
    this.lineCanvas.width = width;
    this.lineCanvas.height = height;
  }

  discs(k) {
    const run = this.run;
    return {present: run.codes[k].present, x: run.values(k, "x_m"), depth: run.values(k, "depth_m"),
      radius: run.values(k, "radius_m")};
  }

  toPixel(view, x, depth) {
    return [(x - view.left) * view.scale, (depth - view.top) * view.scale * view.height];
  }

  toMetres(view, column, row) {
    return [view.left + column / view.scale, view.top + row / view.scale / view.height];
  }

  line(view, points, ink, width, dash = []) {
    if (points.length < 2) return;
    const pen = this.pen;
    pen.beginPath();
    for (const [x, depth] of points) pen.lineTo(...this.toPixel(view, x, depth));
    pen.strokeStyle = ink;
    pen.lineWidth = width * this.ratio;
    pen.setLineDash(dash.map(length => length * this.ratio));
    pen.lineJoin = "round";
    pen.stroke();
    pen.setLineDash([]);
  }

  label(view, text, x, depth, ink) {
    const [column, row] = this.toPixel(view, x, depth), pen = this.pen;
    pen.font = `${12 * this.ratio}px "DejaVu Sans", sans-serif`;
    pen.lineWidth = 3 * this.ratio;
    pen.strokeStyle = "#fff";
    pen.strokeText(text, column + 4 * this.ratio, row - 4 * this.ratio);
    pen.fillStyle = ink;
    pen.fillText(text, column + 4 * this.ratio, row - 4 * this.ratio);
  }

  /** Moment k: pictures and fills, lines over them, axes, faults over these. */
  async draw(k, view, shown, picked, other) {
    const lines = await this.run.loadLines(k);
    this.pen.clearRect(0, 0, this.lineCanvas.width, this.lineCanvas.height);
    for (const [name, {ink}] of shownLayers(this.run, "band", shown)) this.drawBand(view, lines.layers[name], ink);
    for (const paint of this.grounds(k, view, lines, shown)) paint();
    this.drawStrokes(view, this.strokes(lines, shown));
    this.drawAxes(view);
    this.drawStrokes(view, this.upperStrokes(k, view, lines, shown, picked, other));
    this.lineCanvas.setAttribute("aria-label", `Section of ${this.run.head.scene} at ` +
      `${placeText(this.run.moments[k].extension_m)} of extension, ${lines.faults.length} faults`);
  }

  /** What paints below the lines: pictures, fills, and bonds, which are too many for lines of a drawing. */
  grounds(k, view, lines, shown) {
    const painters = {
      footwall: lines.footwall && (() => this.drawFootwall(view, lines.footwall)),
      underlay: page.underlay && (() => this.drawUnderlay(view)),
      seismic: lines.seismic && (() => this.drawSeismic(view, lines.seismic)),
      bonds: this.run.has("bonds_left") && (() => this.drawBonds(k, view)),
    };
    return Object.keys(painters).filter(name => painters[name] && shown.has(name)).map(name => painters[name]);
  }

  /** The grounds alone, as a canvas; null where there are none. */
  groundPicture(k, view, lines, shown) {
    const painters = this.grounds(k, view, lines, shown), canvas = document.createElement("canvas"), {pen} = this;
    if (painters.length === 0) return null;
    [canvas.width, canvas.height] = [this.lineCanvas.width, this.lineCanvas.height];
    this.pen = canvas.getContext("2d");
    for (const paint of painters) paint();
    this.pen = pen;
    return canvas;
  }

  /** Lines in the order in which they cover each other: points, ink and width, some with a dash or a label. */
  strokes(lines, shown) {
    const all = [], {picks} = this.run.head, surfaces = name => lines.surfaces.filter(line => line.name === name);
    const add = (name, list, width, more = {}) => {
      if (shown.has(name)) for (const {points} of list) all.push({points, ink: inkOf(name), width, ...more});
    };
    for (const line of lines.horizons || []) add("horizons", [line], line.stratum === 0 ? 2 : 0.9);
    for (const name of ["detachment", "floor", "original surface"]) add("detachment", surfaces(name), 1.6);
    for (const {start_x_m: x, start_depth_m: depth} of lines.base)
      add("unbent", [{points: x.map((one, i) => [one, depth[i]])}], 1.2, {dash: [6, 4]});
    add("target", surfaces("target line"), 1.4, {dash: [8, 4]});
    for (const line of lines.predictions || [])
      add("predictions", [line], 1.6, {dash: [3, 3], label: line.name, at: line.points[Math.floor(line.points.length / 2)]});
    add("picks", picks ? [...picks.horizons, ...picks.faults] : [], 2, {dash: [2, 3]});
    for (const [name, {ink}] of shownLayers(this.run, "line", shown))
      all.push({points: rowsOf(lines.layers[name], 2).map(([x, height]) => [x, -height]), ink, width: 1.6});
    return all;
  }

  /** Lines over the axes: faults, those of the other run, and where a picked disc came from. */
  upperStrokes(k, view, lines, shown, picked, other) {
    const isMine = picked?.run === this.run;
    return [...(shown.has("faults") ? this.faultStrokes(lines.faults, isMine && picked.kind === "fault" ? picked.index : -1) : []),
      ...(shown.has("faults") && other ? other.faults.map(({points}) => ({points, ink: otherInk, width: 1.6, dash: [7, 4]})) : []),
      ...(isMine && picked.kind === "disc" ? this.pathStrokes(k, view, picked.id) : [])];
  }

  faultStrokes(faults, chosen) {
    const fastest = Math.max(...faults.map(fault => fault.rate_mm_per_a), 1e-9);
    return faults.flatMap(({points, rate_mm_per_a: rate}, index) => {
      const ink = index === chosen ? pickedInk : inkOf("faults"), share = rate / fastest;
      return [{points, ink: "#fff", width: 2.5 + 3 * share},
        {points, ink, width: (index === chosen ? 2 : 1) + 2 * share, label: String(index), at: points[0]}];
    });
  }

  pathStrokes(k, view, id) {
    const {run} = this, points = [], placeAt = m => [run.values(m, "x_m")[id], run.values(m, "depth_m")[id]];
    run.codes.forEach(({present}, m) => { if (id < present.length && present[id]) points.push(placeAt(m)); });
    const path = [{points, ink: "#fff", width: 4}, {points, ink: pickedInk, width: 2}];
    if (!run.codes[k].present[id]) return path;
    const reach = Math.max(run.values(k, "radius_m")[id], 5 * this.ratio / view.scale), [x, depth] = placeAt(k);
    const ring = Array.from({length: 49}, (_, n) => [x + reach * Math.cos(n * Math.PI / 24),
      depth + reach * Math.sin(n * Math.PI / 24) / view.height]);
    return [...path, {points: ring, ink: pickedInk, width: 2.5}];
  }

  drawStrokes(view, strokes) {
    for (const {points, ink, width, dash, label, at} of strokes) {
      this.line(view, points, ink, width, dash);
      if (at) this.label(view, label, ...at, ink);
    }
  }

  drawBonds(k, view) {
    const pairs = this.run.bonds(k), x = this.run.values(k, "x_m"), depth = this.run.values(k, "depth_m");
    const pen = this.pen;
    pen.beginPath();
    for (let i = 0; i < pairs.length; i += 2) {
      pen.moveTo(...this.toPixel(view, x[pairs[i]], depth[pairs[i]]));
      pen.lineTo(...this.toPixel(view, x[pairs[i + 1]], depth[pairs[i + 1]]));
    }
    pen.strokeStyle = inkOf("bonds") + "88";
    pen.lineWidth = 0.6 * this.ratio;
    pen.stroke();
  }

  /** Rows x, bottom, top; heights, not depths. Behind the discs. */
  drawBand(view, rows, ink) {
    const pen = this.painter.context, points = rowsOf(rows, 3);
    pen.globalCompositeOperation = "destination-over";
    pen.fillStyle = ink;
    pen.beginPath();
    for (const [x, bottom] of points) pen.lineTo(...this.toPixel(view, x, -bottom));
    for (const [x, , top] of points.reverse()) pen.lineTo(...this.toPixel(view, x, -top));
    pen.fill();
    pen.globalCompositeOperation = "source-over";
  }

  /** Patches below the base, the darker the more their shear stress has changed; behind the discs. */
  drawFootwall(view, {corners, shear_mpa: shear, end_mpa: end}) {
    const pen = this.pen, {palette, darkest} = vocabulary.layers.footwall;
    shear.forEach((value, n) => {
      pen.beginPath();
      for (let i = 8 * n; i < 8 * n + 8; i += 2) pen.lineTo(...this.toPixel(view, corners[i], corners[i + 1]));
      pen.closePath();
      const ink = cssColour(palettes[palette][Math.round(255 * darkest * Math.min(value / end, 1))]);
      pen.fillStyle = pen.strokeStyle = ink;
      pen.lineWidth = 1;
      pen.fill();
      pen.stroke();
    });
  }

  drawUnderlay(view) {
    const [left, top, right, bottom] = page.data.underlay.corners_m;
    const [x0, y0] = this.toPixel(view, left, top), [x1, y1] = this.toPixel(view, right, bottom);
    this.pen.globalAlpha = Number(page.opacity);
    this.pen.drawImage(page.underlay, x0, y0, x1 - x0, y1 - y0);
    this.pen.globalAlpha = 1;
  }

  /** Marks along the upper and left edge at plain numbers of the page's unit: place in pixels and text. */
  marks(view) {
    const {width, height} = this.lineCanvas, ratio = this.ratio, {metres} = lengthUnit();
    const list = (first, pixelsPerMetre, end, place) => {
      const marks = [], by = plainStep(55 * ratio / pixelsPerMetre / metres), decimals = Math.max(-Math.floor(Math.log10(by)), 0);
      for (let n = Math.ceil(first / metres / by); place(n * by * metres) <= end; ++n)
        marks.push({at: place(n * by * metres), text: (n * by || 0).toFixed(decimals)});
      return marks;
    };
    return {across: list(view.left, view.scale, width, x => this.toPixel(view, x, 0)[0]),
      down: list(view.top, view.scale * view.height, height, depth => this.toPixel(view, 0, depth)[1]).filter(({at}) => at > 24 * ratio)};
  }

  drawAxes(view) {
    const pen = this.pen, {width} = this.lineCanvas, ratio = this.ratio, {across, down} = this.marks(view), unit = lengthUnit().name;
    pen.fillStyle = pen.strokeStyle = "#595959";
    pen.font = `${11 * ratio}px "DejaVu Sans", sans-serif`;
    pen.lineWidth = ratio;
    pen.beginPath();
    for (const {at, text} of across) {
      pen.moveTo(at, 0);
      pen.lineTo(at, 5 * ratio);
      const words = `${text} ${unit}`, room = pen.measureText(words).width + 3 * ratio;
      if (!this.numbersOutside && at > 30 * ratio && at + room < width) pen.fillText(words, at + 3 * ratio, 11 * ratio);
    }
    down.forEach(({at, text}, n) => {
      pen.moveTo(0, at);
      pen.lineTo(5 * ratio, at);
      if (this.numbersOutside) return;
      const words = n ? text : `${text} ${unit}`;
      pen.lineWidth = 3 * ratio;
      pen.strokeStyle = "#fff";
      pen.strokeText(words, 7 * ratio, at + 4 * ratio);
      pen.fillText(words, 7 * ratio, at + 4 * ratio);
    });
    pen.lineWidth = ratio;
    pen.strokeStyle = "#595959";
    pen.stroke();
  }

  /** The seismic image in depth over the discs: dark where rock below is harder. */
  drawSeismic(view, image) {
    const {traces, samples} = image, [x0, y0] = this.toPixel(view, image.left_m, image.top_m);
    const [x1, y1] = this.toPixel(view, image.left_m + traces * image.across_m, image.top_m + samples * image.down_m);
    this.pen.imageSmoothingEnabled = true;
    this.pen.drawImage(image.canvas ??= seismicCanvas(image), x0, y0, x1 - x0, y1 - y0);
  }

  /** Index of the fault within `reach` pixels, or -1. */
  async faultAt(k, view, column, row, reach) {
    const {faults} = await this.run.loadLines(k);
    let best = -1, least = reach;
    faults.forEach((fault, index) => {
      for (let i = 0; i + 1 < fault.points.length; ++i) {
        const [ax, ay] = this.toPixel(view, ...fault.points[i]), [bx, by] = this.toPixel(view, ...fault.points[i + 1]);
        const length2 = (bx - ax) ** 2 + (by - ay) ** 2 || 1;
        const t = Math.min(Math.max(((column - ax) * (bx - ax) + (row - ay) * (by - ay)) / length2, 0), 1);
        const distance = Math.hypot(column - ax - t * (bx - ax), row - ay - t * (by - ay));
        if (distance < least) [best, least] = [index, distance];
      }
    });
    return best;
  }
}
