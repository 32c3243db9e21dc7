// Runs of what is drawn, in this page: the program's own model, in a worker for each seed.

const hasModule = Boolean($("module").textContent.trim());

/** The module's bytes; the page has them compressed, as text. */
async function moduleBytes() {
  const packed = Uint8Array.from(atob($("module").textContent.trim()), letter => letter.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

const workerUrl = hasModule && URL.createObjectURL(new Blob([$("worker").textContent], {type: "text/javascript"}));

/** What the module reads in place of files, and which scene of it; at draft, where it is run and says nothing else.
 * A shipped scene as it is goes by its name, by which its errors are known. */
function requestNow(seed) {
  const name = shippedNow(), path = `/${baseName()}.toml`, own = name ? {} : {[path]: sceneText()};
  const files = {...facts.files, ...own};
  for (const kind of pickKinds.filter(hasPicks)) files[`/${picksFile(kind)}`] = picksText(kind);
  const {accuracy = "draft"} = page.state.scene;
  return {files, request: {scene: name || path, ...(seed === undefined ? {} : {accuracy, seed})}};
}

/** The name of the shipped scene that is drawn; none where something has changed. */
function shippedNow() { return page.shipped?.text === sceneText() ? page.shipped.name : undefined; }

/** What is drawn is a shipped scene, as yet. */
function rememberShipped(name) { page.shipped = {name, text: sceneText(), description: page.state.scene.description}; }

/** Takes a shipped scene in place of what is drawn, which undo brings back. */
function takeExample(name) {
  takeSceneFile(facts.files[`/listric/scenes/${name}.toml`], `${name}.toml`);
  rememberShipped(name);
  checkSoon();
}

/** The shipped scene that the address names behind its #. */
function takeExampleOfAddress() {
  const name = location.hash.slice(1);
  if (facts.shelf.includes(name)) takeExample(name);
}

/** A message of the module as it reads beside the file that will be saved. */
function asOfFile(message) { return message.replace(/^\/(?=[^/\s]+\.(toml|csv):)/, ""); }

// -- checks

/** A worker that reads the scene after changes, and what it has said of the last one: null until then. */
const checker = {worker: null, verdict: null, number: 0, timer: 0};

async function beginChecks() {
  if (!hasModule) return;
  const worker = new Worker(workerUrl);
  worker.onmessage = ({data}) => {
    if (data.program && data.program.sources !== facts.sources)
      tellRun(page.otherModel = `The model here is of listric ${data.program.version}, and may compute other bits. `);
    if (!data.failed && !data.read || data.number !== checker.number) return; // of something else, or of before
    checker.verdict = data.failed ? {fault: asOfFile(data.failed)} : data.read;
    const show = () => page.drag ? setTimeout(show, 100) : showState(); // more lines would move what is dragged
    show();
  };
  worker.postMessage({load: await moduleBytes()});
  checker.worker = worker;
  checkSoon();
}

function checkSoon() {
  checker.verdict = null;
  const number = ++checker.number;
  clearTimeout(checker.timer);
  if (checker.worker)
    checker.timer = setTimeout(() => checker.worker.postMessage({check: {...requestNow(), number}}), 300);
}

// -- runs

const runs = [];
const isWorking = run => run.worker && !run.isStopped;
const isUnderWay = () => runs.some(run => run.worker);
const longestSilence = 120; // seconds after which a worker may be gone: nobody tells

async function beginRuns() {
  if (isUnderWay() && !confirm("This ends the runs under way. What they have found is lost, unless you save it first."))
    return;
  for (const run of runs.splice(0)) {
    run.worker?.terminate();
    run.worker = null;
  }
  const faults = showState();
  if (faults.length) return tellRun(`${faults[0].path}: ${faults[0].message}`);
  const first = Number(page.state.scene.seed ?? 1), count = clamp(Math.round(Number($("seeds").value)) || 1, 1, 8);
  const bytes = await moduleBytes();
  $("runs").replaceChildren();
  $("chart").replaceChildren();
  for (let k = 0; k < count; ++k) runs.push(newRun(first + k, bytes));
  showRuns();
}

function newRun(seed, bytes) {
  const now = performance.now(), run = {seed, name: `${shippedNow() || baseName()}-seed-${seed}`,
    request: requestNow(seed), begun: now, heard: now, files: new Zip(), shape: settings(),
    canvas: element("canvas"), words: element("p", {className: "faint"}), table: element("table"),
    verdict: element("p", {className: "faint verdict"}),
    base: (page.chain || []).flatMap(segment => page.section.pointsOf(segment))};
  $("runs").append(element("figure", {}, run.canvas,
    element("figcaption", {}, run.words, element("div", {className: "scroll"}, run.table), run.verdict)));
  run.worker = new Worker(workerUrl);
  run.worker.onmessage = ({data}) => takeMessage(run, data);
  run.worker.onerror = event => { event.preventDefault(); endRun(run, `the run has failed: ${event.message}`); };
  run.worker.postMessage({load: bytes.slice(0)});
  run.worker.postMessage({start: run.request});
  return run;
}

function takeMessage(run, data) {
  run.heard = performance.now();
  if (data.read) run.scene = data.read;
  if (data.progress) run.stage = data.progress.split("  ")[1] ?? data.progress;
  if (data.moment) {
    run.firstPicture ??= performance.now();
    Object.assign(run, {moment: data.moment, discs: data.discs, memory: data.memory});
    paintRun(run);
  }
  if (data.file) takeFile(run, data);
  if (data.radius) run.radius = data.radius;
  if (data.travel !== undefined) run.travel = data.travel;
  if (data.stopped) run.isStopped = true;
  if (data.failed) return endRun(run, asOfFile(data.failed));
  if (data.done) {
    Object.assign(run, {moment: data.done, summary: data.summary});
    paintRun(run);
    showMeasures(run, data.verdict);
    return endRun(run, "");
  }
  showRuns();
}

/** A file of the run's folder; a later one of its name takes its place. */
function takeFile(run, {file, bytes}) {
  run.files.add(file, bytes);
  if (file !== "history.csv") return;
  run.history = historyOf(new TextDecoder().decode(bytes));
  showHistory();
}

function endRun(run, why) {
  run.worker.terminate();
  Object.assign(run, {worker: null, failure: why, seconds: (performance.now() - run.begun) / 1000});
  showRuns();
}

function stopOrGoOn() {
  const goesOn = !runs.some(isWorking);
  for (const run of runs.filter(one => one.worker)) {
    if (goesOn) run.isStopped = false;
    run.worker.postMessage(goesOn ? {goOn: true} : {stop: true});
  }
  showRuns();
}

/** Seconds until the end, as the extension so far has gone; undefined: not known yet. */
function secondsLeft(run) {
  const done = (run.travel ?? run.moment?.travel ?? 0) / run.scene?.distance_m;
  return done > 0.01 ? (performance.now() - run.firstPicture) / 1000 * (1 - done) / done : undefined;
}

function wordsOf(run) {
  if (run.failure) return `Seed ${run.seed}: ${run.failure}`;
  const silence = (performance.now() - run.heard) / 1000;
  if (isWorking(run) && silence > longestSilence)
    return `Seed ${run.seed}: no word for ${duration(silence)}; the browser may have ended it, for want of memory. ` +
      "Run it again, or with the program";
  if (!run.moment) return `Seed ${run.seed}: ${run.stage ?? "reads the scene"}`;
  const {extension, discs, state_hash: hash} = run.moment, left = secondsLeft(run);
  const until = !run.worker ? `, in ${duration(run.seconds)}` : run.isStopped ? ", stopped"
    : left ? `, ${duration(left)} left` : "";
  return `Seed ${run.seed}: ${placeText(extension)} of extension${until}; ${discs} discs; state_hash ${hash}`;
}

function tellRun(text) { $("run_state").textContent = text; }

function showRuns() {
  for (const run of runs) run.words.textContent = wordsOf(run);
  const alive = runs.filter(run => run.worker);
  $("run_stop").disabled = !alive.length;
  $("run_stop").textContent = alive.length && !alive.some(isWorking) ? "Go on" : "Stop";
  $("save_picture").disabled = !runs.some(run => run.discs);
  $("save_run").disabled = !runs.some(run => run.history);
  const calls = runs.filter(run => run.summary).map(nativeCall);
  if (calls.length) tellRun(`${page.otherModel}The same run by the program: ${calls.join("; ")}`);
  else if (alive.length) tellRun(page.otherModel);
}

/** The results by which runs are told apart, as the report has them at its end, and whether the run is good. */
function showMeasures(run, verdict) {
  const {summary, radius} = run, errors = summary.known_errors || [];
  const known = Object.fromEntries(errors.map(one => [one.measure, one]));
  const rows = Object.entries(mainNumbers(summary, facts.headline)).map(([name, value]) =>
    ({name, told: valueAndError(value, measureUnit(name), radius, known[name])}));
  const heads = ["measure", "value", ...(rows.some(({told: [, error]}) => error) ? ["by recorded runs"] : [])];
  const cells = ({name, told: [value, error]}) => [element("td", {}, measureWords(name)),
    element("td", {className: "number"}, value),
    element("td", {title: errorSources(known[name])}, error && `(${error})`)];
  run.table.replaceChildren(element("tr", {}, ...heads.map(head => element("th", {}, head))),
    ...rows.map(row => element("tr", {}, ...cells(row).slice(0, heads.length))));
  run.verdict.textContent = verdict.join(". ");
}

/** Unit in which times are told, by the way that the runs go. */
function timeUnit() {
  const rateOf = scene => Number(/^rate_m_per_a = (\S+)/m.exec(scene.toml)?.[1]);
  const times = runs.filter(run => run.scene).map(({scene}) => scene.distance_m / rateOf(scene));
  const longest = Math.max(0, ...times.filter(Number.isFinite));
  return longest >= 1e4 ? {name: "Myr", years: 1e6} : {name: "a", years: 1};
}

/** Draws the chosen measure of all runs; the choice has what their histories have. */
function showHistory() {
  const series = runs.filter(run => run.history).map(({seed, history}) => ({label: `seed ${seed}`, history}));
  const isKnown = name => series.some(({history}) => history[name]?.some(Number.isFinite));
  const names = [...new Set(series.flatMap(({history}) => Object.keys(history)))]
    .filter(name => !["extension_m", "travel_m"].includes(name) && isKnown(name));
  const select = $("charted"), chosen = select.value || "rollover_tilt_deg";
  if (select.options.length !== names.length)
    select.replaceChildren(...names.map(name => new Option(measureWords(name), name)));
  select.value = names.includes(chosen) ? chosen : names[0];
  $("history").hidden = !series.length;
  if (series.length) drawHistory($("chart"), select.value, series);
}

function nativeCall({seed, request: {request: {scene, accuracy}}}) {
  return `listric run ${scene.replace(/^\//, "./")} --accuracy ${accuracy} --seed ${seed}`;
}

// -- pictures

/** Colours of discs by stratum or strain: those of figures and report. */
function discColour(mode, strata) {
  const byStrain = mode === "strain", {rows} = vocabulary.palettes[vocabulary[byStrain ? "scale" : "strata"].palette];
  const at = share => `#${rows.slice(6 * Math.round(255 * clamp(share, 0, 1))).slice(0, 6)}`;
  const {colours, layer_m: layer} = vocabulary.pre_rift;
  if (byStrain) return (stratum, strain) => at(strain / 2);
  const ofRock = depth => colours[Math.floor(Math.max(depth, 0) / layer) % colours.length];
  return (stratum, strain, depth) => stratum > 0 ? at((stratum - 1) / Math.max(strata - 1, 1)) : ofRock(depth);
}

function paintRun(run) {
  if (!run.discs) return;
  const {canvas, discs, scene, shape: {length, thickness}} = run, width = $("runs").clientWidth;
  const scale = width / (1.02 * (length + scene.distance_m)), height = Math.round(1.25 * thickness * scale);
  const sharp = window.devicePixelRatio || 1, pen = canvas.getContext("2d");
  const {color: ink, backgroundColor: ground} = getComputedStyle(document.body);
  canvas.width = Math.round(width * sharp);
  canvas.height = Math.round(height * sharp);
  pen.scale(sharp, sharp);
  pen.fillStyle = ground;
  pen.fillRect(0, 0, width, height);
  let strata = 0;
  for (let k = 0; k < discs.length; k += 6) strata = Math.max(strata, discs[k + 3]);
  const colourOf = discColour($("run_colours").value, strata);
  const column = x => x * scale + 0.01 * width, row = y => 0.15 * thickness * scale - y * scale;
  for (let k = 0; k < discs.length; k += 6) {
    pen.fillStyle = colourOf(discs[k + 3], discs[k + 4], discs[k + 5]);
    pen.beginPath();
    pen.arc(column(discs[k]), row(discs[k + 1]), discs[k + 2] * scale, 0, 7);
    pen.fill();
  }
  const line = (points, colour) => {
    pen.strokeStyle = colour;
    pen.lineWidth = 1.5;
    pen.beginPath();
    for (const [x, y] of points) pen.lineTo(column(x), row(y));
    pen.stroke();
  };
  line(run.base.map(({x, y}) => [x, y]), ink);
  for (const {points_m: points} of run.summary?.faults || [])
    line(points.map(([x, depth]) => [x, -depth]), vocabulary.layers.faults.ink);
}

function saveRunPictures() {
  for (const run of runs.filter(one => one.discs))
    run.canvas.toBlob(blob => download(`${baseName()}-seed-${run.seed}.png`, blob, "image/png"));
}

/** Folders of runs as the program leaves them, each in a zip; the program can go on with one that has not ended. */
async function saveRuns() {
  const told = [];
  for (const run of runs.filter(one => one.history)) {
    download(`${run.name}.zip`, await run.files.blob(run.name), "application/zip");
    told.push(run.summary ? `listric report ${run.name}`
      : `listric run ${run.name}/scene.toml --resume --output ${run.name}`);
  }
  tellRun(`Saved. Unzip, then: ${told.join("; ")}`);
}

function addRunListeners() {
  $("run_controls").hidden = !hasModule;
  $("no_module").hidden = hasModule;
  if (!hasModule) return;
  $("run").onclick = () => beginRuns().catch(error => tellRun(error.message));
  $("run_stop").onclick = stopOrGoOn;
  $("run_colours").onchange = () => runs.forEach(paintRun);
  $("save_picture").onclick = saveRunPictures;
  $("save_run").onclick = () => saveRuns().catch(error => tellRun(`Not saved: ${error.message}`));
  $("charted").onchange = showHistory;
  $("example").hidden = false;
  $("example").append(...facts.shelf.map(name => new Option(name)));
  $("example").onchange = () => { takeExample($("example").value); $("example").selectedIndex = 0; };
  window.addEventListener("hashchange", takeExampleOfAddress);
  setInterval(() => { if (runs.some(isWorking)) showRuns(); }, 5000);
  showRuns();
  beginChecks().catch(error => tellRun(error.message));
}
