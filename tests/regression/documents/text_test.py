"""Text of strangers: of any length, in any encoding, in any place. It is refused at reading, with its
file and line, or it is carried to the end; what a call has left is believed by its content.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest text_test
"""

import json
import os
import re
import shutil
import subprocess
import tempfile
import tomllib
import unittest
from pathlib import Path

from program import PROGRAM, SOURCES

SCENE = """description = "Small block"
[hanging_wall]
length_m = 12000.0
thickness_m = 3000.0
mean_radius_m = 180.0
[detachment]
start_dip_deg = 60.0
segments = [{arc = {radius_m = 6000.0, end_dip_deg = 0.0}}, {line = {length_m = 20000.0}}]
[extension]
distance_m = 600.0
speed_m_per_s = 4.0
ramp_s = 2.0
[gravity]
[bonds]
[output]
interval_m = 100.0
figures_at_m = []
series = "none"
"""


class Ended:
    def __init__(self, done):
        self.code, self.out, self.err = done.returncode, done.stdout, done.stderr.decode()


class TextTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cache = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cache.cleanup)
        cls.cache = Path(cache.name)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.write("small.toml", SCENE)

    def write(self, name, content):
        path = os.path.join(os.fsencode(self.folder), os.fsencode(name))
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return path

    def call(self, *words, without=(), **more):
        """Without figures, which take seconds; with one cache of hanging walls for all tests."""
        environment = {**os.environ, "XDG_CACHE_HOME": str(self.cache), "LISTRIC_PYTHON": "/bin/false",
                       **more}
        for name in without:
            environment.pop(name, None)
        return Ended(subprocess.run([PROGRAM, *words], cwd=self.folder, env=environment, timeout=60,
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False))

    def run_small(self, *words, scene="small.toml", until="0m", **more):
        return self.call("run", scene, "--threads", "1", "--no-report", "--quiet", "--until", until,
                         *words, **more)

    def summary(self, output="out"):
        return json.loads((self.folder / output / "summary.json").read_bytes())

    def assert_refused(self, ended, *parts):
        said = ended.err + ended.out.decode()  # `check` says it as its result
        self.assertEqual(ended.code, 2, said)
        for part in parts:
            self.assertIn(part, said)
        self.assertEqual(said.count("\n"), 1, said)
        self.assertNotRegex(said, r"[\x00-\x09\x0b-\x1f]")


class Length(TextTest):
    def test_scene_of_any_length(self):
        import h5py
        picks = "".join(f"H{k // 2000},{1000 + k % 2000},{500 + k}\n" for k in range(4000))
        self.write("picks.csv", "name,x_m,depth_m\n" + picks)
        self.write("long.toml", SCENE.replace("Small", "Long " * 14000) +
                   '[observed]\nhorizons = "picks.csv"\n')
        done = self.run_small("--output", "out", scene="long.toml")
        self.assertEqual(done.code, 0, done.err)
        written = (self.folder / "out/scene.toml").read_bytes()
        self.assertGreater(len(written), 130_000)
        with h5py.File(self.folder / "out/snapshots/extension-00000.00m.h5") as file:
            self.assertEqual(file["run/scene"][()], written)
            self.assertNotIn("scene", file["run"].attrs)
        again = self.run_small("--output", "out", "--resume", scene="long.toml", until="2m")
        self.assertEqual(again.code, 0, again.err)
        self.assertEqual(len(list((self.folder / "out/snapshots").iterdir())), 2)


