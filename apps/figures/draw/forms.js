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

const shortNumber = x => Math.abs(x) >= 1e6 || x !== 0 && Math.abs(x) < 1e-4 ? x.toExponential().replace("e+", "e") : String(x);

const first = text => text.charAt(0).toUpperCase() + text.slice(1);

/** A value as a field shows it. */
function fieldText(value) { return typeof value === "string" ? value : plainText(value); }

class Forms {
  /** @param change  takes path and value (undefined: the default), to be made and kept
   *  @param toggle  takes a table's name and whether it is there */
  constructor(host, {change, toggle}) {
    Object.assign(this, {host, change, toggle, fields: new Map(), tables: new Map(), bad: new Map()});
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
    const own = schemaAt(path), facts = own["x-listric"] || {}, key = path.split(".").at(-1), id = `at_${path}`;
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

  /** What a text stands for; keeps the objection to it, and shows it. */
  judge(path) {
    const {input, fault} = this.fields.get(path), typed = valueOf(path, input.value), why = typed.fault ?? "";
    if (why) this.bad.set(path, why);
    else this.bad.delete(path);
    fault.textContent = why;
    input.setAttribute("aria-invalid", Boolean(why));
    return typed;
  }

  take(path) {
    const {value, fault} = this.judge(path);
    this.change(path, value, fault);
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
      const value = valueIn(scene, path), {input, own} = one;
      const text = value === undefined ? "" : fieldText(value);
      if (input.value !== text) input.value = text;
      input.readOnly = this.isDrawn(path, scene);
      const isChoice = input.tagName === "SELECT", usual = isChoice ? own.default : defaultOf(path);
      const word = usual === undefined ? (own["x-listric"]?.default ?? "").replace(/^""$/, "") : fieldText(usual);
      if (isChoice) input.options[0].textContent = `${word} (default)`;
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
