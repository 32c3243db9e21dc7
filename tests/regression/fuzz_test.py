"""Some cases of tests/fuzz, always the same ones; and its shrinker.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest fuzz_test
"""

import math
import random
import sys
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

from program import PROGRAM, SOURCES

sys.path.insert(0, str(SOURCES / "tests/fuzz"))
import fuzz  # noqa: E402
import scenes  # noqa: E402
import shrink  # noqa: E402


class Fuzz(unittest.TestCase):
    def test_cases_end_in_order(self):
        fuzzer = fuzz.fuzz(PROGRAM, 120.0, "test", kinds=("scenes", "snapshots"), most=2, batch=12)
        self.assertEqual(fuzzer.failures, [])
        self.assertEqual(fuzzer.count["scenes"], 2 * fuzz.SHARES["scenes"] * 12)
        self.assertGreater(fuzzer.count["valid scenes"], 10)   # else only refusals are tested
        self.assertEqual(fuzzer.count["snapshots"], 2 * fuzz.SHARES["snapshots"])

    def test_a_small_scene_is_brief_enough_to_run(self):
        with tempfile.TemporaryDirectory() as scratch:
            fuzzer = fuzz.Fuzzer(PROGRAM, Path(scratch), Path(scratch) / "kept", "test", 1)
            wrong = {**scenes.BASE, "gravity": {"acceleration": 9.81}}
            correct = fuzzer.correct_ones([wrong, scenes.BASE], 0, Path(scratch), "runs")
        self.assertEqual(list(correct), [1])
        self.assertLessEqual(fuzz.forecast(correct[1]), fuzz.BRIEF, correct[1])
        self.assertEqual(fuzz.forecast("7 tables, about 176 discs, 52 s, 3 snapshots, 1 MB of disk"), 52)
        self.assertEqual(fuzz.forecast("7 tables, about 176 discs, 52.0 min, 3 snapshots, 1 MB of disk"), math.inf)

    def test_a_run_that_was_forecast_to_be_long_may_be(self):
        with tempfile.TemporaryDirectory() as scratch, mock.patch.dict(fuzz.LONGEST, {"run": 0.1}):
            fuzzer = self.fuzzer_of(scratch, "sleep 1; echo refused; exit 2")
            self.assertEqual(fuzzer.run("", Path(scratch, "run"), seconds=1), (None, 2, b"refused\n"))
            self.assertRegex(fuzzer.run("", Path(scratch, "run"))[0], "no end in")

    def test_what_crashes_is_found_and_shrunk(self):
        class Broken(fuzz.Fuzzer):
            def checked(self, text, folder, words=("check",)):
                return ("it crashed" if "friction" in text and "[bonds]" in text else None), 0, b""

        found = []
        broken = Broken.__new__(Broken)
        broken.scratch = SOURCES
        broken.fail = lambda name, first, files, calls: found.append(files["a.toml"].decode())
        scene = {**scenes.BASE, "bonds": {"tensile_strength_pa": 1e6}, "gravity": {}, "compaction": {}}
        scene["detachment"] = scene["detachment"] | {"friction": 0.2}
        broken.shrunk_scene(scene, 1, ("check",))
        self.assertEqual(len(found), 1)
        self.assertIn("[bonds]", found[0])
        self.assertNotIn("tensile", found[0])
        self.assertNotIn("[gravity]", found[0])

    def test_a_failure_of_the_batch_alone_is_one(self):
        with tempfile.TemporaryDirectory() as scratch:
            scratch = Path(scratch)
            program = scratch / "listric"
            for script, failures in (('[ $# -gt 2 ] && kill -SEGV $$; echo correct', [("check-scenes-7", "exit code -11")]),
                                     ("exit 4", [("check-scenes-7-0", "exit code 4"), ("check-scenes-7-1", "exit code 4")]),
                                     ("echo refused; exit 2", [])):
                program.write_text(f"#!/bin/sh\n{script}\n")
                program.chmod(0o755)
                fuzzer = fuzz.Fuzzer(program, scratch, scratch / "kept", "test", 2)
                fuzzer.correct_ones([scenes.BASE, scenes.BASE], 7, scratch, "scenes")
                self.assertEqual(fuzzer.failures, failures)
                self.assertTrue(all((scratch / "kept" / name).is_dir() for name, _ in failures))
            kept = scratch / "kept/check-scenes-7"
            self.assertEqual((kept / "call.txt").read_text(), "check 0.toml 1.toml\nexit code -11\n")
            self.assertTrue((kept / "1.toml").is_file())

    def fuzzer_of(self, scratch, script):
        program = Path(scratch, "listric")
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)
        return fuzz.Fuzzer(program, Path(scratch), Path(scratch, "kept"), "test", 1)

    def test_every_kind_has_a_case_when_the_time_is_over_at_once(self):
        for jobs in (1, 2):
            with tempfile.TemporaryDirectory() as scratch:
                fuzzer = self.fuzzer_of(scratch, 'while [ $# -gt 1 ] && [ "$1" != --output ]; do shift; done; mkdir -p "$2"'
                                        '; echo "{\\"finished\\": true, \\"state_hash\\": 1}" >"$2/summary.json"')
                fuzzer.carry_out(0.0, jobs, fuzz.KINDS)
            self.assertEqual((fuzzer.failures, dict(fuzzer.made)), ([], dict.fromkeys(fuzz.KINDS, fuzz.LEAST)))

    def test_a_run_that_cannot_be_resumed_fails(self):
        for script, why in (('case "$*" in *--until*) ;; *--resume*) echo "there is another run"; exit 2;; esac',
                             "exit code 2 of the last call, --resume"),
                            ("exit 0", "no summary.json after a run to its end")):
            with tempfile.TemporaryDirectory() as scratch:
                fuzzer = self.fuzzer_of(scratch, script)
                fuzzer.case("sequences", 0)
            self.assertEqual(fuzzer.failures, [("sequence-0", why)])

    def test_what_explain_tells_is_kept(self):
        with tempfile.TemporaryDirectory() as scratch:
            scratch = Path(scratch)
            program = scratch / "listric"
            program.write_text('#!/bin/sh\n[ "$1" = explain ] && echo depth is nan m || echo correct\n')
            program.chmod(0o755)
            fuzzer = fuzz.Fuzzer(program, scratch, scratch / "kept", "test", 1)
            fuzzer.case("scenes", 0)
            self.assertEqual(fuzzer.failures, [("explain-0", "explain tells a number that is none")])

    def test_numbers_are_inside_or_beyond_their_range(self):
        kind = {"type": "number", "minimum": 0.1, "maximum": 5.0, "default": 1.0}
        chance = random.Random(1)
        inside = [scenes.number(chance, kind, False) for _ in range(300)]
        self.assertTrue(all(0.1 <= one <= 5.0 for one in inside))
        self.assertIn(0.1, inside)
        self.assertIn(5.0, inside)
        beyond = [scenes.number(chance, kind, True) for _ in range(300)]
        self.assertTrue(any(one < 0.1 for one in beyond) and any(one > 5.0 for one in beyond))

    def test_lists_and_texts_shrink_to_what_fails(self):
        self.assertEqual(shrink.shrink_list(list(range(40)), lambda kept: {3, 29} <= set(kept)), [3, 29])
        parts = list(range(40))
        self.assertEqual(shrink.shrink_list(parts, lambda kept: 3 in kept, end=time.monotonic()), parts)
        text = b"one\ntwo\nthree bad\nfour\n"
        self.assertEqual(shrink.shrink_text(text, lambda data: b"bad" in data), b"bad")


if __name__ == "__main__":
    unittest.main()
