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

/** "stage" of stage.1.distance_m, "" of seed. */
const tableNameOf = path => path.includes(".") ? path.split(".")[0] : "";

/** A value as a field shows it. */
function fieldText(value) { return typeof value === "string" ? value : plainText(value); }

class Forms {
  /** @param change  takes path and value (undefined: the default), to be made and kept
   *  @param toggle  takes a table's name and whether it is there */
  constructor(host, {change, toggle}) {
    Object.assign(this, {host, change, toggle, fields: new Map(), tables: new Map(), lists: new Map(), bad: new Map()});
    const isTable = own => own.type === "object" || own.items?.properties;
    const top = Object.keys(schema.properties).filter(key => !isTable(schema.properties[key]));
    this.addTable("", "Scene", "name, accuracy and seed", top, true);
    for (const [name, table] of Object.entries(schema.properties)) {
      if (!isTable(table) || drawnElsewhere[name] === null) continue;
      if (table.items) {
        this.addList(name, table.items);
        continue;
      }
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
    return details;
  }

  /** [[name]], of which a scene has as many as it likes. */
  addList(name, {description, properties}) {
    const title = name.replace("_", " "), add = element("button", {}, `Add ${/^[aeiou]/.test(title) ? "an" : "a"} ${title}`);
    const details = this.addTable(name, name, description.replace(/^effect: /, ""), [], true), host = element("div");
    const list = {title, host, add, keys: Object.keys(properties), items: []};
    this.lists.set(name, list);
    details.append(host, add);
    add.onclick = () => {
      this.changeList(name, all => all.push({}));
      list.items.at(-1).details.open = true;
      list.items.at(-1).details.querySelector("input").focus();
    };
  }

  itemOf(name, index) {
    const {title, keys, add, items} = this.lists.get(name), path = `${name}.${index}`, gist = element("span");
    const fault = element("p", {className: "fault", role: "alert"}), controls = element("div", {className: "controls"});
    const button = (word, make) => {
      const made = element("button", {onclick: () => make(made)}, word);
      made.setAttribute("aria-label", `${word} ${title} ${index + 1}`);
      controls.append(made);
      return made;
    };
    const move = by => () => {
      this.changeList(name, all => all.splice(index + by, 0, ...all.splice(index, 1)));
      const [here, there] = [items[index], items[index + by]], next = by < 0 ? there.up : there.down;
      [here.details.open, there.details.open] = [there.details.open, here.details.open];
      (next.disabled ? there.details.firstChild : next).focus();
    };
    const [up, down] = name === "stage" ? [button("Up", move(-1)), button("Down", move(1))] : []; // the order of others means nothing
    button("Remove", () => {
      this.changeList(name, all => all.splice(index, 1));
      add.focus();
    });
    const details = element("details", {className: "item"}, element("summary", {}, element("b", {}, `${first(title)} ${index + 1}`), " ", gist),
      fault, controls, ...keys.map(key => this.fieldOf(`${path}.${key}`)));
    return {path, details, gist, fault, up, down};
  }

  /** Makes a list anew; texts that were refused in it are dropped, since they belong to places in it. */
  changeList(name, make) {
    const all = [page.state.scene[name] ?? []].flat();
    make(all);
    for (const path of this.bad.keys()) if (tableNameOf(path) === name) this.bad.delete(path);
    this.change(name, all.length ? all : undefined);
  }

  showLists(scene, faults) {
    for (const [name, {host, items}] of this.lists) {
      const all = [scene[name] ?? []].flat();
      while (items.length > all.length) {
        const {path, details} = items.pop();
        for (const own of this.fields.keys()) if (own.startsWith(`${path}.`)) for (const kept of [this.fields, this.bad]) kept.delete(own);
        details.remove();
      }
      while (items.length < all.length) {
        items.push(this.itemOf(name, items.length));
        host.append(items.at(-1).details);
      }
      items.forEach(({path, details, gist, fault, up, down}, k) => {
        gist.textContent = Object.entries(all[k]).map(([key, value]) => `${key} = ${plainText(value)}`).join(", ");
        fault.textContent = faults.find(one => one.path === path)?.message ?? "";
        details.classList.toggle("bad", faults.some(one => one.path === path || one.path.startsWith(`${path}.`)));
        if (up) [up.disabled, down.disabled] = [k === 0, k === all.length - 1];
      });
    }
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
    this.fields.set(path, {field, input, fault, own, text: this.searchedOf(path)});
    return field;
  }

  searchedOf(path) {
    const facts = schemaAt(path)["x-listric"] || {};
    return `${path} ${facts.doc} ${facts.symbol || ""}`.toLowerCase();
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
      table.classList.toggle("bad", name !== "" && faults.some(({path}) => path.split(".")[0] === name));
      if (box) box.checked = isOn;
    }
    this.showLists(scene, faults);
    for (const [path, one] of this.fields) {
      if (this.bad.has(path)) continue;
      const value = valueIn(scene, path), {input, own} = one;
      const text = value === undefined ? "" : fieldText(value);
      const isChoice = input.tagName === "SELECT";
      if (isChoice && ![...input.options].some(option => option.value === text)) input.append(element("option", {value: text}, text)); // of an older scene
      if (input.value !== text) input.value = text;
      input.readOnly = this.isDrawn(path, scene);
      const usual = isChoice || this.lists.has(tableNameOf(path)) ? own.default : defaultOf(path);
      const word = usual === undefined ? (own["x-listric"]?.default ?? "").replace(/^""$/, "") : fieldText(usual);
      if (isChoice) input.options[0].textContent = word === "(none)" ? word : `${word} (default)`;
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
        if (tableNameOf(path) !== name) continue;
        const fits = words.every(word => text.includes(word));
        field.hidden = !fits;
        field.style.display = fits ? "" : "none";
        here += fits;
      }
      const {items = [], keys = []} = this.lists.get(name) || {}; // an empty list has what its items would have
      if (!items.length) here += keys.filter(key => words.every(word => this.searchedOf(`${name}.0.${key}`).includes(word))).length;
      table.style.display = here ? "" : "none";
      if (words.length && here) for (const details of table.querySelectorAll("details")) details.open = true;
      count += here;
    }
    return count;
  }
}
