// Values for people, with units, digits and errors, in reports and on the drawing page. Each has its own timeUnit().

/** A declared unit as it is written: "m²". */
function unitWord(unit) {
  return {1: "", index: "", m2: "m²", deg: "°", diameters: "discs", a: timeUnit().name}[unit] ?? (unit || "");
}

/** A number with so many significant digits, without an exponent where that is short. */
function digits(value, count) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-3 || size >= 1e7) return value.toExponential(count > 2 ? 1 : 0).replace("e+", "e");
  const decimals = Math.max(count - 1 - Math.floor(Math.log10(size)), 0);
  return value.toFixed(Math.min(decimals, 6));
}

/** Lengths are known to a fraction of a disc: the power of ten below a fifth of its diameter, m. */
function lengthStep(radius) { return 10 ** Math.floor(Math.log10(0.4 * radius)); }

/** A length in metres with no more digits than are known. */
function roundedMetres(value, radius) {
  const step = lengthStep(radius);
  return (Math.round(value / step) * step).toFixed(Math.max(-Math.round(Math.log10(step)), 0));
}

/** A value and its unit, with the digits that it deserves: ["9.31", "km"]. */
function numberAndUnit(value, unit, radius) {
  if (value === undefined || value === null) return ["", ""];
  if (typeof value === "boolean") return [value ? "yes" : "no", ""];
  if (typeof value !== "number") return [String(value), ""];
  if (!Number.isFinite(value)) return ["", ""];
  const [scale, word] = scaleOf(value, unit);
  if (unit === "m") {
    const rounded = roundedMetres(value, radius);
    const decimals = Math.max(3 - Math.round(Math.log10(lengthStep(radius))), 0);
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
function valueText(value, unit, radius) { return withUnit(...numberAndUnit(value, unit, radius)); }

function withUnit(text, word) { return word === "°" ? text + word : `${text} ${word}`.trim(); }

const errorParts = [["resolution", "finer grain", -1], ["speed", "slower wall", -1], ["spread", "other seeds", 0]];

/** A value and what recorded runs tell of its error: ["0.83", "finer grain: +0.18"]. The error has two digits at most,
 * and the value no more than those. */
function valueAndError(value, unit, radius, known) {
  const text = valueText(value, unit, radius);
  const errors = errorParts.filter(([name]) => typeof known?.[name] === "number" && known[name] !== 0);
  if (typeof value !== "number" || errors.length === 0) return [text, ""];
  const [scale, word] = scaleOf(value, unit), [number] = numberAndUnit(value, unit, radius);
  const usual = (number.split(".")[1] || "").length;
  const largest = Math.max(...errors.map(([name]) => Math.abs(known[name]))) / scale;
  const decimals = Math.min(Math.max(1 - Math.floor(Math.log10(largest)), 0), usual), least = 0.5 * 10 ** -decimals;
  const words = errors.filter(([name]) => Math.abs(known[name]) / scale >= least).map(([name, what, sign]) => {
    const size = (Math.abs(known[name]) / scale).toFixed(decimals);
    return `${what}: ${sign === 0 ? "±" : sign * known[name] > 0 ? "+" : "−"}${size}`;
  });
  return words.length ? [withUnit((value / scale).toFixed(decimals), word), words.join("; ")] : [text, ""];
}

/** Where what is known of an error comes from. */
function errorSources(known) {
  return errorParts.filter(([name]) => typeof known?.[name] === "number")
    .map(([name, what]) => `${what}: ${known[`${name}_against`]} (${known[`${name}_record`]})`).join("; ");
}

/** Results by which runs are told apart, and the cutoff, of a summary. @param headline  names of the former */
function mainNumbers(summary, headline) {
  const numbers = {};
  for (const name of [...headline, "cutoff_x_m", "cutoff_z_m"]) {
    const list = name.startsWith("number of ") ? summary?.[name.slice(10)] : undefined;
    const value = Array.isArray(list) ? list.length : summary?.[name];
    if (typeof value === "number") numbers[name] = value;
  }
  return numbers;
}
