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
        self.assertGreater(runner.codes["checked"], 70)

    def test_a_failure_of_the_batch_alone_is_one(self):
        said = 'echo "$#"; [ $# = 2 ] || echo more'
        with tempfile.TemporaryDirectory() as scratch:
            program = Path(scratch, "listric")
            for script, failures in ((f"[ $# -gt 2 ] && kill -SEGV $$; {said}", [("batch-0", "exit code -11")]),
                                     (f"{said}; exit 3", [(number, "exit code 3") for number in range(3)]),
                                     ("echo one line", [("batch-0", "1 lines about 3 files")]),
                                     (f"{said}; echo three; exit 2", [])):
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
