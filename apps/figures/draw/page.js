// The page: what is drawn and chosen now, what undo goes back to, and which files it reads and writes.

const facts = dataOf("data"), schema = dataOf("schema");

/** A state is what undo goes back to: the scene's document, picks, and where the picture is. */
const page = {
  state: {scene: {}, picks: {horizons: [], faults: []}, faultPoints: null, picture: null},
  past: [], future: [], floats: new Set(), file: "", pictureImage: null,
  tool: "fault", chosen: "", line: null, drag: null, extension: 0, lastChange: {},
};

const copyState = state => structuredClone(state);
const shapeNow = () => shapeOf(page.state.scene.detachment);
const km = (x, digits = 2) => `${(x / 1000).toFixed(digits)} km`;

// -- changes and undo

/** Makes a change that undo takes back; changes of one kind in quick succession are one. */
function change(kind, make) {
  const before = copyState(page.state), now = performance.now();
  if (make(page.state) === false) return;
  const joined = kind && kind === page.lastChange.kind && now - page.lastChange.time < 800 && !page.future.length;
  if (!joined) page.past.push(before);
  if (page.past.length > 200) page.past.shift();
  page.future = [];
  page.saved = false;
  page.lastChange = {kind, time: now};
  showAll();
}

function travel(from, to) {
  if (!from.length) return;
  to.push(copyState(page.state));
  page.state = from.pop();
  page.lastChange = {};
  page.forms.bad.clear();
  showAll();
}

function setAt(scene, path, value) {
  const [table, key] = path.includes(".") ? path.split(".") : [null, path], inside = table ? scene[table] ??= {} : scene;
  if (value === undefined) delete inside[key];
  else inside[key] = value;
}

/** Puts a shape into the scene; the hanging wall is as thick as it is deep. */
function putShape(state, shape) {
  Object.assign(state.scene.detachment, tableOf(shape));
  (state.scene.hanging_wall ??= {}).thickness_m = Number(depthOf(shape).toFixed(2));
}

/** A shape that a node's change made, at the depth that is kept if so asked. */
function atKeptDepth(before, after) {
  if ($("keep_depth").checked && !setDepth(after, depthOf(before))) return before;
  return objectionToShape(after) ? before : after;
}

function changeShape(kind, make) {
  const before = shapeNow();
  if (!before) return;
  const after = make(before);
  if (after) change(kind, state => putShape(state, atKeptDepth(before, after)));
  else tell("That is not possible here: pieces would be too short, or the detachment would not end flat.");
}

// -- faults

function faultsNow() {
  const {scene} = page.state, found = faultsBySchema(schema, scene, page.floats);
  const all = found.length ? found : faultsOfWhole(facts, schema, scene);
  const typed = [...page.forms.bad].map(([path, message]) => ({path, message}));
  return [...typed, ...all.filter(fault => !page.forms.bad.has(fault.path))];
}

function tell(text) { $("told").textContent = text; }

// -- showing

function settings() {
  const {scene} = page.state, of = path => Number(valueAt(facts, schema, scene, path));
  return {length: of("hanging_wall.length_m"), thickness: of("hanging_wall.thickness_m"), distance: of("extension.distance_m")};
}

/** Draws the section as it is now; forms and tables stay as they are. */
function showSection() {
  const {scene, picks, faultPoints} = page.state, {length, distance} = settings(), section = page.section, shape = shapeNow();
  const good = shape && shape.pieces.length && shape.pieces.every(piece => piece.radius > 0 || piece.length > 0);
  const chain = (shape ? good && chainOf(shape, 1.5 * (length + 2 * distance)) : baseOf(facts, schema, scene)) || null, angle = Number($("angle").value);
  const fault = good ? new ShearCoordinate(chain, Math.tan(angle * degree)) : null;
  page.chain = chain;
  section.drawPicture(pictureNow(), Number($("opacity").value));
  if (chain) section.drawModel({chain, shape: good ? shape : null, fault, length, extension: page.extension, angle,
    preview: Boolean(good), chosen: page.tool === "fault" ? nodeOf(page.chosen) : -1});
  section.drawAxes(length);
  section.drawPicks(picks, faultPoints);
  section.drawHandles(handlesNow(good ? shape : null, chain), page.chosen);
  if (good) showKinematics(chain, length, angle, fault);
}

const nodeOf = key => key.startsWith("node ") ? Number(key.slice(5)) : -1;

/** Picture with its reference points; undo goes back to the points, not to another picture. */
function pictureNow() { return page.pictureImage && page.state.picture ? {...page.pictureImage, points: page.state.picture} : null; }

function handlesNow(shape, chain) {
  if (page.tool === "picks") return pickHandles();
  if (page.tool === "picture") return pictureNow()?.points.map((p, k) => ({key: `reference ${"ab"[k]}`, kind: "reference", x: p.x, y: -p.depth,
    label: `Reference point ${"AB"[k]} at x ${km(p.x)}, depth ${km(p.depth)}`})) || [];
  if (!shape) return [];
  const handles = [];
  const turn = k => {
    const s = chain[k], reach = 64 / page.section.view.scale / Math.max(1, page.section.view.height * Math.sin(s.startDip * degree));
    handles.push({key: `turn ${k}`, kind: "turn", x: s.start.x + reach * s.startTangent.x, y: s.start.y + reach * s.startTangent.y,
      from: s.start, label: `Dip ${k ? `at the kink before piece ${k + 1}` : "at the breakaway"}: ${s.startDip.toFixed(1)} degrees`});
  };
  shape.pieces.forEach((piece, k) => {
    if (k === 0 && piece.kind === "arc" || k > 0 && "startDip" in piece && piece.kind === "arc") turn(k);
    const {end} = chain[k];
    handles.push({key: `node ${k}`, kind: "node", x: end.x, y: end.y, label: `Node ${k + 1} of ${shape.pieces.length}: ${tellPiece(k, chain)}`});
  });
  return handles;
}

