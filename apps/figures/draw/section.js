"use strict";
// The section: an SVG whose nodes, picks and reference points are elements that take the focus.

const dataOf = id => JSON.parse(document.getElementById(id).textContent);
const $ = id => document.getElementById(id);
const vocabulary = dataOf("vocabulary");
document.documentElement.style.setProperty("--pick", vocabulary.layers.picks.ink); // as in figures and report

function svg(name, attributes = {}, parent = null) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return parent ? parent.appendChild(element) : element;
}

/** Colours of strata, oldest first, from the palette of the figures. */
function strataColours(count) {
  const {rows} = vocabulary.palettes[vocabulary.strata.palette];
  return Array.from({length: count}, (_, k) => `#${rows.slice(6 * Math.round(255 * k / Math.max(count - 1, 1))).slice(0, 6)}`);
}

const strataCount = 8; // as many as the program draws

class Section {
  constructor(host) {
    this.host = host;
    this.svg = svg("svg", {role: "application", "aria-label": "The section: drag nodes, or reach them with Tab and move them with arrows"}, host);
    this.layers = {};
    for (const name of ["ground", "picture", "model", "axes", "lines", "handles"]) this.layers[name] = svg("g", {class: name}, this.svg);
    const path = (layer, name, attributes = {}) => this[name] = svg("path", {class: name, ...attributes}, this.layers[layer]);
    path("ground", "footwall");
    path("ground", "rock");
    this.image = svg("image", {preserveAspectRatio: "none"}, this.layers.picture);
    this.strata = strataColours(strataCount).map(fill => svg("path", {class: "strata", fill}, this.layers.model));
    for (const name of ["pre", "wall", "top"]) path("model", name);
    this.axis = svg("path", {class: "axis"}, this.layers.axes);
    this.words = svg("g", {}, this.layers.axes);
    path("lines", "fault");
    this.chosen = svg("path", {class: "chosen-piece"}, this.layers.lines);
    this.hits = svg("g", {}, this.layers.lines);
    this.picks = svg("g", {}, this.layers.lines);
    this.view = {left: 0, top: 0, scale: 1, height: 1};
    this.handles = [];
    this.measure();
  }

  /** Sizes are read when they may have changed, since reading them lays the page out. */
  measure() {
    this.width = this.host.clientWidth;
    this.height = this.host.clientHeight;
  }

  px(x, depth) { return [(x - this.view.left) * this.view.scale, (depth - this.view.top) * this.view.scale * this.view.height]; }
  metres(column, row) { return {x: this.view.left + column / this.view.scale, y: -(this.view.top + row / this.view.scale / this.view.height)}; }

  at(event) {
    const box = this.svg.getBoundingClientRect();
    return this.metres(event.clientX - box.left, event.clientY - box.top);
  }

  /** The view that holds everything, at the host's width. */
  showWhole(length, thickness) {
    this.measure();
    const margin = 0.04 * length, width = this.width;
    this.view.scale = width / (length + 2.4 * margin);
    this.view.left = -1.4 * margin;
    const above = 22 / this.view.scale / this.view.height, below = 34 / this.view.scale / this.view.height;
    this.view.top = -above - 0.03 * thickness;
    const height = (above + 1.12 * thickness + below) * this.view.scale * this.view.height;
    this.host.style.height = `${Math.round(Math.min(Math.max(height, 200), window.innerHeight * 0.72))}px`;
    this.measure();
  }

  zoom(factor, centre = {column: this.width / 2, row: this.height / 2}) {
    const at = this.metres(centre.column, centre.row);
    this.view.scale *= factor;
    this.view.left = at.x - centre.column / this.view.scale;
    this.view.top = -at.y - centre.row / this.view.scale / this.view.height;
  }

  /** Through points, and back along others if there are any; to a tenth of a pixel. */
  path(points, closed = false, back = []) {
    const {left, top, scale} = this.view, down = scale * this.view.height;
    let d = "";
    const add = p => { d += `${d ? "L" : "M"}${Math.round(10 * scale * (p.x - left)) / 10},${Math.round(-10 * down * (p.y + top)) / 10}`; };
    for (const p of points) add(p);
    for (let k = back.length; k-- > 0;) add(back[k]);
    return closed && d ? `${d}Z` : d;
  }

  /** Arcs as points that are a pixel off at most. */
  pointsOf(segment) {
    const steps = segment.curvature ? clamp(Math.ceil(Math.abs(segment.length * segment.curvature) / 0.03), 2, 60) : 1;
    return Array.from({length: steps + 1}, (_, k) => pointOn(segment, segment.length * k / steps));
  }

