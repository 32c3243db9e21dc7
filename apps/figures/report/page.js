// The page: what is shown, what is clicked.

const page = {
  data: dataOf("data"),
  runs: [], sections: [],
  t: 0, mode: "strata", palette: "figures", layers: {}, shown: new Set(), picked: null, opacity: 0.5,
  view: {left: 0, top: 0, scale: 1, height: 1},
};

const counts = new Intl.NumberFormat("en", {maximumFractionDigits: 0});

/** The run whose moments the slider runs through: the longer one, where two do not end together (to a cycle's way). */
function leader() { return page.runs.reduce((a, b) => travelOf(b.moments.at(-1)) > 1.001 * travelOf(a.moments.at(-1)) ? b : a); }

/** How far the slider is, m. */
function shownTravel() { return travelOf(leader().moments[page.t]); }

/** The moment of a run beside the one that the slider is at. */
function momentOf(run) { return run === leader() ? page.t : run.nearest(shownTravel()); }

// -- drawing

/** A fifteenth of the thickest model, as in the figures: a kilometre of one of 15 km. */
function marginUnit() { return Math.max(...page.runs.map(run => run.head.thickness_m)) / 15; }

/** Edges of a run's section, m: of the model at its start and its largest, and of the discs at any moment. */
function extentOf(run) {
  const {length_m: length, extension_m: extension, thickness_m: depth} = run.head;
  const extent = {left: 0, top: 0, right: length + extension, bottom: depth};
  run.codes.forEach(({present}, k) => {
    const [x, z, radius] = ["x_m", "depth_m", "radius_m"].map(name => run.values(k, name));
    present.forEach((there, id) => {
      if (!there) return;
      extent.left = Math.min(extent.left, x[id] - radius[id]);
      extent.right = Math.max(extent.right, x[id] + radius[id]);
      extent.top = Math.min(extent.top, z[id] - radius[id]);
      extent.bottom = Math.max(extent.bottom, z[id] + radius[id]);
    });
  });
  return extent;
}

/** The edges of all sections with room around them: a footwall with stresses reaches far below and to the left. */
function edges() {
  const unit = marginUnit(), of = (name, best) => best(...page.runs.map(run => (run.extent ??= extentOf(run))[name]));
  return {left: of("left", Math.min) - (hasFootwall() ? 20 : 1) * unit, top: of("top", Math.min) - 2 * unit,
    right: of("right", Math.max) + unit, bottom: of("bottom", Math.max) + (hasFootwall() ? 9 : 1) * unit};
}

function layOut() {
  const {left, top, right, bottom} = edges();
  for (const section of page.sections) {
    const width = section.host.clientWidth, ratio = Math.min(window.devicePixelRatio || 1, 2);
    const height = Math.round(Math.max(Math.min(width * page.view.height * (bottom - top) / (right - left), window.innerHeight * 0.75), 140));
    section.host.style.aspectRatio = `${width} / ${height}`;
    section.host.style.setProperty("--ratio", width / height);
    section.resize(Math.round(width * ratio), Math.round(height * ratio));
  }
}

function hasFootwall() { return page.shown.has("footwall") && "footwall" in page.layers; }

function showWhole() {
  const canvas = page.sections[0].discCanvas, {left, top, right, bottom} = edges(), longest = right - left;
  const scale = Math.min(canvas.width / longest, canvas.height / (bottom - top) / page.view.height);
  Object.assign(page.view, {left: left - (canvas.width / scale - longest) / 2, top, scale});
}

let drawing = 0;

/** Lines of the second run, whose faults are drawn over the first one; null without one. */
async function linesOfOther() {
  const other = page.runs[1];
  return other ? other.loadLines(momentOf(other)) : null;
}

