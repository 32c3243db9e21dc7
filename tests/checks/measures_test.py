import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from measures import names, read_dictionary, violations
from source_tree import read_tree


class PlantedViolations(unittest.TestCase):
    def test_a_name_in_two_files(self):
        tree = {"apps/a.cpp": '{"area_balance", "1"}', "apps/b.cpp": 'x("area_balance");'}
        self.assertEqual(violations(tree, {"area_balance"}),
                         ["area_balance: declared in one place, but written in apps/a.cpp, apps/b.cpp"])

    def test_what_is_no_violation(self):
        tree = {"apps/a.cpp": '{"area_balance"} "area_balance"', "apps/b.cpp": '"area_balance_x"',
                "apps/c.py": '"area_balance"'}
        self.assertEqual(violations(tree, {"area_balance"}), [])


class Call(unittest.TestCase):
    def ended(self, root):
        """The call that checks the tree there."""
        check = Path(__file__).with_name("measures.py")
        return subprocess.run([sys.executable, "-B", check, root], capture_output=True, text=True, check=False)

    def test_a_violation_is_its_exit_code(self):
        with tempfile.TemporaryDirectory() as root:
            Path(root, "apps").mkdir()
            self.assertEqual(self.ended(root).returncode, 1)   # nothing is looked at
            Path(root, "apps/a.cpp").write_text('x("area_balance");')
            self.assertEqual(self.ended(root).returncode, 0)
            Path(root, "apps/b.cpp").write_text('x("area_balance");')
            found = self.ended(root)
            self.assertEqual((found.returncode, found.stdout.startswith("area_balance: ")), (1, True), found)


class Sources(unittest.TestCase):
    def test_each_name_stands_in_one_file(self):
        self.assertEqual(violations(read_tree(), names(read_dictionary())), [])


if __name__ == "__main__":
    unittest.main()
