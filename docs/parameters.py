#!/usr/bin/env python3
"""Writes docs/reference/parameters.md from the declarations in apps/*.schema.json, which the build makes. A heading, and so an
anchor, for every table and parameter.
"""

import json
import os
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/reference/parameters.md"
SCHEMA = ROOT / "apps/scene.schema.json"
PLAN = ROOT / "apps/flexure.schema.json"

HEAD = """# Parameters of a scene

Made from the declarations by `docs/parameters.sh`; `./listric explain --parameters` prints the same facts. A scene is a TOML file;
`--set fault_weakening.least_slip_m=50` changes a parameter for one call. Keys end with their unit.

An **effect** is a process: it is on if its table is in the file, even if the table is empty. **Allowed** is what the program accepts.
**Usual** is the range of the shipped scenes, the studies and the published values that these pages quote; where none is given, none is
known. **Symbol** is that of Seyferth and Henk (2005). A sentence "Raising it ..." describes the change from the
default.

"""

#: Where a table, or one of its keys, is explained: pages of docs.
EXPLAINED = {
    "": "reference/run-folder.md",
    "accuracy": "theory/genesis.md#accuracy",
    "seed": "guides/troubleshooting.md#the-result-is-strange",
    "materials": "guides/choosing.md#friction-of-faults",
    "hanging_wall": "theory/genesis.md",
    "hanging_wall.mean_radius_m": "guides/choosing.md#resolution",
    "detachment": "theory/cycle.md#detachment-and-walls",
    "detachment.friction": "guides/choosing.md#friction-of-the-detachment",
    "detachment.friction_rule": "explain/fault-weakening.md#friction-on-the-detachment",
    "detachment.footwall_top_m": "guides/inversion.md#ground-behind-the-breakaway",
    "detachment.footwall_friction": "guides/inversion.md#ground-behind-the-breakaway",
    "stage": "guides/inversion.md#stages",
    "fault_weakening.shortening_mean_stress_ratio": "guides/inversion.md#weak-rock-under-thrust",
    "detachment.csv": "start/your-own-section.md",
    "detachment.csv_delimiter": "start/your-own-section.md",
    "detachment.svg": "start/your-own-section.md",
    "detachment.svg_path": "start/your-own-section.md",
    "detachment.svg_points": "start/your-own-section.md",
    "detachment.shift_x_m": "start/your-own-section.md",
    "detachment.tolerance_m": "start/your-own-section.md",
    "picked_fault": "start/your-own-section.md",
    "observed": "start/your-own-section.md",
    "stretching": "guides/laboratory.md#pure-shear",
    "extension": "theory/index.md#axes-and-clocks",
    "extension.speed_m_per_s": "guides/choosing.md#speed",
    "material": "theory/cycle.md#contact",
    "cycle": "theory/cycle.md#motion",
    "cycle.damping": "theory/cycle.md#damping-against-the-mean-motion",
    "cycle.averaging_time_s": "theory/cycle.md#damping-against-the-mean-motion",
    "cycle.time_step_safety": "theory/cycle.md#time-step",
    "cycle.skin": "theory/cycle.md#neighbours",
    "output": "reference/run-folder.md",
    "gravity": "theory/cycle.md#motion",
    "bonds": "theory/cycle.md#bonds",
    "fault_weakening": "theory/faults.md#fault-detection-afd",
    "fault_weakening.normal_stiffness_pa": "theory/faults.md#weak-rock",
    "fault_weakening.shear_stiffness_pa": "theory/faults.md#weak-rock",
    "fault_weakening.friction": "guides/choosing.md#friction-of-faults",
    "fault_weakening.update_interval_a": "theory/faults.md#property-update",
    "fault_weakening.mean_stress_ratio": "theory/faults.md#property-update",
    "fault_weakening.largest_change": "theory/faults.md#property-update",
    "bond_healing": "theory/faults.md#healing-icm",
    "sedimentation": "theory/sediment.md#deposition-and-erosion",
    "pore_fluid": "theory/pore-fluid.md#flow",
    "compaction": "theory/sediment.md#compaction",
    "heat": "explain/heat.md#what-is-solved",
    "heat.regional_extension_m": "explain/heat.md#it-loads-a-base-that-bends",
    "heat.thermal_expansion_per_k": "explain/heat.md#it-loads-a-base-that-bends",
    "energy": "theory/cycle.md#energy",
    "elastic_base": "theory/elastic-base.md#elastic-body",
    "elastic_base.elastic_thickness_m": "guides/choosing.md#elastic-thickness",
    "elastic_base.elastic_isotherm_c": "explain/elastic-base.md",
    "elastic_base.asthenosphere_density_kg_per_m3": "explain/heat.md#it-loads-a-base-that-bends",
    "elastic_base.crust_density_kg_per_m3": "theory/elastic-base.md#isostasy",
    "elastic_base.mantle_density_kg_per_m3": "theory/elastic-base.md#isostasy",
    "elastic_base.infill_density_kg_per_m3": "theory/elastic-base.md#isostasy",
    "elastic_base.cell_size_m": "explain/cost-of-accuracy.md#the-elastic-base",
    "elastic_base.update_interval_cycles": "explain/cost-of-accuracy.md#coupling",
    "elastic_base.modes": "explain/cost-of-accuracy.md#coupling",
    "elastic_base.mass_factor": "theory/elastic-base.md#coupling",
    "elastic_base.swing_damping": "theory/elastic-base.md#coupling",
    "lower_crust_thinning": "theory/elastic-base.md#lower-crust",
    "basin_water": "theory/elastic-base.md#basin-water",
    "footwall_erosion": "theory/elastic-base.md#footwall-erosion",
    "base_motion": "theory/elastic-base.md#prescribed-motion",
    "base_motion.fault_x_m": "guides/choosing.md#a-moving-basement",
    "flexure": "theory/elastic-base.md#thin-plates-to-compare-with",
}
TITLES = {"": "At the top of the file", "detachment.segments.arc": "Arcs of the detachment",
          "detachment.segments.line": "Lines of the detachment", "elastic_base.layers": "Layers of the elastic base"}


