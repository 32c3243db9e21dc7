"use strict";
// TOML 1.0 (https://toml.io/en/v1.0.0), read with the lines of its keys and written as scenes have it.

class TomlError extends Error {
  constructor(line, message) {
    super(message);
    this.line = line;
  }
}

/** Without a prototype: `__proto__` is a key like any other. */
const newTable = () => Object.create(null);

/** An integer that a number of JavaScript cannot hold stays exact. */
function integerOf(digits, base) {
  const sign = digits.startsWith("-") ? -1n : 1n, bare = digits.replace(/^[+-]/, "").replace(/_/g, "");
  const big = sign * BigInt(base === 10 ? bare : {16: "0x", 8: "0o", 2: "0b"}[base] + bare);
  return big >= BigInt(Number.MIN_SAFE_INTEGER) && big <= BigInt(Number.MAX_SAFE_INTEGER) ? Number(big) : big;
}

const tomlNumbers = [
  [/^0x[0-9A-Fa-f](_?[0-9A-Fa-f])*$/, word => integerOf(word.slice(2), 16)],
  [/^0o[0-7](_?[0-7])*$/, word => integerOf(word.slice(2), 8)],
  [/^0b[01](_?[01])*$/, word => integerOf(word.slice(2), 2)],
  [/^[+-]?(0|[1-9](_?\d)*)$/, word => integerOf(word, 10)],
];
const tomlFloat = /^[+-]?(0|[1-9](_?\d)*)(\.\d(_?\d)*)?([eE][+-]?\d(_?\d)*)?$/;
const tomlDate = /^(\d{4}-\d\d-\d\d([Tt ]\d\d:\d\d:\d\d(\.\d+)?([Zz]|[+-]\d\d:\d\d)?)?|\d\d:\d\d:\d\d(\.\d+)?)$/;

class TomlReader {
  constructor(text) {
    this.text = text.replace(/^\ufeff/, "").replace(/\r\n/g, "\n");
    this.at = 0;
    this.lines = new Map();    // of keys, by path
    this.floats = new Set();   // paths of numbers that are written as such
    this.closed = new Set();   // tables that no header may open again, and arrays and inline tables
    this.dotted = new Set();
    const control = /[\x00-\x08\x0b-\x1f\x7f]/.exec(this.text);
    if (control) {
      this.at = control.index;
      this.fail(`has the control character U+${control[0].charCodeAt(0).toString(16).toUpperCase().padStart(4, "0")}; TOML has it as an escape alone`);
    }
  }

  get line() { return this.text.slice(0, this.at).split("\n").length; }
  fail(message) { throw new TomlError(this.line, message); }
  peek(word) { return this.text.startsWith(word, this.at); }

  take(pattern) {
    pattern.lastIndex = this.at;
    const found = pattern.exec(this.text);
    if (found) this.at += found[0].length;
    return found;
  }

