// Files that can be saved from the page.

function save(name, content, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], {type}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function csvOf(names, rows) {
  const field = value => value === null || value === undefined || Number.isNaN(value) ? "" :
    /[",\n]/.test(value) ? `"${String(value).replaceAll('"', '""')}"` : String(value);
  return [names, ...rows].map(row => row.map(field).join(",")).join("\n") + "\n";
}

function discsCsv(run, k) {
  const names = ["x_m", "depth_m", "radius_m", "stratum", "rock", "start_x_m", "start_depth_m",
    "window_strain", "total_strain", "behaviour", "bonds", "mean_stress_pa", "shear_stress_pa"].filter(name => run.has(name));
  const columns = names.map(name => run.values(k, name)), rows = [];
  run.codes[k].present.forEach((there, id) => {
    if (there) rows.push([id, ...columns.map(column => column[id])]);
  });
  return csvOf(["id", ...names], rows);
}

/** A row per point of lines. */
function linesCsv(lines) {
  const names = [...new Set(lines.flatMap(Object.keys))].filter(name => !Array.isArray(lines[0][name]));
  return csvOf(["line", ...names, "x_m", "depth_m"], lines.flatMap((line, index) =>
    line.points.map(([x, depth]) => [index, ...names.map(name => line[name]), x, depth])));
}

/** Discs and lines of a section as one canvas, on white. */
function pictureOf(section) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [section.discCanvas.width, section.discCanvas.height];
  const context = canvas.getContext("2d");
  context.fillStyle = "#fff";
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(section.discCanvas, 0, 0);
  context.drawImage(section.lineCanvas, 0, 0);
  return canvas;
}

/** Discs as a picture, lines and faults as lines. */
function svgOf(section, view, lines) {
  const {width, height} = section.discCanvas;
  const path = (points, ink, thick) => `<polyline fill="none" stroke="${ink}" stroke-width="${thick}" points="` +
    points.map(([x, depth]) => section.toPixel(view, x, depth).map(v => v.toFixed(1)).join(",")).join(" ") + `"/>`;
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}">\n` +
    `<image width="${width}" height="${height}" href="${section.discCanvas.toDataURL()}"/>\n` +
    [...lines.surfaces.map(line => path(line.points, inkOf("detachment"), 1.5)),
      ...(lines.horizons || []).map(line => path(line.points, inkOf("horizons"), 1)),
      ...lines.faults.map(line => path(line.points, inkOf("faults"), 2))].join("\n") + "\n</svg>\n";
}
