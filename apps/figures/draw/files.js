// Files that the page reads and writes: scenes, picks and pictures.

/** Reads a scene; picks that its table names come as files of their own. */
function readScene(text, name, picks = {horizons: [], faults: []}, faultPoints = null) {
  let read;
  try {
    read = readToml(text);
  } catch (error) {
    if (!(error instanceof TomlError)) throw error;
    tell(`${name}:${error.line}: ${error.message}`);
    return false;
  }
  const scene = read.document, {shift, asked, lines} = takeObserved(scene);
  page.lines = read.lines;
  page.state = {...page.state, scene, file: name, floats: read.floats, asked: {...asked, shift}, picks: {horizons: [...picks.horizons, ...lines.horizons], faults: [...picks.faults, ...lines.faults]}, faultPoints};
  return true;
}

const pickKinds = ["horizons", "faults"];

/** What the program adds to every x of a picked fault, and of picks that have no shift of their own. */
function faultShift(scene) { return Number(scene.detachment?.shift_x_m) || 0; }

/** Takes [observed] out of a scene: lines, names of files that are asked for, the shift of both, and the picture with its place. */
function takeObserved(scene) {
  const observed = typeof scene.observed === "object" ? scene.observed : {};
  const shift = Number(observed.shift_x_m ?? faultShift(scene)) || 0, asked = {};
  const good = faultsBySchema(schema.properties.observed, observed).length === 0;
  const lines = {horizons: good ? observed.horizon_lines || [] : [], faults: good ? observed.fault_lines || [] : []};
  for (const kind of pickKinds) if (good && observed[kind]) asked[kind] = observed[kind];
  if (good && observed.picture) asked.picture = {name: observed.picture, corners: observed.corners_m?.length === 4 ? observed.corners_m : null};
  if (good) delete scene.observed;
  return {shift, asked, lines};
}

function hasPicks(kind) { return page.state.picks[kind].some(line => line.x_m.length); }

/** Kinds of picks that stay in a file that nobody has dropped. */
function kindsInFiles() { return pickKinds.filter(kind => page.state.asked[kind] && !hasPicks(kind)); }

/** What the program is to add to every x of the picks that it reads: a file that nobody has dropped needs it. */
function shiftOfPicks() { return kindsInFiles().length ? page.state.asked.shift : 0; }

function missingFiles() {
  const {asked, scene} = page.state, table = scene.detachment, names = kindsInFiles().map(kind => asked[kind]);
  if (table?.csv || table?.svg) names.push(table.csv || table.svg);
  if (asked.picture) names.push(asked.picture.name);
  return names;
}

/** Rows of a CSV file with a header: commas, semicolons or tabs. Each has its cells by name, and whether an empty line stands before it. */
function readCsv(text) {
  const rows = text.replace(/^\ufeff/, "").split(/\r\n|\n|\r/).filter(row => !row.startsWith("#"));
  const delimiter = [";", "\t", ","].find(sign => rows.find(row => row.trim())?.includes(sign)) || ",";
  const cells = row => row.match(new RegExp(`("([^"]|"")*"|[^${delimiter}]*)(${delimiter}|$)`, "g")).map(cell =>
    cell.replace(new RegExp(`${delimiter}$`), "").trim().replace(/^"([\s\S]*)"$/, (_, inner) => inner.replace(/""/g, '"')));
  const records = rows.map(cells), isEmpty = record => record.every(cell => !cell);
  const head = records.find(record => !isEmpty(record)) || [], below = records.slice(records.indexOf(head) + 1);
  return {head, rows: below.flatMap((record, k) => isEmpty(record) ? [] :
    [{cells: Object.fromEntries(record.slice(0, head.length).map((cell, n) => [head[n], cell])), afterGap: k > 0 && isEmpty(below[k - 1])}])};
}

/** What tells a row's piece from others of its name, as the program has it: columns `line` and `segment`, else the block, by empty lines. */
function piecesOf(head, rows) {
  const labels = head.filter(name => /^(line|segment)$/i.test(name)), labelled = rows.map(row => labels.map(name => row.cells[name]).filter(Boolean).join(", "));
  if (labelled.some(Boolean)) return labelled;
  const isSpaced = rows.filter(row => row.afterGap).length + 1 >= rows.length;
  let block = 0;
  return rows.map(row => block += Number(row.afterGap && !isSpaced));
}

