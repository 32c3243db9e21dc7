"""Calls that a newcomer makes around a run: new, diff, cite, view.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest front_door_test
"""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from program import NO_FIGURES, PROGRAM, SOURCES


class FrontDoor(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)

    def call(self, *words, code=0, **options):
        """Standard output and error."""
        done = subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True, text=True,
                              check=False, stdin=subprocess.DEVNULL, **options)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout + done.stderr

    def run_briefly(self, name, *words):
        self.call("run", "lis1", "--set", "hanging_wall.mean_radius_m=400", "--until", "10m", "--no-report", "-q",
                  "-o", name, *words, env=os.environ | NO_FIGURES)

    def test_diff_shows_parameters_and_results_and_ends_with_1(self):
        self.assertEqual(self.call("diff", "lis1", "lis1"), "")
        text = self.call("diff", "lis1", "lis2-elastic", code=1)
        self.assertRegex(text, r"\ndetachment\.start_dip_deg +90 +60 +deg\n")
        self.assertRegex(text, r"\nelastic_base +off +on\n")
        self.run_briefly("a")
        self.run_briefly("b", "--set", "detachment.friction=0.1")
        self.assertEqual(self.call("diff", "a", "a"), "")
        text = self.call("diff", "a", "b", code=1)
        self.assertRegex(text, r"\ndetachment\.friction +0\.5 +0\.1\n\nresult ")
        self.assertRegex(text, r"\nbasin_area_m2 .* m2\n")
        self.assertNotIn("\nseed", text)
        self.assertIn("no folder of a run", self.call("diff", "a", ".", code=2))

    def test_cite_has_the_works_behind_the_effects_that_were_on(self):
        self.run_briefly("cited", "--without", "compaction")
        text = self.call("cite", "cited")
        program = self.call("--version").split()[1].partition("+")
        self.assertIn(f"version {program[0]}", text)
        self.assertIn("@article{seyferth_henk_2005,", text)
        self.assertIn("@manual{itasca_1999,", text)  # bonds were on
        self.assertNotIn("baldwin_butler", text)  # compaction was off
        self.assertNotIn("doi", text.lower())
        (self.folder / "cited/summary.json").unlink()
        self.assertIn("has not ended", self.call("cite", "cited", code=2))

    def test_view_shows_a_report_or_cards_of_all_runs(self):
        self.assertIn("there is no folder out", self.call("view", code=2, env=self.without_display()))
        self.run_briefly("out/one")
        self.run_briefly("out/<many>/two", "--seed", "2")
        self.assertEqual(self.call("view", "out/one", env=self.without_display()), "out/one/report.html\n")
        self.assertTrue((self.folder / "out/one/report.html").exists())
        self.assertEqual(self.call("view", env=self.without_display()), "out/index.html\n")
        page = (self.folder / "out/index.html").read_text()
        self.assertEqual(page.count("<article>"), 2)
        self.assertIn('<a href="one/report.html">out/one</a>', page)
        self.assertIn("<h2>out/&lt;many>/two</h2>", page)  # it has no report
        self.assertRegex(page, r"lis1, standard, seed 2; \d{4}-\d\d-\d\d ")
        self.assertRegex(page, r'<td title="extension_m">extension<td>[\d.]+ km\n?<')
        self.assertRegex(page, r'<td title="basin_area_m2">basin area<td>-?[\d.]+ km²')
        self.assertNotRegex(page, r"(src|href)=\"?https?:")
        self.call("view", env=self.without_display())  # again, over its own page
        (self.folder / "out/index.html").write_text("<h1>My page</h1>")
        self.assertIn("is no file of such a call", self.call("view", code=2, env=self.without_display()))
        self.assertEqual((self.folder / "out/index.html").read_text(), "<h1>My page</h1>")

    def test_check_says_warnings_in_lines_of_their_own(self):
        self.call("new", "short.toml")
        scene = self.folder / "short.toml"
        scene.write_text(re.sub(r"(?m)^#? *distance_m = .*", "distance_m = 300", scene.read_text()))
        said = self.call("check", "short.toml")
        self.assertRegex(said, r"(?m)^short.toml: correct: .*\nwarning: .*longer")
        self.assertNotIn("\\x", said)

    @staticmethod
    def without_display():
        return {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}

    def test_works_are_those_of_the_documents(self):
        listed = (SOURCES / "docs/reference/references.md").read_text()
        declared = (SOURCES / "apps/model/works.cpp").read_text()
        for name in re.findall(r"const Work \w+\{\"([A-Z]\w+)", declared):
            self.assertIn(name, listed)

    def test_new_scene_is_correct_and_replaces_nothing(self):
        for name in sorted(path.stem for path in (SOURCES / "apps/scenes").glob("*.toml")):
            self.assertEqual(self.call("new", f"of-{name}.toml", "--from", name), f"of-{name}.toml\n")
            self.assertIn(": correct: ", self.call("check", f"of-{name}.toml"))
        before = (self.folder / "of-lis1.toml").read_text()
        self.assertIn("of-lis1.toml: exists", self.call("new", "of-lis1.toml", code=2))
        self.assertEqual((self.folder / "of-lis1.toml").read_text(), before)
        self.assertIn("give my.toml", self.call("new", "my", code=2))
        self.assertIn("did you mean lis2?", self.call("new", "my.toml", "--from", "lsi2", code=2))
        self.assertFalse((self.folder / "my.toml").exists())


if __name__ == "__main__":
    unittest.main()
