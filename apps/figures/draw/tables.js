// What the page shows beside its forms: the section, tables of pieces, picks and cost, and what is wrong.

/** What the section is drawn by, m; distance: the greatest displacement of the moving wall. */
function settings() {
  const of = path => Number(valueAt(path));
  return {length: of("hanging_wall.length_m"), thickness: of("hanging_wall.thickness_m"),
    distance: page.state.scene.stage ? page.now.greatest_extension_m : of("extension.distance_m")};
}

/** Draws the section as it is now; forms and tables stay as they are. */
function showSection() {
  const {scene, picks, faultPoints} = page.state, {length, thickness, distance} = settings(), section = page.section;
  const drawn = shapeNow(), shape = drawn && Number.isFinite(chainOf(drawn).at(-1).end.x) ? drawn : null;
  const reach = 1.5 * (length + 2 * distance), flat = {start: {x: 0, y: -thickness}, end: {x: reach, y: -thickness}, startDip: 0, endDip: 0, length: reach, curvature: 0};
  const chain = shape ? chainOf(shape, reach) : scene.stretching ? [flat] : null;
  const basin = shape && isWhole(shape) ? kinematicsOf(shape, length, page.extension) : null;
  page.chain = chain;
  section.drawPicture(pictureNow(), Number($("opacity").value));
  if (chain) section.drawModel({chain, shape, length, extension: page.extension, basin, chosen: page.tool === "fault" ? nodeOf(page.chosen) : -1});
  else section.clear();
  section.drawAxes(length);
  section.drawPicks(picks, faultPoints);
  section.drawHandles(handlesNow(shape, chain), page.chosen);
  showKinematics(basin);
}

const nodeOf = key => key.startsWith("node ") ? Number(key.slice(5)) : -1;

/** Picture with its reference points; undo goes back to the points, not to another picture. */
function pictureNow() { return page.pictureImage && page.state.picture ? {...page.pictureImage, points: page.state.picture} : null; }