class Encoding(TextTest):
    def test_files_that_are_no_utf_8(self):
        latin1, nul = "# L\xe4nge\n".encode("latin1"), b'name = "a\0b"\n'
        # An overlong form and a surrogate are no UTF-8 either.
        for content, line, what in ((latin1, 19, "0xe4"), (nul, 19, "NUL"), (b"#\xc0\xaf", 19, "0xc0"),
                                    (b"#\xed\xa0\x80", 19, "0xed")):
            self.write("bad.toml", SCENE.encode() + content)
            for words in (["check"], ["run"]):
                self.assert_refused(self.call(*words, "bad.toml"), f"bad.toml:{line}:", what, "UTF-8")
        self.write("wide.toml", SCENE.encode("utf-16"))
        self.assert_refused(self.call("check", "wide.toml"), "wide.toml:1:", "UTF-16")
        self.write("marked.toml", SCENE.encode("utf-8-sig"))
        self.assertEqual(self.call("check", "marked.toml").code, 0)
        self.write("rock.toml", (SOURCES / "apps/materials/mat18-b.toml").read_bytes() + latin1)
        self.write("of-rock.toml", SCENE + '[materials]\nbasement = "./rock.toml"\n')
        self.assert_refused(self.call("check", "of-rock.toml"), "rock.toml:", "0xe4")
        self.write("plan.toml", b'scene = "small.toml"\n' + latin1)
        for study in (["sweep", "plan.toml"], ["validate", "--plan", "plan.toml"]):
            self.assert_refused(self.call(*study), "plan.toml:2:4:", "0xe4")
        self.assertEqual(os.listdir(self.folder / "out") if (self.folder / "out").exists() else [], [])

    def test_escaped_nul_in_a_text(self):
        for line in ('description = "a\\u0000b"', 'name = "a\\u0000b"'):
            self.write("bad.toml", SCENE.replace('description = "Small block"', line))
            self.assert_refused(self.call("check", "bad.toml"), "bad.toml:1:", "NUL")
        self.write("bad.toml", SCENE + '[[observed.horizon_lines]]\nname = "a\\u0000b"\nx_m = [1.0]\n'
                   "depth_m = [1.0]\n")
        self.assert_refused(self.call("check", "bad.toml"), "bad.toml:20:", "NUL")

    def test_picked_points_with_one_coordinate(self):
        for table in ("[[observed.horizon_lines]]", "[[observed.fault_lines]]", "[picked_fault]"):
            self.write("bad.toml", f"{SCENE}{table}\nx_m = [1.0, 2.0]\ndepth_m = [1.0]\n")
            self.assert_refused(self.call("check", "bad.toml"), "bad.toml:", "2 x_m and 1 depth_m")

    def test_text_of_any_characters_comes_back(self):
        text = ("a\x7f\x80\x1b\x01\t\"\"\" ''' \\ # report = 1\nreport = 2\r\n\u2028\U0001f600{}$x$%s\n"
                "[bonds]\n")
        escaped = json.dumps(text).replace("\x7f", "\\u007f").replace("\\ud83d\\ude00", "\U0001f600")
        self.write("odd.toml", SCENE.replace('"Small block"', escaped))
        done = self.run_small("--output", "out", scene="odd.toml")
        self.assertEqual(done.code, 0, done.err)
        written = tomllib.loads((self.folder / "out/scene.toml").read_bytes().decode())
        self.assertEqual(written["description"], text)
        again = self.run_small("--output", "out", "--resume", scene="odd.toml", until="2m")
        self.assertEqual(again.code, 0, again.err)
        self.assertEqual(self.call("check", "out/scene.toml").code, 0)

    def test_words_of_a_call_that_are_no_utf_8(self):
        self.write(b"l\xe4ngs.toml", SCENE)
        for words in (["check", b"l\xe4ngs.toml"], ["run", b"l\xe4ngs.toml"],
                      ["run", "small.toml", "--output", b"\xe4"], ["figures", b"\xe4"],
                      ["run", "small.toml", "--set", b"description=\xe4"],
                      ["laboratory", "uniaxial", b"\xe4.toml"], ["calibrate", "--name", b"\xe4"],
                      ["trace", b"\xe4.csv"], ["sweep", b"\xe4.toml"], ["export", "faults", b"\xe4"]):
            self.assert_refused(self.call(*words), "\\xe4", "UTF-8")
        self.assertEqual(sorted(os.listdir(os.fsencode(self.folder))), [b"l\xe4ngs.toml", b"small.toml"])

    def test_picked_name_that_is_no_utf_8(self):
        """Whoever reads the file, the run's end must have a summary."""
        self.write("picks.csv", b"name,x_m,depth_m\nH\xf6he,1000,500\nH\xf6he,2000,600\n")
        self.write("picked.toml", SCENE + '[observed]\nhorizons = "picks.csv"\n')
        done = self.run_small("--output", "out", scene="picked.toml")
        if done.code == 2:
            self.assertIn("picks.csv:2", done.err)
            self.assertFalse((self.folder / "out").exists())
        else:
            self.assertEqual(done.code, 0, done.err)
            self.assertEqual(self.summary()["observed"][0]["name"], "H\ufffdhe")

    def test_environment_of_any_bytes(self):
        """Folders may have any name; what is told of them is text."""
        scenes = os.path.join(os.fsencode(self.folder), b"sz\xe9nes")
        self.write(os.path.join(scenes, b"mine.toml"), SCENE)
        self.write(os.path.join(scenes, b"h\xf6he.toml"), SCENE)
        environment = {"LISTRIC_SCENES": os.fsdecode(scenes), "LISTRIC_CALL": os.fsdecode(b"l\xe4"),
                       "XDG_CACHE_HOME": os.fsdecode(os.path.join(scenes, b"\xff")),
                       "LISTRIC_PYTHON": os.fsdecode(b"/bin/\xe4"), "USER": os.fsdecode(b"\xe4"),
                       "HOSTNAME": os.fsdecode(b"\xe4")}
        done = self.run_small("--output", "out", scene="mine", **environment)
        self.assertEqual(done.code, 0, done.err)
        self.assertEqual(self.summary()["scene"], "mine")
        log = (self.folder / "out/log.txt").read_bytes().decode()
        self.assertNotIn("kept from an earlier run", log)
        for words in (["scenes"], ["schema"], ["run", "mine2"]):
            told = self.call(*words, **environment)
            told.out.decode()
        self.assert_refused(told, "h\\xf6he", "did you mean mine?")

    def test_escape_sequences_reach_no_terminal(self):
        self.write("shy.toml", '"\\u001b[31mred" = 1\n' + SCENE)
        self.assert_refused(self.call("check", "shy.toml"), "shy.toml:1:", "\\x1b[31mred")
        self.write("scenes/shy.toml", 'description = "\\u001b[31mred"\n')
        told = self.call("scenes", LISTRIC_SCENES=str(self.folder / "scenes"))
        self.assertNotIn(b"\x1b", told.out)