def is_table(schema):
    return "properties" in schema and "x-listric" not in schema


def parameters(schema, path=""):
    """(table, its subject, {key: schema}) for the top of the file, each table, and what stands inside a parameter."""
    own = {key: one for key, one in schema["properties"].items() if "x-listric" in one}
    tables = [(path, schema.get("description", ""), own)]
    for key, one in schema["properties"].items():
        below = f"{path}.{key}".lstrip(".")
        if is_table(one):
            tables += parameters(one, below)
        elif one.get("items", {}).get("properties"):
            inside = one["items"]
            if any(is_table(part) for part in inside["properties"].values()):  # one of several tables
                for kind, part in inside["properties"].items():
                    tables += parameters(part, f"{below}.{kind}")
            else:
                tables += parameters(inside, below)
    written = ("observed.", "old_fault.")  # by the program
    return [table for table in tables if not table[0].startswith(written)]


def reference(schema):
    """(name, schema) of all parameters, named as for `--set`."""
    return [(f"{table}.{key}".lstrip("."), one) for table, _, keys in parameters(schema) for key, one in keys.items()]


def formula(symbol):
    """d_cw, Delta t_w, r_d^max/r_d^min as TeX."""
    tex = re.sub(r"\b(Delta|Phi|rho|mu|nu|lambda)(?=_|\b)", r"\\\1", symbol).replace("eps", r"\dot{\epsilon}")
    return "$" + re.sub(r"([_^])([A-Za-z]{2,})", r"\1{\\mathrm{\2}}", tex).replace("/", " / ") + "$"


def anchor(heading):
    return re.sub(r"[^\w-]", "", heading.lower())


def sentence(text):
    return (text if text.startswith("x ") else text[:1].upper() + text[1:]) + ("" if text.endswith(".") else ".")


def number(x):
    return f"{x:g}" if abs(x) < 1e5 else f"{x:.3g}".replace("e+0", "e").replace("e+", "e")


def facts(name, one):
    value = one["default"]
    unit = one.get("unit") or ("1" if one["type"] in ("number", "integer") else "")
    key = name.rpartition(".")[2]
    follows = f" at {one['usual_rate_m_per_a']:g} m/a, follows [the rate](../guides/choosing.md#geological-rate)" if "usual_rate_m_per_a" in one else ""
    yield f"`{key}`, {value[1:-1]}" if value in ("(none)", "(required)") else f"**Default** `{key} = {value}`{follows}"
    if unit:
        yield f"**Unit** {unit}"
    yield f"**Type** {one['type']}"
    if "allowed" in one:
        yield f"**Allowed** {one['allowed'].replace('9.223372036854776e18', '2^63')}"
    if "usual" in one:
        yield "**Usual** {} to {}".format(*map(number, one["usual"]))
    if "symbol" in one:
        yield f"**Symbol** {formula(one['symbol'])}"
    table = name.rpartition(".")[0]
    while table and name not in EXPLAINED and table not in EXPLAINED:
        table = table.rpartition(".")[0]
    to = EXPLAINED.get(name) or EXPLAINED[table]
    yield f"[{'Theory' if to.startswith('theory') else 'More'}]({os.path.relpath(to, 'reference')})"


def page(schema):
    tables = parameters(schema)
    lines = [HEAD + "| table | parameters |\n|---|---|\n"]
    for table, _, keys in tables:
        links = " ".join(f"[`{key}`](#{anchor(f'{table}.{key}')})" for key in keys)
        lines.append(f"| [{TITLES.get(table) or f'`{table}`'}](#{heading_anchor(table)}) | {links or 'none'} |\n")
    for table, doc, keys in tables:
        lines.append(f"\n## {TITLES.get(table) or table}\n")
        if doc:
            lines.append(f"\n{'**Effect.** ' if doc.startswith('effect: ') else ''}{sentence(doc.removeprefix('effect: '))}\n")
        for key, one in keys.items():
            name = f"{table}.{key}".lstrip(".")
            declared = one["x-listric"]
            lines.append(f"\n### {name}\n{sentence(declared['doc'])} {declared['changes']} "
                         f"{' · '.join(facts(name, declared))}\n")
    return "".join(lines)


def heading_anchor(table):
    return anchor(TITLES.get(table, table).replace(" ", "-"))


def read_declared(file):
    """What the build writes beside the sources."""
    if not file.exists():
        raise SystemExit(f"{file}: is made by the build: ./listric scenes")
    return json.loads(file.read_text(encoding="utf-8"))


def read_schema():
    """The schema of a scene, and with it the table that plans of flexure have of their own."""
    schema, plan = read_declared(SCHEMA), read_declared(PLAN)
    table = dict(plan["properties"]["flexure"])
    table["description"] = "table of plans for `listric flexure`, " + table["description"]
    schema["properties"]["flexure"] = table
    return schema


if __name__ == "__main__":
    PAGE.write_text(page(read_schema()), encoding="utf-8")
