"""The schema of scenes and the program agree on what a scene is: on every scene that is shipped and
on 300 that are spoilt at random. Where they do not, docs/guides/editors.md says why.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest scene_schema_test
"""

import copy
import datetime
import json
import math
import os
import random
import re
import subprocess
import tempfile
import tomllib
import unittest
from pathlib import Path

from jsonschema import Draft4Validator
from program import PROGRAM, SOURCES


# What the program refuses and the schema cannot: what docs/guides/editors.md says, and in which words the
# program tells it.
BEYOND_A_SCHEMA = {
    "the chain of the detachment": r"reaches a depth of|does not join|starts and ends with a dip|"
                                   r"ends with a dip|stays at the surface",
    "the number of discs": r"too (large|small) \([^)]*\), gives \d+ discs",
    "the size of the run": r"makes a run that (takes|writes)|fills the basin",
    "tables beside each other": r"beside \[|must be 0 beside it|needs csv, or uplift or shift|"
                                r"give one of them|beside a base that bends",
    "numbers of several keys": r"for the base to float upright|beyond the right wall|"
                               r"which a base under discs is condensed with|"
                               r"elastic_base: (?!needs)|halves elements|sinks without end|"
                               r"outside of the footwall|pore_fluid: (weighs|needs sediment)|"
                               r"the density of grains|a multiple of the interval|above crust_m|"
                               r"the hanging wall is crust|above surface_temperature_c|makes more heat than|"
                               r"no lower crust stretches",
    "layers": r"needs (name|material|one of )|upside down|below the detachment|less than a mean disc|overlaps|"
              r"four strengths|of two layers|weakened rock cannot have|is about bonds|two a layer",
    "beds of sediment": r"only the last bed|the last bed|beds come from the oldest|no stratum ends|two laws of one|"
                        r"law mudstone|law kozeny_carman alone|a share of nothing|needs laminae_share|thin beds|"
                        r"another law of permeability|a material of the bed's own",
    "old faults": r"needs points|has one point|outside of the hanging wall|shorter than its band",
    "stages": r"a stage (moves|that does)|shortening, which needs|but the wall rests|the wall comes to|net shortening|"
              r"the first stage's rate|moves what lies on it",
    "the ground": r"both shape the ground|the ground falls to the|deep, allowed: at most hanging_wall",
    "order": r"is not sorted",
    "other files": r"no such file|has no \[(bonds|pores)\]",
    "nan and inf": r"\((nan|-?inf)\)",
}


def toml(value):
    """A value in TOML, tables inline."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, datetime.date):
        return value.isoformat()
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(k)} = {toml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value)


def program(*words, **options):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, **options)


def schema_of(*options):
    return json.loads(program("schema", *options).stdout)


def some_number(schema, dice):
    """Within the range of a parameter, at its ends or beyond them."""
    least, most = schema.get("minimum", -1e9), schema.get("maximum", 1e9)
    whole = schema["type"] == "integer"
    span = most - least
    value = dice.choice([least, most, least - 1, most + 1, least - 0.5 * span, most + span,
                         math.nextafter(least, -math.inf), math.nextafter(most, math.inf),
                         dice.uniform(least, min(most, least + 1e4)), dice.uniform(least, most),
                         math.nan, math.inf])
    # TOML has integers up to 2^63 - 1.
    return int(value) if whole and math.isfinite(value) and abs(value) < 2**63 else value


def some_value(schema, dice):
    """Of a parameter's type as a rule, not always allowed."""
    if "enum" in schema:
        return dice.choice(schema["enum"] + ["nonsense", "", schema["enum"][0].upper()])
    kind = schema.get("type")
    if kind in ("number", "integer"):
        return some_number(schema, dice)
    if kind == "boolean":
        return dice.choice([True, False])
    if kind == "array":
        if "anyOf" in schema:
            return some_target(dice)
        if isinstance(schema["items"], list):                          # a point
            return [some_value(one, dice) for one in schema["items"]][:dice.choice([1, 2, 2, 2])]
        return [some_value(schema["items"], dice) for _ in range(dice.randrange(3))]
    if kind == "object":
        return {key: some_value(value, dice) for key, value in schema["properties"].items()
                if key in schema.get("required", []) or dice.random() < 0.2}
    return dice.choice(["", "some words", "no/such/file.toml", "mat18-b", "mat18-w", "mat18-x"])