function pickHandles() {
  const line = lineNow();
  return line ? line.x_m.map((x, k) => ({key: `pick ${k}`, kind: "pick", x, y: -line.depth_m[k],
    label: `Point ${k + 1} of ${line.name} at x ${km(x)}, depth ${km(line.depth_m[k])}`})) : [];
}

function lineNow(state = page.state) { return page.line ? state.picks[page.line.kind]?.[page.line.index] : undefined; }

function tellPiece(k, chain = page.chain) {
  const s = chain[k], shape = shapeNow(), piece = shape.pieces[k];
  const kind = piece.kind === "arc" ? `arc of radius ${km(piece.radius)}, dip ${s.startDip.toFixed(1)}° to ${s.endDip.toFixed(1)}°`
    : `line of ${km(piece.length)}, dip ${s.startDip.toFixed(1)}°`;
  return `x ${km(s.end.x)}, depth ${km(-s.end.y)}; ${kind}, from the node before`;
}

/** Where the detachment soles out, in a sentence. */
function tellSole(chain = page.chain, shape = shapeNow()) {
  const s = chain[lastSloping(shape)];
  return `Soles out at a depth of ${km(-s.end.y)} at x = ${km(s.end.x)}.`;
}

function tellChosen() {
  const shape = shapeNow(), k = nodeOf(page.chosen), line = lineNow();
  if (page.tool === "picture") {
    tell(pictureNow() ? "Drag A and B to places that you know, then type x and depth of both." : "Choose a PNG or JPEG of a section, or drop one here.");
  } else if (page.tool === "picks") {
    tell(line ? `${line.name}: ${line.x_m.length} points. Click the section to add one.` : "Make a horizon or a fault first, then click the section.");
  } else if (shape && page.chain) {
    const turned = page.chosen.startsWith("turn ") ? `Dip ${page.chain[Number(page.chosen.slice(5))].startDip.toFixed(1)}°. ` : "";
    tell((k >= 0 && k < shape.pieces.length ? `Node ${k + 1}: ${tellPiece(k)}. ` : turned) + tellSole());
  } else tell(page.state.scene.stretching ? "This scene has a flat base that stretches: there is no detachment to draw." : "");
}

function showKinematics(chain, length, angle, fault) {
  const {extension} = page;
  $("extension_told").textContent = km(extension, 1);
  $("angle_told").textContent = `${angle}°`;
  const found = extension > 0 ? predictKinematics(chain, extension, angle, length + extension, fault) : null;
  page.kinematics = found;
  const rows = [["Tilt of the head block", found?.tilt != null ? `${found.tilt.toFixed(1)}°` : "-"],
    ["Cutoff of the pre-rift top", found?.cutoff ? `x ${km(found.cutoff.x)}, depth ${km(found.cutoff.depth)}` : "-"],
    ["Deepest basin", found ? `${km(found.deepest.depth)} at x ${km(found.deepest.x)}` : "-"],
    ["Area of the basin", found ? `${(found.area / 1e6).toFixed(1)} km²` : "-"]];
  const table = $("kinematics");
  if (!table.rows.length) for (const [name] of rows) table.append(element("tr", {}, element("td", {}, name), element("td", {className: "number"})));
  rows.forEach(([, text], k) => { table.rows[k].cells[1].textContent = text; });
}

function duration(s) {
  return s < 90 ? `${s.toFixed(0)} s` : s < 5400 ? `${(s / 60).toFixed(1)} min` : s < 172800 ? `${(s / 3600).toFixed(1)} h` : `${(s / 86400).toFixed(1)} d`;
}

const about = new Intl.NumberFormat("en", {maximumSignificantDigits: 3});

/** Makes a table's rows when there are others than before; else they stay, and with them the focus. */
function keepRows(table, signature, make) {
  if (table.dataset.rows === signature) return;
  table.dataset.rows = signature;
  table.replaceChildren(...make());
}

const headOf = names => element("tr", {}, ...names.map(text => element("th", {}, text)));
const cells = count => Array.from({length: count}, () => element("td", {className: "number"}));

