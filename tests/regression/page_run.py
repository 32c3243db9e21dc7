"""Runs in the drawing page, by the model in it: the same words and bits as the program's. `.ci/run page` calls it.

    LISTRIC_PROGRAM=../../build/ci/listric python3 -m unittest page_run
"""

import json
import re
import time
import unittest
import zipfile

from browsed import Browsed
from program import SOURCES, listric
from refused_scenes import refused_scenes


def without_folders(message):
    """The page has no folders, so names begin with / there and with ./ here."""
    return re.sub(r"(?<![\w.])\.?/", "", message)


class RunningPage(Browsed):
    """The drawing page with a short scene, to run it there."""

    METRES = 500

    @classmethod
    def setUpClass(cls):
        cls.make_folders()
        scene = (SOURCES / "apps/scenes/lis1.toml").read_text()
        assert "distance_m = 10000.0" in scene
        (cls.folder / "short.toml").write_text(scene.replace("distance_m = 10000.0", f"distance_m = {cls.METRES}.0"))
        assert listric("draw", "short.toml", cwd=cls.folder).returncode == 0
        cls.open_browser(1200, 1400)

    def setUp(self):
        self.assertEqual(self.visit((self.folder / "short-drawing.html").as_uri()), "true")

    def wait_for(self, what, seconds=600):
        end = time.monotonic() + seconds
        while not (found := self.script(f"return {what}")):
            self.assertLess(time.monotonic(), end, f"{what}: {self.script('return document.body.innerText')}")
            time.sleep(0.1)
        return found

    def saved(self, name):
        """A file that the page has saved, once it is whole."""
        path = self.downloads / name
        for _ in range(600):
            if path.exists():
                return path
            time.sleep(0.05)
        self.fail(f"{name} is not saved; there are {sorted(path.name for path in self.downloads.iterdir())}")

    def unpacked(self, name):
        """The folder in a zip that the page saves."""
        self.script("$('save_run').click();")
        with zipfile.ZipFile(self.saved(f"{name}.zip")) as packed:
            self.assertIsNone(packed.testzip())
            packed.extractall(self.folder)
        return self.folder / name


class PageRun(RunningPage):
    def test_runs_to_the_hash_of_the_program(self):
        ended = listric("run", "short.toml", "--accuracy", "draft", "--seed", "2", "--no-figures", "--no-report", cwd=self.folder)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        summary = json.loads((self.folder / "out/short/summary.json").read_text())
        self.script("$('seeds').value = 2; $('run').click();")
        self.wait_for("runs.some(run => run.discs)")
        self.script("$('run_stop').click();")
        self.wait_for("runs.every(run => run.isStopped || run.summary)")
        self.script("$('run_stop').click();")
        self.wait_for("runs.every(run => run.summary || run.failure)")
        first, second = self.script("""
            return runs.map(({failure, moment, summary}) => ({failure, hash: moment.state_hash, summary}));""")
        self.assertEqual((first["failure"], second["failure"]), ("", ""))
        self.assertNotEqual(first["hash"], second["hash"])
        self.assertEqual(second["hash"], summary["state_hash"])
        for name in ("basin_area_m2", "strain_top10", "rollover_tilt_deg", "faults"):
            self.assertEqual(second["summary"].get(name), summary.get(name), name)
        self.assertIn("listric run ./short.toml --accuracy draft --seed 2", self.script("return $('run_state').textContent"))

    def test_scenes_are_refused_in_the_words_of_check(self):
        checked = 0
        for case, text in refused_scenes().items():
            (self.folder / "case.toml").write_text(text)
            ended = listric("check", "./case.toml", cwd=self.folder)
            if "mesh_file" in text or ended.returncode == 0:
                continue
            verdict = self.script("""
                if (!window.reader) {
                  window.reader = new Worker(workerUrl);
                  reader.postMessage({load: await moduleBytes()});
                }
                reader.postMessage({check: {files: {...facts.files, "/case.toml": a[0]}, request: {scene: "/case.toml"}}});
                const data = await new Promise(done => { reader.onmessage = event => (event.data.failed || event.data.read) && done(event.data); });
                return data.failed ? asOfFile(data.failed) : "no fault";""", text)
            with self.subTest(case):
                self.assertEqual(without_folders(verdict), without_folders(ended.stdout.strip().removeprefix("listric: ")))
            checked += 1
        self.assertGreater(checked, 40)

    def test_an_elastic_base_is_sent_to_the_program(self):
        elastic = (SOURCES / "apps/scenes/lis1-elastic.toml").read_text()
        self.script("takeSceneFile(a[0], 'elastic.toml'); $('run').click();", elastic)
        self.assertIn("run this scene with the program", self.wait_for("runs[0]?.failure"))

    def test_asks_nothing_of_the_network(self):
        self.wait_for("checker.verdict")
        self.assertEqual(self.script("return $('run_state').textContent"), "")  # the model is of these sources
        self.assertIn("The program finds no fault", self.script("return $('state').textContent"))
        errors = [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(errors, [])


if __name__ == "__main__":
    unittest.main()
