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
function layersOf(runs) {
  const own = runs.flatMap(run => run.head.layers).map(layer => [layer.name, {...layer, on: layer.kind !== "discs"}]);
  const known = Object.entries(vocabulary.layers).filter(([name]) => runs.some(isIn[name] || (() => true)));
  return Object.fromEntries([...known, ...own]);
}

/** Layers of a kind that a run's effects declare, as far as they are shown. */
function shownLayers(run, kind, shown) {
  return run.head.layers.filter(layer => layer.kind === kind && shown.has(layer.name)).map(layer => [layer.name, layer]);
}

const otherInk = "#b35900"; // of faults of the other run

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

  /** Lines of moment k in the order in which they cover each other. */
  async draw(k, view, shown, picked, other) {
    const lines = await this.run.loadLines(k), pen = this.pen;
    pen.clearRect(0, 0, this.lineCanvas.width, this.lineCanvas.height);
    if (shown.has("footwall") && lines.footwall) this.drawFootwall(view, lines.footwall);
    if (shown.has("underlay") && page.underlay) this.drawUnderlay(view);
    if (shown.has("seismic") && lines.seismic) this.drawSeismic(view, lines.seismic);
    for (const [name, {ink}] of shownLayers(this.run, "band", shown)) this.drawBand(view, lines.layers[name], ink);
    if (shown.has("bonds") && this.run.has("bonds_left")) this.drawBonds(k, view);
    const surfaces = name => lines.surfaces.filter(line => line.name === name);
    if (shown.has("horizons"))
      for (const line of lines.horizons || [])
        this.line(view, line.points, inkOf("horizons"), line.stratum === 0 ? 2 : 0.9);
    if (shown.has("detachment"))
      for (const name of ["detachment", "floor", "original surface"])
        for (const line of surfaces(name)) this.line(view, line.points, inkOf("detachment"), 1.6);
    if (shown.has("unbent"))
      for (const line of lines.base)
        this.line(view, line.start_x_m.map((x, i) => [x, line.start_depth_m[i]]), inkOf("unbent"), 1.2, [6, 4]);
    if (shown.has("target"))
      for (const line of surfaces("target line")) this.line(view, line.points, inkOf("target"), 1.4, [8, 4]);
    if (shown.has("predictions"))
      for (const line of lines.predictions || []) {
        this.line(view, line.points, inkOf("predictions"), 1.6, [3, 3]);
        const end = line.points[Math.floor(line.points.length / 2)];
        this.label(view, line.name, end[0], end[1], inkOf("predictions"));
      }
    if (shown.has("picks") && this.run.head.picks)
      for (const line of [...this.run.head.picks.horizons, ...this.run.head.picks.faults])
        this.line(view, line.points, inkOf("picks"), 2, [2, 3]);
    for (const [name, {ink}] of shownLayers(this.run, "line", shown))
      this.line(view, rowsOf(lines.layers[name], 2).map(([x, height]) => [x, -height]), ink, 1.6);
    this.drawAxes(view);
    if (shown.has("faults")) this.drawFaults(view, lines.faults, picked);
    if (shown.has("faults") && other)
      for (const fault of other.faults) this.line(view, fault.points, otherInk, 1.6, [7, 4]);
    if (picked?.kind === "disc" && picked.run === this.run) this.drawPath(k, view, picked.id);
    this.lineCanvas.setAttribute("aria-label", `Section of ${this.run.head.scene} at ` +
      `${wayText(this.run.moments[k]).replace("km", "km of extension")}, ${lines.faults.length} faults`);
  }

  drawFaults(view, faults, picked) {
    const fastest = Math.max(...faults.map(fault => fault.rate_mm_per_a), 1e-9);
    faults.forEach((fault, index) => {
      const chosen = picked?.kind === "fault" && picked.run === this.run && picked.index === index;
      this.line(view, fault.points, "#fff", 2.5 + 3 * fault.rate_mm_per_a / fastest);
      this.line(view, fault.points, chosen ? "#d4006a" : inkOf("faults"),
        (chosen ? 2 : 1) + 2 * fault.rate_mm_per_a / fastest);
      const [x, depth] = fault.points[0];
      this.label(view, String(index), x, depth, chosen ? "#d4006a" : inkOf("faults"));
    });
  }

  drawPath(k, view, id) {
    const path = [];
    this.run.moments.forEach((_, m) => {
      if (id < this.run.codes[m].present.length && this.run.codes[m].present[id])
        path.push([this.run.values(m, "x_m")[id], this.run.values(m, "depth_m")[id]]);
    });
    this.line(view, path, "#fff", 4);
    this.line(view, path, "#d4006a", 2);
    if (!this.run.codes[k].present[id]) return;
    const [column, row] = this.toPixel(view, this.run.values(k, "x_m")[id], this.run.values(k, "depth_m")[id]);
    this.pen.beginPath();
    this.pen.arc(column, row, Math.max(this.run.values(k, "radius_m")[id] * view.scale, 5 * this.ratio), 0, 7);
    this.pen.strokeStyle = "#d4006a";
    this.pen.lineWidth = 2.5 * this.ratio;
    this.pen.stroke();
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

  /** Marks along the upper and left edge at plain numbers of kilometres: place in pixels and text. */
  marks(view) {
    const {width, height} = this.lineCanvas, ratio = this.ratio;
    const step = pixelsPerKilometre => [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50].find(s => s * pixelsPerKilometre > 55 * ratio) || 100;
    const across = step(1000 * view.scale), down = step(1000 * view.scale * view.height);
    const number = (value, by) => (Math.abs(value) < 1e-9 ? 0 : value).toFixed(by < 1 ? 1 : 0);
    const list = (first, by, end, place) => {
      const marks = [];
      for (let value = Math.ceil(first / 1000 / by) * by; place(1000 * value) <= end; value += by)
        marks.push({at: place(1000 * value), text: number(value, by)});
      return marks;
    };
    return {across: list(view.left, across, width, x => this.toPixel(view, x, 0)[0]),
      down: list(view.top, down, height, depth => this.toPixel(view, 0, depth)[1]).filter(({at}) => at > 24 * ratio)};
  }

  drawAxes(view) {
    const pen = this.pen, {width} = this.lineCanvas, ratio = this.ratio, {across, down} = this.marks(view);
    pen.fillStyle = pen.strokeStyle = "#595959";
    pen.font = `${11 * ratio}px "DejaVu Sans", sans-serif`;
    pen.lineWidth = ratio;
    pen.beginPath();
    for (const {at, text} of across) {
      pen.moveTo(at, 0);
      pen.lineTo(at, 5 * ratio);
      const words = `${text} km`, room = pen.measureText(words).width + 3 * ratio;
      if (!this.numbersOutside && at > 30 * ratio && at + room < width) pen.fillText(words, at + 3 * ratio, 11 * ratio);
    }
    down.forEach(({at, text}, n) => {
      pen.moveTo(0, at);
      pen.lineTo(5 * ratio, at);
      if (this.numbersOutside) return;
      const words = n ? text : `${text} km`;
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
