"""Figures and the page do not depend on who calls, nor on names; what fails says what it was.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest figures_test
"""

import base64
import fcntl
import json
import os
import pty
import re
import shutil
import struct
import subprocess
import tempfile
import termios
import unittest
from pathlib import Path

import numpy as np
from PIL import Image
from program import PROGRAM, read_terminal

DESCRIPTION = r"from $PROJ\north\line12 to $OUT"
SCENE = f"""
description = '{DESCRIPTION}'
[hanging_wall]
length_m = 6000.0
thickness_m = 2000.0
mean_radius_m = 130.0
[detachment]
start_dip_deg = 60.0
segments = [{{arc = {{radius_m = 4000.0, end_dip_deg = 0.0}}}}, {{line = {{length_m = 9000.0}}}}]
[extension]
distance_m = 100.0
speed_m_per_s = 4.0
ramp_s = 2.0
[gravity]
[output]
interval_m = 50.0
figures_at_m = []
"""


BOX = """
[hanging_wall]
length_m = 4000.0
thickness_m = 1000.0
mean_radius_m = 100.0
[base_motion]
fault_x_m = 2000.0
fault_slip_m = 40.0
[materials]
basement = 'sandbox-sand'
[extension]
speed_m_per_s = 2.0
ramp_s = 2.0
[gravity]
[output]
interval_m = 20.0
figures_at_m = []
"""


