// Tables of the schema as forms: a field per parameter with its unit, range and meaning.

/** Keys that the section itself draws, or that are files of which a page knows nothing. */
const drawnElsewhere = {detachment: ["segments", "csv", "csv_delimiter", "svg", "svg_path", "svg_points", "shift_x_m", "tolerance_m"],
  observed: null, picked_fault: null};

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key in made && key !== "list") made[key] = value;
    else made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

const first = text => text.charAt(0).toUpperCase() + text.slice(1);

/** A number as a field shows it. */
function fieldText(value, schema) { return typeof value === "string" && schema.type === "string" ? value : tomlValue(value, schema); }

/** The value that a text in a field stands for: {value}, {missing} or {fault}. */
function valueOf(text, schema) {
  text = text.trim();
  if (text === "") return {missing: true};
  if (schema.type === "string") return {value: text};
  try {
    const {value, isFloat} = readTomlValue(schema.type === "array" && !text.startsWith("[") ? `[${text}]` : text.replace(/^\+?\./, "0."));
    return {value, floats: isFloat ? new Set([""]) : new Set()};
  } catch {
    const comma = /^[-+]?\d+,\d+$/.test(text) ? "; a decimal point instead of the comma?" : "";
    return {fault: `${text} is no ${schema.type === "array" ? "list of numbers, such as 5000, 10000" : schema.type || "value"}${comma}`};
  }
}

/** The objection to a text in the field of a parameter; empty: none. */
function objectionTo(schema, path, text) {
  const own = schemaAt(schema, path), {value, missing, fault, floats} = valueOf(text, own);
  if (missing) return "";
  if (fault) return fault;
  const check = new SchemaCheck(floats);
  check.check(own, value, "");
  return check.faults.length ? `${check.faults[0].path}${check.faults[0].path ? ": " : ""}${check.faults[0].message}` : "";
}

class Forms {
  /** @param change  takes path and value (undefined: the default), to be made and kept
   *  @param toggle  takes a table's name and whether it is there */
  constructor(host, schema, {change, toggle, defaultOf}) {
    Object.assign(this, {host, schema, change, toggle, defaultOf, fields: new Map(), tables: new Map(), bad: new Map()});
    const isTable = own => own.type === "object" || own.items?.properties; // [[name]] is edited as text
    const top = Object.keys(schema.properties).filter(key => !isTable(schema.properties[key]));
    this.addTable("", "Scene", "name, accuracy and seed", top, true);
    for (const [name, table] of Object.entries(schema.properties)) {
      if (table.type !== "object" || drawnElsewhere[name] === null) continue;
      const keys = Object.keys(table.properties || {}).filter(key => !drawnElsewhere[name]?.includes(key));
      this.addTable(name, name, table.description.replace(/^effect: /, ""), keys, !table.description.startsWith("effect: "));
    }
  }

  addTable(name, title, doc, keys, isPart) {
    const details = element("details", {open: ["", "hanging_wall", "extension"].includes(name)});
    const table = element("div", {className: "table"}), summary = element("summary", {}, element("b", {}, title), ` ${doc}`);
    if (!isPart) {
      const box = element("input", {type: "checkbox", id: `on_${name}`, className: "switch"});
      box.setAttribute("aria-label", `${title} is on`);
      box.onchange = () => this.toggle(name, box.checked);
      table.append(box);
    }
    details.append(summary);
    table.append(details);
    this.tables.set(name, table);
    for (const key of keys) details.append(this.fieldOf(name ? `${name}.${key}` : key));
    this.host.append(table);
  }

  fieldOf(path) {
    const own = schemaAt(this.schema, path), facts = own["x-listric"] || {}, key = path.split(".").at(-1), id = `at_${path}`;
    const input = this.inputOf(own, id);
    const label = element("label", {htmlFor: id}, first(facts.doc || key));
    const notes = [facts.allowed, facts.usual && `usual ${facts.usual.map(shortNumber).join(" to ")}`].filter(Boolean).join("; ");
    const doc = element("p", {className: "doc"}, element("code", {}, key), notes ? `: ${notes}. ` : ". ", facts.changes || "");
    const fault = element("p", {className: "fault", id: `${id}_fault`, role: "alert"});
    input.setAttribute("aria-describedby", fault.id);
    const field = element("div", {className: `field ${this.isBroad(own, input) ? "broad" : ""}`}, label, input,
      element("span", {className: "unit"}, facts.unit || ""), doc, fault);
    input.onchange = () => this.take(path);
    input.oninput = () => this.judge(path);
    this.fields.set(path, {field, input, fault, own, text: `${path} ${facts.doc} ${facts.symbol || ""}`.toLowerCase()});
    return field;
  }

