"""Some cases of tests/stability/damaged_inputs.py, always the same.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest damaged_inputs_test
"""

import sys
import tempfile
import unittest
from pathlib import Path

from program import PROGRAM, SOURCES

sys.path.insert(0, str(SOURCES / "tests/stability"))
import damaged_inputs  # noqa: E402

QUICK = [reader for reader in damaged_inputs.SHARES
         if reader not in ("explained", "begun", "failed_sweep", "underlay")]


class DamagedInputs(unittest.TestCase):
    def test_what_is_damaged_ends_in_a_sentence(self):
        runner = damaged_inputs.carry_out(PROGRAM, 110, seed=38, only=QUICK)
        self.assertEqual([(case.reader, case.number, why) for case, why in runner.failures], [])
        self.assertEqual(runner.tolerant(QUICK), [])
        self.assertGreater(runner.codes["checked"], 70)
        self.assertGreater(sum(runner.refused.values()), 50)

    def judged(self, script, count=110, only=QUICK):
        """What is found of a program, a script: failures of cases, by number, and readers that are too tolerant."""
        with tempfile.TemporaryDirectory() as scratch:
            program = Path(scratch, "listric")
            program.write_text(f"#!/bin/sh\n{script}\n")
            program.chmod(0o755)
            runner = damaged_inputs.carry_out(program, count, seed=38, only=only)
            return [(case.number, why) for case, why in runner.failures], runner.tolerant(only)

    def test_a_program_that_accepts_everything_fails(self):
        failures, tolerant = self.judged('shift; for file; do echo "$file: correct"; done')
        self.assertEqual(failures, [])
        self.assertEqual(tolerant, [(reader, "refuses nothing") for reader in QUICK])

    def test_refusals_without_file_or_place_fail(self):
        only = ["scene"]   # one batch
        self.assertEqual(self.judged("shift; for file; do echo x; done; exit 2", 5, only), (
            [(number, "a refusal without the name of a file") for number in range(5)], [("scene", "refuses nothing")]))
        self.assertEqual(self.judged('shift; for file; do echo "$file: is wrong"; done; exit 2', 5, only),
                         ([], [("scene", "0 of 5 refusals say where")]))
        self.assertEqual(self.judged('shift; for file; do echo "$file:3: is wrong"; done; exit 2', 5, only), ([], []))
        self.assertEqual(self.judged("exit 2", 5, only)[0],
                         [(number, "exit code 2 without a word") for number in range(5)])

    def test_a_failure_of_the_batch_alone_is_one(self):
        said = 'shift; for file; do echo "$file: correct"; done'
        with tempfile.TemporaryDirectory() as scratch:
            program = Path(scratch, "listric")
            for script, failures in ((f"[ $# -gt 2 ] && kill -SEGV $$; {said}", [("batch-0", "exit code -11")]),
                                     (f"{said}; exit 3", [(number, "exit code 3") for number in range(3)]),
                                     ('echo "$2: correct"', [("batch-0", "no line about 2 of 3 files")]),
                                     (f"{said}; exit 2", [("batch-0", "exit code 2, but 0 files refused")]),
                                     ('shift; for file; do echo "$file:1: no"; done; exit 2', [])):
                program.write_text(f"#!/bin/sh\n{script}\n")
                program.chmod(0o755)
                runner = damaged_inputs.Runner(program, Path(scratch), Path(scratch, "kept"))
                runner.carry_out([damaged_inputs.Case("scene", number, {"a.toml": b"x"}, [["check", "@a.toml"]], True)
                                  for number in range(3)], 1)
                self.assertEqual([(case.number, why) for case, why in runner.failures], failures, script)
            self.assertIn("check @0/a.toml @1/a.toml @2/a.toml", Path(scratch, "kept/scene-batch-0/call.txt").read_text())
            self.assertTrue(Path(scratch, "kept/scene-batch-0/2/a.toml").is_file())


if __name__ == "__main__":
    unittest.main()
