import unittest

from links import read_documents
from record import violations


class PlantedViolations(unittest.TestCase):
    def found(self, text, path="docs/a.md"):
        return violations({path: text})

    def test_a_page_that_names_its_commit(self):
        for words in ("Made at commit ca655f1.", "Made by Listric 0.2.0+ca655f1."):
            self.assertEqual(self.found(f"{words}\n\n![a](a.png)\n"), [], words)

    def test_a_page_that_does_not(self):
        for link in ("![a](a/b.png)", "[a](a/b.csv)"):
            self.assertEqual(len(self.found(f"Made at commit 12.\n\n{link}\n")), 1, link)

    def test_a_page_without_a_record(self):
        self.assertEqual(self.found("[a](b.md), as `![a](a.png)` would be\n"), [])
        self.assertEqual(self.found("![a](a.png)", path="README.md"), [])


class Documents(unittest.TestCase):
    def test_the_record_names_its_commits(self):
        self.assertEqual(violations(read_documents()), [])


if __name__ == "__main__":
    unittest.main()
