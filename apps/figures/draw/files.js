// Files that the page reads and writes: scenes, picks and pictures.

/** Puts a document into the page; picks that its table names come as files of their own. */
function showDocument(scene, name, picks = {horizons: [], faults: []}, faultPoints = null) {
  const {shift, asked, lines} = takeObserved(scene);
  page.state = {...page.state, scene, file: name, asked: {...asked, shift}, faultPoints,
    picks: {horizons: [...picks.horizons, ...lines.horizons], faults: [...picks.faults, ...lines.faults]}};
}

const pickKinds = ["horizons", "faults"];

/** What the program adds to every x of a picked fault, and of picks that have no shift of their own. */
function faultShift(scene) { return Number(scene.detachment?.shift_x_m) || 0; }

/** Takes [observed] out of a scene: lines, names of files that are asked for, the shift of both, and the picture with its place.
 * What is none of these stays. */
function takeObserved(scene) {
  const {horizon_lines: horizons = [], fault_lines: faults = [], picture, corners_m: corners, shift_x_m: ownShift, ...names} = scene.observed || {};
  const areLines = list => Array.isArray(list) && list.every(line => Array.isArray(line?.x_m) && Array.isArray(line.depth_m));
  const isGood = areLines(horizons) && areLines(faults) && Object.entries({picture: "", ...names}).every(([key, name]) =>
    ["picture", ...pickKinds].includes(key) && typeof name === "string");
  if (!isGood) return {shift: 0, asked: {}, lines: {horizons: [], faults: []}};
  delete scene.observed;
  return {shift: Number(ownShift ?? faultShift(scene)) || 0, lines: {horizons, faults},
    asked: {...names, ...(picture ? {picture: {name: picture, corners: corners?.length === 4 ? corners : null}} : {})}};
}

function hasPicks(kind) { return page.state.picks[kind].some(line => line.x_m.length); }

/** Kinds of picks that stay in a file that nobody has dropped. */
function kindsInFiles() { return pickKinds.filter(kind => page.state.asked[kind] && !hasPicks(kind)); }

/** What the program is to add to every x of the picks that it reads: a file that nobody has dropped needs it. */
function shiftOfPicks() { return kindsInFiles().length ? page.state.asked.shift : 0; }

/** Files that layers and old faults name. */
function filesOfLists() {
  const all = [...page.forms.lists.keys()].flatMap(name => page.state.scene[name] ?? []);
  return all.flatMap(one => ["csv", "top_csv", "bottom_csv"].map(key => one[key]).filter(Boolean));
}

function missingFiles() {
  const {asked, scene} = page.state, table = scene.detachment, names = kindsInFiles().map(kind => asked[kind]);
  if (table?.csv || table?.svg) names.push(table.csv || table.svg);
  if (asked.picture) names.push(asked.picture.name);
  return [...names, ...filesOfLists().filter(name => !page.given[`/${name}`])];
}