/** Picked lines of a CSV file. Throws Error. */
function picksIn(text, name) {
  const {head, rows} = readCsv(text), pieces = piecesOf(head, rows), lines = new Map(), ages = {};
  for (const needed of ["x_m", "depth_m"])
    if (!head.includes(needed)) throw new Error(`${name}: has no column ${needed}, ${adviceOn(needed, head)}`);
  rows.forEach(({cells: row}, k) => {
    const title = head.includes("name") ? row.name : "picked fault", x = Number(row.x_m), depth = Number(row.depth_m), age = row.age_a ? Number(row.age_a) : undefined;
    if (!title || !row.x_m || !row.depth_m || !Number.isFinite(x) || !Number.isFinite(depth) || age !== undefined && !(age >= 0))
      throw new Error(`${name}: row ${k + 2} needs a name and numbers x_m and depth_m`);
    const key = JSON.stringify(head.includes("name") ? [title, pieces[k]] : title);
    if (!lines.has(key)) lines.set(key, {name: title, x_m: [], depth_m: []});
    const line = lines.get(key);
    if (age !== undefined) ages[title] = age;
    line.x_m.push(x);
    line.depth_m.push(depth);
  });
  for (const line of lines.values()) if (line.name in ages) line.age_a = ages[line.name];
  return {lines: [...lines.values()], hasNames: head.includes("name")};
}

function takeCsv(text, name) {
  const {asked, scene} = page.state, {lines, hasNames} = picksIn(text, name), shift = hasNames ? asked.shift : faultShift(scene);
  for (const line of lines) line.x_m = line.x_m.map(x => x + shift);
  if (!hasNames) {
    change("", state => { state.faultPoints = {x_m: lines[0].x_m, depth_m: lines[0].depth_m}; });
    tell(`${name}: ${lines[0].x_m.length} points, drawn as dots. Drag the nodes onto them.`);
    return;
  }
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
  const order = file => /\.toml$/i.test(file.name) ? 0 : /\.csv$/i.test(file.name) ? 1 : 2;
  for (const file of [...files].sort((a, b) => order(a) - order(b)))
    try {
      if (order(file) === 0) takeSceneFile(await file.text(), file.name);
      else if (order(file) === 1) takeCsv(await file.text(), file.name);
      else if (/\.svg$/i.test(file.name)) tell(`${file.name}: a drawing is fitted by the program: listric draw my.toml with svg = "${file.name}"`);
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
  const before = copyState(page.state);
  if (!readScene(text, name)) return;
  const after = page.state;
  page.state = before;
  page.chosen = "";
  page.line = null;
  page.forms.bad.clear();
  change("", () => { page.state = after; });
  page.fresh = true;
  $("extension").value = $("extension").max;
  showAll();
  showWhole();
  const missing = missingFiles();
  if (missing.length) tell(`${name} names ${missing.join(" and ")}. Drop ${missing.length > 1 ? "them" : "it"} here, too; or begin with: listric draw ${name}`);
}

/** The scene with picks and picture as files beside it. */
function sceneText() {
  const scene = structuredClone(page.state.scene), {asked} = page.state, shift = shiftOfPicks(), observed = {};
  for (const kind of pickKinds) if (hasPicks(kind) || asked[kind]) observed[kind] = hasPicks(kind) ? picksFile(kind) : asked[kind];
  if (Object.keys(observed).length && (shift || faultShift(scene))) observed.shift_x_m = shift;
  Object.assign(observed, pictureKeys());
  if (Object.keys(observed).length) scene.observed = observed;
  return `# Drawn with ${facts.program}.\n\n${writeToml(scene, schema)}`;
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

function save() {
  const faults = showState(), missing = missingFiles(), {asked} = page.state;
  const replaced = pickKinds.filter(kind => asked[kind] && hasPicks(kind)).map(kind => `. Its ${kind} take the place of ${asked[kind]}, which was not dropped`);
  if (faults.length) {
    tell(`Not saved: ${faults[0].path}: ${faults[0].message}`);
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
