import unittest

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


class Sources(unittest.TestCase):
    def test_each_name_stands_in_one_file(self):
        self.assertEqual(violations(read_tree(), names(read_dictionary())), [])



if __name__ == "__main__":
    unittest.main()
