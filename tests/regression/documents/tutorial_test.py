"""The ten commands of docs/start/your-own-section.md, as they stand there, and what they leave.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest tutorial_test
"""

import csv
import json
import re
import tempfile
import unittest
from pathlib import Path

from documents.document_commands import commands, run


class Tutorial(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.out = Path(folder.name, "out/tutorial")
        cls.calls = commands("docs/start/your-own-section.md", "All of it in ten commands")
        cls.ended = [run(call, "out/tutorial", cls.out, figures=not re.search("/(second|weak)$", call))
                     for call in cls.calls]

    def summary(self, run):
        return json.loads(Path(self.out, run, "summary.json").read_text())

    def test_ten_calls_end_well(self):
        self.assertEqual(len(self.calls), 10)
        for call, ended in zip(self.calls, self.ended):
            with self.subTest(call):
                self.assertEqual(ended.returncode, 0, ended.stdout)

    def test_fault_is_fitted_and_told(self):
        self.assertIn("correct", self.ended[1].stdout)
        self.assertRegex(self.ended[2].stdout, r"detachment: \d+ arcs and lines through \d+ points")
        self.assertLess(self.summary("run")["detachment_misfit_m"], 50.0)  # tolerance_m's default

    def test_picks_are_compared(self):
        with open(self.out / "picks.csv", newline="") as file:
            names = {row["name"] for row in csv.DictReader(file)}
        observed = self.summary("run")["observed"]
        self.assertEqual({one["name"] for one in observed}, names)
        for one in observed:
            self.assertLessEqual(one["mean_m"], one["largest_m"])
            self.assertGreater(one["points_compared"], 10)  # of 38; the basin does not reach all

    def test_other_runs_are_others(self):
        runs = [self.summary(name) for name in ("run", "second", "weak")]
        self.assertEqual(len({one["state_hash"] for one in runs}), 3)
        self.assertEqual([one["seed"] for one in runs], [1, 2, 1])

    def test_lines_and_figures_are_there(self):
        for k, kind in ((5, "horizons"), (6, "faults"), (7, "surfaces")):
            files = self.ended[k].stdout.splitlines()
            self.assertEqual(len(files), 13)  # every 500 m
            for name in files:
                self.assertTrue(Path(name).name.startswith(kind), name)
                self.assertTrue(Path(name).is_file(), name)
        for name in ("underlay-6.0km-*.png", "strata-6.0km.png"):
            [picture] = Path(self.out, "run/figures").glob(name)
            self.assertGreater(picture.stat().st_size, 20000)


if __name__ == "__main__":
    unittest.main()
