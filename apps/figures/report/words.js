// Names, units and digits for people.

/** A measure's label as the program declares it: "cutoff_x_m" as "Cutoff, x", a part of one as "Time: genesis". */
function wordsOf(name) {
  const [own, part] = name.replace("number of ", "").split("."), label = page.data.measures[own]?.[2] || own.replaceAll("_", " ");
  const text = part ? `${label}: ${part.replaceAll("_", " ")}` : label;
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** A description without the source in brackets behind it. */
function titleWords(text) { return text.replace(/ \[[^\]]*\]$/, ""); }

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
  const longest = Math.max(...page.runs.map(run => yearsOf(run, Math.max(run.head.extension_m, travelOf(run.moments.at(-1))))));
  return longest >= 1e4 ? {name: "Myr", years: 1e6} : {name: "a", years: 1};
}

/** Age of a run at a travel: straight between the corners that its head has, and beyond. */
function yearsOf(run, travel) {
  const ages = run.head.ages, end = Math.max(1, ages.findIndex(([at]) => at >= travel));
  const [[x0, y0], [x1, y1]] = ages.at(-1)[0] < travel ? ages.slice(-2) : ages.slice(end - 1);
  return y0 + (y1 - y0) * (travel - x0) / (x1 - x0);
}

/** How long the wall of a run has been on a way, in the page's unit. */
function timeOf(run, travel) { return yearsOf(run, travel) / timeUnit().years; }

/** Decimals of lengths in metres: none for discs of 10 m and more, as in the program's tables. */
function metreDecimals() {
  return Math.max(...page.runs.map(run => Math.ceil(Math.log10(10 / run.head.mean_radius_m))), 0);
}

/** "12,345 m", of small models "0.0123 m" */
function metresText(metres) {
  return `${new Intl.NumberFormat("en", {maximumFractionDigits: metreDecimals()}).format(metres)} m`;
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