function showCost() {
  const {scene} = page.state, table = $("cost"), now = scene.accuracy ?? "standard";
  keepRows(table, "levels", () => [headOf(["Accuracy", "Radius", "Discs", "At the end", "Time"]), ...facts.levels.map(({name}) => {
    const radio = element("input", {type: "radio", name: "accuracy", value: name});
    radio.onchange = () => change("", state => { state.scene.accuracy = name; });
    return element("tr", {}, element("td", {}, element("label", {}, radio, ` ${name}`)), ...cells(4));
  })]);
  facts.levels.forEach((level, k) => {
    const here = level.name === now, row = table.rows[k + 1], other = structuredClone(scene);
    other.accuracy = level.name;
    if (!here) delete other.hanging_wall?.mean_radius_m;
    if (!here) delete other.extension?.speed_m_per_s;
    const cost = page.chain ? predictCost(facts, schema, other) : null, radius = Number(valueAt(facts, schema, other, "hanging_wall.mean_radius_m"));
    if (here) page.cost = cost;
    row.className = here ? "chosen" : "";
    row.querySelector("input").checked = here;
    const numbers = cost ? [about.format(cost.discs), about.format(cost.discsAtEnd), duration(cost.seconds)] : ["-", "-", "-"];
    [`${Number(radius.toPrecision(4))} m`, ...numbers].forEach((text, column) => { row.cells[column + 1].textContent = text; });
  });
  const threads = facts.speeds.threads, speed = speedAt(facts.speeds, page.cost?.discs ?? 1e4, false).team / 1e6;
  $("cost_note").textContent = `On the machine that wrote this page, with ${threads} ${threads === 1 ? "thread" : "threads"} when nothing else runs ` +
    `(${about.format(speed)} million disc-steps per second). Elsewhere: listric explain.`;
}

function showPieces() {
  const shape = shapeNow(), table = $("pieces"), chain = page.chain;
  if (!shape || !chain) {
    keepRows(table, "none", () => []);
    return;
  }
  const last = lastSloping(shape);
  keepRows(table, JSON.stringify([last, ...shape.pieces.map(piece => [piece.kind, "startDip" in piece])]), () =>
    [headOf(["", "Piece", "Radius or length, m", "Dip, °", "", "Ends at x, km", "depth, km"]), ...shape.pieces.map((piece, k) => rowOfPiece(piece, k, last))]);
  const put = (cell, value) => {
    const field = cell.querySelector("input"), text = String(Number(value.toFixed(2)));
    if (!field) cell.lastChild.textContent = text;
    else if (field.value !== text) field.value = text;
    field?.setAttribute("aria-invalid", false);
  };
  shape.pieces.forEach((piece, k) => {
    const row = table.rows[k + 1], {startDip, endDip, end} = chain[k];
    row.className = page.chosen === `node ${k}` ? "chosen" : "";
    put(row.cells[2], piece.radius ?? piece.length);
    put(row.cells[3], startDip);
    if (piece.kind === "arc") put(row.cells[4], endDip);
    [end.x, -end.y].forEach((x, column) => { row.cells[5 + column].textContent = (x / 1000).toFixed(2); });
  });
}

function rowOfPiece(piece, k, last) {
  const number = (label, broad, make) => {
    const input = element("input", {type: "text", inputMode: "decimal", className: broad ? "broad" : ""});
    input.setAttribute("aria-label", `${label} of piece ${k + 1}`);
    input.onchange = () => typePiece(input, k, make);
    return input;
  };
  const choose = element("button", {title: `Choose piece ${k + 1}`}, String(k + 1)), text = () => document.createTextNode("");
  choose.onclick = () => chooseHandle(`node ${k}`, true);
  const from = k === 0 || "startDip" in piece ? number("First dip", false, (next, x) => {
    if (k === 0) next.startDip = x;
    if (k > 0 || "startDip" in next.pieces[0]) next.pieces[k].startDip = x;
  }) : text();
  const to = piece.kind === "line" ? [] : ["to ", k === last ? text() : number("Last dip", false, (next, x) => { next.pieces[k].endDip = x; })];
  const size = number(piece.kind === "arc" ? "Radius" : "Length", true, (next, x) => { next.pieces[k][piece.kind === "arc" ? "radius" : "length"] = x; });
  return element("tr", {}, element("td", {}, choose), element("td", {}, piece.kind), element("td", {}, size),
    element("td", {className: "number"}, from), element("td", {className: "number"}, ...to), ...cells(2));
}

/** A number that is typed into the table of pieces. */
function typePiece(input, k, make) {
  const {value, fault} = valueOf(input.value, {type: "number"}), next = copyOf(shapeNow());
  if (!fault && value !== undefined) make(next, Number(value));
  const faults = fault ? [{message: fault}] : faultsBySchema(schema.properties.detachment, tableOf(next)), why = faults[0]?.message || objectionToShape(next);
  input.setAttribute("aria-invalid", Boolean(why || value === undefined));
  if (why || value === undefined) tell(`Piece ${k + 1}: ${why || "a number is missing"}.`);
  else change("", state => putShape(state, next));
}

function showLines() {
  const {picks} = page.state, table = $("lines"), all = ["horizons", "faults"].flatMap(kind => picks[kind].map((line, index) => ({kind, index, line})));
  keepRows(table, all.map(({kind}) => kind).join(), () => all.length
    ? [headOf(["", "Kind", "Name", "Age before the end, Myr", "Points", ""]), ...all.map(({kind, index}) => rowOfLine(kind, index))] : []);
  all.forEach(({kind, index, line}, k) => {
    const row = table.rows[k + 1], here = page.line?.kind === kind && page.line.index === index, [radio, name, age] = row.querySelectorAll("input");
    row.className = here ? "chosen" : "";
    radio.checked = here;
    name.value = line.name;
    if (age) age.value = line.age_a === undefined ? "" : String(line.age_a / 1e6);
    row.cells[4].textContent = line.x_m.length;
    for (const [part, label] of [[radio, "Draw"], [name, "Name of"], [age, "Age, million years before the end of extension, of"], [row.cells[5].firstChild, "Remove"]])
      part?.setAttribute("aria-label", `${label} ${line.name}`);
  });
}