def some_target(dice):
    points = [[0.0, 0.0], [10000.0, -200], [40000.0, dice.choice([-500.0, "deep", 1e9])]]
    return dice.choice([
        points, points[::-1], [], [points], points[:2], [[0.0]], [[0.0, 1.0, 2.0]],
        [{"time_a": 0.0, "points": points[:2]}, {"time_a": 5e5, "points": points[:2]}],
        [{"time_a": 0.0}], [{"time_a": 0.0, "points": []}], [{"time_a": -1.0, "points": points}],
        [points[0], {"time_a": 0.0, "points": points}]])


ANYTHING = [0, 1, -7, 2.5, "text", "", True, False, [], [1.0, "two"], {}, {"key": 1},
            datetime.date(2026, 11, 22)]


class Spoiler:
    """Changes scenes; one function for each kind of mistake."""

    def __init__(self, schema, dice):
        self.schema, self.dice = schema, dice

    def tables(self, scene):
        return [name for name in scene if isinstance(scene[name], dict)]

    def declared(self, name):
        return self.schema["properties"][name]["properties"]

    def wrong_type(self, scene):
        name = self.dice.choice(self.tables(scene))
        keys = list(self.declared(name))
        if not keys or self.dice.random() < 0.2:
            scene[self.dice.choice(list(scene))] = self.dice.choice(ANYTHING)
        else:
            scene[name][self.dice.choice(keys)] = self.dice.choice(ANYTHING)

    def other_value(self, scene):
        name = self.dice.choice([t for t in self.tables(scene) if self.declared(t)])
        key, schema = self.dice.choice(list(self.declared(name).items()))
        scene[name][key] = some_value(schema, self.dice)

    def other_array(self, scene):
        arrays = [(scene[name], key, schema) for name in self.tables(scene)
                  for key, schema in self.declared(name).items() if schema["type"] == "array"]
        if arrays:
            table, key, schema = self.dice.choice(arrays)
            table[key] = some_value(schema, self.dice)

    def top_value(self, scene):
        key = self.dice.choice(["name", "description", "accuracy", "seed"])
        scene[key] = some_value(self.schema["properties"][key], self.dice)

    def unknown_key(self, scene):
        place = self.dice.choice([scene] + [scene[name] for name in self.tables(scene)])
        if "segments" in place and self.dice.random() < 0.7:
            place = self.dice.choice(place["segments"])
            place = self.dice.choice([place, *place.values()])
        key = self.dice.choice(["thickness", "length", "colour", "dip_deg", "start_dip_deg", "m"])
        place[key] = self.dice.choice([1.0, {}])

    def missing_key(self, scene):
        place = self.dice.choice([scene[name] for name in self.tables(scene) if scene[name]])
        if "segments" in place and self.dice.random() < 0.5:
            place = next(iter(self.dice.choice(place["segments"]).values()))
        del place[self.dice.choice(list(place))]

    def removed_table(self, scene):
        for _ in range(self.dice.randint(1, 2)):
            del scene[self.dice.choice(self.tables(scene))]

    def extra_table(self, scene):
        names = [name for name, entry in self.schema["properties"].items()
                 if entry["type"] == "object" and name not in scene]
        name = self.dice.choice(names)
        full = self.dice.random() < 0.5
        scene[name] = {key: schema["default"] for key, schema in self.declared(name).items()
                       if full and "default" in schema}

    def swapped_values(self, scene):
        name = self.dice.choice([t for t in self.tables(scene) if len(scene[t]) > 1])
        first, second = self.dice.sample(list(scene[name]), 2)
        scene[name][first], scene[name][second] = scene[name][second], scene[name][first]

    def swapped_tables(self, scene):
        first, second = self.dice.sample(self.tables(scene), 2)
        scene[first], scene[second] = scene[second], scene[first]

    def other_chain(self, scene):
        if "detachment" not in scene:
            return self.other_value(scene)
        pieces = scene["detachment"]["segments"]
        piece = self.dice.choice(pieces)
        kind = self.dice.choice(["arc", "line"])
        changes = [
            pieces.clear, pieces.pop, lambda: pieces.append(piece), lambda: pieces.append({}),
            lambda: pieces.append(3.0), lambda: pieces.append({"curve": {}}),
            lambda: piece.update({"arc": {"radius_m": 1e4}, "line": {"length_m": 1e4}}),
            lambda: pieces.insert(0, {kind: some_value(
                self.schema["properties"]["detachment"]["properties"]["segments"]["items"]
                ["properties"][kind], self.dice)})]
        return self.dice.choice(changes)()

    def spoil(self, scene):
        kinds = [self.wrong_type, self.other_value, self.other_value, self.other_array,
                 self.top_value, self.unknown_key, self.missing_key, self.removed_table,
                 self.extra_table, self.swapped_values, self.swapped_tables, self.other_chain]
        self.dice.choice(kinds)(scene)


