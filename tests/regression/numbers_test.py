"""Numbers in calls are read as those in files are, and a table that never ends is refused.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest numbers_test
"""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from program import PROGRAM

SCENE = """accuracy = "draft"
[hanging_wall]
[detachment]
segments = [{arc = {radius_m = 15000.0, end_dip_deg = 0.0}}]
[observed]
horizons = "picks.csv"
"""


class Calls(unittest.TestCase):
    def refused(self, *words):
        done = subprocess.run([PROGRAM, *words], text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, timeout=60)
        self.assertEqual(done.returncode, 2, done.stdout)
        return done.stdout

    def test_lengths(self):
        for text, said in (("5,5km", "decimal comma; write 5.5"), ("0x10", "hexadecimal"),
                           ("1e400", "too large"), ("nan", "no value"), ("5 miles", "such as 5km")):
            self.assertIn(said, self.refused("run", "lis1", "--until", text))

    def test_options(self):
        self.assertIn("hexadecimal", self.refused("export", "faults", "out", "--at", "0x10"))
        self.assertIn("is not a finite number",
                      self.refused("figures", "out", "--underlay", "a.png", "--corners", "0,0,nan,1"))

    def test_tables(self):
        with tempfile.TemporaryDirectory() as name:
            pipe = Path(name, "points.csv")
            os.mkfifo(pipe)
            self.assertIn("is no regular file", self.refused("trace", pipe))
            scene, picks = Path(name, "s.toml"), Path(name, "picks.csv")
            scene.write_text(SCENE)
            picks.write_text("name,x_m,depth_\x1b[31mm\n")
            said = self.refused("check", scene)
            self.assertIn("depth_\\x1b[31mm", said)
            self.assertNotIn("\x1b", said)
            picks.write_text("name;x_m;depth_m\nTop;500;1000\nTop;900;-800\n")
            done = subprocess.run([PROGRAM, "check", scene], text=True, stdout=subprocess.PIPE)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertIn("picks.csv:3: depth_m: -800 is above the original surface", done.stdout)


if __name__ == "__main__":
    unittest.main()
