"""A program for any x86-64 processor runs on one with no more than SSE2, and on one without AVX-512, to the
same bits as here: on processors that qemu emulates.

The program is what LISTRIC_PROGRAM names, or, of a build of dem alone, tests/dem_only/levels.cpp, which
LISTRIC_LEVELS names. Where the emulated processor has no fused multiply-add, the C library here is asked
to go without, too. Genesis, which would take an emulator minutes, is recalled from the run here.
"""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SCENE = pathlib.Path(__file__).resolve().parents[1] / "scenes" / "every-effect.toml"
UNTIL = "20m"
WITHOUT_FMA = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA"}


@unittest.skipUnless(shutil.which("qemu-x86_64"), "no qemu-x86_64 (Debian package qemu-user)")
class OldProcessors(unittest.TestCase):
    def setUp(self):
        self.cache = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.cache)

    def run_scene(self, *emulator, **environment):
        if "LISTRIC_LEVELS" in os.environ:
            return tuple(subprocess.run([*emulator, os.environ["LISTRIC_LEVELS"]], stdout=subprocess.PIPE, text=True,
                                        check=True, env={**os.environ, **environment}).stdout.split())
        with tempfile.TemporaryDirectory() as folder:
            call = [*emulator, os.environ["LISTRIC_PROGRAM"], "run", str(SCENE), "--until", UNTIL,
                    "--threads", "1", "--output", folder + "/run"]
            ended = subprocess.run(call, capture_output=True, text=True, check=False, env={
                **os.environ, "XDG_CACHE_HOME": self.cache, **environment})
            self.assertEqual(ended.returncode, 0, ended.stderr)
            summary = json.loads(pathlib.Path(folder, "run", "summary.json").read_text())
            return summary["cycle_level"], summary["state_hash"]

    def test_with_sse2_alone(self):
        emulator = ("qemu-x86_64", "-cpu", "kvm64,-sse3")
        here = self.run_scene(LISTRIC_CYCLE="plain", **WITHOUT_FMA)
        self.assertEqual(self.run_scene(*emulator), here)
        self.assertEqual(self.run_scene(*emulator, LISTRIC_CYCLE="baseline"), ("baseline", here[1]))

    def test_without_avx512(self):
        here = self.run_scene(LISTRIC_CYCLE="plain")
        self.assertEqual(self.run_scene("qemu-x86_64", "-cpu", "Haswell"), ("v3", here[1]))


if __name__ == "__main__":
    unittest.main()