class SceneSchema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schema = schema_of()
        Draft4Validator.check_schema(cls.schema)
        cls.validator = Draft4Validator(cls.schema)
        cls.scenes = {path: tomllib.loads(path.read_text())
                      for path in sorted((SOURCES / "apps/scenes").glob("*.toml"))}

    def check(self, *files):
        """What the program says of each file, and its exit code."""
        done = program("check", *map(str, files))
        lines = [line for line in done.stdout.splitlines() if not line.startswith("warning: ")]
        self.assertEqual(len(lines), len(files))
        self.assertEqual(done.stderr, "")
        return lines, done.returncode

    def test_accepts_every_shipped_scene(self):
        self.assertGreaterEqual(len(self.scenes), 9)
        for path, scene in self.scenes.items():
            with self.subTest(path.name):
                self.assertEqual([e.message for e in self.validator.iter_errors(scene)], [])
        lines, code = self.check(*self.scenes)
        self.assertEqual(code, 0)
        for path, line in zip(self.scenes, lines):
            self.assertRegex(line, rf"^{path}: correct: \d+ tables, ")

    def test_accepts_every_shipped_material(self):
        schema = schema_of("--material")
        Draft4Validator.check_schema(schema)
        materials = sorted((SOURCES / "apps/materials").glob("*.toml"))
        for path in materials:
            material = tomllib.loads(path.read_text())
            Draft4Validator(schema).validate(material)
            del material["material"]["friction"]
            self.assertFalse(Draft4Validator(schema).is_valid(material))
        self.assertEqual(self.check(*materials)[1], 0)

    def test_is_named_by_every_shipped_file(self):
        for folder, schema in ("scenes", "scene"), ("materials", "material"):
            for path in (SOURCES / "apps" / folder).glob("*.toml"):
                name = re.match(r"#:schema (\S+)\n", path.read_text())[1]
                named = (path.parent / name).resolve()
                self.assertEqual(named, SOURCES / f"apps/{schema}.schema.json")
                self.assertTrue(named.is_file(), "the build makes it")

    def test_is_made_by_the_build(self):
        for option in ("", "--material", "--sweep", "--validation", "--flexure"):
            made = SOURCES / f"apps/{option[2:] or 'scene'}.schema.json"
            self.assertEqual(json.loads(made.read_text()), schema_of(*option.split()), made)

    def test_agrees_with_the_program_on_spoilt_scenes(self):
        dice = random.Random(2026)
        spoiler = Spoiler(self.schema, dice)
        shipped = list(self.scenes.values())
        scenes, files = [], []
        with tempfile.TemporaryDirectory() as folder:
            for number in range(300):
                scene = copy.deepcopy(dice.choice(shipped))
                spoiler.spoil(scene)
                file = Path(folder) / f"{number}.toml"
                file.write_text("".join(f"{key} = {toml(scene[key])}\n" for key in scene))
                scenes.append(tomllib.loads(file.read_text()))
                files.append(file)
            lines, _ = self.check(*files)
        counts = dict.fromkeys([(True, True), (False, False), (True, False), (False, True)], 0)
        for scene, line in zip(scenes, lines):
            errors = [error.message for error in self.validator.iter_errors(scene)]
            correct = ": correct: " in line
            counts[not errors, correct] += 1
            with self.subTest(line=line, scene=toml(scene)):
                if errors:
                    self.assertFalse(correct, errors)
                elif not correct:
                    reasons = [text for text, words in BEYOND_A_SCHEMA.items()
                               if re.search(words, line)]
                    self.assertTrue(reasons, "the schema takes it")
        # Enough of each that an agreement says something.
        self.assertGreater(counts[True, True], 40, counts)
        self.assertGreater(counts[False, False], 120, counts)

    def test_has_every_parameter(self):
        table = None
        for line in program("explain", "--parameters").stdout.splitlines():
            if head := re.match(r"\[?\[(\w+)\]", line):
                table = head[1]
            elif line.startswith("Segment"):
                break
            elif key := re.match(r"    (\w+) = ", line):
                place = self.schema["properties"][table] if table else self.schema
                place = place.get("items", place)   # of a table [[name]]
                self.assertIn(key[1], place["properties"], table)
                self.assertTrue(place["properties"][key[1]]["description"])
        self.assertEqual(table, "stage")

    def test_has_the_program_s_ranges(self):
        # A scene that has the table, or may.
        bases = {"stretching": "pure-shear", "base_motion": "lis1"}
        named = {path.stem: scene for path, scene in self.scenes.items()}
        cases = []
        for table, entry in self.schema["properties"].items():
            for key, of in entry.get("properties", {}).items():
                if of.get("type") not in ("number", "integer"):
                    continue
                least, most, whole = of["minimum"], of["maximum"], of["type"] == "integer"
                beyond = [least - 1, most + 1] if whole else [math.nextafter(least, -math.inf),
                                                              math.nextafter(most, math.inf)]
                for value in [least, most, *beyond]:
                    scene = copy.deepcopy(named[bases.get(table, "lis1-elastic")])
                    scene.setdefault(table, {})[key] = int(value) if whole else value
                    cases.append(scene)
        self.assertGreater(len(cases), 300)
        with tempfile.TemporaryDirectory() as folder:
            files = [Path(folder) / f"{number}.toml" for number in range(len(cases))]
            for file, scene in zip(files, cases):
                file.write_text("".join(f"{key} = {toml(scene[key])}\n" for key in scene))
            lines, _ = self.check(*files)
        for line, scene in zip(lines, cases):
            self.assertEqual("out of range" in line, not self.validator.is_valid(scene), line)

    def test_goes_on_after_a_bad_file_and_writes_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            bad, plan = Path(folder) / "bad.toml", Path(folder) / "plan.toml"
            bad.write_text('[hanging_wall]\nlenght_m = 1.0\n')
            plan.write_text('scene = "lis1"\nseeds = 2\nmeasures = ["strain_top10"]\n[[vary]]\n'
                            'parameter = "gravity.acceleration_m_per_s2"\nvalues = [9.81, 3.7]\n')
            elsewhere = Path(folder) / "empty"
            elsewhere.mkdir()
            words = [bad, "lis1", "lis11", plan, SOURCES / "apps/studies/validation.toml"]
            done = program("check", *words, cwd=elsewhere,
                           env={**os.environ, "HOME": elsewhere, "XDG_CACHE_HOME": elsewhere})
            self.assertEqual(list(elsewhere.iterdir()), [])
            told = program("run", bad, cwd=elsewhere)
        lines = done.stdout.splitlines()
        self.assertEqual(done.returncode, 2)
        self.assertEqual(f"listric: {lines[0]}\n", told.stderr)
        self.assertEqual(lines[0], f"{bad}:2: hanging_wall.lenght_m: unknown key, did you mean "
                                   "length_m?")
        self.assertRegex(lines[1], r"^lis1: correct: 10 tables, about 16,\d00 discs, ")
        self.assertIn("did you mean lis1?", lines[2])
        self.assertRegex(lines[3], r"correct: a sweep of 4 runs, ")
        self.assertRegex(lines[4], r"correct: a validation of \d+ experiments, ")

    def test_documents_what_it_cannot_say(self):
        text = (SOURCES / "docs/guides/editors.md").read_text()
        for reason in BEYOND_A_SCHEMA:
            self.assertIn(f"| {reason} |", text)


if __name__ == "__main__":
    unittest.main()
