// How many discs a scene has and how long it takes, as apps/run/forecast/prediction.cpp has it. Prices and speeds are the
// program's own numbers, which it wrote into the page.

/** A parameter in force: the scene's, that of its accuracy, or the default. */
function valueAt(facts, schema, document, path) {
  const [table, key] = path.split("."), given = document[table]?.[key];
  if (given !== undefined) return typeof given === "bigint" ? Number(given) : given;
  return defaultAt(facts, schema, document, path);
}

function defaultAt(facts, schema, document, path) {
  const [table, key] = path.split("."), name = document.accuracy ?? "standard";
  const level = facts.levels.find(one => one.name === name) || facts.levels[1];
  if (path === "extension.distance_m" && document.stage?.length)
    return stagesOf(facts, schema, document).reduce((sum, {travel}) => sum + travel, 0);
  if (path in level.defaults) return level.defaults[path];
  const scaled = facts.effects[table]?.levels?.[level.name]?.[key];
  if (scaled !== undefined) return scaled;
  const source = table === "material" ? facts.basement : facts.effects[table]?.rock;
  const rock = source && facts.rocks[document.materials?.[source] ?? schema.properties.materials.properties[source].default];
  const own = schemaAt(schema, path);
  const follows = own?.["x-listric"]?.usual_rate_m_per_a !== undefined;
  return rock?.[key] ?? (follows ? atRate(own, valueAt(facts, schema, document, "extension.rate_m_per_a")) : own?.default);
}

/** A parameter's default at a geological rate, m/a: one that stands for metres of travel follows it, as at_rate() in
 * apps/scene/parameters/parameter.cpp has it. */
function atRate(own, rate) {
  const usual = own["x-listric"].usual_rate_m_per_a;
  if (!(rate > 0) || rate === usual) return own.default;
  const rounded = x => Number(x.toPrecision(12));
  if (own["x-listric"].unit !== "a") return rounded(own.default * (rate / usual));
  const metres = own.default * usual, years = metres / rate;
  return rounded(rounded(years) * rate) === rounded(metres) ? rounded(years) : years;
}

/** The stages of a scene, as apps/scene/scene.cpp makes them: way of the wall, m, below 0 shortening; travel, m, the clock, which runs
 * in pauses, too; its speed in the model, m/s. */
function stagesOf(facts, schema, document) {
  if (!Array.isArray(document.stage)) return [];
  const [rate, speed] = ["extension.rate_m_per_a", "extension.speed_m_per_s"].map(key => valueAt(facts, schema, document, key));
  return document.stage.map(stage => {
    const way = Number(stage.distance_m ?? 0), ratio = Number(stage.rate_m_per_a ?? rate) / rate, pause = Number(stage.pause_a ?? 0);
    return {way, travel: pause ? pause * rate : Math.abs(way) / ratio, speed: Number(stage.speed_m_per_s ?? speed) / (way ? ratio : 1)};
  });
}

/** Greatest displacement of the moving wall, m. */
function greatestExtension(facts, schema, document) {
  const stages = stagesOf(facts, schema, document);
  let position = 0;
  return stages.length ? Math.max(0, ...stages.map(({way}) => position += way)) : valueAt(facts, schema, document, "extension.distance_m");
}

/** Time of the model for all its travel, s, as dem/motion.cpp has it. */
function modelTime(facts, schema, document) {
  const change = 20; // m beside a change of stages, where the wall is slower
  const of = key => valueAt(facts, schema, document, key), stages = stagesOf(facts, schema, document), ramp = 0.5 * of("extension.ramp_s");
  if (!stages.length) return of("extension.distance_m") / of("extension.speed_m_per_s") + ramp;
  const lost = travel => travel < change ? 2 * Math.sqrt(travel * change) - travel : change; // m behind one at full speed
  return stages.reduce((time, {travel, speed}, k) => time + (travel + (k > 0 ? lost(travel) : 0) + (k + 1 < stages.length ? change : 0)) / speed,
    Math.min(ramp, of("extension.distance_m") / stages[0].speed));
}