function rowOfLine(kind, index) {
  const radio = element("input", {type: "radio", name: "line"}), name = element("input", {type: "text", className: "name"});
  const age = element("input", {type: "text", inputMode: "decimal"}), drop = element("button", {}, "Remove");
  radio.onchange = () => { page.line = {kind, index}; showAll(); };
  name.onchange = () => change("", state => nameLine(state, kind, index, name.value));
  age.onchange = () => change("", state => ageLine(state, kind, index, age));
  drop.onclick = () => change("", state => { state.picks[kind].splice(index, 1); page.line = null; });
  return element("tr", {}, element("td", {}, radio), element("td", {}, kind === "faults" ? "fault" : "horizon"), element("td", {}, name),
    element("td", {}, kind === "faults" ? "" : age), ...cells(1), element("td", {}, drop));
}

function nameLine(state, kind, index, name) {
  const taken = state.picks[kind].some((line, k) => k !== index && line.name === name.trim());
  if (!name.trim() || taken) {
    tell(taken ? `There is a line ${name.trim()} already; rows of one name are one line.` : "A line needs a name.");
    return false;
  }
  state.picks[kind][index].name = name.trim();
  return true;
}

function ageLine(state, kind, index, input) {
  const {value, missing} = valueOf(input.value, {type: "number"}), age = Number(value) * 1e6;
  if (missing) delete state.picks[kind][index].age_a;
  else if (age >= 0 && age <= 1e10) state.picks[kind][index].age_a = age;
  else {
    input.setAttribute("aria-invalid", true);
    tell("An age is in million years before the end of extension, 0 to 10000.");
    return false;
  }
  return true;
}

function showReferences() {
  const picture = pictureNow(), host = $("references");
  $("drop_picture").disabled = !picture;
  $("corners").textContent = "";
  if (!picture) {
    host.replaceChildren();
    return;
  }
  if (!host.childNodes.length) host.append(...[0, 1].flatMap(k => ["x", "depth"].map(key => {
    const input = element("input", {type: "text", inputMode: "decimal", size: 8, id: `reference_${"ab"[k]}_${key}`});
    input.onchange = () => {
      const {value} = valueOf(input.value, {type: "number"});
      input.setAttribute("aria-invalid", typeof value !== "number");
      if (typeof value === "number") change("", state => { state.picture[k][key] = value; });
    };
    return element("label", {}, `${"AB"[k]}: ${key}, m `, input);
  })));
  picture.points.forEach((p, k) => ["x", "depth"].forEach(key => { $(`reference_${"ab"[k]}_${key}`).value = Number(p[key].toFixed(1)); }));
  const corners = cornersOf(picture).map(x => x.toFixed(0)).join(",");
  $("corners").textContent = `Later, over the run: listric figures DIR --underlay ${picture.name} --corners ${corners}`;
}

function showState() {
  const faults = faultsNow(), box = $("state"), {lines} = page;
  box.classList.toggle("bad", faults.length > 0);
  const place = path => page.fresh && lines?.has(path) ? `line ${lines.get(path)}: ` : "";
  box.textContent = faults.length
    ? faults.slice(0, 6).map(({path, message}) => `${place(path)}${path}: ${message}`).join("\n") + (faults.length > 6 ? `\nand ${faults.length - 6} more` : "")
    : `Correct: listric check accepts this scene. ${page.cost ? `${about.format(page.cost.discs)} discs, about ${duration(page.cost.seconds)} at ${page.state.scene.accuracy ?? "standard"}.` : ""}`;
  page.forms.show(page.state.scene, faults);
  return faults;
}

function showAll() {
  const {scene, picks} = page.state, {distance} = settings();
  if (page.lastChange.time) page.fresh = false;
  $("title").textContent = scene.description || "Draw a section";
  $("subtitle").textContent = `${page.file}${page.past.length ? ", changed" : ""}; ${facts.program}`;
  $("undo").disabled = !page.past.length;
  $("redo").disabled = !page.future.length;
  $("save_picks").disabled = !picks.horizons.length && !picks.faults.length;
  const slider = $("extension"), atEnd = Number(slider.value) >= Number(slider.max);
  slider.max = distance;
  if (atEnd || page.extension > distance) slider.value = distance;
  page.extension = Number(slider.value);
  for (const tool of ["fault", "picks", "picture"]) $(`panel_${tool}`).hidden = page.tool !== tool;
  showSection();
  showPieces();
  showCost();
  showLines();
  showReferences();
  showState();
  const shape = shapeNow(), k = nodeOf(page.chosen);
  $("add").disabled = !shape;
  $("remove").disabled = !shape || k < 0 || k >= shape.pieces.length || !removeNode(shape, k);
  tellChosen();
}

// -- dragging and keys

function chooseHandle(key, focus = false) {
  page.chosen = key;
  showSection();
  showPieces();
  const shape = shapeNow(), k = nodeOf(key);
  $("remove").disabled = page.tool !== "fault" || !shape || k < 0 || !removeNode(shape, k);
  tellChosen();
  if (focus) page.section.handles.find(handle => handle.dataset.key === key)?.focus({preventScroll: true});
}

