// Colours of discs. Packed as the canvas has them: alpha, blue, green, red from the highest byte.

/** Classes of rock, colours, palettes, scales and layers: figures/vocabulary.json, which all painters share. */
const vocabulary = dataOf("vocabulary");

const palettes = {};
for (const [name, palette] of Object.entries(vocabulary?.palettes || {}))
  palettes[name] = Uint32Array.from({length: 256}, (_, k) =>
    packedColour(palette.rows.slice(6 * k, 6 * k + 6)));

function packedColour(hex) {
  const rgb = parseInt(hex.replace("#", ""), 16);
  return (0xff000000 | (rgb & 0xff) << 16 | (rgb & 0xff00) | rgb >> 16) >>> 0;
}

function cssColour(packed) {
  return "#" + [packed & 255, packed >> 8 & 255, packed >> 16 & 255]
    .map(part => part.toString(16).padStart(2, "0")).join("");
}

/** A share of the way from one colour to another. */
function mixed(packed, other, share) {
  const part = shift => Math.round((packed >> shift & 255) * (1 - share) + (other >> shift & 255) * share);
  return (0xff000000 | part(16) << 16 | part(8) << 8 | part(0)) >>> 0;
}

/** What discs can be coloured by: streams that it needs, where its scale ends, a label. */
const modes = {
  strata: {label: "strata", needs: ["stratum", "start_depth_m"]},
  window: {label: "strain of the window", remark: "without", needs: ["window_tectonic_strain"], end: "window_tectonic_strain"},
  total: {label: "total strain", remark: "without", needs: ["total_tectonic_strain"], end: "total_tectonic_strain"},
  rock: {label: "rock behaviour", needs: ["behaviour"]},
  mean: {label: "mean stress (MPa)", needs: ["mean_stress_pa"], end: "mean_stress_pa", unit: 1e6},
  shear: {label: "shear stress (MPa)", needs: ["shear_stress_pa"], end: "shear_stress_pa", unit: 1e6},
  displacement: {label: "displacement (m)", needs: ["start_x_m", "start_depth_m"], end: "displacement_m"},
  settled_window: {label: "strain of the window", remark: "with", needs: ["window_strain"], end: "window_strain"},
  settled_total: {label: "total strain", remark: "with", needs: ["total_strain"], end: "total_strain"},
};

/** What makes rock of these runs lower where nothing shears, in words. */
function settlingOf(runs) { return [...new Set(runs.map(run => run.head.settling))].filter(Boolean).join(", "); }

/** Label of a mode; of strain with what it is without, or with. */
function modeLabel(name, runs) {
  const {label, remark} = modes[name], settling = settlingOf(runs);
  return remark && settling ? `${label} ${remark} ${settling}` : label;
}

/** What all of these runs can be coloured by. */
function modesOf(runs) {
  return Object.keys(modes).filter(name => (modes[name].remark !== "with" || settlingOf(runs)) &&
    modes[name].needs.every(stream => runs.every(run => run.has(stream))));
}

function displacement(run, k) {
  const x = run.values(k, "x_m"), z = run.values(k, "depth_m");
  const x0 = run.values(k, "start_x_m"), z0 = run.values(k, "start_depth_m");
  return x.map((value, i) => Math.hypot(value - x0[i], z[i] - z0[i]));
}

/** The end of a scale: the program found it for each run's last moment; the same at all moments. */
function scaleEnd(runs, mode) { return Math.max(...runs.map(run => run.moments.at(-1).ends[modes[mode].end] || 0)) || 1; }

/** The colours of a scale, or of the strata: those of the figures, unless another palette is chosen. */
function paletteOf(mode, chosen) {
  return palettes[chosen] || palettes[vocabulary[mode === "strata" ? "strata" : "scale"].palette];
}

/** Of stratum k of so many, every second one slightly lighter. */
function stratumColour(k, strata, table) {
  const {lighter, lighter_from: from} = vocabulary.strata, colour = table[Math.round(255 * (k - 1) / Math.max(strata - 1, 1))];
  return strata >= from && k % 2 === 0 ? mixed(colour, 0xffffffff, lighter) : colour;
}

/** Of the n-th layer of rock, from 1, by turns. */
function layerColour(n) { return vocabulary.rock_layers.colours[(n - 1) % vocabulary.rock_layers.colours.length]; }

/** A colour by id. */
function discColours(run, k, mode, palette, top, strata) {
  const table = paletteOf(mode, palette), colours = new Uint32Array(run.codes[k].present.length);
  if (mode === "strata") {
    const stratum = run.codes[k].stratum, depth = run.values(k, "start_depth_m");
    const young = Array.from({length: strata + 1}, (_, s) => s && stratumColour(s, strata, table));
    const old = vocabulary.pre_rift.colours.map(packedColour), layer = vocabulary.pre_rift.layer_m;
    const bed = run.codes[k].layer, beds = (run.head.rock_layers || []).map((name, n) => packedColour(layerColour(n + 1)));
    for (let i = 0; i < colours.length; ++i)
      colours[i] = stratum[i] > 0 ? young[stratum[i]] : bed && bed[i] ? beds[bed[i] - 1] : old[Math.floor(Math.max(depth[i], 0) / layer) % old.length];
  } else if (mode === "rock") {
    const classes = vocabulary.rock_classes.map(({colour}) => packedColour(colour));
    run.codes[k].behaviour.forEach((behaviour, i) => { colours[i] = classes[behaviour]; });
  } else {
    const values = mode === "displacement" ? displacement(run, k) : run.values(k, modes[mode].needs[0]);
    const undefinedColour = packedColour(vocabulary.scale.undefined.colour);
    for (let i = 0; i < colours.length; ++i)
      colours[i] = Number.isNaN(values[i]) ? undefinedColour : table[Math.round(255 * Math.min(Math.max(values[i] / top, 0), 1))];
  }
  return colours;
}

/** Lays the ink of layers of discs over colours by id. */
function inkDiscs(colours, run, k, layers) {
  for (const [name, {ink}] of layers) {
    const over = packedColour(ink);
    run.codes[k][name].forEach((share, i) => { if (share > 0) colours[i] = mixed(colours[i], over, share / 255); });
  }
  return colours;
}
