"""What is installed serves strangers: moved away from where it was installed, without the sources,
the program runs and other projects link the libraries.

    LISTRIC_BUILD=build/native python3 -m unittest install_test      in this folder
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
SOURCES = HERE.parents[1]
BUILD = Path(os.environ.get("LISTRIC_BUILD", SOURCES / "build/native")).resolve()

# Hides build and sources from what follows; needs no root where users may have namespaces.
HIDE = ["unshare", "--mount", "--map-root-user", "sh", "-c",
        'mount -t tmpfs none "$0" && mount -t tmpfs none "$1" && shift && exec "$@"', BUILD, SOURCES]


def call(*command, **options):
    """Its output; an error shows it."""
    done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, **options)
    if done.returncode:
        raise AssertionError(f"{' '.join(map(str, command))}\nexit {done.returncode}\n{done.stdout}")
    return done.stdout


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = Path(tempfile.mkdtemp(prefix="listric-installed-"))
        cls.addClassCleanup(shutil.rmtree, cls.place)
        call("cmake", "--install", BUILD, "--prefix", cls.place / "first")
        cls.prefix = cls.place / "moved"
        (cls.place / "first").rename(cls.prefix)
        cls.elsewhere = cls.place / "elsewhere"
        cls.elsewhere.mkdir()
        cls.hide = HIDE if subprocess.run([*HIDE, "true"], capture_output=True).returncode == 0 else []
        cls.state_hash = cls.run_lis1("500m")

    @classmethod
    def outside(cls, *words):
        """A call in an empty folder; sources and build are hidden where that is allowed."""
        return call(*cls.hide, *words, cwd=cls.elsewhere)

    @classmethod
    def program(cls, *words):
        return cls.outside(cls.prefix / "bin/listric", *words)

    @classmethod
    def run_lis1(cls, until, output="out/lis1"):
        """The hash of LIS1 at draft accuracy."""
        cls.program("run", "lis1", "--accuracy", "draft", "--until", until, "--quiet", "--output", output)
        return json.loads((cls.elsewhere / output / "summary.json").read_text())["state_hash"]

    def project(self, source, *definitions, target="all"):
        """Configures and builds a project; the folder of its programs."""
        folder = self.place / Path(source).name
        call("cmake", "-G", "Ninja", "-S", source, "-B", folder, "-DCMAKE_BUILD_TYPE=Release",
             f"-DCMAKE_PREFIX_PATH={self.prefix}", *definitions)
        call("cmake", "--build", folder, "--target", target)
        return folder

    def test_sources_and_build_are_hidden(self):
        if not self.hide:
            self.skipTest("no user may hide folders here (unshare)")
        for file in SOURCES / "CMakeLists.txt", BUILD / "CMakeCache.txt":
            self.assertTrue(file.exists())
            self.outside("test", "!", "-e", file)

    def test_the_program_runs_without_the_sources(self):
        figures = list((self.elsewhere / "out/lis1/figures").glob("*.png"))
        self.assertTrue(figures, "no figures")
        self.program("laboratory", "uniaxial", "mat18-b")
        self.assertIn("lis1-elastic", self.program("scenes"))
        if any(self.prefix.rglob("liblistric_fem.so")):
            self.program("run", "flexure")
        if any(self.prefix.rglob("liblistric_ranks.so")):
            self.program("run", "lis1", "--accuracy", "draft", "--until", "0m", "--ranks", "--output", "alone")

    def test_editors_and_shells_find_their_files(self):
        share = self.prefix / "share"
        scene = share / "listric/scenes/lis1.toml"
        schema = scene.parent / scene.read_text().split()[1]
        self.assertIn("hanging_wall", json.loads(schema.read_text())["properties"])
        self.assertIn("lis1: correct: ", self.program("check", "lis1"))
        self.assertTrue((share / "listric/records/validation.csv").is_file())
        for script in ("bash-completion/completions/listric", "zsh/site-functions/_listric",
                       "fish/vendor_completions.d/listric.fish"):
            self.assertIn("'listric' complete ", (share / script).read_text())
        self.assertIn("lis1-elastic", self.program("complete", "run", "lis1-"))
        self.assertIn(".TH LISTRIC 1", (share / "man/man1/listric.1").read_text())

    def test_python_finds_the_package_and_the_package_the_program(self):
        script = ("import listric, sys; print(listric.find_program());"
                  "run = listric.Run(sys.argv[1]); print(run.summary['state_hash']);"
                  "print(run.snapshots[0].discs['x'].units)")
        environment = {name: value for name, value in os.environ.items() if name != "LISTRIC_PROGRAM"}
        environment["PYTHONPATH"] = str(self.prefix / "lib/python3/dist-packages")
        said = call(sys.executable, "-B", "-c", script, self.elsewhere / "out/lis1", env=environment)
        self.assertEqual(said.split(), [str(self.prefix / "bin/listric"), self.state_hash, "m"])

    def test_a_project_finds_the_package(self):
        folder = self.project(HERE / "consumer")
        faults = [[float(word) for word in line.split()]
                  for line in call(folder / "trace_fault").splitlines()]
        self.assertEqual(len(faults), 1)
        dip, slip, throw, misfit = faults[0]
        self.assertAlmostEqual(dip, 60.0, delta=2.0)
        # Across one spacing on each side, a fit sees three quarters of the slip or more.
        self.assertAlmostEqual(throw, 30.0 * 3 ** 0.5 / 2, delta=0.25 * 26.0)
        self.assertLess(misfit, 1.0)

    def test_the_examples_have_the_bits_of_the_program(self):
        folder = self.project(SOURCES / "examples")
        self.assertEqual(call(folder / "drive_lis1").strip(), self.state_hash)
        self.assertGreater(int(call(folder / "own_event").split()[0]), 100)
        snapshots = sorted((self.elsewhere / "out/lis1/snapshots").glob("*.h5"))
        table = call(folder / "read_snapshots", *snapshots).splitlines()
        self.assertEqual(len(table), 1 + len(snapshots))
        self.assertEqual(table[1].split(), ["0", "0.0", "0.0"])
        said = self.outside(folder / "run_scene").splitlines()
        self.assertIn("rollover_tilt_deg ", " ".join(said))
        self.assertEqual(said[-1].split()[-1], self.run_lis1("1km", "out/1km"))

    def test_examples_are_short_and_stand_in_the_documents(self):
        page = (SOURCES / "docs/guides/library.md").read_text()
        programs = sorted((SOURCES / "examples").glob("*.cpp"))
        self.assertEqual(len(programs), 4)
        for program in programs:
            text = program.read_text()
            self.assertIn(f"```cpp\n{text}```\n", page, program.name)
            self.assertLessEqual(text.count("\n"), 30 if program.stem == "run_scene" else 40, program)

    def test_a_project_of_one_library_needs_its_packages_alone(self):
        of_scenes = ("tomlplusplus", "nlohmann_json", "pugixml")
        for library, hidden in (("dem", (*of_scenes, "fmt", "ZLIB", "PkgConfig")), ("snapshot", of_scenes)):
            source = self.elsewhere / library
            source.mkdir()
            (source / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(mine LANGUAGES CXX)\n"
                f"find_package(Listric REQUIRED COMPONENTS {library})\nadd_executable(mine mine.cpp)\n"
                f"target_link_libraries(mine PRIVATE listric::{library})\n")
            (source / "mine.cpp").write_text(f"#include <listric/{library}.hpp>\nint main() {{}}\n")
            self.project(source, *(f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in hidden))

    def test_a_project_builds_the_sources_with_its_own(self):
        # Bits are equal at any optimisation; little of it builds faster.
        folder = self.project(HERE / "fetched", f"-DLISTRIC_SOURCE_DIR={SOURCES}", "-DLISTRIC_FEM=OFF",
                              "-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-DCMAKE_UNITY_BUILD=ON", target="drive_lis1")
        self.assertEqual(call(folder / "drive_lis1").strip(), self.state_hash)

    def test_a_project_goes_on_without_what_listric_needs(self):
        source = self.elsewhere / "optional"
        source.mkdir()
        (source / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(mine LANGUAGES CXX)\n"
            "find_package(Listric QUIET)\nmessage(\"found ${Listric_FOUND}: ${Listric_NOT_FOUND_MESSAGE}\")\n")
        said = call("cmake", "-G", "Ninja", "-S", source, "-B", self.place / "optional",
                    f"-DCMAKE_PREFIX_PATH={self.prefix}", env={**os.environ, "PKG_CONFIG_LIBDIR": "/nonexistent"})
        self.assertIn("found 0: Listric needs HDF5", said)

    def test_a_umask_closes_nothing_unsaid(self):
        closed = self.place / "closed"
        said = call("cmake", "--install", BUILD, "--prefix", closed, "--component", "development", umask=0o077)
        cure = re.search(r"chmod\s+-R\s+a\+rX\s+'(.*)'", said)
        self.assertEqual(cure and cure[1], str(closed), said)
        said = call("cpack", "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", closed / "packages",
                    "-D", "CPACK_DEBIAN_PACKAGE_SHLIBDEPS=OFF", "-D", "CPACK_COMPONENTS_ALL=development", umask=0o077)
        packed, = closed.glob("packages/_CPack_Packages/*/DEB/*/development/usr")
        for path in [packed, *packed.rglob("*")]:
            self.assertEqual(path.stat().st_mode & 0o444, 0o444, path)
            self.assertTrue(path.is_file() or path.stat().st_mode & 0o111 == 0o111, path)

    def test_what_others_read_names_no_folder_of_ours(self):
        for file in self.prefix.rglob("*.cmake"):
            self.assertNotIn(str(SOURCES), file.read_text(), file)

    def test_public_headers_include_only_public_headers(self):
        headers = self.prefix / "include/listric"
        include = re.compile(r'^#include "([^"]*)"', re.MULTILINE)
        for header in headers.rglob("*.hpp"):
            for name in include.findall(header.read_text()):
                self.assertTrue((headers / name).exists(), f"{header}: {name} is not installed")


if __name__ == "__main__":
    unittest.main()
