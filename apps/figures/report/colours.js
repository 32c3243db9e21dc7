// Colours of discs. Packed as the canvas has them: alpha, blue, green, red from the highest byte.

const palettes = {};
for (const [name, palette] of Object.entries(dataOf("palettes") || {}))
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

/** A share of the way to white. */
function lighter(packed, share) {
  const part = shift => Math.round((packed >> shift & 255) * (1 - share) + 255 * share);
  return (0xff000000 | part(16) << 16 | part(8) << 8 | part(0)) >>> 0;
}

// Dark against light first, hue second, so that they differ for everybody.
const rocks = [["basement, bonds intact", "#d9dce1"], ["basement, minor faults", "#8fa3bf"],
  ["weak: major faults", "#8c2d19"], ["loose sediment", "#f3d489"], ["bonded sediment", "#c9a227"]]
  .map(([name, hex]) => ({name, colour: packedColour(hex)}));

/** What discs can be coloured by: streams that it needs, the largest value of a run, a label. */
const modes = {
  strata: {label: "strata", needs: ["stratum", "start_depth_m"]},
  window: {label: "strain of the window", needs: ["window_strain"], scale: true, root: true},
  total: {label: "total strain", needs: ["total_strain"], scale: true, root: true},
  rock: {label: "rock behaviour", needs: ["behaviour", "stratum", "rock"]},
  mean: {label: "mean stress (MPa)", needs: ["mean_stress_pa"], scale: true, unit: 1e6},
  shear: {label: "shear stress (MPa)", needs: ["shear_stress_pa"], scale: true, unit: 1e6},
  displacement: {label: "displacement (m)", needs: ["start_x_m", "start_depth_m"], scale: true},
};

function displacement(run, k) {
  const x = run.values(k, "x_m"), z = run.values(k, "depth_m");
  const x0 = run.values(k, "start_x_m"), z0 = run.values(k, "start_depth_m");
  return x.map((value, i) => Math.hypot(value - x0[i], z[i] - z0[i]));
}

function shownValues(run, k, mode) {
  return mode === "displacement" ? displacement(run, k) : run.values(k, modes[mode].needs[0]);
}

/** The upper end of a scale: below it are 99 of 100 discs of the last moments; the same in all. */
function upperEnd(runs, mode) {
  const all = [];
  for (const run of runs) {
    const k = run.moments.length - 1, present = run.codes[k].present;
    shownValues(run, k, mode).forEach((value, i) => { if (present[i]) all.push(value); });
  }
  all.sort((a, b) => a - b);
  const unit = modes[mode].unit || 1;
  const high = (all[Math.floor(0.99 * (all.length - 1))] || 0) / unit;
  if (!(high > 0)) return 0.01 * unit;
  const power = 10 ** Math.floor(Math.log10(high));
  return unit * power * [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].find(step => high <= step * power * (1 + 1e-9));
}

/** A colour by id. */
function discColours(run, k, mode, palette, top, strata) {
  const table = palettes[palette];
  const colours = new Uint32Array(run.codes[k].present.length);
  if (mode === "strata") {
    const stratum = run.codes[k].stratum, depth = run.values(k, "start_depth_m");
    for (let i = 0; i < colours.length; ++i)
      colours[i] = stratum[i] > 0
        ? lighter(table[Math.round(255 * (stratum[i] - 1) / Math.max(strata - 1, 1))], stratum[i] % 2 ? 0.2 : 0)
        : Math.floor(depth[i] / 1000) % 2 ? 0xffb9b4ae : 0xffd8d5d1;
  } else if (mode === "rock") {
    const behaviour = run.codes[k].behaviour, rock = run.codes[k].rock;
    for (let i = 0; i < colours.length; ++i) {
      const index = rock[i] % 2 ? 2 : behaviour[i] === 3 ? 3 : rock[i] >= 2 ? 4 : Math.min(behaviour[i], 1);
      colours[i] = rocks[index].colour;
    }
  } else {
    const values = shownValues(run, k, mode), root = modes[mode].root;
    for (let i = 0; i < colours.length; ++i) {
      const share = Math.min(Math.max(values[i] / top, 0), 1);
      colours[i] = table[Math.round(255 * (root ? Math.sqrt(share) : share))];
    }
  }
  return colours;
}
