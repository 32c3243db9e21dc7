"""Runs in the drawing page, by the model in it: the same words and bits as the program's. `.ci/run page` calls it.

    LISTRIC_PROGRAM=../../build/ci/listric python3 -m unittest page_run
"""

import json
import re
import unittest

from program import SOURCES, listric
from refused_scenes import refused_scenes
from running_page import RunningPage


def without_folders(message):
    """The page has no folders, so names begin with / there and with ./ here."""
    return re.sub(r"(?<![\w.])\.?/", "", message)


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