/** What becomes of a state when a handle comes to a place. */
function moveHandle(state, key, p) {
  const [kind, which] = key.split(" ");
  if (kind === "pick") {
    const line = lineNow(state);
    [line.x_m[which], line.depth_m[which]] = [Math.round(p.x), Math.round(-p.y)];
  } else if (kind === "reference") {
    const k = "ab".indexOf(which), picture = {...page.pictureImage, points: state.picture};
    state.picture[k] = {...pixelAt(picture, p), x: p.x, depth: -p.y};
  } else {
    const shape = shapeOf(state.scene.detachment);
    const start = chainOf(shape)[which].start;
    const dip = -Math.atan2(p.y - start.y, Math.max(p.x - start.x, 1e-9)) / degree;
    putShape(state, atKeptDepth(shape, kind === "turn" ? turnStart(shape, dip, Number(which)) : dragNode(shape, Number(which), p)));
  }
}

function startDrag(event) {
  const handle = event.target.closest(".handle"), section = page.section;
  if (event.button) return;
  section.svg.setPointerCapture(event.pointerId);
  const at = section.at(event);
  if (handle) {
    const matrix = handle.transform.baseVal[0].matrix, place = section.metres(matrix.e, matrix.f);
    page.drag = {key: handle.dataset.key, before: copyState(page.state), off: {x: place.x - at.x, y: place.y - at.y}, moved: false};
    chooseHandle(handle.dataset.key, true);
  } else {
    page.drag = {key: null, from: {column: event.clientX, row: event.clientY}, view: {...section.view}, piece: event.target.dataset?.piece, moved: false};
  }
  event.preventDefault();
}

function goOnDragging(event) {
  const {drag, section} = page;
  if (!drag) return;
  if (drag.key) {
    const at = section.at(event);
    drag.moved = true;
    page.state = copyState(drag.before);
    moveHandle(page.state, drag.key, {x: at.x + drag.off.x, y: at.y + drag.off.y});
    drawSoon();
    return;
  }
  const [dx, dy] = [event.clientX - drag.from.column, event.clientY - drag.from.row];
  if (!drag.moved && Math.hypot(dx, dy) < 5) return;
  drag.moved = true;
  section.view.left = drag.view.left - dx / section.view.scale;
  section.view.top = drag.view.top - dy / section.view.scale / section.view.height;
  drawSoon();
}

const frameTimes = []; // of frames while something is dragged, ms: what a test reads

/** One drawing per frame, however many moves there are. */
function drawSoon() {
  if (page.frame) return;
  page.frame = requestAnimationFrame(() => {
    page.frame = null;
    const start = performance.now();
    showSection();
    if (page.drag?.key) tellChosen();
    frameTimes.push(performance.now() - start);
    if (frameTimes.length > 500) frameTimes.shift();
  });
}

function endDrag(event) {
  const {drag} = page;
  page.drag = null;
  if (!drag) return;
  if (drag.key && drag.moved) {
    const after = page.state;
    page.state = drag.before;
    change("", () => { page.state = after; });
  } else if (!drag.key && !drag.moved && page.tool === "picks") addPick(page.section.at(event));
  else if (!drag.key && !drag.moved && drag.piece !== undefined) chooseHandle(`node ${drag.piece}`, true);
}

/** Horizons are kept sorted from left to right; a fault goes on where it ended. */
function addPick(p) {
  if (!lineNow()) {
    tell("Make a horizon or a fault first: buttons below the section.");
    return;
  }
  let place = 0;
  change("", state => {
    const line = lineNow(state), x = Math.round(p.x);
    place = page.line.kind === "horizons" ? line.x_m.filter(other => other <= x).length : line.x_m.length;
    line.x_m.splice(place, 0, x);
    line.depth_m.splice(place, 0, Math.round(-p.y));
  });
  chooseHandle(`pick ${place}`, true);
}

function newLine(kind) {
  let count = page.state.picks[kind].length + 1;
  const name = () => `${kind === "faults" ? "fault" : "horizon"} ${count}`;
  while (page.state.picks[kind].some(line => line.name === name())) ++count;
  change("", state => { page.line = {kind, index: state.picks[kind].push({name: name(), x_m: [], depth_m: []}) - 1}; });
}

function addHere(share = 0.5, piece = null) {
  if (page.tool === "picks") {
    const {host} = page.section;
    addPick(page.section.metres(host.clientWidth / 2, host.clientHeight / 2));
    return;
  }
  const shape = shapeNow();
  if (page.tool !== "fault" || !shape) return;
  const k = piece ?? clamp(nodeOf(page.chosen), 0, shape.pieces.length - 1);
  changeShape("", before => addNode(before, k, share));
  chooseHandle(`node ${k}`, true);
}

function removeHere() {
  const [kind, which] = page.chosen.split(" ");
  if (page.tool === "picks" && kind === "pick")
    change("", state => [lineNow(state).x_m, lineNow(state).depth_m].forEach(list => list.splice(which, 1)));
  else if (page.tool === "fault" && kind === "node") {
    const before = shapeNow(), after = removeNode(before, Number(which));
    if (!after) {
      tell("This node stays: the detachment has to end flat, at a depth.");
      return;
    }
    change("", state => putShape(state, after));
    chooseHandle(`node ${Math.min(Number(which), after.pieces.length - 1)}`, true);
  }
}

/** A double click on the detachment adds a node there. */
function doubleClick(event) {
  const k = document.elementFromPoint(event.clientX, event.clientY)?.dataset.piece; // the target is what has the pointer
  if (page.tool !== "fault" || k === undefined) return;
  const chain = page.chain, foot = footPoint([chain[k]], page.section.at(event));
  addHere(clamp((foot?.arcLength ?? 0.5 * chain[k].length) / chain[k].length, 0, 1), Number(k));
}