/** Paints the sections; what is around them follows. */
async function draw() {
  const turn = ++drawing;
  const inked = run => shownLayers(run, "discs", page.shown);
  await Promise.all(page.runs.map(run => run.load([...modes[page.mode].needs, ...(page.shown.has("bonds") ? bondStreams : []),
    ...inked(run).map(([name]) => name), ...(page.mode === "strata" ? ["layer", "start_travel_m"] : [])])));
  if (turn !== drawing) return;
  const top = scaleEnd(page.runs, page.mode);
  const strata = Math.max(...page.runs.map(run => run.codes.at(-1).stratum.reduce((a, b) => Math.max(a, b), 0)));
  const others = await linesOfOther();
  for (const section of page.sections) {
    const k = momentOf(section.run);
    if (section.name) section.name.textContent = nameOf(section.run);
    const colours = discColours(section.run, k, page.mode, page.palette, top, strata);
    section.painter.paint(page.view, section.discs(k), inkDiscs(colours, section.run, k, inked(section.run)));
    await section.draw(k, page.view, page.shown, page.picked, section.run === page.runs[0] ? others : null);
  }
  page.scale = {top, strata};
  drawLegend();
  await addFootwallLegend();
  tell();
  writeAddressSoon();
}

/** When the youngest stratum of all runs was laid down, in the page's unit of time. */
function youngestTime() {
  return Math.max(...page.runs.map(run => timeOf(run, run.values(run.moments.length - 1, "start_travel_m").reduce((a, b) => Math.max(a, b), 0))));
}

/** Whether a disc that is shown has no strain of the window. */
function hasUndefined(run) {
  const k = momentOf(run), {present} = run.codes[k];
  return run.values(k, modes[page.mode].needs[0]).some((value, id) => present[id] && Number.isNaN(value));
}

/** Whether the seismic image is over the discs of every section. */
function isCovered() { return page.shown.has("seismic") && page.runs.every(run => run.lines[momentOf(run)]?.seismic); }

/** Entries of the legend of what is shown: a colour, or colours from one number to another, and a label. */
function legendItems() {
  const {top, strata} = page.scale, {unit} = modes[page.mode], table = paletteOf(page.mode, page.palette), items = [];
  const bar = colour => Array.from({length: 60}, (_, n) => cssColour(colour(n / 59)));
  if (isCovered()) { /* by the seismic image */ }
  else if (page.mode === "rock") items.push(...vocabulary.rock_classes.map(({label, colour}) => ({label, colour})));
  else if (page.mode === "strata") {
    if (strata) items.push({label: `sediment laid down (${timeUnit().name}), ${strata} strata`, from: 0, to: digits(youngestTime(), 2),
      colours: bar(share => stratumColour(Math.min(1 + Math.floor(share * strata), strata), strata, table))});
    const beds = page.runs.flatMap(one => (one.head.rock_layers || []).map((label, n) => ({colour: layerColour(n + 1), label})));
    items.push(...new Map(beds.map(bed => [bed.colour + bed.label, bed])).values());
    vocabulary.pre_rift.colours.forEach((colour, n) =>
      items.push({colour, label: n ? "by turns" : `pre-rift, layers of ${vocabulary.pre_rift.layer_m / 1000} km`}));
  } else items.push({label: modeLabel(page.mode, page.runs), from: 0, to: `${plain(top / (unit || 1))} or more`,
    colours: bar(share => table[Math.round(255 * share)])});
  if (["window", "settled_window"].includes(page.mode) && !isCovered() && page.runs.some(hasUndefined)) items.push(vocabulary.scale.undefined);
  for (const name of ["faults", "horizons", "picks", "target", "predictions"])
    if (page.shown.has(name) && name in page.layers) items.push({label: page.layers[name].label, colour: page.layers[name].ink});
  for (const [name, layer] of Object.entries(page.layers))
    if (layer.kind && page.shown.has(name)) items.push({label: layer.label, colour: layer.ink});
  if (page.shown.has("seismic") && page.layers.seismic)
    items.push({label: "seismic image in depth: dark where rock below is harder", colour: "#6e6e6e"});
  return items;
}