class Names(TextTest):
    def test_name_is_one_folder(self):
        names = ["../../dir-escaped", "..", ".", "", "a/b", "/tmp/absolute", "a\\u0000b", "a\\nb",
                 "\\u001b[31m", "x" * 201, "a\\u007fb"]
        for name in names:
            self.write("bad.toml", f'name = "{name}"\n' + SCENE)
            for words in (["check"], ["run"]):
                self.assert_refused(self.call(*words, "bad.toml"), "bad.toml:1: name:")
        self.assert_refused(self.call("run", "small.toml", "--set", "name=../up"), "--set", "name:")
        for name in ("...toml", ".\n.toml", "x" * 201 + ".toml"):
            self.write(name, SCENE)
            self.assert_refused(self.call("check", name), "name:", "rename")
        self.assertFalse((self.folder / "out").exists())
        self.write("...toml", 'name = "good"\n' + SCENE)
        self.write("fine.toml", 'name = "Höhe (2), Süd – ß"\n' + SCENE)
        for scene in ("...toml", "fine.toml"):
            self.assertEqual(self.call("check", scene).code, 0)

    def test_runs_of_before_have_any_name(self):
        self.assertEqual(self.run_small("--output", "out").code, 0)
        scene = self.folder / "out/scene.toml"
        scene.write_text(scene.read_text().replace('name = "small"', 'name = "a/b"'))
        done = self.call("export", "surfaces", "out")
        self.assertEqual(done.code, 0, done.err)

    def test_names_of_plans(self):
        run = '[[run]]\nname = "{}"\nscene = "small.toml"\nat_m = [0.0]\n'
        experiment = '[[experiment]]\nname = "x"\nruns = "one"\n'
        picture = '[[experiment.picture]]\nname = "{}"\n'
        for name in ("../up", "..", "a,b", "a/b", "a\\u0007b"):
            self.write("plan.toml", run.format(name))
            self.assert_refused(self.call("validate", "--plan", "plan.toml"), "plan.toml:2:", "name")
            self.write("plan.toml", run.format("one") + experiment + picture.format(name))
            self.assert_refused(self.call("validate", "--plan", "plan.toml"), "plan.toml:9:", "name")
        self.assert_refused(self.call("calibrate", "--name", "../up"), "--name", "has a /")
        for text in ("a\\u001bb", "a\\rb", "a,b"):
            self.write("plan.toml", 'scene = "small.toml"\nmeasures = ["strain_top10"]\n[[vary]]\n'
                       f'parameter = "description"\nvalues = ["{text}"]\n')
            self.assert_refused(self.call("sweep", "plan.toml"), "plan.toml:5:")


