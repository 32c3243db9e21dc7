"""Real shells complete calls with the scripts of `listric completion`, and the manual's page
has every call and option.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest completion_test
"""

import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from program import PROGRAM, SOURCES


def output(*words, **options):
    return subprocess.run(words, stdout=subprocess.PIPE, text=True, check=True, **options).stdout


class Completion(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        Path(cls.folder.name, "lists of mine.toml").touch()
        cls.script = Path(cls.folder.name, "script")
        cls.script.write_text(output(PROGRAM, "completion", "bash"))

    def completed(self, *words):
        """What <TAB> at the end of the last word offers."""
        call = ('. "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _listric && '
                'printf "%s\\n" "${COMPREPLY[@]}"')
        return output("bash", "-uc", call, self.script, "listric", *words,
                      cwd=self.folder.name).splitlines()

    def test_is_registered(self):
        self.assertIn("_listric", output("bash", "-c", '. "$0"; complete -p listric', self.script))

    def test_completes_calls(self):
        self.assertEqual(self.completed("ru"), ["run"])
        self.assertEqual(self.completed("che"), ["check"])
        self.assertEqual(self.completed("--ver"), ["--version"])

    def test_completes_scenes_and_files(self):
        scenes = sorted(path.stem for path in (SOURCES / "apps/scenes").glob("lis*.toml"))
        self.assertEqual(self.completed("run", "lis"), scenes + ["lists of mine.toml"])
        self.assertEqual(self.completed("check", "lis1", "lists"), ["lists of mine.toml"])

    def test_completes_options_and_their_values(self):
        self.assertEqual(self.completed("run", "lis1", "--acc"), ["--accuracy"])
        levels = ["draft", "standard", "fine", "sandbox"]
        self.assertEqual(self.completed("run", "lis1", "--accuracy", ""), levels)
        self.assertEqual(self.completed("run", "lis1", "--accuracy", "=", "dr"), ["draft"])
        self.assertEqual(self.completed("run", "lis1", "--accuracy", "="), levels)
        for option in "--seed", "--until":
            self.assertEqual(self.completed("run", "lis1", option, ""), [""])
        self.assertEqual(self.completed("run", "lis1", "--set", "hanging_wall.len"),
                         ["hanging_wall.length_m="])
        self.assertEqual(self.completed("run", "lis1", "--without", "sed"), ["sedimentation"])
        for call in "run", "explain", "check":  # which take plans of flexure
            self.assertEqual(self.completed(call, "flex"), ["flexure"])
        self.assertEqual(self.completed("draw", "flex"), [""])
        self.assertEqual(self.completed("laboratory", "shear"), ["shear-box"])
        self.assertEqual(self.completed("laboratory", "biaxial", "mat18-b-"),
                         ["mat18-b-calibrated"])
        self.assertEqual(self.completed("laboratory", "biaxial", "mat18-b", "--set", "bonds.shear"),
                         ["bonds.shear_strength_pa=", "bonds.shear_strength_sd_pa="])
        self.assertEqual(self.completed("laboratory", "biaxial", "mat18-b", "--strength-is", "f"),
                         ["force"])
        self.assertEqual(self.completed("sweep", "--task", "1/2", "--jo"), ["--jobs"])

    @unittest.skipUnless(shutil.which("zsh"), "no zsh")
    def test_zsh_completes_as_bash_does(self):
        script = Path(self.folder.name, "_script")
        script.write_text(output(PROGRAM, "completion", "zsh"))
        stubs = ('compdef() {}; compset() {}; _files() { print -- FILES }; '
                 'compadd() { while [[ $1 != -- ]]; do shift; done; shift; print -l -- "$@" }; '
                 '. "$0"; words=("$@"); CURRENT=$#; _listric')
        for words in (("ru",), ("run", "lis1", "--accuracy", ""), ("run", "lis1", "--set", "hanging_wall.len"),
                      ("laboratory", "biaxial", "mat18-b", "--set", "bonds.shear"), ("sweep", "--jo"),
                      ("help", "swe"), ("export", "hor"), ("run", "lis1", "--accuracy=dr")):
            offered = output("zsh", "-fc", stubs, script, "listric", *words, cwd=self.folder.name).splitlines()
            wanted = [word for word in self.completed(*words) if word]
            self.assertEqual([word for word in offered if word.startswith(words[-1]) and word not in ("", "FILES")],
                             wanted, words)
        self.assertIn("FILES", output("zsh", "-fc", stubs, script, "listric", "run", ""))
        self.assertNotIn("FILES", output("zsh", "-fc", stubs, script, "listric", "help", ""))

    @unittest.skipUnless(shutil.which("fish"), "no fish")
    def test_fish_completes_as_bash_does(self):
        script = Path(self.folder.name, "script.fish")
        script.write_text(output(PROGRAM, "completion", "fish"))
        for words in (("ru",), ("run", "lis1", "--accuracy", "d"), ("run", "lis1", "--set", "hanging_wall.len"),
                      ("run", "lis"), ("sweep", "--jo"), ("help", "swe"), ("export", "hor"),
                      ("run", "lis1", "--accuracy=dr")):
            offered = output("fish", "--no-config", "-c", "source $argv[1]; complete -C $argv[2]", script,
                             " ".join(("listric", *words)), cwd=self.folder.name).splitlines()
            self.assertEqual(sorted(line.partition("\t")[0].replace("\\ ", " ") for line in offered),
                             sorted(self.completed(*words)), words)


class Manual(unittest.TestCase):
    def test_has_every_call_and_option(self):
        page = output(PROGRAM, "manual").replace("\\-", "-")
        calls = re.findall(r"^  (\w+)  ", output(PROGRAM, "--help"), re.MULTILINE)
        self.assertIn("validate", calls)
        sections = page.split(".SS listric ")[1:]
        self.assertEqual([section.split()[0].rstrip(".") for section in sections], calls)
        for call, section in zip(calls, sections):
            options = re.findall(r"^  (?:-\w, )?(--[\w-]+)", output(PROGRAM, call, "--help"),
                                 re.MULTILINE)
            for option in set(options) - {"--help"}:
                self.assertRegex(section, rf"\n\.B [^\n]*{option}\b", call)

    def test_is_roff(self):
        page = output(PROGRAM, "manual")
        done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z"], input=page, text=True,
                              capture_output=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