function drawLegend() {
  const host = $("legend");
  host.textContent = "";
  for (const {label, colour, colours, from, to} of legendItems()) {
    const entry = host.appendChild(document.createElement("span"));
    entry.className = "entry";
    if (!colours) {
      addSwatch(entry, colour);
      entry.append(label);
      continue;
    }
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [160, 14];
    const context = canvas.getContext("2d");
    colours.forEach((one, n) => {
      context.fillStyle = one;
      context.fillRect(n * 160 / colours.length, 0, 160 / colours.length + 1, 14);
    });
    entry.append(`${label} ${from} `, canvas, ` ${to}`);
  }
}

function addSwatch(host, colour) {
  const swatch = host.appendChild(document.createElement("span"));
  swatch.className = "swatch";
  swatch.style.background = colour;
}

async function addFootwallLegend() {
  const run = page.runs.find(isIn.footwall);
  const lines = run && page.shown.has("footwall") && await run.loadLines(momentOf(run));
  if (lines?.footwall)
    $("legend").append(`footwall: change of shear stress, white 0, dark ${digits(lines.footwall.end_mpa, 2)} MPa or more`);
  else if (lines) $("legend").append("the footwall's stress is there at the figures' moments and at the end");
}

/** "5.00 km, 0.500 Myr" */
function momentText(run) {
  const moment = run.moments[momentOf(run)];
  return `${wayText(moment)}, ${timeOf(run, travelOf(moment)).toFixed(3)} ${timeUnit().name}`;
}

/** "B: " of the second of two runs. */
function letterOf(run) { return page.runs.length > 1 ? `${"AB"[page.runs.indexOf(run)]}: ` : ""; }

/** Label of one of two runs, and where it is shown if not where the slider is. */
function nameOf(run) {
  const moment = run.moments[momentOf(run)], isElsewhere = placeText(travelOf(moment)) !== placeText(shownTravel());
  return labelOf(run) + (isElsewhere ? `, here at ${wayText(moment)}` : "");
}

function tell() {
  const run = leader(), moment = run.moments[page.t];
  $("slider").value = page.t;
  $("slider").setAttribute("aria-valuetext", wayText(moment));
  $("moment").textContent = `${letterOf(run)}${momentText(run)}, ${counts.format(moment.discs)} discs`;
  page.chart.moveTo(travelOf(moment));
  drawFaults();
}

async function drawFaults() {
  const run = page.picked?.run || page.runs[0], lines = await run.loadLines(momentOf(run)), {faults} = lines;
  const chosen = page.picked?.kind === "fault" ? page.picked.index : -1;
  drawFaultTable($("faults"), faults, chosen, index => pick({kind: "fault", run, index}), run.head.mean_radius_m);
  const index = Math.max(chosen, 0), fault = faults[index], cutoffs = lines.cutoffs?.[index];
  $("throws_title").textContent = fault ? `Throw along fault ${index}` : "Throw along a fault";
  $("expansion_title").textContent = fault ? `Growth of strata, fault ${index}` : "Growth of strata";
  await run.load(["start_travel_m"]);
  drawThrows($("throws"), fault, cutoffs, horizonNames(lines), page.scale.strata);
  drawExpansion($("expansion"), run, fault, cutoffs, page.scale.strata);
  drawWheeler($("wheeler"), run, momentOf(run));
  await drawUplift(run);
  await describe();
}

async function drawUplift(run) {
  const [line] = (await run.loadLines(momentOf(run))).base, {name, metres} = lengthUnit();
  $("uplift_part").hidden = !line;
  if (line) drawPlain($("uplift"), line.start_x_m.map((x, i) => [x / metres, -line.ddepth_m[i]]), [`x (${name})`, "uplift (m)"],
    {xlabel: `x before extension (${name})`, ylabel: "uplift (m)", drawPoints: false});
}