/** The chain on which a scene slides, as far as its model needs it; null: the scene has none. */
function baseOf(facts, schema, document) {
  const [length, thickness] = ["hanging_wall.length_m", "hanging_wall.thickness_m"].map(key => valueAt(facts, schema, document, key));
  const reach = length + 1.5 * greatestExtension(facts, schema, document) + thickness, shape = shapeOf(document.detachment);
  if (document.stretching) return [lineSegment({x: 0, y: -thickness}, {x: reach, y: -thickness})];
  return shape && shape.pieces.length ? chainOf(shape, reach) : null;
}

function meanSquareRadius(mean, ratio) {
  const smallest = 2 * mean / (1 + ratio), largest = ratio * smallest;
  return (largest * largest + largest * smallest + smallest * smallest) / 3;
}

/** Terms of an effect's price with the scene's parameters. */
function termsOf(facts, schema, document, name) {
  const effect = facts.effects[name];
  let terms = effect.terms;
  for (const {key, is_switch: isSwitch, terms: own} of effect.parameters || []) {
    const value = valueAt(facts, schema, document, `${name}.${key}`), usual = schemaAt(schema, `${name}.${key}`).default;
    if (value === usual) continue;
    if (isSwitch) terms = own;
    else terms = Object.fromEntries(Object.entries(terms).map(([term, price]) => [term, price + own[term] * (usual / value - 1)]));
  }
  return terms;
}

function stableTimeStep(facts, schema, document) {
  const of = key => valueAt(facts, schema, document, key);
  const radius = of("hanging_wall.mean_radius_m"), smallest = 2 / (1 + of("hanging_wall.radius_ratio"));
  const rock = of("hanging_wall.rock_density_kg_per_m3"), mass = rock / (1 - 0.166) * Math.PI * radius * radius;
  const rocks = ["material", ...Object.keys(facts.effects).filter(name => name in document)]
    .filter(table => schemaAt(schema, `${table}.normal_stiffness_pa`));
  const sediments = rocks.filter(table => schemaAt(schema, `${table}.grain_density_kg_per_m3`))
    .map(table => of(`${table}.grain_density_kg_per_m3`) * (1 - of(`${table}.surface_porosity`)));
  const floor = of("cycle.inertial_mass_floor"), lightest = Math.min(rock, ...sediments) / rock * smallest * smallest;
  const inertia = (floor > 0 ? floor : lightest) * mass;
  // Weakened rock keeps its stiffness, but is never the stiffest.
  return Math.sqrt(of("cycle.softness")) * Math.min(...rocks.map(table => {
    const normal = 0.5 * of(`${table}.normal_stiffness_pa`), shear = 0.5 * of(`${table}.shear_stiffness_pa`);
    const stiffness = Math.max(3 * (normal + shear), 12 * shear);
    return of("cycle.time_step_safety") * Math.sqrt(2 * inertia / (stiffness * (1 + of("cycle.damping"))));
  }));
}