/** Picks of a CSV file, or the points of a fault and what is fitted to them. Of a fault that is in an SVG, the scene says where. */
function takePicks(text, name) {
  if (!model) throw new Error(`${name}: to read picks ${lacksModel}`);
  const {asked, scene} = page.state, isDrawing = /\.svg$/i.test(name), ofList = filesOfLists().find(own => own.split("/").at(-1) === name);
  page.given[`/${ofList ?? name}`] = text;
  model.give(`/${ofList ?? name}`, text);
  if (ofList) {
    showAll();
    return tell(`${name} is read with the scene, which needs it beside it.`);
  }
  const isFault = isDrawing || !/^[^#\n]*\bname\b/m.test(text) || scene.detachment?.csv?.endsWith(name);
  if (isFault) return takeFault(name, isDrawing ? {svg: name} : {csv: name});
  const lines = answerOf("lines", {file: `/${name}`, shift_m: asked.shift});
  if (lines.fault) throw new Error(lines.fault);
  const kind = asked.faults && asked.faults.endsWith(name) ? "faults" : asked.horizons && asked.horizons.endsWith(name) ? "horizons"
    : /fault/i.test(name) ? "faults" : "horizons";
  change("", state => {
    state.picks[kind] = [...state.picks[kind].filter(old => !lines.some(line => line.name === old.name)), ...lines];
    page.line = {kind, index: state.picks[kind].length - 1};
    delete state.asked[kind];
  });
  setTool("picks");
  tell(`${name}: ${lines.length} ${kind}.`);
}

/** Shows a picked fault as dots, and the detachment that is fitted to them; how it is read, the scene says. */
function takeFault(name, file) {
  const {csv, svg, segments, start_dip_deg: dip, ...how} = page.state.scene.detachment || {};
  const found = answerOf("fault", {...how, ...file});
  if (!found.x_m) throw new Error(found.fault);
  change("", state => {
    state.faultPoints = {x_m: found.x_m, depth_m: found.depth_m};
    if (found.fault) return;
    state.scene.detachment = Object.fromEntries(Object.entries({...how}).filter(([key]) => !drawnElsewhere.detachment.includes(key)));
    putShape(state, shapeOf(found));
  });
  const count = `${name}: ${found.x_m.length} points, drawn as dots.`;
  if (found.fault) tell(`${count} Drag the nodes onto them: ${asOfFile(found.fault)}`);
  else tell(`${count} The detachment is fitted to them, at most ${placeText(found.misfit_m)} off. Undo brings back the one before.`);
}

function readPicture(file) {
  return new Promise((done, failed) => {
    const reader = new FileReader(), image = new Image();
    reader.onload = () => { image.src = reader.result; };
    reader.onerror = image.onerror = () => failed(new Error(`${file.name}: is no picture that a browser reads; PNG or JPEG`));
    image.onload = () => done({image: reader.result, name: file.name, width: image.naturalWidth, height: image.naturalHeight});
    reader.readAsDataURL(file);
  });
}

/** Lays a picture under the section; without corners over all of its width. */
function takePicture(state, picture, corners) {
  const {length, distance} = settings(), across = length + distance, {width, height} = picture;
  const [x0, z0, x1, z1] = corners || [0, 0, across, across * height / width];
  page.pictureImage = picture;
  delete state.asked.picture;
  state.picture = (corners ? [0, 1] : [0.1, 0.9]).map(share =>
    ({px: share * width, py: share * height, x: x0 + share * (x1 - x0), depth: z0 + share * (z1 - z0)}));
}

async function takeFiles(files) {
  const order = file => /\.toml$/i.test(file.name) ? 0 : /\.(csv|svg)$/i.test(file.name) ? 1 : 2;
  for (const file of [...files].sort((a, b) => order(a) - order(b)))
    try {
      if (order(file) === 0) takeSceneFile(await file.text(), file.name);
      else if (order(file) === 1) takePicks(await file.text(), file.name);
      else {
        const picture = await readPicture(file), asked = page.state.asked.picture;
        change("", state => takePicture(state, picture, asked?.corners));
        setTool("picture");
        if (asked?.corners) tell(`${file.name} lies where the scene has ${asked.name}.`);
      }
    } catch (error) {
      tell(error.message);
    }
}

function takeSceneFile(text, name) {
  if (!model) return tell(`${name}: to read a scene ${lacksModel}; begin with: listric draw ${name}`);
  const scene = `/${name}`;
  model.give(scene, text);
  let document;
  try {
    document = model.ask("document", {scene});
  } catch (error) {
    return tell(asOfFile(error.message));
  }
  page.chosen = "";
  page.line = null;
  page.forms.bad.clear();
  page.now = {...page.now, in_force: {}, ...answerOf("read", {scene})};
  change("", () => showDocument(document, name));
  page.fresh = text;
  $("extension").value = $("extension").max;
  showAll();
  showWhole();
  const missing = missingFiles();
  if (missing.length) tell(`${name} names ${missing.join(" and ")}. Drop ${missing.length > 1 ? "them" : "it"} here, too; or begin with: listric draw ${name}`);
}

/** The scene with picks and picture as files beside it. */
function sceneText(isNamed = kind => hasPicks(kind) || page.state.asked[kind]) {
  const scene = structuredClone(page.state.scene), {asked} = page.state, shift = shiftOfPicks(), observed = {};
  for (const kind of pickKinds.filter(isNamed)) observed[kind] = hasPicks(kind) ? picksFile(kind) : asked[kind];
  if (Object.keys(observed).length && (shift || faultShift(scene))) observed.shift_x_m = shift;
  Object.assign(observed, pictureKeys());
  if (Object.keys(observed).length) scene.observed = observed;
  return `# Drawn with ${facts.program}.\n\n${textOf(scene)}`;
}

/** Where the picture lies, as [observed] has it. */
function pictureKeys() {
  const picture = pictureNow(), {asked} = page.state;
  if (picture) return {picture: picture.file || picture.name, corners_m: cornersOf(picture).map(x => roundLength(x, placeDecimals() + 2))};
  return asked.picture ? {picture: asked.picture.name, ...(asked.picture.corners ? {corners_m: asked.picture.corners} : {})} : {};
}

function picksFile(kind) { return `${baseName()}-${kind}.csv`; }

/** Name of what is saved: as typed, else the scene's; names of shipped scenes stay with them. */
function baseName() {
  const {saveAs, scene, file} = page.state;
  const name = (saveAs || scene.name || file.replace(/\.toml$/i, "") || "drawn").replace(/[^\p{L}\p{N}_.-]+/gu, "-");
  return facts.shelf.includes(name.toLowerCase()) ? `${name}-drawn` : name;
}

/** The call that runs what is saved: at standard where that takes less than five minutes, since draft traces few faults. */
function runCall() {
  const {accuracy} = page.state.scene, call = `listric run ./${baseName()}.toml`, {draft, standard} = page.seconds;
  if (accuracy) return call;
  if (!(standard >= 300)) return `${call} --accuracy standard`;
  return `${call} --accuracy draft (about ${duration(draft)}; draft traces few faults, standard takes about ${duration(standard)})`;
}

/** Picks as the program reads them, which adds the shift; lines of one name are its pieces. */
function picksText(kind) {
  const lines = page.state.picks[kind], withAges = kind === "horizons", shift = shiftOfPicks();
  const inPieces = new Set(lines.map(line => line.name)).size < lines.length;
  const quoted = text => /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  const rows = lines.flatMap((line, number) => line.x_m.map((x, k) => [...(inPieces ? [number] : []), quoted(line.name), roundLength(x - shift, 6), line.depth_m[k], ...(withAges ? [line.age_a ?? ""] : [])].join(",")));
  return [[...(inPieces ? ["line"] : []), "name", "x_m", "depth_m", ...(withAges ? ["age_a"] : [])].join(","), ...rows].join("\n") + "\n";
}

function download(name, text, type) {
  const link = element("a", {href: URL.createObjectURL(new Blob([text], {type})), download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

async function save() {
  tell("The program reads the scene.");
  await verdictNow();
  const faults = showState(), missing = missingFiles(), {asked} = page.state;
  const replaced = pickKinds.filter(kind => asked[kind] && hasPicks(kind)).map(kind => `. Its ${kind} take the place of ${asked[kind]}, which was not dropped`);
  if (faults.length && !missing.some(name => faults[0].message.includes(name))) {
    tell(`Not saved: ${faults[0].message}`);
    $("state").scrollIntoView({block: "nearest"});
    return;
  }
  page.saved = true;
  download(`${baseName()}.toml`, sceneText(), "application/toml");
  if (!$("save_picks").disabled) savePicks();
  const beside = [...missing, ...(pictureNow() && !pictureNow().file ? [pictureNow().name] : [])];
  tell(`Saved ${baseName()}.toml. Next: listric check ./${baseName()}.toml, then ${runCall()}` +
    (beside.length ? `. It needs ${beside.join(" and ")} beside it.` : "") + replaced.join(""));
}

function savePicks() {
  for (const kind of pickKinds.filter(hasPicks)) download(picksFile(kind), picksText(kind), "text/csv");
}