class Believed(TextTest):
    def sweep(self, values):
        self.write("plan.toml", 'scene = "small.toml"\nset = "extension.distance_m=20 '
                   'output.interval_m=20"\nmeasures = ["unbalanced_ratio_mean"]\n[[vary]]\n'
                   f'parameter = "cycle.time_step_safety"\nvalues = [{values}]\n')
        return self.call("sweep", "plan.toml", "--output", "sweep", "--quiet")

    def rows(self):
        lines = (self.folder / "sweep/sweep.csv").read_text().splitlines()[1:]
        return [line.split(",") for line in lines]

    def test_failure_is_of_its_scene(self):
        first = self.folder / "sweep/runs/0001-seed=1"
        self.assertEqual(self.sweep("10.0, 0.5").code, 0)
        failed = self.rows()[0]
        self.assertEqual(failed[4], "3")
        log = (first / "log.txt").read_text()
        self.sweep("10.0, 0.5")  # is known
        self.assertEqual((self.rows()[0], (first / "log.txt").read_text()), (failed, log))
        said = json.loads((first / "failure.json").read_text())
        for content in ("[]", "null", "", '{"exit_code": 3, "rea', '{"exit_code":"3"}', "{",
                        '{"exit_code":3,"reason":5}', json.dumps({**said, "scene_hash": 7}),
                        "[" * 100_000, '{"exit_code":1e999}'):
            (first / "failure.json").write_text(content)
            self.assertEqual(self.sweep("10.0, 0.5").code, 0)
            self.assertEqual(self.rows()[0][4], "3", content)
            self.assertIn("reason", json.loads((first / "failure.json").read_text()))
        self.assertEqual(self.sweep("0.4, 0.5").code, 0)  # the plan is corrected
        self.assertEqual([row[3:5] for row in self.rows()], [["finished", "0"]] * 2)
        self.assertFalse((first / "failure.json").exists())
        self.assertEqual(self.sweep("0.45, 0.5").code, 0)  # what is finished is somebody's
        self.assertIn("other parameters", self.rows()[0][3])

    def test_summary_of_another_shape(self):
        self.assertEqual(self.run_small("--output", "out").code, 0)
        expected = self.summary()["state_hash"]
        for content in ('{"finished": 1, "extension_m": 200.0}', "[]", "null", '{"finished": tr', "3",
                        '{"finished": true, "extension_m": "far"}', '{"provenance": 3}', "[" * 99_999,
                        '{"finished": true, "extension_m": 1e999}', '{"a":' * 99_999):
            (self.folder / "out/summary.json").write_text(content)
            done = self.run_small("--output", "out", "--resume")
            self.assertEqual((done.code, self.summary()["state_hash"]), (0, expected), content[:50])

    def test_validation_believes_runs_of_its_plan(self):
        plan = ('[[run]]\nname = "one"\nscene = "small.toml"\nat_m = [0.0]\nset = '
                '"extension.distance_m=1 {}"\n[[experiment]]\nname = "x"\nruns = "one"\n'
                '[[experiment.expect]]\nmeasure = "unbalanced_ratio_mean"\nwhat = "rest"\n')
        words = ["validate", "--plan", "plan.toml", "--accuracy", "standard", "--seeds", "1", "--threads",
                 "1", "--runs", "runs", "--output", "doc.md"]
        self.write("plan.toml", plan.format(""))
        done = self.call(*words)
        self.assertEqual(done.code, 0, done.err)
        self.write("plan.toml", plan.format("material.friction=0.3"))
        other = self.call(*words)
        self.assertEqual(other.code, 2, other.err)
        self.assertIn("other parameters", other.err)
        self.write("plan.toml", plan.format(""))
        summary = next((self.folder / "runs").rglob("summary.json"))
        for content in ('{"finished": true, "accuracy": 3}', '{"finished": "yes"}', "[1]"):
            summary.write_text(content)
            self.assertIn(self.call(*words).code, (0, 2))

    def test_hanging_wall_of_another(self):
        """A file of the cache is not believed by its name."""
        cache = {"XDG_CACHE_HOME": str(self.folder / "cache")}
        files = []
        for seed in ("1", "2"):
            self.assertEqual(self.run_small("--seed", seed, "--output", seed, **cache).code, 0)
            files += [file for file in (self.folder / "cache/listric").glob("*.h5") if file not in files]
        expected = self.summary("2")["state_hash"]
        shutil.copy(files[0], files[1])
        again = self.run_small("--seed", "2", "--output", "2", "--force", **cache)
        self.assertEqual((again.code, self.summary("2")["state_hash"]), (0, expected))
        self.assertIn("made again", (self.folder / "2/log.txt").read_text())

    def test_history_of_a_calibration(self):
        for content in ("[3]", '[{"what": 1}]', '[{"what":"elasticity","of":{},"result":["a"]}]', "{}",
                        '[{"what"', "[" * 99_999):
            self.write("cal/history.json", content)
            done = self.call("calibrate", "--discs", "100", "--seeds", "1", "--resume", "--output", "cal")
            self.assertEqual(done.code, 4, done.err)
            self.assertIn("history.json: is not the history", done.err)


