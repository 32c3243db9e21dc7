"""Scenes from the declared parameters: apps/scene.schema.json has type, range and default of each. A
scene is {table: {key: value}}; values inside, at and beyond their ranges, and any tables together."""

import json
import math
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[2]
DECLARED = json.loads((SOURCES / "apps/scene.schema.json").read_text(encoding="utf-8"))
SCHEMA = DECLARED["properties"]
NEEDS = {table: needs for table, needs in DECLARED["dependencies"].items() if isinstance(needs, list)}
# Small enough that a run takes a second.
BASE = {
    "": {"description": "small, from fuzz"},
    "hanging_wall": {"length_m": 4000.0, "thickness_m": 1500.0, "mean_radius_m": 90.0},
    "detachment": {"segments": [{"arc": {"radius_m": 1500.0, "end_dip_deg": 0.0}}, {"line": {"length_m": 6000.0}}]},
    "extension": {"distance_m": 100.0, "speed_m_per_s": 4.0, "ramp_s": 2.0},
    "output": {"interval_m": 50.0, "figures_at_m": [], "series": "none"},
}
EFFECTS = [name for name, table in SCHEMA.items() if table.get("description", "").startswith("effect:")]
# They name files or belong to another kind of base: taken seldom.
FAULT = ("friction", "friction_rule")   # which no depth depends on
SELDOM = ("stretching", "picked_fault", "observed", "materials")
# Need finite elements, or a file: not in small runs.
DEEP = ("elastic_base", "lower_crust_thinning", "basin_water", "footwall_erosion", "base_motion")
FILES = ("wells_at_m", "target_csv", "target")   # names of files, or lists that seldom fit
INTERVALS = ("interval_a", "update_interval_a")
SEGMENTS = [
    [{"arc": {"radius_m": 1500.0, "end_dip_deg": 0.0}}, {"line": {"length_m": 6000.0}}],
    [{"arc": {"radius_m": 700.0, "end_dip_deg": 0.0}}, {"line": {"length_m": 500.0}},
     {"arc": {"radius_m": 800.0, "start_dip_deg": 90.0, "end_dip_deg": 0.0}}, {"line": {"length_m": 6000.0}}],
    [{"line": {"length_m": 500.0}}, {"arc": {"radius_m": 1000.0, "end_dip_deg": 0.0}}, {"line": {"length_m": 6000.0}}],
    [{"arc": {"radius_m": 1000.0, "end_dip_deg": 60.0}}, {"arc": {"radius_m": 2000.0, "end_dip_deg": 0.0}},
     {"line": {"length_m": 6000.0}}],
]


def number(chance, kind, beyond):
    """A number inside, at or, if `beyond`, outside of its range."""
    least, most = kind.get("minimum", kind.get("exclusiveMinimum")), kind.get("maximum", kind.get("exclusiveMaximum"))
    least, most = -1e9 if least is None else least, 1e9 if most is None else most
    where = chance.random()
    if beyond:
        span = abs(most) + abs(least)
        return chance.choice([least - 1, most + 1, math.nextafter(least, -math.inf), math.nextafter(most, math.inf),
                              -most - 1, span * 1e9, math.nan, math.inf, -math.inf, 0.0, -0.0])
    if where < 0.15:
        return chance.choice([least, most])
    usual = kind.get("x-listric", {}).get("usual")
    if usual and where < 0.6:
        return chance.uniform(*usual)
    default = kind.get("default")
    if isinstance(default, (int, float)) and default and where < 0.9:   # within a factor of a thousand
        return min(most, max(least, default * 10.0 ** chance.uniform(-3, 3)))
    if least > 0:
        return math.exp(chance.uniform(math.log(least), math.log(most)))
    return chance.uniform(least, most)