  drawAxes(length) {
    const {width, height, view} = this, unit = lengthUnit(), drawn = JSON.stringify([width, height, view, length]);
    if (drawn === this.drawnAxes) return;
    this.drawnAxes = drawn;
    const step = (metresPerPixel, least) => {
      const rough = metresPerPixel * least, power = 10 ** Math.floor(Math.log10(rough));
      return power * [1, 2, 5, 10].find(k => k * power >= rough);
    };
    this.words.textContent = "";
    let d = "";
    const across = step(1 / view.scale, 75), down = step(1 / view.scale / view.height, 40);
    const word = (x, y, text, anchor) => { svg("text", {x, y, "text-anchor": anchor}, this.words).textContent = text; };
    for (let x = Math.ceil(view.left / across) * across; ; x += across) {
      const [column] = this.px(x, 0);
      if (column > width - 12) break;
      d += `M${column.toFixed(1)},${height}v-6`;
      if (column > 12) word(column, height - 9, shortNumber(Number((x / unit.metres).toPrecision(6))), "middle");
    }
    word(width - 6, height - 24, `x, ${unit.name}`, "end");
    for (let z = Math.ceil(view.top / down) * down; ; z += down) {
      const [, row] = this.px(0, z);
      if (row > height - 30) break;
      d += `M0,${row.toFixed(1)}h6`;
      if (row > 26) word(9, row + 4, shortNumber(Number((z / unit.metres).toPrecision(6))), "start");
    }
    word(6, 15, `depth, ${unit.name}${view.height > 1 ? ` (×${view.height})` : ""}`, "start");
    const [, ground] = this.px(0, 0);
    this.axis.setAttribute("d", `${d}M${this.px(0, 0)[0].toFixed(1)},${ground.toFixed(1)}H${this.px(length, 0)[0].toFixed(1)}`);
  }

  /** Detachment, rock on both sides of it, and the basin that kinematics predicts, if it does. */
  drawModel({chain, shape, length, extension, basin, chosen}) {
    const line = chain.flatMap(segment => this.pointsOf(segment)), bottom = this.metres(0, this.height + 10).y;
    const left = this.metres(-10, 0).x, wall = length + (shape ? extension : 0), right = this.metres(this.width + 10, 0).x;
    this.fault.setAttribute("d", this.path(line));
    this.footwall.setAttribute("d", this.path([{x: left, y: 0}, {x: 0, y: 0}, ...line, {x: right, y: line.at(-1).y}, {x: right, y: bottom}, {x: left, y: bottom}], true));
    const under = line.filter(p => p.x < wall), end = under.length < line.length ? under.at(-1)?.y ?? 0 : line.at(-1).y;
    this.rock.setAttribute("d", this.path([...under, {x: wall, y: end}, {x: wall, y: 0}, {x: 0, y: 0}], true));
    this.wall.setAttribute("d", this.path([{x: wall, y: 0}, {x: wall, y: end}]));
    const piece = shape && chosen >= 0 && chosen < shape.pieces.length ? chain[chosen] : null;
    this.chosen.setAttribute("d", piece ? this.path(this.pointsOf(piece)) : "");
    while (this.hits.childNodes.length > (shape?.pieces.length || 0)) this.hits.lastChild.remove();
    shape?.pieces.forEach((_, k) => {
      const hit = this.hits.childNodes[k] || svg("path", {class: "hit"}, this.hits);
      hit.dataset.piece = k;
      hit.setAttribute("d", this.path(this.pointsOf(chain[k])));
    });
    this.drawBasin(basin, chain, extension, wall);
  }

  /** Nothing of a model, where a scene has no base that can be drawn. */
  clear() {
    for (const path of [this.fault, this.footwall, this.rock, this.wall, this.chosen]) path.setAttribute("d", "");
    this.hits.textContent = "";
    this.drawBasin(null);
  }

  /** Sediment that kept the basin full, in strata of equal age, and the pre-rift top. */
  drawBasin(basin, chain, extension, wall) {
    if (!basin) {
      for (const path of [...this.strata, this.pre, this.top]) path.setAttribute("d", "");
      return;
    }
    const curve = numbers => Array.from({length: numbers.length / 2}, (_, k) =>
      ({x: basin.unit_m * numbers[2 * k], y: basin.unit_m * numbers[2 * k + 1]}));
    const exposed = way => Array.from({length: 41}, (_, k) => pointAt(chain, way * k / 40));
    const tops = basin.tops.map((numbers, k) => [...exposed(extension * (1 - k / strataCount)), ...curve(numbers)]);
    [...tops.slice(1), [{x: 0, y: 0}, {x: wall, y: 0}]].forEach((top, k) => this.strata[k].setAttribute("d", this.path(tops[k], true, top)));
    this.top.setAttribute("d", this.path(curve(basin.tops[0])));
    this.pre.setAttribute("d", basin.layers.map(numbers => this.path(curve(numbers))).join(""));
  }

