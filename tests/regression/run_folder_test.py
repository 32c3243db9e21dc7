"""The folder of a run: stopped and resumed as if it never was, other runs' and users' files, names.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest run_folder_test
"""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from program import PROGRAM, SOURCES

sys.dont_write_bytecode = True
sys.path.insert(0, str(SOURCES / "apps/python"))
import listric

# Some 370 discs.
SCENE = """
[hanging_wall]
length_m = 12000.0
thickness_m = 3000.0
mean_radius_m = 150.0
[detachment]
start_dip_deg = 60.0
segments = [{arc = {radius_m = 6000.0, end_dip_deg = 0.0}}, {line = {length_m = 20000.0}}]
[extension]
distance_m = 800.0
speed_m_per_s = 4.0
ramp_s = 2.0
[gravity]
[bonds]
[bond_healing]
[sedimentation]
interval_a = 5000.0
[output]
interval_m = 100.0
figures_at_m = [300.0]
"""

# An analogue box of 40 cm.
BOX = """
[hanging_wall]
length_m = 0.40
thickness_m = 0.10
mean_radius_m = 0.004
[detachment]
start_dip_deg = 60.0
segments = [{arc = {radius_m = 0.20, end_dip_deg = 0.0}}, {line = {length_m = 1.0}}]
[extension]
distance_m = 0.04
speed_m_per_s = 0.02
ramp_s = 0.1
[material]
normal_stiffness_pa = 1e8
shear_stiffness_pa = 1e8
friction = 0.6
[gravity]
[output]
interval_m = 0.004
figures_at_m = []
"""

TIMES = ("threads", "ranks", "wall_s", "predicted_wall_s", "disc_steps_per_s", "time_by_part_s",
         "cycle_level")

# What somebody may keep in a run's folder and beside it.
MINE = """notes.txt base.csv 2024.part thesis.2024.part picks.csv my.toml
    snapshots/reference-packing.h5 snapshots/extension-1m.h5 snapshots/mine.7.part
    snapshots/._extension-00000.00m.h5
    figures/map-25km.png figures/fig3-10km.pdf figures/base.png figures/.data-backup/a
    figures/strata-final.png export/spectrum.csv export/wells-m.geojson export/outcrop_m.csv
    export/horizons-extension-00000.00m-old.csv paraview/seismic-line.vtp
    paraview/footwall-section.vtu ../base.csv ../export/discs.gsd""".split()


def without_times(summary):
    return {name: value for name, value in summary.items() if name not in TIMES}


