// What a scene may hold: the program's schema (JSON schema, draft 4, as far as `listric schema` uses it), with the
// program's way of saying what is wrong.

/** Damerau-Levenshtein distance in which no letter moves twice, as apps/support/words/spelling.cpp has it. */
function editDistance(a, b) {
  let above = [], row = Array.from({length: b.length + 1}, (_, j) => j);
  for (let i = 1; i <= a.length; ++i) {
    const before = above;
    above = row;
    row = [i];
    for (let j = 1; j <= b.length; ++j) {
      row[j] = Math.min(above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1));
      if (i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1]) row[j] = Math.min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.length];
}

/** The allowed name that a word may mean; undefined: none is near. */
function nearestName(word, allowed) {
  const typed = word.slice(0, 64).toLowerCase();
  let best, least = Math.max(1, Math.floor(typed.length / 3)) + 1;
  for (const name of allowed) {
    const distance = typed.length > 2 && name.startsWith(`${typed}_`) ? 0 : editDistance(typed, name);
    if (distance < least) [least, best] = [distance, name];
  }
  return best;
}

function adviceOn(word, allowed) {
  const meant = nearestName(word, allowed);
  return meant ? `did you mean ${meant}?` : `allowed: ${allowed.join(", ")}`;
}

/** What a range allows, in words. */
function rangeText(schema) {
  const parts = [];
  if ("minimum" in schema) parts.push(`${schema.exclusiveMinimum ? "above" : "at least"} ${shortNumber(schema.minimum)}`);
  if ("maximum" in schema) parts.push(`${schema.exclusiveMaximum ? "below" : "at most"} ${shortNumber(schema.maximum)}`);
  return parts.join(", ");
}

function shortNumber(x) {
  if (Math.abs(x) >= 1e6 || x !== 0 && Math.abs(x) < 1e-4) return x.toExponential().replace("e+", "e");
  return String(x);
}

function typeName(value) {
  if (Array.isArray(value)) return "array";
  if (typeof value === "bigint") return "integer";
  if (typeof value === "object") return "date" in value && typeof value.date === "string" ? "date" : "object";
  return typeof value;
}

function shownValue(value) {
  if (Array.isArray(value)) return "array";
  if (typeof value === "object") return "date" in value ? `date ${value.date}` : "table";
  return typeof value === "string" ? tomlText(value) : `${typeof value} ${value}`;
}

class SchemaCheck {
  constructor(floats) {
    this.floats = floats;
    this.faults = [];
  }

  fault(path, message) { this.faults.push({path, message}); }

  /** Whether a value is as a schema wants it, without a word on why. */
  isGood(schema, value, path) {
    const other = new SchemaCheck(this.floats);
    other.check(schema, value, path);
    return other.faults.length === 0;
  }

  check(schema, value, path) {
    const type = typeName(value);
    if (schema.type && !this.isType(schema.type, type, value, path)) {
      this.fault(path, `wrong type (${shownValue(value)}), allowed: ${schema["x-listric"]?.type || schema.type}`);
      return;
    }
    if (type === "number" || type === "integer") this.checkNumber(schema, value, path);
    if (type === "string") this.checkText(schema, value, path);
    if (type === "array") this.checkArray(schema, value, path);
    if (type === "object") this.checkTable(schema, value, path);
    this.checkCases(schema, value, path);
  }

  isType(wanted, type, value, path) {
    if (wanted === "number") return type === "number" || type === "integer";
    if (wanted === "integer") return type === "integer" || type === "number" && Number.isInteger(value) && !this.floats.has(path);
    return wanted === type;
  }

  checkNumber(schema, value, path) {
    const {minimum: low = -Infinity, maximum: high = Infinity} = schema;
    if (value >= low && value <= high && !(schema.exclusiveMinimum && value == low) &&
        !(schema.exclusiveMaximum && value == high) && (typeof value === "bigint" || Number.isFinite(value))) return;
    this.fault(path, `out of range (${value}), allowed: ${rangeText(schema) || "a finite number"}`);
  }

  checkText(schema, value, path) {
    if (schema.enum && !schema.enum.includes(value))
      this.fault(path, `unknown value (${tomlText(value)}), ${adviceOn(value, schema.enum)}`);
    if (schema.pattern && !new RegExp(schema.pattern).test(value) || value.length > (schema.maxLength ?? Infinity))
      this.fault(path, `${tomlText(value.slice(0, 60))} is not allowed here`);
  }