  isBroad(own, input) { return input.tagName === "TEXTAREA" || own.type === "string" && !own.enum && !own.anyOf; }

  inputOf(own, id) {
    const choices = own.type === "boolean" ? ["true", "false"] : own.anyOf ? null : own.enum;
    if (choices) {
      const select = element("select", {id}, element("option", {value: ""}));
      select.append(...choices.map(name => element("option", {value: name}, name)));
      return select;
    }
    if (own.type === "array" && own.items?.type !== "number") return element("textarea", {id, rows: 2, spellcheck: false});
    const input = element("input", {id, type: "text", autocomplete: "off", spellcheck: false});
    if (own.type === "number" || own.type === "integer") input.inputMode = "decimal";
    const names = own.anyOf?.flatMap(rule => rule.enum || []) || [];
    if (names.length) {
      input.setAttribute("list", `${id}_names`);
      this.host.append(element("datalist", {id: `${id}_names`}, ...names.map(value => element("option", {value}))));
    }
    return input;
  }

  /** Keeps the objection to what is typed, and shows it. */
  judge(path) {
    const {input, fault} = this.fields.get(path), why = objectionTo(this.schema, path, input.value);
    if (why) this.bad.set(path, why);
    else this.bad.delete(path);
    fault.textContent = why;
    input.setAttribute("aria-invalid", Boolean(why));
    return why;
  }

  take(path) {
    const {input, own} = this.fields.get(path), why = this.judge(path);
    this.change(path, why ? undefined : valueOf(input.value, own).value, why);
  }

  /** Whether the section decides a value: a wall is as thick as the detachment is deep. */
  isDrawn(path, scene) { return path === "hanging_wall.thickness_m" && Array.isArray(scene.detachment?.segments); }

  /** Shows a scene and what is wrong with it; a text that is refused stays. */
  show(scene, faults) {
    for (const [name, table] of this.tables) {
      const isOn = name === "" || name in scene, box = table.querySelector(".switch");
      table.classList.toggle("off", !isOn);
      table.classList.toggle("bad", name !== "" && faults.some(({path}) => path === name || path.startsWith(`${name}.`)));
      if (box) box.checked = isOn;
    }
    for (const [path, one] of this.fields) {
      if (this.bad.has(path)) continue;
      const keys = path.split("."), value = keys.length === 1 ? scene[path] : scene[keys[0]]?.[keys[1]], {input, own} = one;
      const text = value === undefined ? "" : typeof value === "boolean" ? String(value) : fieldText(value, own);
      if (input.value !== text) input.value = text;
      input.readOnly = this.isDrawn(path, scene);
      const usual = this.defaultOf(path), word = usual === undefined ? (own["x-listric"]?.default ?? "").replace(/^""$/, "") : fieldText(usual, own);
      if (input.tagName === "SELECT") input.options[0].textContent = `${word} (default)`;
      else input.placeholder = word;
      one.field.classList.toggle("given", value !== undefined);
      const whole = faults.find(fault => fault.path === path);
      one.fault.textContent = whole ? whole.message : "";
      input.setAttribute("aria-invalid", Boolean(whole));
    }
  }

  /** Shows fields whose texts hold all words; returns how many. */
  filter(words) {
    let count = 0;
    for (const [name, table] of this.tables) {
      let here = 0;
      for (const [path, {field, text}] of this.fields) {
        if ((path.includes(".") ? path.split(".")[0] : "") !== name) continue;
        const fits = words.every(word => text.includes(word));
        field.hidden = !fits;
        field.style.display = fits ? "" : "none";
        here += fits;
      }
      table.style.display = here ? "" : "none";
      if (words.length && here) table.querySelector("details").open = true;
      count += here;
    }
    return count;
  }
}