  blanks() { this.take(/[ \t]*/y); }
  gaps() { this.take(/([ \t\n]|#[^\n]*)*/y); }

  endOfLine() {
    this.blanks();
    this.take(/#[^\n]*/y);
    if (this.at < this.text.length && !this.take(/\n/y)) this.fail("a line goes on after its value");
  }

  key() {
    const keys = [];
    do {
      this.blanks();
      if (this.peek('"')) keys.push(this.basicString());
      else if (this.peek("'")) keys.push(this.literalString());
      else keys.push((this.take(/[A-Za-z0-9_-]+/y) || this.fail("a key is missing"))[0]);
      this.blanks();
    } while (this.take(/\./y));
    return keys;
  }

  basicString() {
    ++this.at;
    const found = this.take(/((?:\\.|[^"\\\n])*)"/y);
    if (!found) this.fail("a quotation mark is not closed");
    return this.unescaped(found[1]);
  }

  literalString() {
    ++this.at;
    const found = this.take(/([^'\n]*)'/y);
    if (!found) this.fail("a quotation mark is not closed");
    return found[1];
  }

  unescaped(text) {
    const short = {b: "\b", t: "\t", n: "\n", f: "\f", r: "\r", '"': '"', "\\": "\\"};
    return text.replace(/\\(u[0-9A-Fa-f]{4}|U[0-9A-Fa-f]{8}|[\s\S])/g, (all, code) => {
      if (code.length > 1) {
        const point = parseInt(code.slice(1), 16);
        if (point > 0x10ffff || point >= 0xd800 && point < 0xe000) this.fail(`${all} is no character`);
        return String.fromCodePoint(point);
      }
      if (!(code in short)) this.fail(`${all} is no escape`);
      return short[code];
    });
  }

  longString(quote) {
    this.at += 3;
    this.take(/\n/y);
    const end = this.take(quote === '"' ? /((?:\\[\s\S]|(?!""")[^\\])*)"""("{0,2})/y : /((?:(?!''')[\s\S])*)'''('{0,2})/y);
    if (!end) this.fail("a long text is not closed");
    const text = end[1] + end[2];
    return quote === '"' ? this.unescaped(text.replace(/\\[ \t]*\n\s*/g, "")) : text;
  }

  value(path) {
    if (this.peek('"""')) return this.longString('"');
    if (this.peek("'''")) return this.longString("'");
    if (this.peek('"')) return this.basicString();
    if (this.peek("'")) return this.literalString();
    if (this.peek("[")) return this.array(path);
    if (this.peek("{")) return this.inlineTable(path);
    const found = this.take(/\d{4}-\d\d-\d\d \d\d[^\s,\]}#]*|[^\s,\]}#]+/y);
    if (!found) this.fail("a value is missing");
    return this.scalar(found[0], path);
  }

  scalar(word, path) {
    if (word === "true" || word === "false") return word === "true";
    for (const [pattern, convert] of tomlNumbers) if (pattern.test(word)) return convert(word);
    if (/^[+-]?(inf|nan)$/.test(word)) {
      this.floats.add(path);
      return word.endsWith("nan") ? NaN : word.startsWith("-") ? -Infinity : Infinity;
    }
    if (tomlFloat.test(word)) {
      this.floats.add(path);
      return Number(word.replace(/_/g, ""));
    }
    if (tomlDate.test(word)) return {date: word};
    return this.fail(`${word} is no value; a text needs quotation marks`);
  }

  array(path) {
    ++this.at;
    const items = [];
    for (;;) {
      this.gaps();
      if (this.take(/\]/y)) return items;
      items.push(this.value(`${path}[${items.length}]`));
      this.gaps();
      if (!this.take(/,/y) && !this.peek("]")) this.fail("a bracket is not closed");
    }
  }

  inlineTable(path) {
    ++this.at;
    const table = newTable();
    this.blanks();
    if (this.take(/\}/y)) return table;
    for (;;) {
      this.keyValue(table, path);
      this.blanks();
      if (this.take(/\}/y)) return table;
      if (!this.take(/,/y)) this.fail("a brace is not closed");
    }
  }

  keyValue(table, path) {
    const line = this.line, keys = this.key();
    if (!this.take(/=/y)) this.fail(`${keys.join(".")} needs an = and a value`);
    this.blanks();
    for (const key of keys.slice(0, -1)) {
      path = path ? `${path}.${key}` : key;
      if (Object.hasOwn(table, key) && !this.dotted.has(table[key])) this.fail(`${path} is there twice`);
      if (!Object.hasOwn(table, key)) {
        table[key] = newTable();
        this.dotted.add(table[key]);
        this.lines.set(path, line);
      }
      table = table[key];
    }
    const last = keys.at(-1);
    path = path ? `${path}.${last}` : last;
    if (Object.hasOwn(table, last)) this.fail(`${path} is there twice`);
    this.lines.set(path, line);
    const value = this.value(path);
    if (typeof value === "object") this.closed.add(value);
    table[last] = value;
  }

  header(root) {
    const line = this.line, isArray = this.peek("[[");
    this.at += isArray ? 2 : 1;
    const keys = this.key();
    if (!this.take(isArray ? /\]\]/y : /\]/y)) this.fail("a bracket is not closed");
    let table = root, path = "";
    keys.forEach((key, k) => {
      const last = k === keys.length - 1;
      path = path ? `${path}.${key}` : key;
      if (!Object.hasOwn(table, key)) {
        table[key] = last && isArray ? [] : newTable();
        this.lines.set(path, line);
      } else if (this.closed.has(table[key]) || typeof table[key] !== "object" || this.dotted.has(table[key]) && last ||
        last && isArray !== Array.isArray(table[key])) {
        this.fail(`${path} is there twice`);
      }
      if (last && isArray) table[key].push(newTable());
      if (last && !isArray) {
        if (this.opened.has(table[key])) this.fail(`[${path}] is there twice`);
        this.opened.add(table[key]);
      }
      table = Array.isArray(table[key]) ? table[key].at(-1) : table[key];
    });
    return [table, path];
  }

  document() {
    const root = newTable();
    this.opened = new Set();
    let table = root, path = "";
    for (;;) {
      this.gaps();
      if (this.at >= this.text.length) return root;
      if (this.peek("[")) [table, path] = this.header(root);
      else this.keyValue(table, path);
      this.endOfLine();
    }
  }
}

/** The document, the lines of its keys and the paths of its floats. Throws TomlError. */
function readToml(text) {
  const reader = new TomlReader(text);
  return {document: reader.document(), lines: reader.lines, floats: reader.floats};
}

/** One value as a line of a scene may hold it. */
function readTomlValue(text) {
  const reader = new TomlReader(text.trim());
  const value = reader.value("");
  reader.endOfLine();
  return {value, isFloat: reader.floats.has("")};
}

// -- writing

function tomlText(text) {
  const short = {"\b": "\\b", "\t": "\\t", "\n": "\\n", "\f": "\\f", "\r": "\\r", '"': '\\"', "\\": "\\\\"};
  return `"${text.replace(/["\\\x00-\x1f\x7f]/g, sign => short[sign] ||
    `\\u${sign.charCodeAt(0).toString(16).padStart(4, "0")}`)}"`;
}

function tomlNumber(number, isInteger) {
  if (typeof number === "bigint") return String(number);
  if (!Number.isFinite(number)) return Number.isNaN(number) ? "nan" : number > 0 ? "inf" : "-inf";
  if (isInteger && Number.isInteger(number)) return number.toFixed(0);
  const text = String(number);
  return /[.e]/.test(text) ? text.replace(/e\+?/, "e") : `${text}.0`;
}

function tomlKey(key) { return /^[A-Za-z0-9_-]+$/.test(key) ? key : tomlText(key); }

/** A value in a line; its schema, if there is one, tells integers from floats. */
function tomlValue(value, schema = {}) {
  if (typeof value === "string") return tomlText(value);
  if (typeof value === "boolean") return String(value);
  if (typeof value === "number" || typeof value === "bigint") return tomlNumber(value, schema.type === "integer");
  if (Array.isArray(value)) {
    const item = k => Array.isArray(schema.items) ? schema.items[k] : schema.items;
    return `[${value.map((one, k) => tomlValue(one, item(k))).join(", ")}]`;
  }
  if ("date" in value) return value.date;
  const pairs = Object.entries(value).map(([key, one]) => `${tomlKey(key)} = ${tomlValue(one, schema.properties?.[key])}`);
  return `{${pairs.join(", ")}}`;
}

/** A key with its value; pieces and other lists of tables have a line each. */
function tomlLine(key, value, schema) {
  const isList = Array.isArray(value) && value.length && typeof value[0] === "object" && !Array.isArray(value[0]);
  if (!isList) return `${tomlKey(key)} = ${tomlValue(value, schema)}`;
  return `${tomlKey(key)} = [\n${value.map(one => `    ${tomlValue(one, schema?.items)},\n`).join("")}]`;
}

/** A scene as text: the top, then its tables in the order of the schema, each with its purpose. */
function writeToml(document, schema) {
  const isTable = value => typeof value === "object" && !Array.isArray(value) && !("date" in value);
  const entries = Object.entries(document), order = Object.keys(schema.properties);
  const lines = entries.filter(([, value]) => !isTable(value)).map(([key, value]) => tomlLine(key, value, schema.properties[key]));
  const tables = entries.filter(([, value]) => isTable(value))
    .sort(([a], [b]) => (order.indexOf(a) + 1 || 1e3) - (order.indexOf(b) + 1 || 1e3));
  for (const [name, table] of tables) {
    const own = schema.properties[name], doc = own?.description?.replace(/^effect: /, "");
    lines.push("", ...(doc ? [`# ${doc}`] : []), `[${tomlKey(name)}]`,
      ...Object.entries(table).map(([key, value]) => tomlLine(key, value, own?.properties?.[key])));
  }
  return lines.join("\n") + "\n";
}
