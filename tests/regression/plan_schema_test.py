"""Schemas of plans and the program agree: on every plan that is shipped, and on plans with one mistake
each.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest plan_schema_test
"""

import json
import subprocess
import tempfile
import tomllib
import unittest
from pathlib import Path

from jsonschema import Draft4Validator
from program import PROGRAM, SOURCES

SWEEP = """scene = "lis1"
measures = ["strain_top10", "rollover_tilt_deg@2500"]
[[vary]]
parameter = "fault_weakening.friction"
values = [0.0, 0.2]
"""
VALIDATION = """[[run]]
name = "control"
scene = "lis1"
at_m = [1000.0]
[[experiment]]
name = "control"
runs = "control"
[[experiment.expect]]
measure = "rollover_tilt_deg"
what = "tilt"
least = 1.0
"""


def validator(kind):
    schema = json.loads(subprocess.run([PROGRAM, "schema", f"--{kind}"], capture_output=True).stdout)
    Draft4Validator.check_schema(schema)
    return Draft4Validator(schema)


class PlanSchema(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name) / "plan.toml"

    def takes(self, kind, text):
        """Whether the schema takes a plan, and whether the program does."""
        self.file.write_text(text)
        done = subprocess.run([PROGRAM, "check", self.file], capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        return validator(kind).is_valid(tomllib.loads(text)), ": correct: " in done.stdout

    def test_take_every_shipped_plan(self):
        plans = {"sweep": [*sorted((SOURCES / "docs/guides/cookbook").glob("*.toml")),
                           SOURCES / "apps/studies/seismics.toml"],
                 "validation": [SOURCES / "apps/studies/validation.toml"],
                 "flexure": [SOURCES / "apps/studies/flexure.toml"]}
        self.assertGreaterEqual(len(plans["sweep"]), 3)
        for kind, files in plans.items():
            for file in files:
                plan = tomllib.loads(file.read_text())
                if kind == "sweep" and "vary" not in plan:
                    continue  # a scene
                with self.subTest(file.name):
                    self.assertEqual([e.message for e in validator(kind).iter_errors(plan)], [])

    def test_refuse_with_the_program(self):
        mistakes = {
            ("sweep", SWEEP): [
                ("strain_top10", "strain_topp10"),                # no measure
                ("@2500", "@deep"),
                ("rollover_tilt_deg@2500", "log_of_events@2500"),
                ("values", "valuess"),
                ("values = [0.0, 0.2]", "values = []"),
                ("values = [0.0, 0.2]", "values = [0.0]\nrange = [0.0, 0.2]"),
                ("scene =", "seeds = 0\nscene ="),
                ("scene = \"lis1\"\n", ""),
                ("scene =", "design = \"random\"\nscene =")],
            ("validation", VALIDATION): [
                ("rollover_tilt_deg", "rollover_tilt"),
                ("least", "lest"),
                ("at_m = [1000.0]", "at_m = [-1.0]"),
                ("what = \"tilt\"\n", ""),
                ("least = 1.0", "kind = \"guess\"")]}
        for (kind, plan), changes in mistakes.items():
            self.assertEqual(self.takes(kind, plan), (True, True))
            for old, new in changes:
                with self.subTest(kind=kind, new=new):
                    self.assertIn(old, plan)
                    self.assertEqual(self.takes(kind, plan.replace(old, new, 1)), (False, False))


if __name__ == "__main__":
    unittest.main()
