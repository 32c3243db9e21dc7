import unittest

from source_tree import ROOT
from weight import cases, read_files, table, weigh


class Weight(unittest.TestCase):
    FILES = {"dem/cycle.cpp": b"int a;\nint b;\n", "apps/run/a.js": b"a();\n", "docs/a.md": b"# A\n\nText\n",
             "docs/record/b.md": b"# B\n", "tests/unit/a_test.cpp": b"TEST(A, Holds) {\n}\nTEST_F(B, Holds) {\n}\n",
             "tests/regression/b_test.py": b"class B:\n    def test_b(self):\n        pass\n"}

    def test_rooms_and_documents(self):
        weight = weigh(self.FILES)
        for what, number in (("files", 6), ("bytes", sum(map(len, self.FILES.values()))), ("lines in dem", 2),
                             ("lines in apps/run", 1), ("lines outside tests", 3), ("lines of documents", 3),
                             ("lines of the lab book", 1), ("lines of tests, C++", 4), ("lines of tests, Python", 3),
                             ("test cases", 3)):
            self.assertEqual(weight[what], number, what)

    def test_cases(self):
        self.assertEqual(cases(self.FILES), {"A.Holds", "B.Holds", "b_test.test_b"})

    def test_difference(self):
        fewer = dict(self.FILES, **{"dem/cycle.cpp": b"int a;\n"})
        self.assertIn(f"{'lines in dem':<28}           2           1          -1", list(table(weigh(self.FILES), weigh(fewer))))

    @unittest.skipUnless((ROOT / ".git").exists(), "no clone")
    def test_a_commit_is_read_as_the_working_tree_is(self):
        now, head = read_files("."), read_files("HEAD")
        self.assertIn("README.md", now.keys() & head.keys())
        self.assertEqual(head["LICENSE"], now["LICENSE"])


if __name__ == "__main__":
    unittest.main()