class RunFolders(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.room = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.room.cleanup)
        cls.folder = Path(cls.room.name)
        # Pictures take longer than these runs.
        cls.environment = os.environ | {"LISTRIC_PYTHON": "/bin/false",
                                        "XDG_CACHE_HOME": str(cls.folder / "cache")}
        os.environ["LISTRIC_PROGRAM"] = str(PROGRAM)
        (cls.folder / "small.toml").write_text(SCENE)
        (cls.folder / "box.toml").write_text(BOX)
        cls.whole = cls.folder / "whole"
        cls.made("small.toml", "--until", "460m", "--output", cls.whole)

    @classmethod
    def call(cls, *words):
        return subprocess.run([PROGRAM, *map(str, words)], cwd=cls.folder, env=cls.environment,
                              capture_output=True, text=True, timeout=120)

    @classmethod
    def made(cls, scene, *words):
        ended = cls.call("run", scene, "--threads", 1, "--quiet", *words)
        assert ended.returncode == 0, ended.stderr
        return ended

    def assertRefused(self, ended, *texts):
        self.assertEqual(ended.returncode, 2, ended.stderr)
        for text in texts:
            self.assertIn(str(text), ended.stderr)

    def assertSameRun(self, run, whole):
        one, other = (json.loads((folder / "summary.json").read_text()) for folder in (run, whole))
        self.assertEqual(without_times(one), without_times(other))
        for name in ("history.csv", "paraview.pvd", "scene.toml"):
            self.assertEqual((run / name).read_bytes(), (whole / name).read_bytes(), name)
        for part in ("paraview", "snapshots", "figures"):
            names = [sorted(file.name for file in (folder / part).glob("*")) for folder in (run, whole)]
            self.assertEqual(*names)
        for file in (whole / "paraview").iterdir():
            self.assertEqual((run / "paraview" / file.name).read_bytes(), file.read_bytes(), file)
        self.assertEqual(*map(self.report_of, (run, whole)))

    def report_of(self, run):
        """The data of a report but times."""
        page = (run / "report.html").read_text()
        data = json.loads(re.search(r'<script[^>]*id="data"[^>]*>(.*?)</script>', page, re.DOTALL)[1])
        for one in data["runs"]:
            one["summary"] = without_times(one["summary"])
        return data

    # ---------------------------------------------------------------------------------- resumed

    def test_stopped_and_resumed_is_as_if_it_never_was(self):
        for threads, stops in ((2, (20, 183, 305)), (1, (75, 85, 390))):
            run = self.folder / f"stopped {threads}"
            for stop in (*stops, 460):
                self.made("small.toml", "--until", f"{stop}m", "--output", run, "--threads", threads,
                          "--resume")
            with self.subTest(stops=stops):
                self.assertSameRun(run, self.whole)

    def test_faults_of_a_stopped_and_resumed_run(self):
        """A stop, 230 m before the end of a window of 250 m, is no start of the last window."""
        lis1 = ("lis1", "--accuracy", "draft", "--set", "hanging_wall.mean_radius_m=300", "--set",
                "output.interval_m=250", "--set", "extension.speed_m_per_s=6", "--resume", "--output")
        whole, run = self.folder / "lis1", self.folder / "lis1 in parts"
        self.made(*lis1, whole, "--until", "1km")
        for stop in (480, 770, 1000):
            self.made(*lis1, run, "--until", f"{stop}m", "--threads", 2)
        self.assertSameRun(run, whole)
        self.assertTrue(json.loads((run / "summary.json").read_text())["faults"])
        for folder in (run, whole):
            for kind in ("faults", "horizons"):
                self.assertEqual(self.call("export", kind, folder).returncode, 0)
        for file in (whole / "export").iterdir():
            self.assertEqual((run / "export" / file.name).read_bytes(), file.read_bytes(), file)

    def test_interrupted_and_killed_is_as_if_it_never_was(self):
        run = self.folder / "interrupted"
        words = [PROGRAM, "run", "small.toml", "--until", "460m", "--output", str(run), "--threads", "1",
                 "--resume", "--quiet"]
        for number, ending in ((2, signal.SIGINT), (4, signal.SIGKILL), (5, signal.SIGTERM)):
            process = subprocess.Popen(words, cwd=self.folder, env=self.environment,
                                       stderr=subprocess.DEVNULL)
            while process.poll() is None and len(list(run.glob("snapshots/*.h5"))) < number:
                time.sleep(0.002)
            process.send_signal(ending)
            process.wait()
        self.made("small.toml", "--until", "460m", "--output", run, "--resume")
        self.assertSameRun(run, self.whole)

    def test_old_snapshots_of_stops_are_passed_over(self):
        """As earlier programs left them."""
        run, stopped = self.folder / "old", self.folder / "stop"
        shutil.copytree(self.whole, run)
        self.made("small.toml", "--until", "230m", "--output", stopped)
        stop = next((stopped / "snapshots").glob("*-00230.*"))
        shutil.copy(stop, run / "snapshots")
        shutil.rmtree(run / "export", ignore_errors=True)
        printed = self.call("export", "surfaces", run).stdout
        self.assertNotIn("00230", printed)
        self.assertEqual(len(listric.Run(run).snapshots), 6)
        (run / "summary.json").unlink()
        self.made("small.toml", "--until", "460m", "--output", run, "--resume")
        self.assertSameRun(run, self.whole)

    # --------------------------------------------------------------------------- other runs' files

    def test_another_runs_snapshots_are_refused(self):
        run = self.folder / "mixed"
        shutil.copytree(self.whole, run)
        for name in ("scene.toml", "summary.json"):
            (run / name).unlink()
        words = ("run", "small.toml", "--seed", "7", "--quiet", "--output", run, "--until", "60m")
        self.assertRefused(self.call(*words), run, "holds an unfinished run", "--force")
        snapshots = run / "snapshots"
        self.assertRefused(self.call(*words, "--resume"), snapshots, "seed = 1 there, 7 in this call",
                           "--force")
        # One among its own, its own scene beside it.
        other = self.folder / "other"
        self.made("small.toml", "--set", "hanging_wall.porosity=0.18", "--until", "0", "--output", other)
        first = "extension-00000.00m.h5"
        shutil.copy(other / "snapshots" / first, snapshots / first)
        ended = self.call("run", "small.toml", "--quiet", "--output", run, "--resume")
        self.assertRefused(ended, snapshots / first, "hanging_wall.porosity = 0.18 there, 0.175")
        shutil.copy(self.whole / "scene.toml", run)
        for words in (("export", "faults"), ("figures",), ("report",)):
            self.assertRefused(self.call(*words, run), first, "another run", "hanging_wall.porosity")
        with self.assertRaisesRegex(listric.RunError, "hanging_wall.porosity = 0.18"):
            listric.Run(run).snapshots
        # A scene that is not that of the snapshots.
        shutil.copy(other / "scene.toml", run)
        (snapshots / first).unlink()
        self.assertRefused(self.call("export", "faults", run), run / "scene.toml", "porosity")

    def test_a_resumed_run_gets_its_scene_and_history_back(self):
        run = self.folder / "bare"
        shutil.copytree(self.whole, run)
        for name in ("scene.toml", "summary.json", "history.csv", "report.html"):
            (run / name).unlink()
        self.made("small.toml", "--until", "460m", "--output", run, "--resume")
        self.assertSameRun(run, self.whole)

    # ------------------------------------------------------------------------------- users' files

    def test_users_files_stay(self):
        place = self.folder / "place"
        run = place / "out"
        self.made("small.toml", "--until", "100m", "--output", run)
        for name in MINE:
            file = run / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(f"mine: {name}")
        (run / "snapshots/extension-00033.00m.h5").mkdir()
        (run / "snapshots/extension-00033.00m.h5/inside").write_text("mine")
        shared = place / "shared"
        shutil.move(run / "figures", shared)
        (run / "figures").symlink_to(shared)
        mine = [run / name for name in MINE] + [run / "snapshots/extension-00033.00m.h5/inside"]

        def assertAllThere(after):
            for file in mine:
                self.assertTrue(file.exists() and file.read_text().startswith("mine"), f"{after}: {file}")

        small = ("run", "small.toml", "--quiet", "--threads", 1, "--output", run)
        for words in ((*small, "--until", "130m", "--resume"), (*small, "--until", "200m", "--resume"),
                      ("export", "surfaces", run), ("report", run),
                      (*small, "--until", "50m", "--force")):
            ended = self.call(*words)
            self.assertEqual(ended.returncode, 0, ended.stderr)
            assertAllThere(words)
        self.assertEqual(self.call("figures", run).returncode, 2)  # no Python
        assertAllThere("figures")
        self.assertEqual(list((run / "export").glob("surfaces-*")), [])
        self.assertEqual(len(list((run / "snapshots").glob("extension-0*.??m.h5"))), 3)

    def test_what_a_run_would_write_over_is_refused(self):
        run = self.folder / "theirs"
        run.mkdir()
        for name in ("history.csv", "log.txt", "scene.toml"):
            (run / name).write_text("mine")
            ended = self.call("run", "small.toml", "--until", "0", "--output", run, "--force")
            self.assertRefused(ended, run / name, "--output")
            self.assertEqual((run / name).read_text(), "mine")
            (run / name).unlink()
        summary = (self.whole / "summary.json").read_bytes()
        self.assertRefused(self.call("laboratory", "uniaxial", "mat18-b", "--output", self.whole),
                           self.whole, "holds a run")
        self.assertEqual((self.whole / "summary.json").read_bytes(), summary)

    def test_the_scene_that_is_read_stays(self):
        run = self.folder / "own"
        run.mkdir()
        scene = run / "scene.toml"
        scene.write_text(SCENE)
        for words in ((), ("--force",), ("--resume",)):
            ended = self.call("run", scene, "--until", "0", "--output", run, *words)
            self.assertRefused(ended, scene, "--output")
            self.assertEqual(scene.read_text(), SCENE)
        picks = run / "history.csv"
        picks.write_text("name,x_m,depth_m\nTop,1000,500\nTop,2000,600\n")
        (self.folder / "picked.toml").write_text(SCENE + '[observed]\nhorizons = "own/history.csv"\n')
        scene.unlink()
        ended = self.call("run", "picked.toml", "--until", "0", "--output", run, "--force")
        self.assertRefused(ended, picks.relative_to(self.folder))
        self.assertTrue(picks.read_text().startswith("name"))
        # A run's own scene says the same again: it stays, with what was noted in it.
        copy = self.folder / "copy"
        self.made("small.toml", "--until", "0", "--output", copy)
        noted = (copy / "scene.toml").read_text() + "# mine\n"
        (copy / "scene.toml").write_text(noted)
        self.made(copy / "scene.toml", "--until", "0", "--output", copy, "--force")
        self.assertEqual((copy / "scene.toml").read_text(), noted)

    # -------------------------------------------------------------------------------------- names

    def test_moments_of_a_small_model_have_names_of_their_own(self):
        run = self.folder / "box"
        ended = self.call("run", "box.toml", "--until", "0.0105m", "--threads", 1, "--output", run)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("10.50 mm of extension", ended.stderr)
        names = {file.name for file in (run / "snapshots").iterdir()}
        self.assertLess({f"extension-{name}m.h5" for name in ("00000.00", "00000.004", "00000.008")},
                        names)
        self.assertEqual(len(names), 4)  # and the end
        self.made("box.toml", "--until", "0.02m", "--output", run, "--resume")
        snapshots = listric.Run(run).snapshots
        rows = len((run / "history.csv").read_text().splitlines()) - 1
        self.assertEqual((len(snapshots), rows), (6, 6))
        for k, snapshot in enumerate(snapshots):
            self.assertAlmostEqual(snapshot.extension_m, 0.004 * k, delta=1e-4)
        times = re.findall(r'timestep="([^"]*)" part="0"', (run / "paraview.pvd").read_text())
        self.assertEqual(len(set(times)), 6)
        printed = self.call("export", "surfaces", run, "--at", "0.008m").stdout.split()
        self.assertEqual([Path(name).name for name in printed],
                         ["surfaces-extension-00000.008m.csv"])
        whole = self.folder / "whole box"
        self.made("box.toml", "--until", "0.02m", "--output", whole)
        self.assertSameRun(run, whole)

    def test_every_extension_once_where_windows_are_shorter_than_a_cycle(self):
        run = self.folder / "dense"
        self.made("small.toml", "--set", "output.interval_m=0.01", "--set", "output.series=none",
                  "--no-report", "--until", "1m", "--output", run)
        rows = (run / "history.csv").read_text().splitlines()[1:]
        extensions = [row.split(",")[0] for row in rows]
        self.assertEqual(len(set(extensions)), len(extensions))
        self.assertEqual(len(list((run / "snapshots").iterdir())), len(extensions))


if __name__ == "__main__":
    unittest.main()
