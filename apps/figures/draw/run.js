// Runs of what is drawn, in this page: the program's own model, in a worker for each seed.

// -- runs

const runs = [];
const isWorking = run => run.worker && !run.isStopped;

async function beginRuns() {
  for (const run of runs) run.worker?.terminate();
  runs.length = 0;
  const faults = showState();
  if (faults.length) return tellRun(faults[0].message);
  const first = Number(page.state.scene.seed ?? 1), count = clamp(Math.round(Number($("seeds").value)) || 1, 1, 8);
  const bytes = await moduleBytes();
  $("runs").replaceChildren();
  for (let k = 0; k < count; ++k) runs.push(newRun(first + k, bytes));
  showRuns();
}

function newRun(seed, bytes) {
  const run = {seed, request: requestNow(seed), begun: performance.now(), canvas: element("canvas"),
    words: element("p", {className: "faint"}), table: element("table"), shape: settings(),
    base: (page.chain || []).flatMap(segment => page.section.pointsOf(segment))};
  $("runs").append(element("figure", {}, run.canvas, element("figcaption", {}, run.words, run.table)));
  run.worker = new Worker(workerUrl);
  run.worker.onmessage = ({data}) => takeMessage(run, data);
  run.worker.onerror = event => { event.preventDefault(); endRun(run, `the run has failed: ${event.message}`); };
  run.worker.postMessage({load: bytes.slice(0)});
  run.worker.postMessage({start: run.request});
  return run;
}

function takeMessage(run, data) {
  if (data.read) run.scene = data.read;
  if (data.progress) run.stage = data.progress.split("  ")[1] ?? data.progress;
  if (data.moment) {
    run.firstPicture ??= performance.now();
    Object.assign(run, {moment: data.moment, discs: data.discs, memory: data.memory});
    paintRun(run);
  }
  if (data.travel !== undefined) run.travel = data.travel;
  if (data.stopped) run.isStopped = true;
  if (data.failed) return endRun(run, asOfFile(data.failed));
  if (data.done) {
    Object.assign(run, {moment: data.done, faults: data.faults, measures: data.measures, headline: data.headline});
    paintRun(run);
    return endRun(run, "");
  }
  showRuns();
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
  if (!run.moment) return `Seed ${run.seed}: ${run.stage ?? "reads the scene"}`;
  const {extension, discs, state_hash: hash} = run.moment, left = secondsLeft(run);
  const until = !run.worker ? `, in ${duration(run.seconds)}` : run.isStopped ? ", stopped"
    : left ? `, ${duration(left)} left` : "";
  return `Seed ${run.seed}: ${placeText(extension)} of extension${until}; ${discs} discs; state_hash ${hash}`;
}

function tellRun(text) { $("run_state").textContent = text; }

function showRuns() {
  for (const run of runs) {
    run.words.textContent = wordsOf(run);
    if (run.headline && !run.table.rows.length)
      run.table.append(...run.headline.map(({name, value}) =>
        element("tr", {}, element("td", {}, name), element("td", {className: "number"}, value))));
  }
  const alive = runs.filter(run => run.worker);
  $("run_stop").disabled = !alive.length;
  $("run_stop").textContent = alive.length && !alive.some(isWorking) ? "Go on" : "Stop";
  $("save_picture").disabled = !runs.some(run => run.discs);
  $("save_run").disabled = !runs.some(run => run.headline);
  const calls = runs.filter(run => run.headline).map(nativeCall);
  if (calls.length) tellRun(`${page.otherModel}The same run by the program: ${calls.join("; ")}`);
  else if (alive.length) tellRun(page.otherModel);
}

function nativeCall({seed, request}) {
  return `listric run ./${request.request.scene.slice(1)} --accuracy ${request.request.accuracy} --seed ${seed}`;
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
  for (const {points_m: points} of run.faults || [])
    line(points.map(([x, depth]) => [x, -depth]), vocabulary.layers.faults.ink);
}

function saveRunPictures() {
  for (const run of runs.filter(one => one.discs))
    run.canvas.toBlob(blob => download(`${baseName()}-seed-${run.seed}.png`, blob, "image/png"));
}

/** All that a run has found, with the scene that it was made of: what the program makes again, to the same hash. */
function saveRun() {
  for (const {seed, request, moment, measures, faults, scene} of runs.filter(run => run.headline))
    download(`${baseName()}-seed-${seed}.json`, JSON.stringify({
      program: facts.program, call: nativeCall({seed, request}), ...moment, measures, faults,
      scene: request.files[request.request.scene], in_force: scene.toml}, null, 1), "application/json");
}

function addRunListeners() {
  $("run_controls").hidden = !hasModule;
  $("no_module").hidden = hasModule;
  if (!hasModule) return;
  $("run").onclick = () => beginRuns().catch(error => tellRun(error.message));
  $("run_stop").onclick = stopOrGoOn;
  $("run_colours").onchange = () => runs.forEach(paintRun);
  $("save_picture").onclick = saveRunPictures;
  $("save_run").onclick = saveRun;
  showRuns();
}
