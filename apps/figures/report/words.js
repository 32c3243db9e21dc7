// Names, units and digits for people.

/** A measure's label as the program declares it: "cutoff_x_m" as "Cutoff, x", a part of one as "Time: genesis". */
function wordsOf(name) {
  const [own, part] = name.replace("number of ", "").split("."), label = page.data.measures[own]?.[2] || own.replaceAll("_", " ");
  const text = part ? `${label}: ${part.replaceAll("_", " ")}` : label;
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** A declared unit as it is written: "m²". */
function unitWord(unit) { return {1: "", index: "", m2: "m²", deg: "°", diameters: "discs", a: timeUnit().name}[unit] ?? (unit || ""); }

/** A description without the source in brackets behind it. */
function titleWords(text) { return text.replace(/ \[[^\]]*\]$/, ""); }

/** A number with so many significant digits, without an exponent where that is short. */
function digits(value, count) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-3 || size >= 1e7) return value.toExponential(count > 2 ? 1 : 0).replace("e+", "e");
  const decimals = Math.max(count - 1 - Math.floor(Math.log10(size)), 0);
  return value.toFixed(Math.min(decimals, 6));
}

/** Unit in which the page tells places and ways, by its longest model. */
function lengthUnit() {
  const longest = Math.max(...page.runs.map(run => run.head.length_m));
  return longest >= 1000 ? {name: "km", metres: 1000} : longest >= 1 ? {name: "m", metres: 1} : {name: "mm", metres: 0.001};
}

/** "5.00 km" */
function placeText(metres, decimals = 2) {
  return `${(metres / lengthUnit().metres).toFixed(decimals).replace(/^-(?=[0.]*$)/, "")} ${lengthUnit().name}`;
}

/** Unit in which the page tells time, by its longest run. */
function timeUnit() {
  const longest = Math.max(...page.runs.map(run => Math.max(run.head.extension_m, travelOf(run.moments.at(-1))) / run.head.rate_m_per_a));
  return longest >= 1e4 ? {name: "Myr", years: 1e6} : {name: "a", years: 1};
}

/** How long the wall of a run has been on a way, in the page's unit. */
function timeOf(run, travel) { return travel / run.head.rate_m_per_a / timeUnit().years; }

/** Decimals of lengths in metres: none for discs of 10 m and more, as in the program's tables. */
function metreDecimals() {
  return Math.max(...page.runs.map(run => Math.ceil(Math.log10(10 / run.head.mean_radius_m))), 0);
}

/** "12,345 m", of small models "0.0123 m" */
function metresText(metres) {
  return `${new Intl.NumberFormat("en", {maximumFractionDigits: metreDecimals()}).format(metres)} m`;
}

/** Lengths are known to a fraction of a disc: the power of ten below a fifth of its diameter, m. */
function lengthStep(radius) { return 10 ** Math.floor(Math.log10(0.4 * radius)); }

/** A length in metres with no more digits than are known. */
function roundedMetres(value, radius) {
  const step = lengthStep(radius);
  return (Math.round(value / step) * step).toFixed(Math.max(-Math.round(Math.log10(step)), 0));
}

/** A value and its unit, with the digits that it deserves: ["9.31", "km"]. */
function valueOf(value, unit, radius) {
  if (value === undefined || value === null) return ["", ""];
  if (typeof value === "boolean") return [value ? "yes" : "no", ""];
  if (typeof value !== "number") return [String(value), ""];
  if (!Number.isFinite(value)) return ["", ""];
  const [scale, word] = scaleOf(value, unit);
  if (unit === "m") {
    const rounded = roundedMetres(value, radius), decimals = Math.max(3 - Math.round(Math.log10(lengthStep(radius))), 0);
    return word === "km" ? [(rounded / 1000).toFixed(decimals), word] : [rounded, word];
  }
  if (unit === "deg" || unit === "diameters") return [value.toFixed(1), word];
  if (unit === "mm/a") return [digits(value, 2), word];
  return [scale === 1 && Number.isInteger(value) ? String(value) : digits(value / scale, 3), word];
}

/** What a value of a unit is told in: how many of the unit that is, and its word. */
function scaleOf(value, unit) {
  const size = Math.abs(value);
  if (unit === "m" && size >= 1000) return [1000, "km"];
  if (unit === "m2" && size >= 1e5) return [1e6, "km²"];
  if (unit === "Pa" && size >= 1e4) return [1e6, "MPa"];
  return [unit === "a" ? timeUnit().years : 1, unitWord(unit)];
}

/** Value and unit as one text: "9.31 km", "38.1°". */
function valueText(value, unit, radius) { return withUnit(...valueOf(value, unit, radius)); }

function withUnit(text, word) { return word === "°" ? text + word : `${text} ${word}`.trim(); }

const errorParts = [["resolution", "finer grain", -1], ["speed", "slower wall", -1], ["spread", "other seeds", 0]];

/** A value and what recorded runs tell of its error: ["0.83", "finer grain: +0.18"]. The error has two digits at most,
 * and the value no more than those. */
function valueAndError(value, unit, radius, known) {
  const text = valueText(value, unit, radius), errors = errorParts.filter(([name]) => typeof known?.[name] === "number" && known[name] !== 0);
  if (typeof value !== "number" || errors.length === 0) return [text, ""];
  const [scale, word] = scaleOf(value, unit), usual = (valueOf(value, unit, radius)[0].split(".")[1] || "").length;
  const largest = Math.max(...errors.map(([name]) => Math.abs(known[name]))) / scale;
  const decimals = Math.min(Math.max(1 - Math.floor(Math.log10(largest)), 0), usual), least = 0.5 * 10 ** -decimals;
  const words = errors.filter(([name]) => Math.abs(known[name]) / scale >= least).map(([name, what, sign]) => {
    const size = (Math.abs(known[name]) / scale).toFixed(decimals);
    return `${what}: ${sign === 0 ? "±" : sign * known[name] > 0 ? "+" : "−"}${size}`;
  });
  return words.length ? [withUnit((value / scale).toFixed(decimals), word), words.join("; ")] : [text, ""];
}

/** "detachment.friction" as "friction". */
function keyWords(path) {
  return path.replace(/^.*\./, "").replace(/_(m2|m|deg|pa|s|a|m_per_s|m_per_a)$/, "").replaceAll("_", " ");
}

/** Letter and what is particular of one of two runs: "A: lis1, friction 0.1". */
function labelOf(run) {
  const r = page.runs.indexOf(run), {scene, seed} = run.head, differences = page.data.differences || [];
  if (page.runs.length < 2) return scene;
  const few = differences.length > 0 && differences.length <= 3;
  const own = few ? differences.map(([path, a, b, unit]) => `${keyWords(path)} ${[a, b][r]}${unit && unit !== "1" ? ` ${unit}` : ""}`)
    : [`seed ${seed}`];
  return `${"AB"[r]}: ${[scene, ...own].join(", ")}`;
}

/** Parameters that differ, in a few words. */
function differenceWords() {
  const differences = page.data.differences || [];
  if (page.runs.length < 2) return "";
  if (differences.length === 0) return "equal scenes";
  const shown = differences.slice(0, 3)
    .map(([path, a, b, unit]) => `${keyWords(path)} ${a} and ${b}${unit && unit !== "1" ? ` ${unit}` : ""}`);
  return shown.join(", ") + (differences.length > 3 ? ` and ${differences.length - 3} more` : "");
}