/** Words for what was clicked. */
async function describe() {
  const {picked} = page;
  if (!picked) return;
  const {run} = picked, k = momentOf(run), which = letterOf(run);
  if (picked.kind === "disc") {
    const id = picked.id;
    if (!run.codes[k].present[id])
      return void ($("picked").textContent = `${which}disc ${id}: not in the model at this moment`);
    await run.load(["start_x_m", "start_depth_m", ...strainStreams, "bonds", "mean_stress_pa", "shear_stress_pa"]);
    const value = name => run.has(name) ? run.values(k, name)[id] : NaN;
    const say = (text, name, unit = 1, suffix = "") => !run.has(name) ? "" :
      `; ${text} ${Number.isNaN(value(name)) ? "not defined" : plain(value(name) / unit) + suffix}`;
    $("picked").textContent = `${which}disc ${id}: stratum ${run.codes[k].stratum[id]}, ` +
      `began at x ${metresText(value("start_x_m"))}, depth ${metresText(value("start_depth_m"))}; is at x ` +
      `${metresText(value("x_m"))}, depth ${metresText(value("depth_m"))}; radius ${value("radius_m").toFixed(1 + metreDecimals())} m` +
      (run.head.settling ? say(`strain of the window without ${run.head.settling}`, "window_tectonic_strain") + say("with it", "window_strain") +
        say(`total strain without ${run.head.settling}`, "total_tectonic_strain") + say("with it", "total_strain")
        : say("strain of the window", "window_strain") + say("total strain", "total_strain")) + say("bonds", "bonds") +
      say("mean stress", "mean_stress_pa", 1e6, " MPa") + say("shear stress", "shear_stress_pa", 1e6, " MPa");
  } else if (picked.kind === "fault") {
    const lines = await run.loadLines(k), fault = lines.faults[picked.index];
    $("picked").textContent = fault ? `${which}fault ${picked.index}: ${fault.attitude}, ${fault.sense}, dip ` +
      `${fault.dip_deg.toFixed(1)}°, ${digits(fault.rate_mm_per_a, 2)} mm/a, ${valueText(fault.length_m, "m", run.head.mean_radius_m)} long` +
      (fault.born_at_m === null ? "; its birth is known at the figures' moments and at the end"
        : `; born at ${metresText(fault.born_at_m)} of extension`) +
      (fault.greatest_throw_m === null ? "" : `; greatest throw ${metresText(fault.greatest_throw_m)}`) +
      throwsOf(fault).map(([horizon, metres, error], n) =>
        `${n ? ", " : "; throw by horizon: "}${horizonName(horizon, horizonNames(lines))} ${metresText(metres)} (± ${metresText(error)})`).join("")
      : `${which}fault ${picked.index}: not active at this moment`;
  } else {
    $("picked").textContent = picked.text;
  }
}

// -- what the user does

/** The number of a moment that there is. */
function momentWithin(t) { return Math.min(Math.max(Math.trunc(t) || 0, 0), leader().moments.length - 1); }

function show(t) {
  page.t = momentWithin(t);
  return draw().catch(trouble);
}

function pick(picked) {
  page.picked = picked;
  return draw().catch(trouble);
}

/** Least and greatest pixels per metre: a model is a dot, a disc is larger than the section. */
function zoomLimits() { return [1 / marginUnit(), 1000 / Math.min(...page.runs.map(run => run.head.mean_radius_m))]; }

function zoom(factor, column, row) {
  const canvas = page.sections[0].discCanvas, {view} = page;
  const at = [column ?? canvas.width / 2, row ?? canvas.height / 2];
  const [x, depth] = page.sections[0].toMetres(view, ...at), [least, greatest] = zoomLimits();
  view.scale = Math.min(Math.max(view.scale * factor, least), greatest);
  view.left = x - at[0] / view.scale;
  view.top = depth - at[1] / view.scale / view.height;
  draw().catch(trouble);
}

function whole() {
  showWhole();
  draw().catch(trouble);
}

let player = 0;