function handlesNow(shape, chain) {
  if (page.tool === "picks") return pickHandles();
  if (page.tool === "picture") return pictureNow()?.points.map((p, k) => ({key: `reference ${"ab"[k]}`, kind: "reference", x: p.x, y: -p.depth,
    label: `Reference point ${"AB"[k]} at x ${placeText(p.x)}, depth ${placeText(p.depth)}`})) || [];
  if (!shape) return [];
  const handles = [];
  const turn = k => {
    const s = chain[k], reach = 64 / page.section.view.scale / Math.max(1, page.section.view.height * Math.sin(s.startDip * degree));
    handles.push({key: `turn ${k}`, kind: "turn", x: s.start.x + reach * tangentOf(s).x, y: s.start.y + reach * tangentOf(s).y,
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
  return line ? shownPicks(line).map(k => ({key: `pick ${k}`, kind: "pick", x: line.x_m[k], y: -line.depth_m[k],
    label: `Point ${k + 1} of ${line.name} at x ${placeText(line.x_m[k])}, depth ${placeText(line.depth_m[k])}`})) : [];
}

/** Points of a line that a hand can tell apart: all of a short one, else one in each square of the view, and the chosen
 * one. */
function shownPicks(line) {
  const all = line.x_m.map((_, k) => k), {section} = page, taken = new Set(), square = 12; // pixels
  if (all.length <= 500) return all;
  return all.filter(k => {
    const [column, row] = section.px(line.x_m[k], line.depth_m[k]);
    const isIn = column >= 0 && column <= section.width && row >= 0 && row <= section.height;
    const place = `${Math.floor(column / square)} ${Math.floor(row / square)}`, isFirst = isIn && !taken.has(place);
    if (isFirst) taken.add(place);
    return isFirst || page.chosen === `pick ${k}`;
  });
}

function lineNow(state = page.state) { return page.line ? state.picks[page.line.kind]?.[page.line.index] : undefined; }

function tellPiece(k, chain = page.chain) {
  const s = chain[k], shape = shapeNow(), piece = shape.pieces[k];
  const kind = piece.kind === "arc" ? `arc of radius ${placeText(piece.radius)}, dip ${s.startDip.toFixed(1)}° to ${s.endDip.toFixed(1)}°`
    : `line of ${placeText(piece.length)}, dip ${s.startDip.toFixed(1)}°`;
  return `x ${placeText(s.end.x)}, depth ${placeText(-s.end.y)}; ${kind}, from the node before`;
}

/** Where the detachment soles out, in a sentence. */
function tellSole(chain = page.chain, shape = shapeNow()) {
  const s = chain[lastSloping(shape)];
  return `Soles out at a depth of ${placeText(-s.end.y)} at x = ${placeText(s.end.x)}.`;
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

function showKinematics(found) {
  const {extension} = page, {name: unit, metres} = lengthUnit();
  $("extension_told").textContent = placeText(extension, 1);
  $("extension").setAttribute("aria-valuetext", placeText(extension, 1));
  $("angle_told").textContent = `${$("angle").value}°`;
  const rows = [["Tilt of the head block", found?.tilt !== undefined ? `${found.tilt.toFixed(1)}°` : "-"],
    ["Cutoff of the head block", found?.cutoff ? `x ${placeText(found.cutoff.x)}, depth ${placeText(found.cutoff.depth)}` : "-"],
    ["Deepest drawn basin", found ? `${placeText(found.deepest.depth)} at x ${placeText(found.deepest.x)}` : "-"],
    ["Area of the basin", found ? `${(found.area / metres ** 2).toFixed(1)} ${unit}²` : "-"]];
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

/** Time on the machine that wrote the page: at the speed of the packing that is nearest in size. */
function secondsOf({discs_at_start: discs, work, shared_work: shared}) {
  const {by_size: sizes, accounted} = facts.speeds, far = ({discs: other}) => Math.abs(Math.log(other / discs));
  const speed = page.now.accounts_energy ? accounted : sizes.reduce((a, b) => far(b) < far(a) ? b : a);
  return shared / speed.team + (work - shared) / speed.one_thread;
}

/** Whether what the program last said is of the scene as it is now, or soon will be. */
const isForeseen = () => model ? !checker.verdict?.fault : !page.past.length;

function showCost() {
  const table = $("cost"), now = page.state.scene.accuracy ?? "standard";
  keepRows(table, "levels", () => [headOf(["Accuracy", "Radius", "Discs", "At the end", "Time"]), ...facts.now.levels.map(({name}) => {
    const radio = element("input", {type: "radio", name: "accuracy", value: name});
    radio.onchange = () => change("", state => { state.scene.accuracy = name; });
    return element("tr", {}, element("td", {}, element("label", {}, radio, ` ${name}`)), ...cells(4));
  })]);
  page.seconds = {};
  page.now.levels.forEach(({name, radius_m: radius, prediction}, k) => {
    const row = table.rows[k + 1], cost = isForeseen() ? prediction : null;
    row.className = name === now ? "chosen" : "";
    row.querySelector("input").checked = name === now;
    if (cost) page.seconds[name] = secondsOf(cost);
    const numbers = cost ? [`${Number(radius.toPrecision(4))} m`, about.format(cost.discs_at_start), about.format(cost.discs_at_end),
      duration(page.seconds[name])] : ["-", "-", "-", "-"];
    numbers.forEach((text, column) => { row.cells[column + 1].textContent = text; });
    if (name === now) page.cost = cost;
  });
  const {threads, by_size: [, {team}]} = facts.speeds;
  $("cost_note").textContent = `On the machine that wrote this page, with ${threads} ${threads === 1 ? "thread" : "threads"} when nothing else runs ` +
    `(${about.format(team / 1e6)} million disc-steps per second). Elsewhere: listric explain.`;
}

function showPieces() {
  const shape = shapeNow(), table = $("pieces"), chain = page.chain;
  if (!shape || !chain) {
    keepRows(table, "none", () => []);
    return;
  }
  const last = lastSloping(shape), unit = lengthUnit();
  keepRows(table, JSON.stringify([last, unit.name, ...shape.pieces.map(piece => [piece.kind, "startDip" in piece])]), () =>
    [headOf(["", "Piece", "Radius or length, m", "Dip, °", "", `Ends at x, ${unit.name}`, `depth, ${unit.name}`]), ...shape.pieces.map((piece, k) => rowOfPiece(piece, k, last))]);
  const put = (cell, value, digits = 2) => {
    const field = cell.querySelector("input"), text = String(Number(value.toFixed(digits)));
    if (!field) cell.lastChild.textContent = text;
    else if (field.value !== text) field.value = text;
    field?.setAttribute("aria-invalid", false);
  };
  shape.pieces.forEach((piece, k) => {
    const row = table.rows[k + 1], {startDip, endDip, end} = chain[k];
    row.className = page.chosen === `node ${k}` ? "chosen" : "";
    put(row.cells[2], piece.radius ?? piece.length, 2 + decimalsOf(shape));
    put(row.cells[3], startDip);
    if (piece.kind === "arc") put(row.cells[4], endDip);
    [end.x, -end.y].forEach((x, column) => { row.cells[5 + column].textContent = (x / unit.metres).toFixed(2); });
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
  const value = numberOf(input.value), next = copyOf(shapeNow());
  if (value !== undefined) make(next, value);
  const why = value === undefined ? "a number is missing" : model ? answerOf("pieces", tableOf(next)).fault
    : isWhole(next) ? "" : "every arc has to turn, and the last piece to end flat";
  input.setAttribute("aria-invalid", Boolean(why));
  if (why) tell(`Piece ${k + 1}: ${why}.`);
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

/** Lines of one name are pieces of one horizon or fault, and of one age. */
function nameLine(state, kind, index, name) {
  if (!name.trim()) {
    tell("A line needs a name.");
    return false;
  }
  const line = state.picks[kind][index], other = state.picks[kind].find((one, k) => k !== index && one.name === name.trim());
  line.name = name.trim();
  if (other) {
    delete line.age_a;
    if (other.age_a !== undefined) line.age_a = other.age_a;
    tell(`${line.name} is in pieces: nothing is between them.`);
  }
  return true;
}

function ageLine(state, kind, index, input) {
  const age = numberOf(input.value) * 1e6;
  const all = state.picks[kind].filter(line => line.name === state.picks[kind][index].name);
  if (!input.value.trim()) for (const line of all) delete line.age_a;
  else if (age >= 0 && age <= 1e10) for (const line of all) line.age_a = age;
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
      const value = numberOf(input.value);
      input.setAttribute("aria-invalid", value === undefined);
      if (value !== undefined) change("", state => { state.picture[k][key] = value; });
    };
    return element("label", {}, `${"AB"[k]}: ${key}, m `, input);
  })));
  const decimals = placeDecimals(), corners = cornersOf(picture).map(x => x.toFixed(decimals)).join(",");
  picture.points.forEach((p, k) => ["x", "depth"].forEach(key => { $(`reference_${"ab"[k]}_${key}`).value = Number(p[key].toFixed(1 + decimals)); }));
  $("corners").textContent = `Corners: ${corners}. The saved scene has them. Later, over the run: listric figures DIR --underlay ${picture.file || picture.name}`;
}

function costText() {
  if (!page.cost) return "";
  return `${about.format(page.cost.discs_at_start)} discs, about ${duration(page.seconds[page.state.scene.accuracy ?? "standard"])} at ${page.state.scene.accuracy ?? "standard"}.`;
}

function showState() {
  const faults = faultsNow(), box = $("state"), {verdict} = checker;
  box.classList.toggle("bad", faults.length > 0);
  box.textContent = faults.length ? faults.map(({message}) => message).join("\n")
    : verdict ? [`The program finds no fault. ${costText()}`, ...verdict.warnings].join("\n")
    : model ? `The program reads the scene. ${costText()}`
    : `This page has no model, so it tests no more than that numbers are some. listric check ./${baseName()}.toml decides. ${costText()}`;
  box.style.minHeight = `${box.offsetHeight}px`; // it grows alone: the section below must not move under a hand
  page.forms.show(page.state.scene, faults);
  return faults;
}

/** What changes when the program has read the scene. */
function showVerdict() {
  showExtension(settings().distance);
  showSection();
  showCost();
  showState();
}

/** The slider is at a share of the distance; at its end it stays there when the distance changes. */
function showExtension(distance) {
  const slider = $("extension"), isAtEnd = slider.value === slider.max;
  page.extension = isAtEnd ? distance : Math.min(page.extension, distance);
  if (!isAtEnd && distance > 0) slider.value = slider.max * page.extension / distance;
}

function showAll() {
  checkSoon();
  const {scene, picks} = page.state, {distance} = settings();
  $("title").textContent = scene.description || "Draw a section";
  $("subtitle").textContent = `${page.state.file}${page.past.length ? ", changed" : ""}; ${facts.program}`;
  $("undo").disabled = !page.past.length;
  $("redo").disabled = !page.future.length;
  $("save_picks").disabled = !picks.horizons.length && !picks.faults.length;
  $("key_steps").textContent = keyStepsText();
  $("save_as").placeholder = baseName();
  $("save_as").value = page.state.saveAs;
  showExtension(distance);
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