function pressKey(event) {
  const isTyping = /INPUT|TEXTAREA|SELECT/.test(event.target.tagName) && event.target.type !== "radio" && event.target.type !== "checkbox";
  const key = event.key.toLowerCase();
  if ((event.ctrlKey || event.metaKey) && !isTyping && (key === "z" || key === "y")) {
    if (key === "z" && !event.shiftKey) travel(page.past, page.future);
    else travel(page.future, page.past);
    event.preventDefault();
    return;
  }
  if (isTyping || event.ctrlKey || event.metaKey) return;
  const handle = event.target.closest?.(".handle"), arrow = {arrowleft: [-1, 0], arrowright: [1, 0], arrowup: [0, 1], arrowdown: [0, -1]}[key];
  if (handle && arrow) {
    const step = event.shiftKey ? 1000 : event.altKey ? 10 : 100, name = handle.dataset.key;
    page.chosen = name;
    nudge(name, handle, arrow.map(x => x * step));
    event.preventDefault();
  } else if (key === "delete" || key === "backspace") removeHere();
  else if (key === "a" || key === "insert") addHere();
  else if (key === "0") showWhole();
  else if (key === "+" || key === "-") zoom(key === "+" ? 1.25 : 0.8);
  else if (key === "enter" && handle) chooseHandle(handle.dataset.key, true);
}

/** Moves a handle by metres; the dip by degrees. */
function nudge(name, handle, [dx, dy]) {
  const [kind, which] = name.split(" "), keep = () => page.section.handles.find(one => one.dataset.key === name)?.focus({preventScroll: true});
  if (kind === "turn") {
    const turned = (Math.abs(dx) >= Math.abs(dy) ? -dx : -dy) / 100;
    changeShape(`turn ${which}`, before => turnStart(before, chainOf(before)[which].startDip + turned, Number(which)));
  } else {
    const place = kind === "node" ? chainOf(shapeNow())[which].end : kind === "pick" ? {x: lineNow().x_m[which], y: -lineNow().depth_m[which]}
      : {x: page.state.picture["ab".indexOf(which)].x, y: -page.state.picture["ab".indexOf(which)].depth};
    change(`move ${name}`, state => moveHandle(state, name, {x: place.x + dx, y: place.y + dy}));
  }
  chooseHandle(name);
  keep();
}

function showWhole() {
  const {length, thickness, distance} = settings();
  page.section.showWhole(length + distance, thickness);
  showSection();
}

function zoom(factor) {
  page.section.zoom(factor);
  showSection();
}

// -- files

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
  const scene = read.document, {shift, asked, lines} = takePicks(scene);
  page.floats = read.floats;
  page.lines = read.lines;
  page.file = name;
  page.asked = {...asked, shift};
  page.state = {...page.state, scene, picks: {horizons: [...picks.horizons, ...lines.horizons], faults: [...picks.faults, ...lines.faults]}, faultPoints};
  return true;
}

/** Takes [observed] out of a scene: lines, names of files that are asked for, and the shift of both. */
function takePicks(scene) {
  const observed = typeof scene.observed === "object" ? scene.observed : {}, table = scene.detachment;
  const shift = Number(observed.shift_x_m ?? table?.shift_x_m ?? 0), asked = {};
  const good = faultsBySchema(schema.properties.observed, observed).length === 0;
  const lines = {horizons: good ? observed.horizon_lines || [] : [], faults: good ? observed.fault_lines || [] : []};
  for (const kind of ["horizons", "faults"]) if (good && observed[kind]) asked[kind] = observed[kind];
  if (good) delete scene.observed;
  return {shift, asked, lines};
}

function missingFiles() {
  const {asked, state} = page, table = state.scene.detachment, names = Object.values(asked || {}).filter(name => typeof name === "string");
  if (table?.csv || table?.svg) names.push(table.csv || table.svg);
  return names;
}

/** Rows of a CSV file with a header: commas, semicolons or tabs. */
function readCsv(text) {
  const rows = text.replace(/^\ufeff/, "").split(/\r\n|\n|\r/).filter(row => row.trim() && !row.startsWith("#"));
  const delimiter = [";", "\t", ","].find(sign => rows[0]?.includes(sign)) || ",";
  const cells = row => row.match(new RegExp(`("([^"]|"")*"|[^${delimiter}]*)(${delimiter}|$)`, "g")).map(cell =>
    cell.replace(new RegExp(`${delimiter}$`), "").trim().replace(/^"([\s\S]*)"$/, (_, inner) => inner.replace(/""/g, '"')));
  const head = cells(rows[0] || "");
  return {head, rows: rows.slice(1).map(row => Object.fromEntries(cells(row).slice(0, head.length).map((cell, k) => [head[k], cell])))};
}

/** Picked lines of a CSV file. Throws Error. */
function picksIn(text, name, shift) {
  const {head, rows} = readCsv(text), lines = new Map();
  for (const needed of ["x_m", "depth_m"])
    if (!head.includes(needed)) throw new Error(`${name}: has no column ${needed}, ${adviceOn(needed, head)}`);
  rows.forEach((row, k) => {
    const title = head.includes("name") ? row.name : "picked fault", x = Number(row.x_m), depth = Number(row.depth_m), age = row.age_a ? Number(row.age_a) : undefined;
    if (!title || !row.x_m || !row.depth_m || !Number.isFinite(x) || !Number.isFinite(depth) || age !== undefined && !(age >= 0))
      throw new Error(`${name}: row ${k + 2} needs a name and numbers x_m and depth_m`);
    if (!lines.has(title)) lines.set(title, {name: title, x_m: [], depth_m: []});
    const line = lines.get(title);
    if (age !== undefined) line.age_a = age;
    line.x_m.push(x + shift);
    line.depth_m.push(depth);
  });
  return {lines: [...lines.values()], hasNames: head.includes("name"), hasAges: head.includes("age_a")};
}

