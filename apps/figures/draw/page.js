// The page begins here, with the field that finds and sets, and what its buttons do.

/** table.key = value sets, as --set does; other words filter the forms. */
function find(final) {
  const text = $("find").value.trim(), [, path, value] = /^([\w.]+)\s*=\s*(.*)$/.exec(text) || [];
  const words = path ? [] : text.toLowerCase().split(/\s+/).filter(Boolean), count = page.forms.filter(words);
  if (path) $("found").textContent = setByText(path, value, final);
  else $("found").textContent = !text ? "" : count ? `${count} ${count === 1 ? "parameter" : "parameters"}`
    : `none; ${(model && valueOf(text.replace(/\W+/g, "_"), "0").fault) ?? ""}`;
}

function setByText(path, text, final) {
  const {value, fault} = valueOf(path, text);
  if (fault) return fault;
  if (!final) return "Enter sets it";
  change("", state => setAt(state, path, value));
  return `${path} is set`;
}

// -- beginning

function setTool(tool) {
  page.tool = tool;
  page.chosen = "";
  document.querySelector(`input[name=tool][value=${tool}]`).checked = true;
  showAll();
  if (tool === "picture") showWhole();
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
  on("drop_picture", () => change("", state => { page.pictureImage = null; delete state.asked.picture; }));
  on("save_as", () => change("", state => { state.saveAs = $("save_as").value.trim().replace(/\.toml$/i, ""); }), "onchange");
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
  on("extension", () => { page.extension = settings().distance * $("extension").value / $("extension").max; drawSoon(); }, "oninput");
  on("height", () => { page.section.view.height = Number($("height").value); showWhole(); }, "onchange");
  on("find", () => find(false), "oninput");
  $("find").addEventListener("keydown", event => { if (event.key === "Enter") find(true); });
  for (const radio of document.querySelectorAll("input[name=tool]")) radio.onchange = () => setTool(radio.value);
  addFileDrop();
  addRunListeners();
  new ResizeObserver(() => { if (page.section.width !== page.section.host.clientWidth) showWhole(); }).observe(page.section.host);
  window.addEventListener("beforeunload", event => {
    if (page.past.length && !page.saved || isUnderWay()) event.preventDefault();
  });
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
  page.forms = new Forms($("forms"), {
    change: (path, value, why) => why ? showState() : change("", state => setAt(state, path, value)),
    toggle: (name, isOn) => change("", state => {
      if (isOn) state.scene[name] ??= {};
      else delete state.scene[name];
    })});
  await startModel().catch(error => tellRun(error.message));
  showDocument(facts.document, `${facts.scene}.toml`, facts.observed, facts.fault_points || null);
  if (facts.on_shelf) rememberShipped(facts.scene);
  if (window.innerWidth < 640) $("height").value = "2";
  page.section.view.height = Number($("height").value);
  addListeners();
  if (facts.picture) {
    const {image, name, file, corners_m: corners} = facts.picture, shown = new Image();
    shown.src = image;
    const isGood = await shown.decode().then(() => true, () => false);
    if (isGood) takePicture(page.state, {image, name, file, width: shown.naturalWidth, height: shown.naturalHeight}, corners);
    if (!corners || !isGood) setTool("picture");
    if (!isGood) page.badPicture = `${name}: is damaged, or no picture that a browser reads; choose another`;
  }
  showAll();
  showWhole();
  if (page.badPicture) tell(page.badPicture);
  $("footer").textContent = `${facts.program}. One file: nothing leaves this computer. Drop TOML, CSV of picks, PNG or JPEG anywhere.`;
  if (model) takeExampleOfAddress();
  $("licence_texts").textContent = $("notices").textContent;
  $("trouble").hidden = true;
}

begin().then(() => { document.documentElement.dataset.ready = "true"; }, error => {
  $("trouble").textContent = `This page cannot be shown: ${error.message}`;
  document.documentElement.dataset.ready = "false";
});
