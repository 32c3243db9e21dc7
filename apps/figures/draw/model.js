// The program's model in this page: it reads, checks and predicts what is drawn, in the program's words. A page that a program
// without it wrote draws and saves, and knows no more than that.

const hasModule = Boolean($("module").textContent.trim());

/** The module's bytes; the page has them compressed, and four as five characters (apps/run/drawing_page.cpp). */
async function moduleBytes() {
  const text = $("module").textContent.trim(), bytes = new Uint8Array(4 * Math.ceil(text.length / 5)), view = new DataView(bytes.buffer);
  for (let k = 0; k < text.length; k += 5) {
    let word = 0;
    for (let n = k; n < k + 5; ++n) word = 85 * word + (n >= text.length ? 84 : text[n] === "~" ? 20 : text.charCodeAt(n) - 40);
    view.setUint32(k / 5 * 4, word);
  }
  const packed = bytes.subarray(0, Math.floor(0.8 * text.length));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

const workerUrl = hasModule && URL.createObjectURL(new Blob([$("worker").textContent], {type: "text/javascript"}));

let model = null; // for answers of some milliseconds; runs and checks have workers

const lacksModel = "needs the model of the program, which this page does not have";

/** A message of the module as it reads beside the file that will be saved. */
function asOfFile(message) { return message.replace(/^\/(?=[^/:]+\.(toml|csv|svg):)/, ""); }

/** What the model says, or {fault}. */
function answerOf(name, value) {
  try {
    return model.ask(name, value);
  } catch (error) {
    return {fault: asOfFile(error.message)};
  }
}

/** What the module reads in place of files, and which scene of it; at draft, where it is run and says nothing else. Picks of a
 * file that nobody has dropped are left out. A shipped scene as it is goes by its name, by which its errors are known. */
function requestNow(seed) {
  const name = shippedNow(), path = `/${baseName()}.toml`, text = page.fresh && !missingFiles().length ? page.fresh : sceneText(hasPicks);
  const files = {...facts.files, ...page.given, ...(name ? {} : {[path]: text})};
  for (const kind of pickKinds.filter(hasPicks)) files[`/${picksFile(kind)}`] = picksText(kind);
  const {accuracy = "draft"} = page.state.scene;
  return {files, request: {scene: name || path, ...(seed === undefined ? {} : {accuracy, seed})}};
}

// -- values and texts

/** A value in a line, as plainly as TOML has it. */
function plainText(value) {
  if (Array.isArray(value)) return `[${value.map(plainText).join(", ")}]`;
  if (typeof value !== "object") return JSON.stringify(value);
  return value.toml ?? `{${Object.entries(value).map(([key, one]) => `${key} = ${plainText(one)}`).join(", ")}}`;
}

/** A document as TOML; without the model, as the page was given it and changed it. */
function textOf(document) {
  if (model) return model.ask("text", document);
  const isTable = value => typeof value === "object" && (!Array.isArray(value) || typeof value[0] === "object"), all = Object.entries(document);
  const lines = entries => entries.map(([key, value]) => `${key} = ${plainText(value)}\n`).join("");
  return lines(all.filter(([, value]) => !isTable(value))) +
    all.filter(([, value]) => isTable(value)).flatMap(([name, value]) => Array.isArray(value) ? value.map(table => [`[[${name}]]`, table]) : [[`[${name}]`, value]])
      .map(([head, table]) => `\n${head}\n${lines(Object.entries(table))}`).join("");
}

/** What a text in the field of a parameter stands for: {value}, {missing}, or {fault}. */
function valueOf(path, text) {
  const {type, items} = schemaAt(path) || {}, opens = items?.type === "array" ? /^\[\s*\[/ : /^\[/;
  text = text.trim();
  if (text === "") return {missing: true};
  if (!["number", "integer", "boolean", "array"].includes(type)) text = JSON.stringify(text);
  else if (type === "array" && !opens.test(text)) text = `[${text}]`;
  else text = text.replace(/^\+?\./, "0.");
  if (model) return valueByModel(path, text);
  const [table, item] = path.split(".");
  if (!schemaAt(path) || Number(item) > (page.state.scene[table]?.length ?? 0)) return {fault: "unknown key"}; // the next item may be new
  try {
    return {value: JSON.parse(text)};
  } catch {
    return {fault: `${text} is no ${type}`};
  }
}

function valueByModel(path, text) {
  const scene = "/now.toml", assignment = `${path}=${text}`, ours = `--set ${assignment}: `, place = placeOf(path);
  model.give(scene, textOf(page.state.scene));
  const {value, fault} = answerOf("value", {scene, set: [assignment], path: place});
  if (!fault?.startsWith(ours)) return {value}; // something else is wrong, and was before
  return {fault: fault.slice(ours.length).replace(`${place}: `, "")};
}

const numberOf = text => text.trim() && Number.isFinite(Number(text)) ? Number(text) : undefined;

// -- kinematics

/** What rigid footwall and slip alone predict of the shape: null, where nothing is. */
function kinematicsOf(shape, length, extension) {
  if (!model || !(extension > 0)) return null;
  const {distance} = settings(), pixels = page.drag?.key ? 6 : 3;
  const request = {detachment: tableOf(shape), extension_m: extension, angle_deg: Number($("angle").value), right_m: length + extension,
    reach_m: 1.5 * (length + 2 * distance), step_m: pixels / page.section.view.scale};
  const key = JSON.stringify(request);
  if (key !== page.kinematicsKey) [page.kinematicsKey, page.kinematics] = [key, answerOf("kinematics", request)];
  return page.kinematics.fault ? null : page.kinematics;
}

// -- checks

/** A worker that reads the scene after changes, and what it has said of the last one: null until then. */
const checker = {worker: null, verdict: null, number: 0, timer: 0, waiting: []};

async function startModel() {
  if (!hasModule) return;
  const bytes = await moduleBytes();
  const started = await startModule(bytes, () => {}), {version, sources} = started.program();
  for (const [path, text] of Object.entries(facts.files)) started.give(path, text);
  model = started;
  if (sources !== facts.sources) page.otherModel = `The model here is of listric ${version}, and may compute other bits. `;
  tellRun(page.otherModel);
  checker.worker = new Worker(workerUrl);
  checker.worker.onmessage = ({data}) => takeVerdict(data);
  checker.worker.postMessage({load: bytes});
}

function takeVerdict(data) {
  if (!data.failed && !data.read || data.number !== checker.number) return; // of something else, or of before
  if (data.read) page.now = data.read;
  checker.verdict = data.failed ? {fault: asOfFile(data.failed)} : data.read;
  for (const done of checker.waiting.splice(0)) done();
  const show = () => page.drag ? setTimeout(show, 100) : showVerdict(); // more lines would move what is dragged
  show();
}

function checkSoon() {
  checker.verdict = null;
  const number = ++checker.number;
  clearTimeout(checker.timer);
  if (checker.worker) checker.timer = setTimeout(() => checker.worker.postMessage({check: {...requestNow(), number}}), 300);
}

/** The program's verdict on what is drawn now; null: there is no program. */
async function verdictNow() {
  while (checker.worker && !checker.verdict) await new Promise(done => checker.waiting.push(done));
  return checker.verdict;
}

/** What is wrong: fields whose texts are refused, or else what the program refuses: [{path, message}]. */
function faultsNow() {
  const typed = [...page.forms.bad].map(([path, message]) => ({path, message: `${placeOf(path)}: ${message}`}));
  const {fault} = checker.verdict || {}, place = /(?:^|: )([a-z_]+(?:\[\d+\])?(?:\.[a-z_]+)?)(?:\[[^:]*)?: /.exec(fault)?.[1] ?? "";
  return typed.length || !fault ? typed : [{path: place.replace(/\[(\d+)\]/, ".$1"), message: fault}];
}