class Places(TextTest):
    def test_log_and_lock_that_are_no_plain_files(self):
        self.write("diary.txt", "dear diary\n")
        log = self.folder / "out/log.txt"
        log.parent.mkdir()
        log.symlink_to("../diary.txt")
        self.assert_refused(self.run_small("--output", "out"), "out/log.txt", "--output writes elsewhere")
        log.unlink()
        self.assertEqual(self.run_small("--output", "out").code, 0)
        log.unlink()
        log.symlink_to("../diary.txt")
        self.assertEqual(self.run_small("--output", "out", "--force").code, 0)
        self.assertEqual((self.folder / "diary.txt").read_text(), "dear diary\n")
        (self.folder / "locked/.lock").mkdir(parents=True)
        self.assert_refused(self.run_small("--output", "locked"), "locked/.lock", "remove it")

    def test_no_place_for_the_cache(self):
        done = self.run_small("--output", "out", without=("XDG_CACHE_HOME", "HOME"),
                              TMPDIR=str(self.folder / "none"))
        self.assertEqual(done.code, 0, done.err)
        self.assertIn("cannot be kept", (self.folder / "out/log.txt").read_text())


class Sources(unittest.TestCase):
    def test_json_is_written_by_one_function(self):
        """Which replaces what is no UTF-8: a byte of somebody's must not end a run."""
        for file in sorted((SOURCES / "apps").rglob("*.[ch]pp")):
            for line in file.read_text().splitlines():
                if re.search(r"\.dump\(", line):
                    self.assertIn("error_handler_t::replace", line, f"{file}: use to_text()")


if __name__ == "__main__":
    unittest.main()