def value(chance, key, kind, beyond):
    """A value of a parameter; one of another type seldom."""
    if beyond and chance.random() < 0.2:
        return chance.choice(["x", "", True, [], {}, [[]], -1, 1e300, "../a", {"a": 1}])
    kinds = kind.get("type")
    if key == "segments":
        return chance.choice(SEGMENTS)
    choices = [word for k in [kind, *kind.get("anyOf", ())] for word in k.get("enum", ())]
    if choices and not beyond:
        return chance.choice(choices)
    if kinds == "boolean":
        return chance.random() < 0.5
    if kinds == "integer":
        drawn = number(chance, kind, beyond)
        return int(drawn) if math.isfinite(drawn) and abs(drawn) < 1e18 else drawn
    if kinds == "number":
        return number(chance, kind, beyond)
    if kinds == "string":
        return chance.choice(["a", "é", "a b", "/dev/null", "mat18-w", "sand"])
    if kinds == "array":
        items = next((k for k in [kind, *kind.get("anyOf", ())] if "items" in k), {}).get("items", {})
        drawn = [items_value(chance, items, beyond) for _ in range(chance.choice([0, 1, 1, 2, 5]))]
        return drawn if beyond or not is_list_of_points(drawn) else sorted(drawn)
    return {}


def is_list_of_points(drawn):
    return all(isinstance(point, list) and point and isinstance(point[0], (int, float)) for point in drawn)


def items_value(chance, items, beyond):
    if isinstance(items, list):
        return [items_value(chance, item, beyond) for item in items]
    if items.get("type") == "array":
        return items_value(chance, items.get("items", {}), beyond)
    if items.get("type") == "object":
        return {key: items_value(chance, kind, beyond) for key, kind in items.get("properties", {}).items()
                if key in items.get("required", ()) or chance.random() < 0.5}
    return value(chance, "", items, beyond)


def make_scene(chance, share_beyond=0.3, small=False):
    """A scene with some effects and some of its parameters drawn. `small`: its size and length stay."""
    scene = json.loads(json.dumps(BASE))
    dense = chance.random()
    for effect in EFFECTS:
        if chance.random() < dense and not (small and effect in DEEP):
            scene[effect] = {}
            for key in INTERVALS:
                if key in SCHEMA[effect]["properties"] and small:
                    scene[effect][key] = 2500.0
    for table in SELDOM:
        if chance.random() < 0.03:
            scene[table] = {}
    beyond = chance.random() < share_beyond
    if chance.random() < 0.9:
        complete(scene)
    for _ in range(chance.choice([1, 2, 3, 6, 12])):
        table = chance.choice([t for t in scene if t])
        keys = [k for k in SCHEMA[table].get("properties", {})
                if table != "detachment" or k in FAULT or chance.random() < 0.02]
        if small:
            keys = [k for k in keys if k not in BASE.get(table, ()) and k not in INTERVALS + FILES]
        if small and table in ("output", "hanging_wall", "extension", "cycle"):
            keys = [k for k in keys if k in ("radius_ratio", "porosity", "damping", "ramp_s", "rate_m_per_a", "skin")]
        if keys:
            key = chance.choice(keys)
            scene[table][key] = value(chance, key, SCHEMA[table]["properties"][key], beyond and chance.random() < 0.4)
    if chance.random() < 0.2:
        scene["detachment"]["segments"] = chance.choice(SEGMENTS)
    if small:
        scene[""]["seed"] = chance.randrange(1, 1000)
    if not small and chance.random() < 0.1:
        scene.pop(chance.choice([t for t in scene if t]))
    return scene


def complete(scene):
    """Adds tables that those of a scene need, and leaves out those that do not go with them."""
    if "elastic_base" in scene:
        scene.pop("base_motion", None)
    added = True
    while added:
        added = [need for table in scene for need in NEEDS.get(table, ()) if need not in scene]
        scene.update({need: {} for need in added})


def toml_value(one):
    if isinstance(one, bool):
        return "true" if one else "false"
    if isinstance(one, (int, float)):
        return repr(one)
    if isinstance(one, str):
        return json.dumps(one, ensure_ascii=False)
    if isinstance(one, dict):
        return "{" + ", ".join(f"{k} = {toml_value(v)}" for k, v in one.items()) + "}"
    return "[" + ", ".join(map(toml_value, one)) + "]"


def to_toml(scene):
    lines = []
    for table, keys in scene.items():
        lines += [f"[{table}]"] if table else []
        lines += [f"{key} = {toml_value(one)}" for key, one in keys.items()]
    return "\n".join(lines) + "\n"
