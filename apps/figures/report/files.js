// Files that can be saved from the page.

function save(name, content, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], {type}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const depthReference = "original surface";   // as `listric export` has it: of every depth

function csvOf(names, rows) {
  const field = value => value === null || value === undefined || Number.isNaN(value) ? "" :
    /[",\n]/.test(value) ? `"${String(value).replaceAll('"', '""')}"` : String(value);
  return [names, ...rows].map(row => row.map(field).join(",")).join("\n") + "\n";
}

function discsCsv(run, k) {
  const names = ["x_m", "depth_m", "radius_m", "stratum", "rock", "start_x_m", "start_depth_m",
    ...strainStreams, "behaviour", "bonds", "mean_stress_pa", "shear_stress_pa"].filter(name => run.has(name));
  const columns = names.map(name => run.values(k, name)), rows = [];
  run.codes[k].present.forEach((there, id) => {
    if (there) rows.push([id, depthReference, ...columns.map(column => Number(column[id].toPrecision(9)))]);
  });
  return csvOf(["id", "depth_reference", ...names], rows);
}

/** A number with the digits that mean something: lengths to a hundredth of what is known, others to four digits. */
function sensible(value, name, radius) {
  if (typeof value !== "number" || !Number.isFinite(value) || Number.isInteger(value)) return value;
  return name.endsWith("_m") ? Number(value.toFixed(Math.max(2 - Math.round(Math.log10(lengthStep(radius))), 0))) : Number(value.toPrecision(4));
}

/** A row per point of lines. */
function linesCsv(lines, radius) {
  const names = [...new Set(lines.flatMap(Object.keys))].filter(name => !Array.isArray(lines[0][name]));
  return csvOf(["line", ...names, "depth_reference", "x_m", "depth_m"], lines.flatMap((line, index) =>
    line.points.map(([x, depth]) => [index, ...names.map(name => sensible(line[name], name, radius)), depthReference, sensible(x, "x_m", radius), sensible(depth, "depth_m", radius)])));
}

// Pictures: a title and the moment above the section, axes around it, legend and provenance below.

const paper = {margin: 46, above: 64, line: 17, font: 12};

/** Texts around a picture of a section. */
function wordsAround(section) {
  const run = section.run, {summary, scene, accuracy, seed} = run.head, {state_hash: hash, provenance} = summary || {};
  return {title: titleWords(run.head.description || scene), moment: `${momentText(run)}; ${page.runs.length > 1 ? labelOf(run) : scene}, ${accuracy}, seed ${seed}` +
    (page.view.height > 1 ? `; heights × ${page.view.height}` : "; no vertical exaggeration"),
    foot: [page.data.program, provenance?.commit && `commit ${provenance.commit}`, hash && `state ${hash}`].filter(Boolean).join(", ")};
}

/** Places of legend entries in lines of a width: [item, x, line], by the width of texts. */
function placedLegend(items, width, widthOf) {
  let [x, line] = [0, 0];
  return items.map(item => {
    const room = (item.colours ? 130 : 18) + widthOf(legendText(item)) + 14;
    if (x > 0 && x + room > width) [x, line] = [0, line + 1];
    const place = [item, x, line];
    x += room;
    return place;
  });
}

function distanceWords() {
  return `distance from the ${page.runs.some(hasDetachment) ? "breakaway" : "left wall"} (${lengthUnit().name})`;
}

/** Text of a legend entry beside its colours. */
function legendText({label, from, to}) { return from === undefined ? label : `${label}: ${from} to ${to}`; }

/** The section with all that a picture needs to stand alone, as a canvas on white. */
async function pictureOf(section) {
  section.numbersOutside = true;
  await draw();
  const canvas = document.createElement("canvas"), ratio = section.ratio, {width, height} = section.discCanvas;
  const context = canvas.getContext("2d"), words = wordsAround(section), p = paper;
  const set = (size, weight = "") => { context.font = `${weight} ${size * ratio}px "DejaVu Sans", sans-serif`; };
  set(p.font);
  const legend = placedLegend(legendItems(), width / ratio, text => context.measureText(text).width / ratio);
  const below = 26 + p.line * (2 + Math.max(...legend.map(([, , line]) => line), 0));
  [canvas.width, canvas.height] = [width + 2 * p.margin * ratio, height + (p.above + 22 + below) * ratio];
  context.fillStyle = "#fff";
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.fillStyle = "#1a1a1a";
  const left = p.margin * ratio, top = (p.above + 18) * ratio;
  const room = canvas.width - 2 * left;
  set(15, "bold");
  context.fillText(words.title, left, 20 * ratio, room);
  set(p.font);
  context.fillText(words.moment, left, 40 * ratio, room);
  context.drawImage(section.discCanvas, left, top);
  context.drawImage(section.lineCanvas, left, top);
  section.numbersOutside = false;
  draw().catch(trouble);
  context.strokeStyle = "#1a1a1a";
  context.lineWidth = ratio;
  context.strokeRect(left, top, width, height);
  const {across, down} = section.marks(page.view);
  context.textAlign = "center";
  context.fillText(distanceWords(), left + width / 2, top - 20 * ratio);
  for (const {at, text} of across) if (at >= 0) context.fillText(text, left + at, top - 5 * ratio);
  context.textAlign = "right";
  for (const {at, text} of down) context.fillText(text, left - 5 * ratio, top + at + 4 * ratio);
  context.save();
  context.translate(12 * ratio, top + height / 2);
  context.rotate(-Math.PI / 2);
  context.textAlign = "center";
  context.fillText(`depth (${lengthUnit().name})`, 0, 0);
  context.restore();
  context.textAlign = "left";
  for (const [item, x, line] of legend) {
    const row = top + height + (22 + p.line * line) * ratio;
    let column = left + x * ratio;
    (item.colours || [item.colour]).forEach((colour, n, all) => {
      context.fillStyle = colour;
      context.fillRect(column + n * (item.colours ? 120 / all.length : 0) * ratio, row - 10 * ratio, (item.colours ? 120 / all.length + 0.5 : 12) * ratio, 12 * ratio);
    });
    context.fillStyle = "#1a1a1a";
    column += (item.colours ? 126 : 16) * ratio;
    context.fillText(legendText(item), column, row);
  }
  context.fillStyle = "#595959";
  set(10);
  context.fillText(words.foot, left, canvas.height - 8 * ratio, room);
  return canvas;
}

function escaped(text) { return String(text).replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;"); }

function svgText(x, y, said, more = "") {
  return `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" ${more}>${escaped(said)}</text>`;
}

/** A line of a section, and its label on a white rim. */
function svgStroke(section, view, {points, ink, width, dash, label, at}) {
  const place = (x, depth) => section.toPixel(view, x, depth).map(v => v / section.ratio);
  const line = points.length < 2 ? "" : `<polyline fill="none" stroke="${ink}" stroke-width="${width.toFixed(2)}" stroke-linejoin="round"` +
    `${dash ? ` stroke-dasharray="${dash.join(" ")}"` : ""} points="` +
    points.map(point => place(...point).map(v => v.toFixed(1)).join(",")).join(" ") + `"/>`;
  const [x, y] = at ? place(...at) : [];
  return line + (at ? svgText(x + 4, y - 4, label, `fill="${ink}" stroke="#fff" stroke-width="3" paint-order="stroke"`) : "");
}

/** Discs, and what is painted over them, as images; lines with their labels as lines and text. */
function svgSection(section, k, view, lines, other) {
  const {width, height} = section.discCanvas, ground = section.groundPicture(k, view, lines, page.shown);
  const strokes = [...section.strokes(lines, page.shown), ...section.upperStrokes(k, view, lines, page.shown, page.picked, other)];
  const images = [section.discCanvas, ground].filter(Boolean).map(canvas =>
    `<image width="${width / section.ratio}" height="${height / section.ratio}" href="${canvas.toDataURL()}"/>`);
  return [...images, ...strokes.map(stroke => svgStroke(section, view, stroke))].join("\n");
}

/** Numbers along a frame of so many pixels. */
function svgAxes(section, view, height) {
  const {across, down} = section.marks(view), {ratio} = section;
  return across.filter(({at}) => at >= 0).map(({at, text}) => svgText(at / ratio, -5, text, 'text-anchor="middle"')).join("") +
    down.map(({at, text}) => svgText(-5, at / ratio + 4, text, 'text-anchor="end"')).join("") +
    svgText(section.discCanvas.width / section.ratio / 2, -20, distanceWords(), 'text-anchor="middle"') +
    svgText(0, 0, `depth (${lengthUnit().name})`, `text-anchor="middle" transform="translate(-34,${height / 2}) rotate(-90)"`);
}

function svgLegendEntry(item, x, y) {
  const all = item.colours || [item.colour], each = item.colours ? 120 / all.length : 12;
  return all.map((colour, n) => `<rect x="${(x + n * each).toFixed(2)}" y="${y - 10}" width="${(each + (item.colours ? 0.3 : 0)).toFixed(2)}" height="12" fill="${colour}"/>`).join("") +
    svgText(x + (item.colours ? 126 : 16), y, legendText(item));
}

/** The section with all that a picture needs to stand alone, as SVG. */
function svgOf(section, k, view, lines, other) {
  const {width, height} = section.discCanvas, words = wordsAround(section), p = paper;
  const [w, h] = [width / section.ratio, height / section.ratio], left = p.margin, top = p.above + 18;
  const measure = document.createElement("canvas").getContext("2d");
  measure.font = `${p.font}px "DejaVu Sans", sans-serif`;
  const legend = placedLegend(legendItems(), w, said => measure.measureText(said).width);
  const total = h + top + 26 + p.line * (2 + Math.max(...legend.map(([, , line]) => line), 0));
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${w + 2 * left}" height="${total}" viewBox="0 0 ${w + 2 * left} ${total}" ` +
    `font-family="DejaVu Sans, sans-serif" font-size="${p.font}" fill="#1a1a1a">\n<title>${escaped(words.title)}</title>\n` +
    `<desc>${escaped(words.foot)}</desc>\n<rect width="100%" height="100%" fill="#fff"/>\n` +
    svgText(left, 20, words.title, 'font-size="15" font-weight="bold"') + svgText(left, 40, words.moment) +
    `\n<clipPath id="frame"><rect width="${w}" height="${h}"/></clipPath>\n<g transform="translate(${left},${top})">\n<g clip-path="url(#frame)">\n` +
    svgSection(section, k, view, lines, other) +
    `\n</g>\n<rect width="${w}" height="${h}" fill="none" stroke="#1a1a1a"/>\n` + svgAxes(section, view, h) + "\n</g>\n" +
    legend.map(([item, x, line]) => svgLegendEntry(item, left + x, top + h + 22 + p.line * line)).join("\n") + "\n" +
    svgText(left, total - 8, words.foot, 'font-size="10" fill="#595959"') + "\n</svg>\n";
}
