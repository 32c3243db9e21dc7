// Dragging, clicks and keys.

function chooseHandle(key, focus = false) {
  page.chosen = key;
  showSection();
  showPieces();
  const shape = shapeNow(), k = nodeOf(key);
  $("remove").disabled = page.tool !== "fault" || !shape || k < 0 || !removeNode(shape, k);
  tellChosen();
  if (focus) page.section.handles.find(handle => handle.dataset.key === key)?.focus({preventScroll: true});
}

/** x and depth of a point, rounded as a hand makes them. */
function pickedPlace({x, y}) { return [x, -y].map(metres => roundLength(metres, placeDecimals()) || 0); }

/** What becomes of a state when a handle comes to a place. */
function moveHandle(state, key, p) {
  const [kind, which] = key.split(" ");
  if (kind === "pick") {
    const line = lineNow(state);
    [line.x_m[which], line.depth_m[which]] = pickedPlace(p);
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

const touches = new Map(); // pointers that are down, by their number

/** Two fingers: how far they are from each other, and their middle. */
function pinchNow() {
  const [a, b] = touches.values();
  return {width: Math.hypot(a.column - b.column, a.row - b.row), column: (a.column + b.column) / 2, row: (a.row + b.row) / 2};
}

/** The second finger ends what the first one drags. */
function startPinch() {
  if (page.drag?.key) page.state = page.drag.before;
  page.drag = null;
  page.pinch = pinchNow();
}

function goOnPinching() {
  if (touches.size < 2) return;
  const {pinch, section} = page, now = pinchNow(), box = section.svg.getBoundingClientRect();
  section.zoom(now.width / Math.max(pinch.width, 1), {column: pinch.column - box.left, row: pinch.row - box.top});
  section.view.left -= (now.column - pinch.column) / section.view.scale;
  section.view.top -= (now.row - pinch.row) / section.view.scale / section.view.height;
  page.pinch = now;
  drawSoon();
}

function startDrag(event) {
  const handle = event.target.closest(".handle"), section = page.section;
  if (event.button) return;
  section.svg.setPointerCapture(event.pointerId);
  touches.set(event.pointerId, {column: event.clientX, row: event.clientY});
  if (touches.size > 1) {
    startPinch();
    return;
  }
  const at = section.at(event);
  if (handle) {
    const matrix = handle.transform.baseVal[0].matrix, place = section.metres(matrix.e, matrix.f);
    page.drag = {key: handle.dataset.key, before: copyState(page.state), at, off: {x: place.x - at.x, y: place.y - at.y}, moved: false};
    chooseHandle(handle.dataset.key, true);
  } else {
    page.drag = {key: null, from: {column: event.clientX, row: event.clientY}, view: {...section.view}, piece: event.target.dataset?.piece, moved: false};
  }
  event.preventDefault();
}

function goOnDragging(event) {
  const {drag, section} = page;
  if (touches.has(event.pointerId)) touches.set(event.pointerId, {column: event.clientX, row: event.clientY});
  if (page.pinch) goOnPinching();
  if (!drag) return;
  if (drag.key) {
    const at = section.at(event);
    if (!drag.moved && Math.hypot(at.x - drag.at.x, (at.y - drag.at.y) * section.view.height) * section.view.scale < 3) return;
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
  touches.delete(event.pointerId);
  if (!touches.size) page.pinch = null;
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
    const line = lineNow(state), [x, depth] = pickedPlace(p);
    place = page.line.kind === "horizons" ? line.x_m.filter(other => other <= x).length : line.x_m.length;
    line.x_m.splice(place, 0, x);
    line.depth_m.splice(place, 0, depth);
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
    addPick(page.section.metres(page.section.width / 2, page.section.height / 2));
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
  const piece = page.chain[k], at = page.section.at(event), far = share => {
    const p = pointOn(piece, share * piece.length);
    return Math.hypot(p.x - at.x, p.y - at.y);
  };
  addHere(Array.from({length: 201}, (_, n) => n / 200).reduce((a, b) => far(b) < far(a) ? b : a), Number(k));
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
    const steps = event.shiftKey ? 10 : event.altKey ? 0.1 : 1, name = handle.dataset.key;
    page.chosen = name;
    nudge(name, arrow.map(x => x * steps));
    event.preventDefault();
  } else if (!event.target.closest?.("#section") && event.target !== document.body) return;
  else if (key === "delete" || key === "backspace") removeHere();
  else if (key === "a" || key === "insert") addHere();
  else if (key === "0") showWhole();
  else if (key === "+" || key === "-") zoom(key === "+" ? 1.25 : 0.8);
  else if (key === "enter" && handle) chooseHandle(handle.dataset.key, true);
}

/** What an arrow key moves a node by, m: 100 m in a basin. */
function keyStep() { return 10 ** (2 - placeDecimals()); }

/** "100 m (Shift 1 km, Alt 10 m)" */
function keyStepsText() {
  const text = metres => `${Number((metres >= 1000 ? metres / 1000 : metres >= 1 ? metres : 1000 * metres).toPrecision(3))} ` +
    (metres >= 1000 ? "km" : metres >= 1 ? "m" : "mm");
  return `${text(keyStep())} (Shift ${text(10 * keyStep())}, Alt ${text(0.1 * keyStep())})`;
}

/** Moves a handle by so many steps; the dip by degrees. */
function nudge(name, [dx, dy]) {
  const [kind, which] = name.split(" "), keep = () => page.section.handles.find(one => one.dataset.key === name)?.focus({preventScroll: true});
  if (kind === "turn") {
    const turned = Math.abs(dx) >= Math.abs(dy) ? -dx : -dy;
    changeShape(`turn ${which}`, before => turnStart(before, chainOf(before)[which].startDip + turned, Number(which)));
  } else {
    const place = kind === "node" ? chainOf(shapeNow())[which].end : kind === "pick" ? {x: lineNow().x_m[which], y: -lineNow().depth_m[which]}
      : {x: page.state.picture["ab".indexOf(which)].x, y: -page.state.picture["ab".indexOf(which)].depth};
    change(`move ${name}`, state => moveHandle(state, name, {x: place.x + keyStep() * dx, y: place.y + keyStep() * dy}));
  }
  chooseHandle(name);
  keep();
}

function showWhole() {
  const {length, thickness, distance} = settings();
  const depths = page.tool === "picture" ? (pictureNow()?.points || []).map(p => p.depth) : [];
  page.section.showWhole(length + distance, Math.max(thickness, ...depths.filter(depth => depth < 4 * thickness)));
  showSection();
}

function zoom(factor) {
  page.section.zoom(factor);
  showSection();
}
