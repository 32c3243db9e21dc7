"""Scenes, plans and points of odd shapes end in a sentence, quickly, whatever they ask for.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest odd_shapes_test
"""

import json
import os
import resource
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from program import NO_FIGURES, PROGRAM

PLAN = """scene = "lis1"
accuracy = "draft"
seeds = 1000
design = "latin-hypercube"
samples = 100000
measures = ["strain_top10"]
[[vary]]
parameter = "fault_weakening.friction"
range = [0.0, 0.3]
"""
SMALL = """[hanging_wall]
length_m = 4000.0
thickness_m = 2000.0
mean_radius_m = 60.0
[detachment]
start_dip_deg = 60.0
segments = [{arc = {radius_m = 4000.0, end_dip_deg = 0.0}}, {line = {length_m = 8000.0}}]
[extension]
distance_m = 400.0
speed_m_per_s = 10.0
ramp_s = 1.0
[gravity]
[sedimentation]
interval_a = 5000.0
[output]
interval_m = 100.0
figures_at_m = []
"""


def listric(*words, **options):
    return subprocess.run([PROGRAM, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, errors="replace", timeout=60, env=os.environ | NO_FIGURES, **options)


class OddShapes(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def file(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def test_toml_of_any_depth_is_refused(self):
        deep = ".".join("a" * 300_000)
        files = [self.file("keys.toml", f"{deep} = 1\n"), self.file("header.toml", f"[{deep}]\n"),
                 self.file("brackets.toml", "a = " + "[" * 300_000),
                 self.file("plan.toml", f'scene = "lis1"\nvary.{deep} = 1\n'),
                 self.file("material.toml", f"[material]\n{deep} = 1\n")]
        ended = listric("check", *files)
        self.assertEqual(ended.returncode, 2, ended.stderr)
        self.assertEqual(ended.stdout.count("nested too deep"), len(files), ended.stdout[-1000:])
        self.assertIn("plan.toml:2: ", ended.stdout)
        ended = listric("explain", "lis1", "--set", ".".join("a" * 60_000) + "=1")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("nested too deep", ended.stderr)
        self.assertLess(len(ended.stderr), 500)

    def test_json_of_any_depth_is_no_summary(self):
        run = self.folder / "run"
        made = listric("run", self.file("small.toml", SMALL), "--until", "0m", "--no-report",
                       "--quiet", "--output", run)
        self.assertEqual(made.returncode, 0, made.stderr)
        for text in ("[" * 300_000 + "]" * 300_000, '{"a":' * 300_000 + "1" + "}" * 300_000):
            (run / "summary.json").write_text(text)
            ended = listric("report", run)
            self.assertIn(ended.returncode, (0, 2, 4), ended.stderr[-500:])
            ended = listric("run", run / "scene.toml", "--until", "0m", "--no-report", "--quiet",
                            "--output", run, "--resume")
            self.assertEqual(ended.returncode, 0, ended.stderr[-500:])

    def test_points_on_a_line_and_far_away_are_traced_or_refused(self):
        def traced(*rows):
            return listric("trace", self.file("points.csv", "x_m,depth_m,dx_m,ddepth_m\n" + "".join(
                f"{','.join(map(str, row))}\n" for row in rows)))

        grid = [(x, y, 0, 0) for x in range(0, 200, 10) for y in range(0, 100, 10)]
        for rows in ([(x, 5, x % 3, 0) for x in range(100)], [(5, y, 0, y % 3) for y in range(100)],
                     [(x, x, x % 3, 0) for x in range(100)], [(5, 5, k, k) for k in range(100)],
                     [(1e8 + 1e-7 * k, 5, 0, 0) for k in range(100)]):
            ended = traced(*rows)
            self.assertEqual((ended.returncode, ended.stdout.strip()), (0, "[]"), ended.stderr)
        for far in ((1e18, 5, 0, 0), (5, 1e300, 0, 0), (5, 5, -1e300, 0), (5, 5, 0, 1.7e308),
                    (1e8, 1e8, 0, 0)):
            ended = traced(*grid, far)
            self.assertEqual(ended.returncode, 2, (far, ended.stderr))
            self.assertIn("points.csv: has ", ended.stderr)

    def test_a_plan_of_too_many_runs_is_refused(self):
        plan = self.file("plan.toml", PLAN)
        for command in ("check", "sweep"):
            ended = listric(command, plan, cwd=self.folder)
            self.assertEqual(ended.returncode, 2)
            self.assertIn(f"{plan}:5: samples: makes 100000000 runs", ended.stdout + ended.stderr)

    def test_what_a_scene_will_make_is_told_or_refused(self):
        told = listric("explain", "lis1", "--set", "output.interval_m=0.5").stdout
        self.assertRegex(told, r"20001 snapshots, 1\d\d GB of disk")
        self.assertRegex(listric("check", "lis1").stdout, r"21 snapshots, \d+ MB of disk")
        high = self.file("high.toml", SMALL.replace("[sedimentation]", "[sedimentation]\nlevel_m = 100000.0"))
        for words in (("check", high), ("run", high, "--output", self.folder / "high")):
            ended = listric(*words)
            self.assertEqual(ended.returncode, 2)
            self.assertIn(f"{high}:14: sedimentation.level_m: 100000 makes a run that fills the basin",
                          ended.stdout + ended.stderr)
        low = self.file("low.toml", SMALL.replace("[sedimentation]", "[sedimentation]\nlevel_m = -2000.0"))
        ended = listric("check", low)
        self.assertEqual(ended.returncode, 2)
        self.assertIn(f"{low}:14: sedimentation.level_m: is -2000", ended.stdout)

    def test_a_deep_fill_stops_when_asked(self):
        scene = self.file("high.toml", SMALL.replace("[sedimentation]", "[sedimentation]\nlevel_m = 100000.0"))
        log, status = self.folder / "told.txt", self.folder / "out/status.json"
        with open(log, "w") as told:
            run = subprocess.Popen([PROGRAM, "run", scene, "--force-size", "--no-report", "--output",
                                    self.folder / "out"], stderr=told)
        end = time.monotonic() + 40
        while time.monotonic() < end and run.poll() is None and not (
                status.exists() and '"extension"' in status.read_text()):
            time.sleep(0.05)
        time.sleep(1.0)  # the first fill, of a minute, has begun
        self.assertIsNone(run.poll(), log.read_text())
        run.send_signal(signal.SIGINT)
        self.assertEqual(run.wait(timeout=40), 130, log.read_text())
        self.assertIn("stopped", log.read_text())
        self.assertEqual(json.loads(status.read_text())["phase"], "stopped")

    def test_erosion_of_all_is_no_matter_of_the_time_step(self):
        scene = self.file("eroded.toml", SMALL.replace(
            "[sedimentation]", "[sedimentation]\ntarget = [[-1000.0, 0.0], [-900.0, -3000.0]]"))
        ended = listric("run", scene, "--no-report", "--quiet", "--output", self.folder / "out")
        self.assertEqual(ended.returncode, 3)
        self.assertIn("below the whole hanging wall", ended.stderr)
        self.assertNotIn("time step", ended.stderr)

    def test_a_report_without_memory_says_so(self):
        run = self.folder / "run"
        made = listric("run", self.file("small.toml", SMALL), "--until", "200m", "--no-report",
                       "--quiet", "--output", run)
        self.assertEqual(made.returncode, 0, made.stderr)
        for megabytes in range(40, 76, 4):
            size = megabytes << 20
            ended = listric("report", run, preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_AS, (size, size)))
            self.assertIn(ended.returncode, (0, 4, 127), (megabytes, ended.stderr[-300:]))
            if ended.returncode == 4:
                self.assertIn("listric: ", ended.stderr)


if __name__ == "__main__":
    unittest.main()