class Figures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        (cls.folder / "scene.toml").write_text(SCENE)
        ended = cls.listric("run", "scene.toml", "--no-report", "--threads", "1", "--output", "out",
                            LISTRIC_PYTHON="/bin/false")   # draws later
        assert ended.returncode == 0, ended.stdout

    @classmethod
    def listric(cls, *words, place=None, **settings):
        environment = {**os.environ, "XDG_CACHE_HOME": str(cls.folder / "cache"), **settings}
        return subprocess.run([PROGRAM, *words], cwd=place or cls.folder, env=environment, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              check=False)

    def copy(self, name):
        shutil.copytree(self.folder / "out", self.folder / name)
        return self.folder / name

    def picture(self, name, **options):
        ramp = Image.fromarray(np.tile(np.linspace(64, 191, 60).astype(np.uint8), (20, 1)))
        ramp.save(self.folder / name, **options)
        return self.folder / name

    def test_they_do_not_depend_on_the_caller(self):
        place = self.folder / "place"
        place.mkdir()
        for name in ("numpy.py", "json.py", "plot.py", "matplotlib.py"):
            (place / name).write_text("raise SystemExit('wrong file')\n")
        (place / "matplotlibrc").write_text("text.usetex: True\nbackend: nonsense\n")
        self.picture("grey.png")
        hostile = {"PYTHONSAFEPATH": "1", "PYTHONPATH": str(place), "PYTHONHOME": "/nowhere",
                   "PYTHONOPTIMIZE": "2", "PYTHONWARNINGS": "error", "PYTHONIOENCODING": "ascii",
                   "MPLBACKEND": "nonsense", "MATPLOTLIBRC": str(place), "MPLCONFIGDIR": "/dev/null/x",
                   "LC_ALL": "de_DE.UTF-8", "HOME": "/nowhere"}
        ended = self.listric("figures", "../out", "--underlay", "../grey.png", "--corners",
                             "0,0,6000,2000", "--format", "svg", place=place, **hostile)
        figures = self.folder / "out/figures"
        self.assertEqual((ended.returncode, ended.stdout),   # what it wrote, and no warning
                         (0, "".join(f"../out/figures/{name}\n" for name in sorted(os.listdir(figures)))))
        self.assertIn(DESCRIPTION, (figures / "strata-0.1km.svg").read_text())
        self.assertEqual(len(list(figures.glob("underlay-0.1km-grey-*.svg"))), 1)

    def test_a_moment_of_ones_own(self):
        folder = self.copy("moment")
        said = self.listric("figures", folder, "--at", "0.05km").stdout
        self.assertEqual(said.split(), [str(file) for file in sorted((folder / "figures").iterdir())])
        made = {file.name for file in (folder / "figures").iterdir()} - {"caption.txt", "origin.txt"}
        self.assertEqual({name.rpartition("-")[2] for name in made}, {"0.05km.png"})
        self.assertIn("strain-0.05km.png", made)
        far = self.listric("figures", folder, "--at", "300m")
        self.assertEqual(far.returncode, 2)
        self.assertIn("--at 300m: no snapshot there; there are some from 0 to 100", far.stdout)

    def test_times_of_a_short_run_are_years(self):
        ended = self.listric("run", "scene.toml", "--no-report", "--threads", "1", "--set", "extension.rate_m_per_a=0.5", "--output", "short",
                             LISTRIC_PYTHON="/bin/false")
        self.assertEqual(ended.returncode, 0, ended.stdout)
        for moment, told in (("50m", "(100 a)"), ("100m", "(200 a)")):
            self.assertEqual(self.listric("figures", "short", "--at", moment, "--only", "strata").returncode, 0)
            self.assertIn(f"at 50 cm/yr {told}: ", (self.folder / "short/figures/caption.txt").read_text())

    def test_a_box_has_a_base_and_no_breakaway(self):
        place = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (place / "box.toml").write_text(BOX)
        ended = self.listric("run", "box.toml", "--no-report", "--threads", "1", "--output", "out", place=place,
                             LISTRIC_PYTHON="/bin/false")
        self.assertEqual(ended.returncode, 0, ended.stdout)
        ended = self.listric("figures", "out", "--only", "strata", "--format", "svg", place=place)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        text = next((place / "out/figures").glob("strata-*.svg")).read_text()
        self.assertIn("Distance from the left wall", text)
        self.assertNotIn("breakaway", text)
        self.assertNotIn(">detachment<", text)

    def test_a_figure_for_print_has_its_width(self):
        folder = self.copy("print")
        ended = self.listric("figures", folder, "--at", "100m", "--width", "85mm", "--only", "strata,seismic-depth", "--dpi", "254")
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.assertEqual([Path(line).name for line in ended.stdout.splitlines()], ["caption.txt", "origin.txt", "strata-seismic-depth-0.1km-85mm-254dpi.png"])
        with Image.open(folder / "figures/strata-seismic-depth-0.1km-85mm-254dpi.png") as picture:
            self.assertEqual(picture.width, 850)
        self.assertIn("(b) synthetic seismic image in depth", (folder / "figures/caption.txt").read_text())
        for words, said in ((("--width", "8mm"), "--width 8mm: a width from 40mm to 500mm"),
                            (("--only", "strat"), "--only: no panel strat; did you mean strata"),
                            (("--at", "5 miles"), "--at: 5 miles: a length of at least 0"),
                            (("--animation", "--width", "85mm"), "--animation: has no --width"),
                            (("--animation", "--format", "png"), "--format: no format png")):
            ended = self.listric("figures", folder, *words)
            self.assertEqual(ended.returncode, 2, ended.stdout)
            self.assertIn(said, ended.stdout)

    def test_an_animation_is_made_whatever_its_folder_is_called(self):
        ended = self.listric("figures", self.copy("slip-50% 'a' é"), "--animation")
        [said] = ended.stdout.splitlines()
        self.assertEqual((ended.returncode, Path(said).exists()), (0, True))
        made = [file.suffix for file in (self.folder / "slip-50% 'a' é/figures").iterdir()]
        self.assertIn(made, ([".mp4"], [".gif"]))

    def test_what_fails_is_named(self):
        python = self.folder / "python"
        cases = (("exit 1", 2, "needs Python with numpy and matplotlib"),
                 ('[ "$4" = -c ] && exit 0; echo "figures.py: cannot import numpy: broken" >&2; exit 69',
                  2, "cannot import numpy: broken"),
                 ('[ "$4" = -c ] && exit 0; echo "figures.py: OSError: No space left" >&2; exit 4',
                  4, "No space left"),
                 ('[ "$4" = -c ] && exit 0; kill -9 $$', 4, "was ended by signal 9"),
                 ('[ "$4" = -c ] && exit 0; echo Traceback >&2; exit 1', 70, "exit code 1: Traceback"))
        for script, code, words in cases:
            python.write_text(f"#!/bin/sh\n{script}\n")
            python.chmod(0o755)
            ended = self.listric("figures", "out", LISTRIC_PYTHON=str(python))
            self.assertEqual(ended.returncode, code, ended.stdout)
            self.assertIn(words, ended.stdout)
            self.assertEqual("needs Python with" in ended.stdout, code == 2, ended.stdout)
        # The first on PATH cannot load the scripts: the system's Python draws.
        for script in ("echo TypeError >&2; exit 1", "echo too old >&2; exit 69"):
            (self.folder / "python3").write_text(f'#!/bin/sh\n[ "$4" = -c ] && exit 0; {script}\n')
            (self.folder / "python3").chmod(0o755)
            environment = {"PATH": f"{self.folder}:{os.environ['PATH']}", "LISTRIC_PYTHON": ""}
            ended = self.listric("figures", "out", "--at", "100m", "--only", "strata", **environment)
            self.assertEqual(ended.returncode, 0, ended.stdout)
        ended = self.listric("figures", "out", LISTRIC_PYTHON="/no/such/python")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("LISTRIC_PYTHON", ended.stdout)

    def test_a_photograph_lies_under_a_section(self):
        run = self.copy("photograph")
        photo = self.picture("photo.jpg")
        corners = ("--underlay", photo, "--corners", "0,0,6000,2000")
        self.assertIn("underlay-0.1km-photo-", self.listric("figures", run, *corners).stdout)
        self.assertIn("underlay-0.1km-photo-", self.listric("figures", run, *corners[:-1], "0,0,5000,2000").stdout)
        self.assertEqual(len(list((run / "figures").glob("underlay-0.1km-photo-*.png"))), 2)   # at two places
        self.assertEqual(self.listric("report", run, *corners).returncode, 0)
        self.assertIn("data:image/jpeg;base64," + base64.b64encode(photo.read_bytes()).decode(),
                      (run / "report.html").read_text())

    def test_a_picture_that_is_none_is_refused(self):
        whole = self.picture("whole.png").read_bytes()
        (self.folder / "cut.png").write_bytes(whole[:-20])
        (self.folder / "empty.png").write_bytes(b"")
        (self.folder / "bomb.png").write_bytes(
            whole[:16] + struct.pack(">II", 2**31 - 1, 2**31 - 1) + whole[24:])
        photo = self.picture("photo.png", format="jpeg").read_bytes()
        (self.folder / "cut.jpg").write_bytes(photo[:-20])
        self.picture("scan.png", format="tiff")
        for name, words in (("cut.png", "is a PNG that is damaged or cut off"), ("empty.png", "is empty"),
                            ("bomb.png", "100 million"), ("cut.jpg", "is a JPEG that is damaged or cut off"),
                            ("scan.png", "is a TIFF"), ("none.png", "no such file"), (".", "is a directory")):
            for call in (("figures", "out"), ("report", "out", "--output", "no.html")):
                ended = self.listric(*call, "--underlay", name, "--corners", "0,0,6000,2000")
                self.assertEqual(ended.returncode, 2, ended.stdout)
                self.assertRegex(ended.stdout, f"--underlay .*{re.escape(name)}.*{words}")
        for corners, words in (("0,0,6000", "3 numbers"), ("6000,0,0,2000", "x1 = 0 must be greater"),
                               ("0,0,6000,-2000", "these are heights"), ("0,0,nan,1", '"nan" is not a finite number'),
                               ("0,0,inf,1", '"inf" is not a finite number'), ("0,5,9,5", "z1 = 5 must be greater"),
                               ("0,0,1e300,1", "no place in a section")):
            ended = self.listric("figures", "out", "--underlay", "whole.png", f"--corners={corners}")
            self.assertEqual(ended.returncode, 2, ended.stdout)
            self.assertIn(words, ended.stdout)
        self.assertFalse((self.folder / "no.html").exists())

    def test_a_page_that_cannot_be_whole_says_so(self):
        run = self.copy("damaged")
        for damaged in ('{"finished": tr', '{"finished": true, "x": 1e999}', "[]", ""):
            (run / "summary.json").write_text(damaged)
            ended = self.listric("report", run)
            self.assertEqual(ended.returncode, 4, damaged)
            self.assertIn("the page is not whole: ", ended.stdout)
            self.assertIn("summary.json is damaged", ended.stdout)
            page = (run / "report.html").read_text()
            data = json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL)[1])
            self.assertIsNone(data["runs"][0]["summary"])
            self.assertIn("summary.json is damaged", data["lacks"][0])
        (run / "summary.json").unlink()
        ended = self.listric("report", run)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        with open(run / "history.csv", "a", encoding="utf-8") as file:
            file.write("150.0,")
        ended = self.listric("report", run)
        self.assertEqual(ended.returncode, 0, ended.stdout)  # curves come from the newest snapshot

    def said_on_a_terminal(self, columns, **settings):
        """What a run writes to a terminal of that width."""
        leader, follower = pty.openpty()
        fcntl.ioctl(follower, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        environment = {**os.environ, "XDG_CACHE_HOME": str(self.folder / "cache"),
                       "LISTRIC_PYTHON": "/bin/false", **settings}
        if "COLUMNS" not in settings:
            environment.pop("COLUMNS", None)  # it comes before the terminal
        run = subprocess.Popen([PROGRAM, "run", "scene.toml", "--no-report", "--threads", "1", "--output",
                                f"wide-{columns}-{settings['TERM']}"], cwd=self.folder, env=environment,
                               stdout=subprocess.DEVNULL, stderr=follower)
        os.close(follower)
        said = read_terminal(leader)
        self.assertEqual(run.wait(), 0, said)
        return said

    def test_progress_fits_the_terminal(self):
        for columns, settings in ((40, {"TERM": "xterm"}), (0, {"TERM": "xterm", "COLUMNS": "30"})):
            said = self.said_on_a_terminal(columns, **settings)
            lines = re.findall("\r\x1b\\[K([^\r\n\x1b]*)(?=\r\x1b)", said)   # rewritten, so progress
            lines = [line for line in lines if line]
            self.assertTrue(lines, said)
            for line in lines:
                self.assertLess(len(line), columns or 30, line)
        said = self.said_on_a_terminal(40, TERM="dumb")
        self.assertNotIn("\x1b", said)
        self.assertNotRegex(said, "\r[^\r\n]")   # the terminal itself writes \r\n


if __name__ == "__main__":
    unittest.main()
