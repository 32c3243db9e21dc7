"""Calls that a newcomer makes around a run: new, diff, cite, view.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest front_door_test
"""

import subprocess
import tempfile
import unittest
from pathlib import Path

from program import PROGRAM, SOURCES


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
