// The run as apps/figures/report_moments.cpp wrote it.

const $ = id => document.getElementById(id);

function trouble(error) {
  $("trouble").hidden = false;
  $("trouble").textContent = typeof DecompressionStream === "undefined"
    ? "This browser is too old for the page: it lacks DecompressionStream (Chrome 80, Firefox 113, Safari 16.4 have it)."
    : `Snapshot data damaged: ${error.message || error}. Make the report anew with: listric report DIR`;
  document.documentElement.dataset.ready = "false";
}

/** The page's data; null, and words to the reader, where they cannot be read. */
function dataOf(id) {
  try { return JSON.parse($(id).textContent); }
  catch (error) { trouble(error); return null; }
}

/** Bytes of base64 text of zlib's format; damage is found by its checksum. */
async function inflated(text) {
  const letters = atob(text);
  const packed = new Uint8Array(letters.length);
  for (let k = 0; k < letters.length; ++k) packed[k] = letters.charCodeAt(k);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Whole numbers from planes of bytes: 0 1 2 3 4 are 0 -1 1 -2 2. */
function unfolded(bytes, planes) {
  const count = bytes.length / planes;
  if (!Number.isInteger(count)) throw new Error("a stream is cut off");
  const numbers = new Int32Array(count);
  for (let k = 0; k < count; ++k) {
    let folded = 0;
    for (let plane = 0; plane < planes; ++plane) folded |= bytes[plane * count + k] << (8 * plane);
    numbers[k] = (folded >>> 1) ^ -(folded & 1);
  }
  return numbers;
}

const bondStreams = ["bonds_left", "bonds_new", "bonds_to"];

const strainStreams = ["window_strain", "total_strain", "window_tectonic_strain", "total_tectonic_strain"];

/** Where nothing settles all strain is tectonic: one stream stands for both. */
function shareStrain({streams, ends}) {
  for (const span of ["window", "total"]) {
    if (!(`${span}_strain` in streams)) continue;
    streams[`${span}_tectonic_strain`] = streams[`${span}_strain`];
    ends[`${span}_tectonic_strain`] = ends[`${span}_strain`];
  }
}

/** A run: head, moments, and of each moment numbers by disc's id. */
class Run {
  constructor(head) {
    this.head = head;
    this.moments = head.moments;
    if (!head.settling) this.moments.forEach(shareStrain);
    this.codes = this.moments.map(() => ({}));
    this.lines = [];
    this.numbers = new Map();
    this.history = tableOf(head.history);
  }

  has(name) { return this.moments.length > 0 && name in this.moments[0].streams; }

  /** Reads these streams of all moments, which are differences from moment to moment. */
  async load(names) {
    const wanted = names.filter(name => this.has(name) && !(name in this.codes[0]));
    await Promise.all(wanted.map(async name => {
      const parts = await Promise.all(this.moments.map(async moment => {
        const [planes, text] = moment.streams[name];
        return unfolded(await inflated(text), planes);
      }));
      let before = new Int32Array(0);
      parts.forEach((codes, k) => {
        if (!bondStreams.includes(name)) {
          if (codes.length < before.length) throw new Error("a stream is too short");
          for (let i = 0; i < before.length; ++i) codes[i] += before[i];
          before = codes;
        }
        this.codes[k][name] = codes;
      });
    }));
  }

  async loadLines(k) {
    if (!this.lines[k])
      this.lines[k] = JSON.parse(new TextDecoder().decode(await inflated(this.moments[k].lines)));
    return this.lines[k];
  }

  /** Lines of the last moment that has all kinds of them. */
  async loadKnown() {
    let k = this.moments.length - 1;
    while (k > 0 && !(await this.loadLines(k)).followed) --k;
    this.known = await this.loadLines(k);
  }

  /** Numbers by id in their unit. */
  values(k, name) {
    const key = `${k} ${name}`;
    if (!this.numbers.has(key)) {
      if (this.numbers.size > 40) this.numbers.clear();
      const codes = this.codes[k][name], scale = this.head.scales[name] || {step: 1, root: false, none: 0};
      const values = new Float64Array(codes.length);
      for (let i = 0; i < codes.length; ++i) {
        const size = codes[i] * scale.step;
        values[i] = scale.none && codes[i] === scale.none ? NaN : scale.root ? Math.sign(size) * size * size : size;
      }
      this.numbers.set(key, values);
    }
    return this.numbers.get(key);
  }

  /** Pairs of ids that are bonded, one after the other. */
  bonds(k) {
    let pairs = [];
    for (let m = 0; m <= k; ++m) {
      const {bonds_left: left, bonds_new: low, bonds_to: further} = this.codes[m];
      const kept = [];
      for (let i = 0; i < left.length; ++i) if (left[i]) kept.push(pairs[2 * i], pairs[2 * i + 1]);
      let last = 0;
      for (let i = 0; i < low.length; ++i) {
        last += low[i];
        kept.push(last, last + further[i]);
      }
      pairs = kept;
    }
    return pairs;
  }

  /** The moment nearest to a travel, m. */
  nearest(travel) {
    let best = 0;
    this.moments.forEach((moment, k) => {
      if (Math.abs(travelOf(moment) - travel) < Math.abs(travelOf(this.moments[best]) - travel))
        best = k;
    });
    return best;
  }
}

/** The clock of a run: with stages of motion the wall's way back and forth, m, else its extension. */
function travelOf(moment) { return moment.travel_m ?? moment.extension_m; }

/** "5.00 km", with stages "1.00 km net after 9.00 km of wall motion"; a pause is no motion */
function wayText(moment) {
  const net = placeText(moment.extension_m), way = placeText(moment.wall_m ?? moment.travel_m ?? 0);
  return "wall_m" in moment && way === net || !("travel_m" in moment) ? net : `${net} net after ${way} of wall motion`;
}

/** A CSV table of numbers by its columns; an empty field is NaN. */
function tableOf(text) {
  const rows = text.trim().split("\n").map(row => row.split(","));
  const names = rows[0][0] ? rows.shift() : [];
  const table = {};
  names.forEach((name, c) => { table[name] = rows.map(row => row[c] === "" ? NaN : Number(row[c])); });
  return table;
}