function takeCsv(text, name) {
  const asked = page.asked || {}, {lines, hasNames} = picksIn(text, name, asked.shift || 0);
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
  });
  delete asked[kind];
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

function takePicture(picture, corners) {
  const {length, distance} = settings(), width = length + distance;
  const [x0, z0, x1, z1] = corners || [0, 0, width, width * picture.height / picture.width];
  page.pictureImage = picture;
  page.state.picture = [{px: 0, py: 0, x: x0, depth: z0}, {px: picture.width, py: picture.height, x: x1, depth: z1}];
  setTool("picture");
}

async function takeFiles(files) {
  const order = file => /\.toml$/i.test(file.name) ? 0 : /\.csv$/i.test(file.name) ? 1 : 2;
  for (const file of [...files].sort((a, b) => order(a) - order(b)))
    try {
      if (order(file) === 0) takeSceneFile(await file.text(), file.name);
      else if (order(file) === 1) takeCsv(await file.text(), file.name);
      else if (/\.svg$/i.test(file.name)) tell(`${file.name}: a drawing is fitted by the program: listric draw my.toml with svg = "${file.name}"`);
      else takePicture(await readPicture(file));
    } catch (error) {
      tell(error.message);
    }
}

function takeSceneFile(text, name) {
  const before = copyState(page.state), old = {floats: page.floats, lines: page.lines, file: page.file};
  if (!readScene(text, name)) {
    Object.assign(page, old);
    return;
  }
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

/** The scene with picks as files of their own beside it. */
function sceneText() {
  const scene = structuredClone(page.state.scene), {horizons, faults} = page.state.picks, name = baseName();
  const observed = {};
  if (horizons.some(line => line.x_m.length)) observed.horizons = `${name}-horizons.csv`;
  if (faults.some(line => line.x_m.length)) observed.faults = `${name}-faults.csv`;
  if (Object.keys(observed).length && scene.detachment?.shift_x_m) observed.shift_x_m = 0;
  for (const kind of ["horizons", "faults"]) observed[kind] ??= page.asked?.[kind]; // a file that nobody has dropped
  if (observed.horizons || observed.faults) scene.observed = JSON.parse(JSON.stringify(observed));
  return `# Drawn with ${facts.program}.\n\n${writeToml(scene, schema)}`;
}

function baseName() { return (page.state.scene.name || page.file.replace(/\.toml$/i, "") || "drawn").replace(/[^\w.-]+/g, "-"); }

function picksText(lines, withAges) {
  const quoted = text => /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  const rows = lines.flatMap(line => line.x_m.map((x, k) => [quoted(line.name), x, line.depth_m[k], ...(withAges ? [line.age_a ?? ""] : [])].join(",")));
  return [["name", "x_m", "depth_m", ...(withAges ? ["age_a"] : [])].join(","), ...rows].join("\n") + "\n";
}

function download(name, text, type) {
  const link = element("a", {href: URL.createObjectURL(new Blob([text], {type})), download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function save() {
  const faults = showState(), missing = missingFiles();
  if (faults.length) {
    tell(`Not saved: ${faults[0].path}: ${faults[0].message}`);
    $("state").scrollIntoView({block: "nearest"});
    return;
  }
  page.saved = true;
  download(`${baseName()}.toml`, sceneText(), "application/toml");
  if (!$("save_picks").disabled) savePicks();
  tell(`Saved ${baseName()}.toml. Next: listric check ${baseName()}.toml, then listric run ${baseName()}.toml --accuracy draft` +
    (missing.length ? `. It needs ${missing.join(" and ")} beside it.` : ""));
}

function savePicks() {
  const {horizons, faults} = page.state.picks;
  if (horizons.some(line => line.x_m.length)) download(`${baseName()}-horizons.csv`, picksText(horizons, true), "text/csv");
  if (faults.some(line => line.x_m.length)) download(`${baseName()}-faults.csv`, picksText(faults, false), "text/csv");
}

// -- the field that finds and sets

/** table.key = value sets, as --set does; other words filter the forms. */
function find(final) {
  const text = $("find").value.trim(), [, path, value] = /^([\w.]+)\s*=\s*(.*)$/.exec(text) || [];
  const words = path ? [] : text.toLowerCase().split(/\s+/).filter(Boolean), count = page.forms.filter(words);
  const names = [...page.forms.fields.keys()];
  if (!text) $("found").textContent = "";
  else if (!path) {
    const near = nearestName(text.replace(/\s+/g, "_"), names.map(name => name.split(".").at(-1)));
    $("found").textContent = count ? `${count} ${count === 1 ? "parameter" : "parameters"}` : `none${near ? `, did you mean ${near}?` : ""}`;
  } else $("found").textContent = setByText(path, value, names, final);
}

function setByText(path, value, names, final) {
  if (!names.includes(path)) {
    const [table, key] = path.split("."), inside = names.filter(name => name.startsWith(`${table}.`)).map(name => name.slice(table.length + 1));
    const near = inside.length ? nearestName(key || "", inside) : undefined;
    if (near) return `unknown key, did you mean ${table}.${near}?`;
    const tables = [...new Set(names.map(name => name.split(".")[0]))];
    const lone = names.filter(name => nearestName(path, [name.split(".").at(-1)]));
    return `unknown key, ${lone.length ? `did you mean ${lone.slice(0, 3).join(" or ")}?` : adviceOn(table, tables)}`;
  }
  const why = objectionTo(schema, path, value);
  if (why) return why;
  if (!final) return "Enter sets it";
  change("", state => setAt(state.scene, path, valueOf(value, schemaAt(schema, path)).value));
  return `${path} is set`;
}

// -- beginning

function setTool(tool) {
  page.tool = tool;
  page.chosen = "";
  document.querySelector(`input[name=tool][value=${tool}]`).checked = true;
  showAll();
}

function addListeners() {
  const {svg: surface} = page.section;
  surface.addEventListener("pointerdown", startDrag);
  surface.addEventListener("pointermove", goOnDragging);
  surface.addEventListener("pointerup", endDrag);
  surface.addEventListener("pointercancel", endDrag);
  surface.addEventListener("dblclick", doubleClick);
  surface.addEventListener("focusin", event => {
    const handle = event.target.closest(".handle");
    if (handle && handle.dataset.key !== page.chosen) chooseHandle(handle.dataset.key);
  });
  surface.addEventListener("wheel", event => {
    if (!event.ctrlKey) return;
    const box = surface.getBoundingClientRect();
    page.section.zoom(Math.exp(-0.002 * event.deltaY), {column: event.clientX - box.left, row: event.clientY - box.top});
    drawSoon();
    event.preventDefault();
  }, {passive: false});
  document.addEventListener("keydown", pressKey);
  const on = (id, make, kind = "onclick") => { $(id)[kind] = make; };
  on("undo", () => travel(page.past, page.future));
  on("redo", () => travel(page.future, page.past));
  on("save", save);
  on("save_picks", savePicks);
  on("open", () => $("file").click());
  on("choose_picture", () => $("file").click());
  on("file", () => takeFiles($("file").files).then(() => { $("file").value = ""; }), "onchange");
  on("drop_picture", () => { page.pictureImage = null; showAll(); });
  on("add", () => addHere());
  on("add_pick", () => addHere());
  on("remove", removeHere);
  on("new_horizon", () => newLine("horizons"));
  on("new_fault", () => newLine("faults"));
  on("closer", () => zoom(1.25));
  on("wider", () => zoom(0.8));
  on("whole", showWhole);
  on("opacity", drawSoon, "oninput");
  on("angle", drawSoon, "oninput");
  on("extension", () => { page.extension = Number($("extension").value); drawSoon(); }, "oninput");
  on("height", () => { page.section.view.height = Number($("height").value); showWhole(); }, "onchange");
  on("find", () => find(false), "oninput");
  $("find").addEventListener("keydown", event => { if (event.key === "Enter") find(true); });
  for (const radio of document.querySelectorAll("input[name=tool]")) radio.onchange = () => setTool(radio.value);
  addFileDrop();
  new ResizeObserver(() => { if (page.section.width !== page.shownWidth) { page.shownWidth = page.section.width; showWhole(); } }).observe(page.section.host);
  window.addEventListener("beforeunload", event => { if (page.past.length && !page.saved) event.preventDefault(); });
}

function addFileDrop() {
  const host = $("section");
  document.addEventListener("dragover", event => {
    event.preventDefault();
    host.classList.add("over");
  });
  document.addEventListener("dragleave", () => host.classList.remove("over"));
  document.addEventListener("drop", event => {
    event.preventDefault();
    host.classList.remove("over");
    takeFiles(event.dataTransfer.files);
  });
}

async function begin() {
  page.section = new Section($("section"));
  page.forms = new Forms($("forms"), schema, {
    change: (path, value, why) => why ? showState() : change("", state => setAt(state.scene, path, value)),
    toggle: (name, isOn) => change("", state => {
      if (isOn) state.scene[name] ??= {};
      else delete state.scene[name];
    }),
    defaultOf: path => path.includes(".") ? defaultAt(facts, schema, page.state.scene, path) : schemaAt(schema, path)?.default});
  readScene(facts.toml, `${facts.scene}.toml`, facts.observed, facts.fault_points || null);
  const {distance} = settings();
  $("extension").max = distance;
  $("extension").value = page.extension = distance;
  if (window.innerWidth < 640) $("height").value = "2";
  page.section.view.height = Number($("height").value);
  addListeners();
  if (facts.picture) {
    const {image, name, corners_m: corners} = facts.picture, shown = new Image();
    shown.src = image;
    await shown.decode();
    takePicture({image, name, width: shown.naturalWidth, height: shown.naturalHeight}, corners);
    if (corners) setTool("fault");
  }
  page.shownWidth = page.section.width;
  showAll();
  showWhole();
  $("footer").textContent = `${facts.program}. One file: nothing leaves this computer. Drop TOML, CSV of picks, PNG or JPEG anywhere.`;
  $("trouble").hidden = true;
}

begin().then(() => { document.documentElement.dataset.ready = "true"; }, error => {
  $("trouble").textContent = `This page cannot be shown: ${error.message}`;
  document.documentElement.dataset.ready = "false";
});
