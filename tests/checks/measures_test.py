import importlib.util
import sys
import unittest

from measures import names, read_dictionary, violations
from source_tree import ROOT, read_tree

spec = importlib.util.spec_from_file_location("measures_page", ROOT / "docs/measures.py")
page = importlib.util.module_from_spec(spec)
spec.loader.exec_module(page)
sys.path.insert(0, str(ROOT / "apps/python"))


class PlantedViolations(unittest.TestCase):
    def test_a_name_in_two_files(self):
        tree = {"apps/a.cpp": '{"area_balance", "1"}', "apps/b.cpp": 'x("area_balance");'}
        self.assertEqual(violations(tree, {"area_balance"}),
                         ["area_balance: declared in one place, but written in apps/a.cpp, apps/b.cpp"])

    def test_what_is_no_violation(self):
        tree = {"apps/a.cpp": '{"area_balance"} "area_balance"', "apps/b.cpp": '"area_balance_x"',
                "apps/c.py": '"area_balance"'}
        self.assertEqual(violations(tree, {"area_balance"}), [])

    def test_a_page_that_is_behind(self):
        entries = [{"name": "a_m", "table": "t", "unit": "m", "doc": "new",
                    "parts": [{"name": "b", "unit": "1", "doc": "part"}]}]
        text = "by hand\n<!-- measures: t -->\n| `a_m` | m | old |\n<!-- end -->\nmore\n"
        made = page.page(text, entries)
        self.assertNotEqual(made, text)
        self.assertIn("| `a_m` | m | new |\n| `a_m`: `b` | 1 | part |\n<!-- end -->\nmore", made)
        self.assertEqual(page.page(made, entries), made)
        self.assertEqual(page.missing("", entries), ["t"])


class Sources(unittest.TestCase):
    def test_each_name_stands_in_one_file(self):
        self.assertEqual(violations(read_tree(), names(read_dictionary())), [])

    def test_the_page_is_current(self):
        text, entries = page.PAGE.read_text(encoding="utf-8"), read_dictionary()
        self.assertEqual(page.missing(text, entries), [])
        self.assertEqual(page.page(text, entries), text, "make it anew: docs/parameters.sh")

    def test_every_entry_says_what_it_is(self):
        for entry in read_dictionary():
            for one in (entry, *entry.get("parts", ())):
                self.assertTrue(one["doc"], one)
                self.assertNotIn("|", one["doc"] + one["unit"], one)


if __name__ == "__main__":
    unittest.main()
