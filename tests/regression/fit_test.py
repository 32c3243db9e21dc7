"""`listric fit`: from picks to a scene, by kinematics and by runs of a small block; what it refuses.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest fit_test

The runs, 15 and two of 400 discs over 300 m, take 20 s.
"""

import csv
import json
import subprocess
import tempfile
import unittest
from pathlib import Path

from program import PROGRAM

SCENE = """[hanging_wall]
length_m = 4000.0
thickness_m = 1500.0
mean_radius_m = 80.0
[detachment]
segments = [{arc = {radius_m = 1500.0, end_dip_deg = 0.0}}, {line = {length_m = 6000.0}}]
[extension]
distance_m = 300.0
speed_m_per_s = 4.0
ramp_s = 2.0
[output]
interval_m = 100.0
figures_at_m = []
series = "none"
[gravity]
[bonds]
[sedimentation]
interval_a = 10000.0
"""
HEAD = "name,x_m,depth_m,age_a\n"
TOP = "".join(f"top,{x},{max(20, 300 - 0.12 * (x - 300)):.0f},30000\n" for x in range(300, 2700, 200))
MIDDLE = "".join(f"h1,{x},{max(10, 110 - 0.06 * (x - 300)):.0f},10000\n" for x in range(300, 1900, 200))


class Fit(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        Path(self.folder, "small.toml").write_text(SCENE)

    def fit(self, picks, *words):
        Path(self.folder, "picks.csv").write_text(picks)
        return subprocess.run([PROGRAM, "fit", "picks.csv", "--scene", "small.toml", "--output", "out", *words],
                              cwd=self.folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              env={"LISTRIC_PYTHON": "/bin/false", "XDG_CACHE_HOME": str(self.folder)})

    def check(self, file):
        return subprocess.run([PROGRAM, "check", file], cwd=self.folder, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)

    def test_kinematics_alone_leave_a_scene_that_check_accepts(self):
        ended = self.fit(HEAD + TOP + MIDDLE, "--predict-only", "--quiet")
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertIn("dip at the breakaway", ended.stdout)
        self.assertFalse(Path(self.folder, "out/runs").exists())
        answer = json.loads(Path(self.folder, "out/fit.json").read_text())
        self.assertNotIn("drafts", answer)
        self.assertEqual(answer["extension_m"], 300.0)
        for number in ("breakaway_dip_deg", "depth_m", "straight"):
            found = answer["kinematics"][number]
            self.assertLessEqual(found["low"], found["value"])
            self.assertGreaterEqual(found["high"], found["value"])
        checked = self.check("out/picks.toml")
        self.assertEqual(checked.returncode, 0, checked.stdout)
        again = self.fit(HEAD + TOP + MIDDLE, "--predict-only", "--quiet")
        self.assertEqual(again.stdout, ended.stdout)

    def test_drafts_follow_and_are_made_once(self):
        words = ("--rounds", "1", "--seeds", "2", "--jobs", "2", "--quiet")
        ended = self.fit(HEAD + TOP + MIDDLE, *words)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        with open(Path(self.folder, "out/fit.csv"), newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["round"] for row in rows], ["1"] * 15 + ["best"] * 2)
        for row in rows:  # h1 has no counterpart in some shapes
            self.assertRegex(row["outcome"], "^finished$|^horizon h1 lies outside")
            self.assertEqual(row["misfit_m"] != "", row["outcome"] == "finished")
        answer = json.loads(Path(self.folder, "out/fit.json").read_text())["drafts"]
        best = [float(row["misfit_m"]) for row in rows[15:] if row["misfit_m"]]
        self.assertAlmostEqual(answer["misfit_m"], sum(best) / len(best), places=1)
        self.assertRegex(ended.stdout, "spread over 2 seeds" if len(best) == 2 else "one seed")
        self.assertEqual(float(rows[15]["breakaway_dip_deg"]), round(answer["breakaway_dip_deg"]["value"], 3))
        self.assertEqual(self.check("out/picks.toml").returncode, 0)
        summaries = {file: file.stat().st_mtime_ns for file in self.folder.glob("out/runs/*/summary.json")}
        self.assertEqual(len(summaries), 17)
        self.assertEqual(self.fit(HEAD + TOP + MIDDLE, *words).stdout, ended.stdout)
        self.assertEqual({file: file.stat().st_mtime_ns for file in summaries}, summaries)

        # Corrected picks are another fit; this one's answer stays.
        answers = {file: file.read_bytes() for file in self.folder.glob("out/*.*")}
        other = self.fit(HEAD + TOP.replace("top,300,300,", "top,300,295,") + MIDDLE, *words)
        self.assertEqual(other.returncode, 2, other.stderr)
        self.assertIn("has other parameters", other.stderr)
        self.assertEqual({file: file.read_bytes() for file in answers}, answers)

    def assert_refused(self, picks, *parts, words=()):
        ended = self.fit(picks, "--predict-only", "--quiet", *words)
        self.assertEqual(ended.returncode, 2, ended.stdout + ended.stderr)
        self.assertEqual(len(ended.stderr.splitlines()), 1, ended.stderr)
        for part in parts:
            self.assertIn(part, ended.stderr)

    def test_bad_picks_are_refused_with_their_line(self):
        self.assert_refused("name,x_m,depth_m\n" + "a,300,200\n", "picks.csv:2", "age_a")
        self.assert_refused(HEAD + TOP + "late,400,100,40000\n", "picks.csv:14", "age_a = 40000", "30000")
        self.assert_refused(HEAD + TOP, "picks.csv:1", "two ages")
        self.assert_refused(HEAD + "top,300,deep,30000\n", "picks.csv:2", "depth_m")
        self.assert_refused("name,x_m,age_a\n", "picks.csv:1", "depth_m")
        in_ka = (HEAD + TOP + MIDDLE).replace(",30000\n", ",30\n").replace(",10000\n", ",10\n")
        self.assert_refused(in_ka, "picks.csv:2", "is it in years")

    def test_nothing_is_written_over(self):
        Path(self.folder, "picks.toml").write_text("# mine\n" + SCENE)
        self.assert_refused(HEAD + TOP + MIDDLE, "picks.toml", "is read by this call",
                            words=("--scene", "picks.toml", "--output", "."))
        Path(self.folder, "fit.csv").write_text("mine\n")
        Path(self.folder, "picks.toml").unlink()
        self.assert_refused(HEAD + TOP + MIDDLE, "fit.csv", "is no file of such a call", words=("--output", "."))
        self.assertEqual(Path(self.folder, "fit.csv").read_text(), "mine\n")
        answer = Path(self.folder, "out/fit.json")
        answer.parent.mkdir()
        answer.write_text(json.dumps({"picks": "/elsewhere/picks.csv", "kinematics": {}}))
        self.assert_refused(HEAD + TOP + MIDDLE, "is the answer to other picks, /elsewhere/picks.csv")

    def test_scenes_with_stages_are_refused(self):
        self.assert_refused(HEAD + TOP + MIDDLE, "has stages", words=("--scene", "inversion-lis1"))

    def test_scenes_without_a_detachment_of_their_own_are_refused(self):
        self.assert_refused(HEAD + TOP + MIDDLE, "pure-shear", "[detachment]", words=("--scene", "pure-shear"))


if __name__ == "__main__":
    unittest.main()