  checkArray(schema, value, path) {
    const {minItems = 0, maxItems = Infinity} = schema;
    if (value.length < minItems || value.length > maxItems)
      this.fault(path, `has ${value.length} items, needs ${minItems === maxItems ? minItems : `at least ${minItems}`}`);
    value.forEach((item, k) => {
      const own = Array.isArray(schema.items) ? schema.items[k] : schema.items;
      if (own) this.check(own, item, `${path}[${k}]`);
    });
  }

  checkTable(schema, value, path) {
    const keys = Object.keys(value), known = Object.keys(schema.properties || {}), inside = key => path ? `${path}.${key}` : key;
    for (const key of keys) {
      if (known.includes(key)) this.check(schema.properties[key], value[key], inside(key));
      else if (schema.additionalProperties === false)
        this.fault(inside(key), `unknown ${typeName(value[key]) === "object" ? "table" : "key"}, ${this.adviceInside(schema, key, known)}`);
    }
    for (const key of schema.required || [])
      if (!(key in value)) this.fault(path || key, path ? `needs ${key}` : `is missing, every scene needs [${key}]`);
    if (keys.length < (schema.minProperties ?? 0) || keys.length > (schema.maxProperties ?? Infinity))
      this.fault(path, `needs exactly one of ${known.join(" and ")}`);
    for (const [key, rule] of Object.entries(schema.dependencies || {})) {
      if (!(key in value)) continue;
      if (Array.isArray(rule)) {
        for (const needed of rule)
          if (!(needed in value)) this.fault(inside(key), `needs [${needed}], which the scene does not have; add [${needed}] or leave out [${key}]`);
      } else this.checkCases(rule, value, path || key);
    }
  }

  /** A parameter that lacks its table is worth recognising. */
  adviceInside(schema, key, known) {
    if (nearestName(key, known)) return adviceOn(key, known);
    const meant = known.flatMap(table => {
      const near = nearestName(key, Object.keys(schema.properties[table].properties || {}));
      return near ? [`${table}.${near}`] : [];
    });
    return meant.length ? `did you mean ${meant.join(" or ")}?` : adviceOn(key, known);
  }

  checkCases(schema, value, path) {
    const good = rules => rules.filter(rule => this.isGood(rule, value, path)).length;
    if (schema.anyOf && !good(schema.anyOf)) {
      const names = schema.anyOf.flatMap(rule => rule.enum || []);
      if (names.length) this.fault(path, `unknown name (${tomlText(value)}), ${adviceOn(value, names)}`);
      else this.explainCase(schema.anyOf, value, path);
    }
    if (schema.oneOf && good(schema.oneOf) !== 1)
      this.fault(path, `needs exactly one of ${schema.oneOf.flatMap(rule => rule.required || []).join(", ")}`);
    if (schema.not && this.isGood(schema.not, value, path))
      this.fault(path, schema.not.required ? `has ${schema.not.required.join(", ")}, which follows from the picked fault; leave it out`
        : `${shownValue(value)} is not allowed here`);
    if (schema.enum && typeof value !== "string") this.fault(path, `allowed: ${schema.enum.join(", ")}`);
    if (schema.required && !schema.type && typeName(value) === "object")
      for (const key of schema.required) if (!(key in value)) this.fault(path, `needs ${key}`);
  }

  /** The objection of the case that is nearest to being good. */
  explainCase(rules, value, path) {
    const tried = rules.map(rule => {
      const other = new SchemaCheck(this.floats);
      other.check(rule, value, path);
      return other.faults;
    });
    this.faults.push(tried.sort((a, b) => a.length - b.length)[0][0]);
  }
}

/** Faults of a scene by the schema: [{path, message}]. */
function faultsBySchema(schema, document, floats = new Set()) {
  const check = new SchemaCheck(floats);
  check.check(schema, document, "");
  return check.faults;
}

/** The schema of a value at a path of table and key; undefined: there is none. */
function schemaAt(schema, path) {
  return path.split(".").reduce((at, key) => at?.properties?.[key], schema);
}