function play() {
  const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  if (player) clearInterval(player);
  player = player ? 0 : setInterval(() => {
    if (page.t + 1 >= leader().moments.length) return play();
    show(page.t + 1);
  }, still ? 1000 : 250);
  if (player && page.t + 1 >= leader().moments.length) show(0);
  $("play").textContent = player ? "Stop" : "Play";
  $("play").setAttribute("aria-pressed", String(Boolean(player)));
}

const keys = {
  ArrowLeft: () => show(page.t - 1), ArrowRight: () => show(page.t + 1), Home: () => show(0), End: () => show(Infinity),
  " ": play, "+": () => zoom(1.5), "-": () => zoom(1 / 1.5), 0: whole,
};

function onKey(event) {
  if (event.defaultPrevented || event.ctrlKey || event.altKey || event.metaKey) return;
  const {tagName, type} = event.target, own = tagName === "SELECT" || type === "range" || tagName === "INPUT";
  if (own && (event.key.startsWith("Arrow") || event.key === "Home" || event.key === "End" || event.key === " ")) return;
  if ((tagName === "BUTTON" || tagName === "SUMMARY") && event.key === " ") return;
  const choice = Object.keys(modes)[Number(event.key) - 1];
  if (keys[event.key]) keys[event.key]();
  else if (choice && [...$("colour").options].some(option => option.value === choice)) {
    page.mode = $("colour").value = choice;
    draw().catch(trouble);
  } else return;
  event.preventDefault();
}

// -- at the start

function addOptions(select, entries, chosen) {
  for (const [value, label] of entries) select.add(new Option(label, value, false, value === chosen));
}

function addLayers() {
  for (const [name, layer] of Object.entries(page.layers)) {
    const label = $("layers").appendChild(document.createElement("label"));
    const box = label.appendChild(document.createElement("input"));
    box.type = "checkbox";
    box.checked = page.shown.has(name);
    box.addEventListener("change", () => {
      box.checked ? page.shown.add(name) : page.shown.delete(name);
      if (name === "footwall") {
        layOut();
        showWhole();
      }
      draw().catch(trouble);
    });
    if (layer.ink) addSwatch(label, layer.ink);
    label.append(` ${layer.label}`);
  }
  if (!page.data.underlay) return;
  const label = $("layers").appendChild(document.createElement("label"));
  label.append("opacity of the picture ");
  const range = label.appendChild(document.createElement("input"));
  Object.assign(range, {type: "range", min: 0, max: 1, step: 0.05, value: page.opacity});
  range.addEventListener("input", () => { page.opacity = range.value; draw().catch(trouble); });
}

function addControls() {
  const [run] = page.runs;
  addOptions($("colour"), modesOf(page.runs).map(name => [name, modeLabel(name, page.runs)]), page.mode);
  addOptions($("palette"), [["figures", "as in the figures"], ...Object.keys(palettes).map(name => [name, name])], page.palette);
  $("height").value = page.view.height;
  const measures = Object.keys(run.history).filter(name => name !== clockOf(run) && run.history[name].some(Number.isFinite));
  addOptions($("column"), measures.map(name => [name, wordsOf(name)]), measures.includes("rollover_tilt_deg") ? "rollover_tilt_deg" : measures[0]);
  addOptions($("second"), [["", "nothing else"], ...measures.map(name => [name, wordsOf(name)])], "");
  $("slider").max = leader().moments.length - 1;
  const on = (id, event, call) => $(id).addEventListener(event, call);
  on("slider", "input", () => show(Number($("slider").value)));
  on("first", "click", () => show(0));
  on("back", "click", () => show(page.t - 1));
  on("forth", "click", () => show(page.t + 1));
  on("last", "click", () => show(Infinity));
  on("play", "click", play);
  on("whole", "click", whole);
  on("closer", "click", () => zoom(1.5));
  on("wider", "click", () => zoom(1 / 1.5));
  on("colour", "change", () => { page.mode = $("colour").value; draw().catch(trouble); });
  on("palette", "change", () => { page.palette = $("palette").value; draw().catch(trouble); });
  on("height", "change", () => { page.view.height = Number($("height").value); layOut(); whole(); });
  on("column", "change", drawCharted);
  on("second", "change", drawCharted);
  addSaves(on);
  document.addEventListener("keydown", onKey);
  window.addEventListener("resize", () => {
    const before = page.sections[0].discCanvas.width;
    layOut();
    page.view.scale *= page.sections[0].discCanvas.width / before;   // as much of the section as before
    draw().catch(trouble);
  });
  page.chart = new HistoryChart($("history"), page.runs, travel => show(leader().nearest(travel)));
  if (measures.length) drawCharted();
}