  drawPicture(picture, opacity) {
    this.svg.classList.toggle("over-picture", Boolean(picture));
    if (!picture) {
      this.image.removeAttribute("href");
      return;
    }
    const [x0, z0, x1, z1] = cornersOf(picture), [left, top] = this.px(x0, z0), [right, bottom] = this.px(x1, z1);
    if (this.image.getAttribute("href") !== picture.image) this.image.setAttribute("href", picture.image);
    for (const [key, value] of Object.entries({x: left, y: top, width: right - left, height: bottom - top, opacity}))
      this.image.setAttribute(key, value);
  }

  drawPicks(lines, faultPoints) {
    this.picks.textContent = "";
    for (const kind of ["horizons", "faults"])
      for (const line of lines[kind]) {
        const points = line.x_m.map((x, k) => ({x, y: -line.depth_m[k]}));
        svg("path", {class: "pick-halo", d: this.path(points)}, this.picks);
        svg("path", {class: `pick-line ${kind === "faults" ? "of-fault" : ""}`, d: this.path(points)}, this.picks);
        if (points.length) {
          const [x, y] = this.px(points[0].x, -points[0].y), isLeft = x < 150;
          svg("text", {x: isLeft ? x + 2 : x - 8, y: isLeft ? y - 8 : y + 4, "text-anchor": isLeft ? "start" : "end"}, this.picks).textContent = line.name;
        }
      }
    if (faultPoints) faultPoints.x_m.forEach((x, k) => {
      const [cx, cy] = this.px(x, faultPoints.depth_m[k]);
      svg("circle", {class: "points", cx, cy, r: 2}, this.picks);
    });
  }

  /** Elements that are dragged: [{key, kind, x, y, label, mark}]. Elements of equal keys stay, and with them the focus. */
  drawHandles(wanted, chosen) {
    const old = new Map(this.handles.map(element => [element.dataset.key, element]));
    this.handles = wanted.map(one => {
      const element = old.get(one.key) || this.makeHandle(one);
      old.delete(one.key);
      const [column, row] = this.px(one.x, -one.y);
      element.setAttribute("transform", `translate(${column.toFixed(1)},${row.toFixed(1)})`);
      element.setAttribute("aria-label", one.label);
      element.setAttribute("class", `handle ${one.kind} ${one.key === chosen ? "chosen" : ""}`);
      const stick = element.querySelector(".stick");
      if (stick) {
        const [sx, sy] = this.px(one.from.x, -one.from.y);
        stick.setAttribute("x2", sx - column);
        stick.setAttribute("y2", sy - row);
      }
      return element;
    });
    for (const element of old.values()) element.remove();
    this.handles.forEach((element, k) => {
      if (this.layers.handles.childNodes[k] !== element) this.layers.handles.insertBefore(element, this.layers.handles.childNodes[k] || null);
    });
  }

  makeHandle({key, kind}) {
    const element = svg("g", {tabindex: 0, role: "button"});
    element.dataset.key = key;
    if (kind === "turn") svg("line", {class: "stick", x1: 0, y1: 0}, element);
    svg("circle", {class: "reach", r: 17}, element);
    if (kind === "turn") svg("path", {class: "mark", d: "M0,-8L8,0L0,8L-8,0Z"}, element);
    else if (kind === "reference") {
      svg("path", {class: "mark", d: "M-13,0H13M0,-13V13"}, element);
      svg("text", {x: 9, y: -9}, element).textContent = key.slice(-1).toUpperCase();
    } else svg("circle", {class: "mark", r: kind === "pick" ? 5 : 8}, element);
    return element;
  }
}

// -- the picture under the section

/** Upper left and lower right corner of a picture by its two reference points: x, depth, x, depth. */
function cornersOf({width, height, points: [a, b]}) {
  const across = Math.abs(b.px - a.px) >= 1 ? (b.x - a.x) / (b.px - a.px) : null;
  const down = Math.abs(b.py - a.py) >= 1 ? (b.depth - a.depth) / (b.py - a.py) : null;
  const good = scale => scale !== null && scale > 0 && Number.isFinite(scale);
  const sx = good(across) ? across : good(down) ? down : 1, sz = good(down) ? down : sx;
  const x = a.x - a.px * sx, depth = a.depth - a.py * sz;
  return [x, depth, x + width * sx, depth + height * sz];
}

/** The pixel of a picture at a place in the section. */
function pixelAt(picture, p) {
  const [x0, z0, x1, z1] = cornersOf(picture);
  return {px: (p.x - x0) / (x1 - x0) * picture.width, py: (-p.y - z0) / (z1 - z0) * picture.height};
}
