// What is drawn and chosen now, and what undo goes back to.

const facts = dataOf("data"), schema = dataOf("schema");

/** A state is what undo goes back to: the scene's document with its file's name and the files that it names; picks, where the
 * picture is, and the name to save it by, if one was typed. `now` is what the program last said of the scene. */
const page = {
  state: {scene: {}, file: "", asked: {}, picks: {horizons: [], faults: []}, faultPoints: null, picture: null, saveAs: ""},
  past: [], future: [], pictureImage: null, now: facts.now, given: {}, seconds: {},
  tool: "fault", chosen: "", line: null, drag: null, extension: 0, lastChange: {}, otherModel: "",
};

const copyState = state => structuredClone(state);
const shapeNow = () => shapeOf(page.state.scene.detachment);

/** The schema of a value at a path of table and key, as --set has it: stage.1.distance_m; undefined: there is none. */
function schemaAt(path) { return path.split(".").reduce((at, key) => at?.items && /^\d+$/.test(key) ? at.items : at?.properties?.[key], schema); }

const valueIn = (document, path) => path.split(".").reduce((at, key) => at?.[key], document);

/** A path as messages have it: stage[1].distance_m. */
const placeOf = path => path.replace(/\.(\d+)/, "[$1]");

/** What a parameter is in force with where the scene does not give it. */
function defaultOf(path) { return valueIn(page.now.in_force, path) ?? schemaAt(path)?.default; }

const valueAt = path => valueIn(page.state.scene, path) ?? defaultOf(path);

/** Unit in which the page tells places, by the length of the hanging wall. */
function lengthUnit() {
  const {length} = settings();
  return length < 1 ? {name: "mm", metres: 0.001} : length < 1000 ? {name: "m", metres: 1} : {name: "km", metres: 1000};
}

/** "5.00 km" */
function placeText(metres, digits = 2) { return `${(metres / lengthUnit().metres).toFixed(digits)} ${lengthUnit().name}`; }

/** Decimals of places, m, that a hand makes in the section. */
function placeDecimals() { return decimalsIn(settings().length); }

// -- changes and undo

/** Makes a change that undo takes back; changes of one kind in quick succession are one. */
function change(kind, make) {
  const before = copyState(page.state), now = performance.now();
  if (make(page.state) === false) return;
  const joined = kind && kind === page.lastChange.kind && now - page.lastChange.time < 800 && !page.future.length;
  if (!joined) page.past.push(before);
  if (page.past.length > 200) page.past.shift();
  page.future = [];
  page.saved = page.fresh = false;
  page.lastChange = {kind, time: now};
  showAll();
}

function travel(from, to) {
  if (!from.length) return;
  to.push(copyState(page.state));
  page.state = from.pop();
  page.lastChange = {};
  page.fresh = false;
  page.forms.bad.clear();
  showAll();
}

function setAt({scene}, path, value) {
  const keys = path.split("."), key = keys.pop(), inside = keys.reduce((at, one) => at[one] ??= schema.properties[one]?.items ? [] : {}, scene);
  if (value === undefined) delete inside[key];
  else inside[key] = value;
}

/** Puts a shape into the scene; the hanging wall is as thick as it is deep. */
function putShape(state, shape) {
  Object.assign(state.scene.detachment, tableOf(shape));
  (state.scene.hanging_wall ??= {}).thickness_m = roundLength(depthOf(shape), 2 + decimalsOf(shape));
  if (page.shipped && state.scene.description === page.shipped.description) state.scene.description = `drawn, from ${page.shipped.name}`; // else it would not fit
}

/** A shape that a node's change made, at the depth that is kept if so asked. */
function atKeptDepth(before, after) {
  if ($("keep_depth").checked && !setDepth(after, depthOf(before))) return before;
  return isWhole(after) ? after : before;
}

function changeShape(kind, make) {
  const before = shapeNow();
  if (!before) return;
  const after = make(before);
  if (after) change(kind, state => putShape(state, atKeptDepth(before, after)));
  else tell("That is not possible here: pieces would be too short, or the detachment would not end flat.");
}

function tell(text) { $("told").textContent = text; }