function drawCharted() { page.chart.draw([$("column").value, $("second").value].filter(Boolean)); }

/** Tables that do not follow the slider. */
function drawTables() {
  drawQuality($("quality"), page.runs);
  drawDifferences($("differences"));
  $("differences_part").hidden = page.runs.length < 2;
  drawMeasures($("measures"), page.runs);
  drawMainMeasures($("main_measures"), page.runs);
}

function addSaves(on) {
  const [section] = page.sections, shown = () => momentOf(page.runs[0]);
  const name = kind => `${page.runs[0].head.scene}-${travelOf(page.runs[0].moments[shown()]).toFixed(metreDecimals())}m-${kind}`;
  on("save_discs", "click", async () => {
    const [run] = page.runs;
    await run.load(Object.keys(run.head.scales).concat("bonds", "behaviour"));
    save(name("discs.csv"), discsCsv(run, shown()), "text/csv");
  });
  const lines = kind => async () => save(name(`${kind}.csv`), linesCsv((await page.runs[0].loadLines(shown()))[kind] || [], page.runs[0].head.mean_radius_m), "text/csv");
  on("save_faults", "click", lines("faults"));
  on("save_horizons", "click", lines("horizons"));
  on("save_history", "click", () => save(`${page.runs[0].head.scene}-history.csv`, page.runs[0].head.history, "text/csv"));
  on("save_png", "click", async () => (await pictureOf(section)).toBlob(blob => save(name("section.png"), blob)));
  on("save_svg", "click", async () => save(name("section.svg"), svgOf(section, shown(), page.view, await page.runs[0].loadLines(shown()), await linesOfOther()), "image/svg+xml"));
  on("copy", "click", async () => {
    writeAddress();
    try { await navigator.clipboard.writeText(`${location.href.split("#")[0]}#${addressWords()}`); $("copy").textContent = "copied"; }
    catch { $("copy").textContent = "copy it from the address bar"; }
  });
}

function addWords() {
  const titles = page.runs.map(run => titleWords(run.head.description || run.head.scene));
  document.title = `${page.runs[0].head.scene}: Listric`;
  const differ = differenceWords();
  $("title").textContent = [...new Set(titles)].join(" beside ") + (differ && new Set(titles).size < 2 ? `: ${differ}` : "");
  $("subtitle").textContent = page.runs.map(run => page.runs.length > 1 ? `${labelOf(run)}, ${run.head.accuracy}`
    : `${run.head.scene}, ${run.head.accuracy}, seed ${run.head.seed}`).join("; ") + (page.data.live ? "; the run goes on" : "") +
    (page.data.left_out ? `; left out so that the file is smaller: ${page.data.left_out}` : "");
  const rocks = [...new Set(page.runs.map(run => run.head.rock))];
  $("rock").textContent = rocks.map((rock, r) => rocks.length > 1 ? `${"AB"[r]}: ${rock}` : rock).join(". ");
  const hashes = page.runs.map(run => run.head.summary?.state_hash).filter(Boolean);
  const words = Object.entries(page.runs[0].head.summary?.provenance || {}).map(([name, value]) => `${name} ${value}`);
  $("footer").textContent = `${words.length ? `Run: ${words.join(", ")}. Page: ` : ""}${page.data.program}${hashes.length ? `; state_hash ${hashes.join(", ")}` : ""}. To cite: ` +
    "CITATION.cff of the program. Palettes: viridis and magma, Smith and van der Walt (2015); batlow, Crameri (2021), doi 10.5281/zenodo.5501399.";
}