/** Discs, cycles and time of a scene on the machine that wrote the page; null without a base. */
function predictCost(facts, schema, document) {
  const of = key => valueAt(facts, schema, document, key), chain = baseOf(facts, schema, document), p = facts.prices;
  if (!chain) return null;
  const radius = of("hanging_wall.mean_radius_m"), thickness = of("hanging_wall.thickness_m"), distance = of("extension.distance_m");
  const discsIn = area => Math.floor((1 - of("hanging_wall.porosity")) * area /
    (Math.PI * meanSquareRadius(radius, of("hanging_wall.radius_ratio"))));
  const effects = Object.keys(facts.effects).filter(name => name in document);
  const start = discsIn(hangingWallArea(of("hanging_wall.length_m"), chain));
  const newArea = effects.reduce((sum, name) => sum + facts.effects[name].new_area, 0) * greatestExtension(facts, schema, document) * thickness;
  const end = start + (newArea > 0 ? discsIn(newArea) : 0), discs = 0.5 * (start + end);
  const timeStep = stableTimeStep(facts, schema, document);
  const cycles = Math.floor(modelTime(facts, schema, document) / timeStep);
  const areaRatio = of("hanging_wall.radius_ratio") ** 2;
  const years = distance / of("extension.rate_m_per_a"), steps = discs * cycles, interval = of("output.interval_m");
  const marks = document.output?.figures_at_m ?? [5000, 10000], movesBase = effects.some(name => facts.effects[name].moves_base);
  const figures = marks.filter(at => at < distance - 0.5 * interval).length * p.early_figure_disc * discs + p.figures +
    p.figures_disc * discs + (movesBase ? p.figures_of_moving_base : 0);
  const ofEffects = effects.reduce((sum, name) => {
    const terms = termsOf(facts, schema, document, name);
    return sum + terms.fixed + terms.per_start_disc * start + terms.per_cycle * cycles + years *
      (terms.per_year + terms.per_disc_year * discs + terms.per_area_ratio_year * areaRatio);
  }, 0);
  let shared = p.cycle * steps + start * (p.genesis + p.genesis_crossing * thickness / radius) +
    distance / p.sample_spacing * p.sample_disc * discs;
  let serial = distance / interval * (p.window + p.window_disc * discs) + ofEffects + figures;
  if (start < p.lists_shared_from) serial += p.list_alone * steps;
  else shared += (start < p.lists_far_from ? p.list_shared : p.list_far) * steps;
  const speed = speedAt(facts.speeds, start, effects.some(name => facts.effects[name].accounts_energy));
  return {discs: start, discsAtEnd: end, timeStep, cycles, work: shared + serial,
    seconds: shared / speed.team + serial / speed.one_thread};
}

/** Speed of a packing, between those that were measured. */
function speedAt(speeds, discs, accounted) {
  if (accounted) return speeds.accounted;
  const sizes = speeds.by_size, k = clamp(sizes.findIndex(one => one.discs >= discs), 1, sizes.length - 1);
  const at = discs >= sizes.at(-1).discs ? sizes.length - 1 : k, [a, b] = [sizes[at - 1], sizes[at]];
  const share = clamp(Math.log(discs / a.discs) / Math.log(b.discs / a.discs), 0, 1);
  return {team: a.team + share * (b.team - a.team), one_thread: a.one_thread + share * (b.one_thread - a.one_thread)};
}

/** Faults of a scene that no schema knows, as apps/scene/scene_checks.cpp finds them: [{path, message}]. */
function faultsOfWhole(facts, schema, document) {
  const of = key => valueAt(facts, schema, document, key), faults = [], shape = shapeOf(document.detachment);
  if (!document.hanging_wall) return faults;
  const distance = of("extension.distance_m"), travel = defaultAt(facts, schema, document, "extension.distance_m");
  if (stagesOf(facts, schema, document).length && Math.abs(distance - travel) > 1e-9 * travel)
    faults.push({path: "extension.distance_m", message: `is ${distance} beside [[stage]], whose ways it follows from (${travel}); leave it out`});
  if (shape) {
    const why = objectionToShape(shape), depth = shape.pieces.length ? depthOf(shape) : 0, thickness = of("hanging_wall.thickness_m");
    if (why) return [{path: "detachment.segments", message: why}];
    if (Math.abs(depth - thickness) > 1)
      faults.push({path: "hanging_wall.thickness_m", message: `the detachment soles out at ${depth.toFixed(1)} m, allowed: that depth within 1 m`});
  }
  const chain = baseOf(facts, schema, document);
  if (!chain) return faults;
  const area = hangingWallArea(of("hanging_wall.length_m"), chain);
  if (!(area > 0)) return [...faults, {path: "detachment.segments", message: "stays at the surface up to the moving wall, needs to descend before hanging_wall.length_m"}];
  const discs = (1 - of("hanging_wall.porosity")) * area / (Math.PI * meanSquareRadius(of("hanging_wall.mean_radius_m"), of("hanging_wall.radius_ratio")));
  if (!(discs >= 100 && discs <= 5e6))
    faults.push({path: "hanging_wall.mean_radius_m", message: `gives ${discs.toFixed(0)} discs, allowed: 100 to 5e6; take ${discs < 100 ? "smaller" : "larger"} discs`});
  return faults;
}
