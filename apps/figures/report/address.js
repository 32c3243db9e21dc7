// What the address says of the page, so that a link shows it as it is seen.

/** What the address says of the page, after its "#". */
function addressWords() {
  const {view} = page, words = new URLSearchParams({t: page.t, colour: page.mode, palette: page.palette,
    view: [view.left, view.top, view.scale * page.sections[0].host.clientWidth / page.sections[0].discCanvas.width, view.height]
      .map(value => Number(value.toPrecision(8))).join(","), shown: [...page.shown].join(",")});
  return String(words);
}

function writeAddress() {
  try { history.replaceState(null, "", `#${addressWords()}`); } catch { /* a browser that keeps a file's address */ }
}

let addressTimer = 0;

/** Browsers ignore addresses that change hundreds of times in seconds: this one is written when the view rests. */
function writeAddressSoon() {
  $("copy").textContent = "copy link";
  clearTimeout(addressTimer);
  addressTimer = setTimeout(writeAddress, 400);
}

function readAddress() {
  const words = new URLSearchParams(location.hash.slice(1) || location.search);
  page.t = momentWithin(words.has("t") ? Number(words.get("t")) : Infinity);
  if (modesOf(page.runs).includes(words.get("colour"))) page.mode = words.get("colour");
  if (Object.hasOwn(palettes, words.get("palette"))) page.palette = words.get("palette");
  page.shown = new Set(words.has("shown") ? words.get("shown").split(",")
    : Object.keys(page.layers).filter(name => page.layers[name].on));
  const view = (words.get("view") || "").split(",").map(Number);
  return view.length === 4 && view.every(Number.isFinite) && view[2] > 0 && view[3] > 0 ? view : null;
}