/** Says what the page lacks. */
function say(lack) {
  $("lacks").hidden = false;
  $("lacks").textContent = `${$("lacks").textContent || "This page is not whole: "}${$("lacks").textContent ? "; " : ""}${lack}`;
}

async function start() {
  $("trouble").hidden = true;
  (page.data.lacks || []).forEach(say);
  page.runs = page.data.runs.map(head => new Run(head));
  if (page.runs.some(run => run.moments.length === 0)) throw new Error("there is no snapshot yet");
  await Promise.all(page.runs.map(run => Promise.all([run.loadKnown(), run.load(["present", "x_m", "depth_m", "radius_m", "stratum", "rock"])])));
  page.layers = layersOf(page.runs);
  const view = readAddress();
  page.sections = page.runs.map(run => {
    const host = $("sections").appendChild(document.createElement("div"));
    host.className = "section";
    const section = new Section(run, host);
    if (page.runs.length > 1) {
      section.name = host.appendChild(document.createElement("div"));
      section.name.className = "name";
    }
    listenTo(section);
    return section;
  });
  addWords();
  page.view.height = view ? view[3] : 1;
  layOut();
  showWhole();
  if (view) Object.assign(page.view, {left: view[0], top: view[1],
    scale: view[2] * page.sections[0].discCanvas.width / page.sections[0].host.clientWidth});
  if (page.data.underlay) {
    page.underlay = new Image();
    page.underlay.src = page.data.underlay.image;
    try { await page.underlay.decode(); }
    catch { say("the browser cannot show the picture below the section"); page.data.underlay = page.underlay = null; }
  }
  addLayers();
  addControls();
  await draw();
  page.firstFrame = performance.now();
  drawTables();
  document.documentElement.dataset.ready = "true";
  if (page.data.live) followFile();
}

/** Looks for newer moments every few seconds: a hidden copy of this file hands over its data. */
function followFile() {
  const frame = document.createElement("iframe");
  frame.hidden = true;
  window.addEventListener("message", event => {
    if (event.source !== frame.contentWindow || typeof event.data !== "string") return;
    frame.remove();
    takeNewer(event.data).catch(() => {}).then(() => { if (page.data.live) setTimeout(look, page.lookAfter); });
  });
  page.lookAfter = 5000;
  const look = page.look = () => {
    frame.src = `${location.href.split("#")[0]}#feed`;
    document.body.append(frame);
  };
  setTimeout(look, page.lookAfter);
}

/** Takes over data of the same run, if they have more; view, colours and what is picked stay. */
async function takeNewer(text) {
  const data = JSON.parse(text), before = page.runs[0].moments.length, atEnd = page.t === leader().moments.length - 1;
  const more = data.runs[0].moments.length;
  if (data.runs[0].scene !== page.runs[0].head.scene || more < before || (more === before && data.live)) return;
  const runs = data.runs.map(head => new Run(head));
  await Promise.all(runs.map(run => Promise.all([run.loadKnown(), run.load(["present", "x_m", "depth_m", "radius_m", "stratum", "rock"])])));
  if (page.picked) page.picked.run = runs[page.runs.indexOf(page.picked.run)];
  [page.data, page.runs] = [data, runs];
  page.sections.forEach((section, r) => { section.run = runs[r]; });
  page.chart.runs = runs;
  $("slider").max = leader().moments.length - 1;
  addWords();
  drawCharted();
  drawTables();
  await show(atEnd ? Infinity : page.t);
}

if (location.hash === "#feed" && window.parent !== window) window.parent.postMessage($("data").textContent, "*");
else if (page.data && vocabulary) start().catch(trouble);
