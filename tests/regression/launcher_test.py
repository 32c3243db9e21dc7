"""The launcher with packages, presets, folders and environments as strangers have them. It is copied
beside sources that are built in a moment; dpkg, apt and sudo are scripts that note what is asked of them.
"""

import fcntl
import os
import pathlib
import pty
import re
import shutil
import subprocess
import tempfile
import time
import unittest

from program import SOURCES, read_terminal

NOBODY = 65534
SCRIPTS = {
    # All packages are installed but those in the file `missing`.
    "dpkg-query": 'for name; do grep -qsx -- "$name" "$NOTES/missing" || echo "$name installed"; done',
    # The system has all packages but those in `absent`.
    "apt-cache": '''shift; for name; do
        grep -qsx -- "$name" "$NOTES/absent" || printf '%s:\\n  Installed: (none)\\n  Candidate: 1\\n' "$name"
        done; printf 'libvirtual:\\n  Candidate: (none)\\n' ''',
    # Notes calls, and what the launcher had said by then.
    "apt-get": '''echo "$*" >>"$NOTES/calls"
        [ -f "$NOTES/broken" ] && { cat "$NOTES/broken"; exit 100; }
        [ -f "$NOTES/talk" ] && cat "$NOTES/talk"
        case "$*" in *install*) cp "$NOTES/stderr" "$NOTES/said"; rm -f "$NOTES/missing";; esac''',
    "sudo": 'exec "$@"',
}
TOOLS = ("readlink awk mkdir flock ls cat grep rm env nproc cp sleep tail head sort sh "
         "find comm touch sed cmake ninja c++ pkg-config").split()
PROJECT = r'''
cmake_minimum_required(VERSION 3.25)
project(listric NONE)
set(LISTRIC_TESTS OFF CACHE BOOL "")
file(WRITE ${CMAKE_BINARY_DIR}/listric "#!/bin/sh\nprintf 'program: '; printf '<%s>' \"$@\"\n[ \"$1\" != advice ] || printf %s \"$LISTRIC_CALL\"\n")
file(CHMOD ${CMAKE_BINARY_DIR}/listric PERMISSIONS OWNER_READ OWNER_EXECUTE WORLD_READ WORLD_EXECUTE)
# The program names its plug-ins by their paths, whether they are built or not.
add_custom_target(names COMMAND echo ${CMAKE_BINARY_DIR}/liblistric_fem.so)
add_custom_target(listric)
'''


