"""Some cases of tests/stability/damaged_inputs.py, always the same.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest damaged_inputs_test
"""

import sys
import unittest

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


if __name__ == "__main__":
    unittest.main()
