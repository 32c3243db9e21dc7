"""Runs that the drawing page saves: the folders that the program leaves. `.ci/run page` calls it.

    LISTRIC_PROGRAM=../../build/ci/listric python3 -m unittest page.page_save
"""

import csv
import json
import re
import unittest

from program import listric
from page.page_run import RunningPage

# Of the machine, or of the way to the result.
OF_THE_RUN = {"wall_s", "predicted_wall_s", "disc_steps_per_s", "time_by_part_s", "provenance", "cycle_level",
              "threads"}


def summary_of(folder):
    summary = json.loads((folder / "summary.json").read_text())
    return {name: value for name, value in summary.items() if name not in OF_THE_RUN}


class PageSave(RunningPage):
    METRES = 700  # ends within a window

    def test_a_finished_run_is_the_folder_of_the_program(self):
        ended = listric("run", "short.toml", "--accuracy", "draft", "--no-figures", "--no-report", cwd=self.folder)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        native = self.folder / "out/short"
        self.script("$('run').click();")
        self.wait_for("runs.length && runs.every(run => run.summary || run.failure)")
        self.assertEqual(self.script("return runs[0].failure"), "")
        page = self.unpacked("short-seed-1")
        self.assertEqual(sorted(file.name for file in (page / "snapshots").iterdir()),
                         sorted(file.name for file in (native / "snapshots").iterdir()))
        self.assertEqual(summary_of(page), summary_of(native))
        for name in ("history.csv", "scene.toml"):
            self.assertEqual((page / name).read_text(), (native / name).read_text(), name)
        self.assert_told(summary_of(native), native)
        self.assert_reported(page, summary_of(native)["state_hash"])
        self.assert_damage_is_told(page)

    def assert_told(self, summary, native):
        """What the page shows of it."""
        rows = self.script("return [...runs[0].table.rows].map(row => [...row.cells].map(cell => cell.textContent))")
        told = dict(row[:2] for row in rows)
        self.assertEqual(told["Extension"], "700 m")
        self.assertEqual(told["Tilt of the head block"], f"{summary['rollover_tilt_deg']:.1f}°")
        self.assertIn("mass error", self.script("return runs[0].verdict.textContent"))
        history = list(csv.DictReader((native / "history.csv").read_text().splitlines()))
        chart = self.script("""
            $("charted").value = "basin_area_m2";
            $("charted").onchange();
            return [runs[0].history.basin_area_m2, $("chart").textContent, $("chart").querySelectorAll("circle").length];""")
        self.assertEqual(chart[0], [float(row["basin_area_m2"]) for row in history])
        self.assertRegex(chart[1], r"extension \(km\)Basin area \(km²\)")
        self.assertEqual(chart[2], len(history))

    def assert_reported(self, folder, state_hash):
        ended = listric("report", folder.name, cwd=self.folder)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        data = re.search(r'id="data">(.*?)</script>', (folder / "report.html").read_text(), re.DOTALL)[1]
        run = json.loads(data)["runs"][0]
        self.assertEqual(run["summary"]["state_hash"], state_hash)
        self.assertEqual(len(run["moments"]), 3)

    def assert_damage_is_told(self, folder):
        snapshot = folder / "snapshots/extension-00500.00m.h5"
        whole = snapshot.read_bytes()
        snapshot.write_bytes(whole[:5000] + bytes([whole[5000] ^ 1]) + whole[5001:])
        ended = listric("report", folder.name, cwd=self.folder)
        self.assertIn("is damaged", ended.stdout)
        snapshot.write_bytes(whole[:5000])
        ended = listric("report", folder.name, cwd=self.folder)
        self.assertRegex(ended.stdout, "extension-00500.00m.h5: .*truncated")
        ended = listric("report", "downloads/short-seed-1.zip", cwd=self.folder)
        self.assertEqual(ended.returncode, 4)
        self.assertIn("unpack it first", ended.stdout)

    def test_the_program_goes_on_with_one_that_was_stopped(self):
        self.script("$('seeds').value = 1; $('run').click();")
        self.wait_for("runs[0]?.travel > 20")
        self.script("$('run_stop').click();")
        self.wait_for("runs[0].isStopped")
        folder = self.unpacked("short-seed-1")
        self.assertIn("--resume", self.script("return $('run_state').textContent"))
        ended = listric("run", "short-seed-1/scene.toml", "--resume", "--output", "short-seed-1", "--no-figures",
                        "--no-report", cwd=self.folder)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.script("$('run_stop').click();")
        self.wait_for("runs[0].summary || runs[0].failure")
        self.assertEqual(json.loads((folder / "summary.json").read_text())["state_hash"],
                         self.script("return runs[0].moment.state_hash"))


if __name__ == "__main__":
    unittest.main()