class Launcher(unittest.TestCase):
    def setUp(self):
        self.place = pathlib.Path(tempfile.mkdtemp(prefix="listric launcher "))
        self.addCleanup(shutil.rmtree, self.place)
        self.place.chmod(0o755)
        self.root, self.notes, self.scripts = (self.place / name for name in ("sources", "notes", "scripts"))
        for folder in (self.root / "apps/scenes", self.notes, self.scripts):
            folder.mkdir(parents=True)
        (self.root / "cmake").mkdir()
        for name in ("listric", "CMakePresets.json", "cmake/packages.sh"):
            shutil.copy2(SOURCES / name, self.root / name)
        (self.root / "CMakeLists.txt").write_text(PROJECT)
        (self.root / "apps/scenes/rigid.toml").write_text("[gravity]\n")
        (self.root / "apps/scenes/elastic.toml").write_text("[gravity]\n\t[ elastic_base.rock ]\n")
        for name, text in SCRIPTS.items():
            self.write_script(name, text)
        self.path = f"{self.scripts}:{os.environ['PATH']}"

    def write_script(self, name, text):
        file = self.scripts / name
        file.write_text("#!/bin/sh\n" + text + "\n")
        file.chmod(0o755)

    def only_tools(self, *left_out):
        """A PATH without dpkg, apt and sudo; what is left out is not there either."""
        self.path = str(self.tools_but(*left_out))

    def tools_but(self, *left_out):
        folder = self.place / "tools"
        folder.mkdir()
        for name in set(TOOLS) - set(left_out):
            (folder / name).symlink_to(shutil.which(name))
        return folder

    def environment(self, **more):
        """A user's, whatever build or queue these tests run in."""
        kept = {name: value for name, value in os.environ.items()
                if not name.startswith(("LISTRIC_", "OMPI_", "PMI_", "SLURM_"))}
        return {**kept, "PATH": self.path, "NOTES": str(self.notes), **more}

    def call(self, *words, launcher=None, code=0, user=None, **environment):
        """What it wrote to its streams."""
        with open(self.notes / "stderr", "w") as stderr:
            done = subprocess.run(
                [launcher or self.root / "listric", *words], stdout=subprocess.PIPE, stderr=stderr, text=True,
                cwd=self.place, user=user, check=False, stdin=subprocess.DEVNULL,
                env=self.environment(**environment))
        said = (self.notes / "stderr").read_text()
        self.assertEqual(done.returncode, code, said)
        return done.stdout, said

    def forget(self):
        """The launcher looks for all again."""
        (self.root / "build/native/built").unlink(missing_ok=True)

    def note(self, name, *lines):
        (self.notes / name).write_text("".join(f"{line}\n" for line in lines))

    def installs(self):
        file = self.notes / "calls"
        calls = file.read_text().splitlines() if file.exists() else []
        return [call for call in calls if " install " in call]

    def test_calls_from_anywhere(self):
        link = self.place / "a link"
        link.symlink_to(self.root / "listric")
        wanted = "program: <explain><a b><*>"
        for launcher, more in ((self.root / "listric", {}), (link, {"CDPATH": "/usr:/"}),
                               ("sources/listric", {"LISTRIC_BUILD": "-other"})):
            self.assertEqual(self.call("explain", "a b", "*", launcher=launcher, **more)[0], wanted)
        self.assertTrue((self.place / "-other/native/listric").exists())
        self.assertEqual(self.call("explain", "a b", "*"), (wanted, ""))  # later calls start at once

    def test_help_and_version_need_no_build(self):
        (self.root / "CMakeLists.txt").write_text("project(listric VERSION 1.2.3 LANGUAGES CXX)\n")
        self.only_tools("cmake", "ninja", "c++")
        self.assertEqual(self.call("--version")[0], "listric 1.2.3\n")
        for words in (), ("--help",), ("-h",), ("help",):
            self.assertIn(f"\n    {self.root}/listric run lis1 --accuracy draft ", "".join(self.call(*words, code=0 if words else 2)))
        self.assertEqual(self.call(code=2)[0], "") # a script whose variable is empty reads nothing
        self.assertFalse((self.root / "build").exists())
        (self.root / "docs/reference").mkdir(parents=True)
        shutil.copy2(SOURCES / "docs/reference/commands.md", self.root / "docs/reference")
        for words in ("nocall",), ("help", "rnu"), ("--verson",), ("rnu", "--help"):
            self.note("missing", "g++")
            self.assertIn("listric: no call", self.call(*words, code=2)[1])
        self.assertEqual(self.installs(), [])
        self.assertFalse((self.root / "build").exists())
        for words in ("help", "run"), ("run", "--help"): # ask the program, which cannot be built
            self.call(*words, code=2)

    def test_options_of_other_shells_are_not_its_own(self):
        for options in "nounset", "errexit:noclobber:noglob", "posix", "xtrace:verbose":
            self.assertEqual(self.call("explain", "*", SHELLOPTS=options)[0], "program: <explain><*>")
        self.assertEqual(self.call("explain", "*", BASHOPTS="failglob:nocasematch")[0], "program: <explain><*>")

    def answered(self, answer, *words):
        """Exit code and text of a call at a terminal, at which somebody types."""
        leader, terminal = pty.openpty()
        process = subprocess.Popen([self.root / "listric", *words], stdin=terminal, stdout=terminal, stderr=terminal,
                                   cwd=self.place, env=self.environment())
        os.close(terminal)
        os.write(leader, answer)
        said = read_terminal(leader)
        return process.wait(), said

    def test_who_sits_at_the_terminal_is_asked(self):
        for missing, answer, code, installs in ((["g++"], b"n\n", 2, 0), (["python3-matplotlib"], b"n\n", 0, 0),
                                                (["g++"], b"\x04", 2, 0), (["g++"], b"\n", 0, 1), (["g++"], b"y\n", 0, 1)):
            self.note("missing", *missing)
            self.note("stderr")
            self.note("calls")
            self.forget()
            found, said = self.answered(answer, "run", "rigid")
            self.assertEqual((found, len(self.installs())), (code, installs), said)
            self.assertIn(f"1 packages missing: {missing[0]}", said)
        self.note("missing", "g++")
        self.forget()
        self.assertIn("no terminal to ask at", self.call("scenes")[1])

    def test_a_build_of_others_is_named_and_not_waited_for_for_ever(self):
        self.call("scenes")
        lock = self.root / "build/native.lock"
        self.assertRegex(lock.read_text(), r"^process \d+ of \S+, since 20")
        with open(lock, "a") as held:
            fcntl.flock(held, fcntl.LOCK_EX)
            # What is built waits for nobody and looks for nothing; what it was made of has changed below.
            self.note("missing", "g++")
            self.assertEqual(self.call("scenes", LISTRIC_WAIT="1"), ("program: <scenes>", ""))
            self.assertEqual(self.installs(), [])
            self.note("missing")
            (self.root / "cmake/new.cmake").touch()
            _, said = self.call("scenes", code=2, LISTRIC_WAIT="1")
            self.assertRegex(said, "waiting for another build in .*: process ")
            self.assertRegex(said, "after 1 s: process .*LISTRIC_WAIT=7200.*LISTRIC_BUILD")
            self.assertIn("whole seconds", self.call("scenes", code=2, LISTRIC_WAIT="x[$(id)]")[1])
        self.call("scenes", LISTRIC_WAIT="1")

    def test_the_program_answers_itself(self):
        self.assertEqual(self.call("run", "--help")[0], "program: <run><--help>") # is built
        calls = self.root / "apps/commands"
        calls.mkdir()
        os.utime(calls, (0, 0))
        without_tools = {"PATH": str(self.tools_but("cmake", "ninja", "c++"))}
        for words in ("run", "--help"), ("help",), ("--version",), ():
            self.assertEqual(self.call(*words, **without_tools)[0], f"program: <{'><'.join(words)}>")
        (calls / "new.cpp").touch()
        self.call("help", code=2, **without_tools) # builds, since its calls may have changed

    def test_numbers_of_the_environment_are_no_commands(self):
        trap = f"a[$(touch '{self.place}/trap')]"
        for count, mine in (("OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"), ("PMI_SIZE", "PMI_RANK"),
                            ("SLURM_STEP_NUM_TASKS", "SLURM_PROCID")):
            for values in ((trap, "1"), ("2", trap), (trap, trap)):
                out, _ = self.call("scenes", **dict(zip((count, mine), values)))
                self.assertEqual(out, "program: <scenes>")
        self.assertFalse((self.place / "trap").exists())
        self.call("scenes", OMPI_COMM_WORLD_SIZE="08", OMPI_COMM_WORLD_RANK="09")
        self.call("scenes", PMI_SIZE="", PMI_RANK="-1")

    def test_tells_how_far_a_build_is(self):
        steps = "".join(f"""add_custom_command(OUTPUT {k} COMMAND ${{CMAKE_COMMAND}} -E touch {k} COMMENT "Building {k}")
            """ for k in range(40))
        (self.root / "CMakeLists.txt").write_text(PROJECT.replace(
            "add_custom_target(listric)", steps + f"add_custom_target(listric DEPENDS {' '.join(map(str, range(40)))})"))
        _, said = self.call("scenes")
        self.assertRegex(said, r"listric: building \d+ of 40\n")
        self.assertLess(said.count("building"), 4)

        ours, theirs = pty.openpty()
        subprocess.run([self.root / "listric", "scenes"], stdout=subprocess.DEVNULL, stderr=theirs, check=True,
                       env={"PATH": self.path, "NOTES": str(self.notes), "LISTRIC_BUILD": str(self.place / "other")})
        os.close(theirs)
        said = read_terminal(ours)
        self.assertIn("\r\x1b[Klistric: building 40 of 40", said)
        self.assertTrue(said.endswith("\r\x1b[K"), said)
        self.assertNotIn("\n", said[said.index("building"):])

    def test_presets_that_are_none(self):
        for preset in ("release", "strict", "nonsense", "../native", "native ci", "nat*", "$(id)"):
            _, said = self.call("scenes", LISTRIC_PRESET=preset, code=2)
            self.assertIn("native x86-64-v3 generic ci debug", said)
        self.assertFalse((self.root / "build").exists())
        shutil.copy2(self.root / "CMakePresets.json", self.root / "CMakeUserPresets.json")
        (self.root / "CMakeUserPresets.json").write_text('''{"version": 6, "configurePresets": [
            {"hidden":true,"name":"hidden-one"},{"inherits":["native"],"name":"mine"}],
            "buildPresets": [{"name": "no-configuration", "configurePreset": "mine"}]}''')
        def built():
            self.call("scenes", LISTRIC_PRESET="mine")
            return (self.root / "build/mine/CMakeCache.txt").read_text()
        built()
        user_presets = self.root / "CMakeUserPresets.json"
        user_presets.write_text(user_presets.read_text().replace(
            '"name":"mine"', '"name":"mine","cacheVariables":{"OWN_CHOICE":"1"}'))
        self.assertIn("OWN_CHOICE:UNINITIALIZED=1", built())  # an edit is noticed
        for preset in ("hidden-one", "no-configuration"):
            self.call("scenes", LISTRIC_PRESET=preset, code=2)

    def test_folders_of_others_stay(self):
        for name, files in {"cmake": ("CMakeCache.txt",), "named": ("CMakeCache.txt", "origin"),
                            "papers": ("thesis.tex",)}.items():
            folder = self.place / name / "debug"
            folder.mkdir(parents=True)
            for file in files:
                (folder / file).write_text("CMAKE_PROJECT_NAME:STATIC=other\n")
            _, said = self.call("scenes", LISTRIC_BUILD=str(folder.parent), LISTRIC_PRESET="debug", code=2)
            self.assertIn("LISTRIC_BUILD", said)
            self.assertEqual(sorted(file.name for file in folder.iterdir()), sorted(files))

    def test_own_folders_are_made_afresh(self):
        self.call("scenes")
        made = self.root / "build/native/made"
        made.touch()
        (self.root / "build/native/origin").unlink()  # as CMake by hand leaves it: taken over
        self.call("scenes")
        self.assertTrue(made.exists())
        moved = self.place / "moved"
        self.root.rename(moved)
        _, said = self.call("scenes", launcher=moved / "listric")
        self.assertIn("starting afresh", said)
        self.assertFalse((moved / "build/native/made").exists())

    def test_names_that_cmake_cannot_take(self):
        for name in ("P#3", "a;b", 'q"t', "back\\slash"):
            _, said = self.call("scenes", code=2, LISTRIC_BUILD=str(self.place / name))
            self.assertIn("rename", said)
        self.assertEqual(self.call("scenes", LISTRIC_BUILD=str(self.place / "a b'ü%&"))[0], "program: <scenes>")

    def compiling(self):
        """Sources with a file that is compiled; says what the object was made of."""
        (self.root / "dem").mkdir()
        source, made = self.root / "dem/one.cpp", self.root / "build/native/one.o"
        with open(self.root / "CMakeLists.txt", "a") as project:
            project.write("add_custom_command(OUTPUT one.o DEPENDS dem/one.cpp COMMAND cp "
                          "${CMAKE_SOURCE_DIR}/dem/one.cpp one.o)\n"
                          "add_custom_target(one DEPENDS one.o)\nadd_dependencies(listric one)\n")

        def build(text, age, **how):
            source.write_text(text)
            os.utime(source, (time.time() - age,) * 2)
            _, said = self.call("scenes", **how)
            return made.read_text(), said
        return source, build

    def test_changed_sources_with_older_times_are_compiled(self):
        source, build = self.compiling()
        self.assertEqual(build("first", 100)[0], "first")
        newest = source.stat().st_mtime_ns
        self.call("scenes")
        self.assertEqual(source.stat().st_mtime_ns, newest)  # what has not changed keeps its time
        made, said = build("older", 3600)
        self.assertEqual(made, "older")
        self.assertIn("1 files of the sources have changed and were not newer", said)
        log = self.root / "build/native/.ninja_log"
        os.utime(log, (time.time() + 3600,) * 2)  # the clock went back since
        os.utime(self.root / "build/native/one.o", (time.time() + 3600,) * 2)
        self.assertEqual(build("again", 0)[0], "again")
        presets = self.root / "CMakePresets.json"
        presets.write_text(presets.read_text().replace("-march=native", "-march=native -DOWN"))
        os.utime(presets, (0, 0))
        _, said = self.call("scenes")
        self.assertIn("configuring", said)

    def test_times_in_the_future_are_set_to_now(self):
        os.utime(self.root / "CMakeLists.txt", (time.time() + 9e4,) * 2)
        _, said = self.call("scenes")
        self.assertIn("1 files of the sources had a time in the future", said)
        self.assertLess((self.root / "CMakeLists.txt").stat().st_mtime, time.time() + 1)
        self.assertEqual(self.call("scenes")[1], "")

    def test_a_full_disk_names_the_folder_of_temporary_files(self):
        (self.root / "CMakeLists.txt").write_text('message(FATAL_ERROR "cannot write: Disk quota exceeded")\n')
        _, said = self.call("scenes", code=4, TMPDIR=str(self.notes))
        self.assertIn(f"or {self.notes}: disk or quota full", said)

    def test_all_packages_are_installed_at_once_and_said_before(self):
        self.note("missing", "g++", "libdeal.ii-dev", "petsc-dev", "openmpi-bin", "mkdocs")
        self.call("run", "elastic", "--ranks=2")
        self.assertEqual(len(self.installs()), 1, self.installs())
        self.assertIn("--no-install-recommends", self.installs()[0])
        said = (self.notes / "said").read_text()
        for name in ("g++", "libdeal.ii-dev", "petsc-dev", "openmpi-bin"):
            self.assertIn(f" {name} ", self.installs()[0] + " ")
            self.assertIn(f" {name}", said)
        self.assertNotIn("mkdocs", self.installs()[0])
        shared = self.place / "share/scenes"
        shared.mkdir(parents=True)
        (shared / "soft.toml").write_text("[elastic_base]\n")
        for name, text in (("bends.toml", 'scene = "elastic"'), ("quoted.toml", "scene = 'elastic'"),
                           ("alters.toml", "[[vary]]\nparameter = 'elastic_base.order'"), ("slides.toml", 'scene = "rigid"'),
                           ("varies.toml", 'scene = "rigid"\n[[vary]]\nparameter = "elastic_base.order"'),
                           ("bent/scene.toml", "[elastic_base]")):
            file = self.place / name
            file.parent.mkdir(exist_ok=True)
            file.write_text(text + "\n")
        for words, asked in ((("run", "rigid"), 0), (("run", "rigid", "--ranks=1"), 0), (("scenes",), 0),
                             (("run", "rigid", "--ranks", "2"), 1), (("run", "rigid", "--ranks"), 1),
                             (("run", "rigid", "--set=elastic_base.order=2"), 1), (("flexure",), 1),
                             (("study", "isostasy"), 1), (("study", "speed"), 0),
                             (("sweep", "bends.toml"), 1), (("sweep", "varies.toml"), 1),
                             (("sweep", "slides.toml"), 0), (("sweep", "quoted.toml"), 1),
                             (("sweep", "alters.toml"), 1), (("run", "soft"), 1),
                             (("study", "resolution", "--scene=elastic"), 1),
                             (("fit", "p.csv", "--scene=elastic"), 1), (("fit", "p.csv", "--scene=rigid"), 0),
                             (("figures", "bent"), 1), (("figures", "."), 0),
                             (("report", "bent"), 0), (("view", "bent"), 0)):
            self.note("missing", "petsc-dev")
            self.note("calls")
            self.call(*words, **({"LISTRIC_SHARE": str(shared.parent)} if "soft" in words else {}))
            self.assertEqual(len(self.installs()), asked, words)

    def test_a_plugin_is_built_once_it_can_be(self):
        self.assertEqual(self.call("run", "elastic")[0], "program: <run><elastic>")  # without deal.II
        with open(self.root / "CMakeLists.txt", "a") as project:
            project.write("if(EXISTS ${CMAKE_SOURCE_DIR}/deal.II)\n"
                          "  add_custom_command(OUTPUT liblistric_fem.so COMMAND touch liblistric_fem.so)\n"
                          "  add_custom_target(listric_fem DEPENDS liblistric_fem.so)\nendif()\n")
        self.call("scenes")
        (self.root / "deal.II").touch()
        self.call("scenes")
        self.assertFalse((self.root / "build/native/liblistric_fem.so").exists())
        self.call("run", "elastic")
        self.assertTrue((self.root / "build/native/liblistric_fem.so").exists())

    def test_packages_that_the_system_does_not_have(self):
        self.note("missing", "gmsh", "petsc-dev", "chromium", "chromium-driver")
        self.note("absent", "gmsh", "chromium")
        _, said = self.call("test", "-N")
        self.assertIn("no package chromium gmsh: going on without", said)
        self.assertTrue(self.installs()[0].endswith(" chromium-driver petsc-dev"), self.installs())

    def test_tests_have_two_speeds(self):
        with open(self.root / "CMakeLists.txt", "a") as project:
            project.write("enable_testing()\nforeach(name quick slow)\n  add_test(NAME ${name} COMMAND true)\nendforeach()\n"
                          "set_tests_properties(quick PROPERTIES LABELS regression)\n"
                          "set_tests_properties(slow PROPERTIES LABELS regression_long)\n")
        for words, ran in ((), {"quick"}), (("--all",), {"quick", "slow"}), (("-R", "slow"), {"slow"}), \
                (("-L", "regression"), {"quick", "slow"}), (("--all", "-R", "quick"), {"quick"}):
            out, said = self.call("test", *words)
            self.assertEqual(set(re.findall(r"Start \d+: (\w+)", out)), ran, words)
            self.assertEqual("--all runs all" in said, not words)

    def test_an_installation_shows_how_far_it_is(self):
        self.note("missing", "g++")
        self.note("talk", "0 upgraded, 2 newly installed, 0 to remove", *(
            f"{step} a{k}" for step in ("Get:1", "Unpacking", "Setting up") for k in range(2)))
        _, said = self.call("scenes")
        self.assertIn("listric: fetching package 1 of 2\n", said)
        self.assertEqual(said.count(" package "), 1) # of a moment; a line every half minute
        self.assertNotIn("Unpacking", said)

    def test_reasons_of_a_failed_installation_are_few(self):
        self.note("missing", "g++")
        self.note("broken", *(f"Ign:{k} http://deb.debian.org" for k in range(100)),
                  *(f"E: Failed to fetch {k}" for k in range(9)))
        _, said = self.call("scenes", code=2)
        self.assertEqual(said.count("E: Failed"), 3)
        self.assertLess(len(said.splitlines()), 8)
        self.assertRegex(said, "by hand: .*apt-get install --no-install-recommends g[+][+]\n")

    def test_without_rights(self):
        self.call("scenes")
        self.note("missing", "g++", "libdeal.ii-dev")
        self.only_tools()
        for name in ("dpkg-query", "apt-cache", "apt-get"):
            shutil.copy2(self.scripts / name, self.path)
        user = None if os.geteuid() else NOBODY
        if user:
            for file in [self.place, *self.place.rglob("*")]:
                os.chown(file, user, -1, follow_symlinks=False)
        _, said = self.call("run", "elastic", code=2, user=user)
        self.assertRegex(said, "as root: .*apt-get install --no-install-recommends g[+][+] libdeal.ii-dev\n")
        # What only figures or this call want ends no call of a program that is built.
        self.forget()
        self.note("missing", "python3-matplotlib", "libjs-dygraphs")
        out, said = self.call("scenes", user=user)
        self.assertEqual(out, "program: <scenes>")
        self.assertRegex(said, "as root: .*libjs-dygraphs python3-matplotlib; going on without\n")
        self.note("missing")
        # A tree that cannot be written runs what was built, else names the way out.
        for folder in (self.root / "build", self.root / "build/native"):
            folder.chmod(0o555)
        out, said = self.call("scenes", user=user)
        self.assertEqual(out, "program: <scenes>")
        self.assertIn("as it was last built", said)
        self.assertEqual(self.call("advice", user=user)[0], f"program: <advice>{self.root / 'listric'}")
        origin = self.root / "build/native/origin"
        built = origin.read_text()
        origin.write_text(f"{self.root}\nflags : sse2 avx4096\n")
        for words in (("scenes",), ("help", "run")):
            _, said = self.call(*words, user=user, code=4)
            self.assertIn("for another processor; LISTRIC_BUILD", said)
        origin.write_text(built)
        _, said = self.call("scenes", user=user, code=4, LISTRIC_PRESET="debug")
        self.assertIn("LISTRIC_BUILD", said)
        (self.root / "build").chmod(0o755)

    def test_checks_of_no_files_fail(self):
        (self.root / ".ci").mkdir()
        shutil.copy2(SOURCES / ".ci/run", self.root / ".ci")
        for step in "format", "python":
            out, _ = self.call(step, launcher=self.root / ".ci/run", code=1,
                               GIT_CEILING_DIRECTORIES=str(self.place))
            self.assertIn(f"failed: {step}", out)

    @unittest.skipUnless(shutil.which("git"), "needs git")
    def test_a_clone_for_windows_runs_on_linux(self):
        shutil.copy(SOURCES / ".gitattributes", self.root)
        for words in (("init", "-q"), ("add", "."), ("-c", "core.autocrlf=true", "checkout-index", "-q", "--prefix=win/", "-a")):
            subprocess.run(["git", "-C", self.root, *words], check=True, stderr=subprocess.DEVNULL)
        self.assertNotIn(b"\r", (self.root / "win/listric").read_bytes())

    def test_without_dpkg(self):
        self.only_tools("cmake", "c++")
        _, said = self.call("scenes", code=2)
        self.assertIn("not found: cmake c++;", said)
        self.assertIn("docs/start/install.md", said)
        for name in ("cmake", "c++"):
            (self.place / "tools" / name).symlink_to(shutil.which(name))
        self.assertEqual(self.call("scenes")[0], "program: <scenes>")


if __name__ == "__main__":
    unittest.main()
