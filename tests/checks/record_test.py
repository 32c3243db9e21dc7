import unittest

from links import read_documents
from record import INDEX, violations

PAGE = """# A

| record | |
|---|---|
| date | 2026-11-23 |
| commit | ca655f1 |
| machine | two cores |
| call | `listric run lis1` |

Sped up from 1.79 at 4c3afaf; it was slower on 22 November.
"""


class PlantedViolations(unittest.TestCase):
    def guide(self, text, path="docs/a.md"):
        return violations({path: text})

    def book(self, text, index="[a](2026-11/a.md)"):
        return violations({"docs/record/2026-11/a.md": text, INDEX: index})

    def test_a_guide_page_of_today(self):
        for text in ("Tilt is 38.17 degrees over 1000000 discs ([record](record/2026-11/a.md)).",
                     "`git show ca655f1` and `it was` are code", "at most 9.22e18, 1e-13 per second", "a defaced facade",
                     "The load that was deposited at its age; Seyferth and Henk (2005)"):
            self.assertEqual(self.guide(text), [], text)

    def test_a_guide_page_with_a_commit(self):
        for text in ("Made by ca655f1.", "0.2.0+ca655f1", "its `state_hash` is 683ed2cad3daedf9", "| 4c3afaf | 1.9 |"):
            self.assertEqual(len(self.guide(text.replace("0.2.0+", "version "))), 1, text)
        self.assertEqual(len(self.guide("Made by ca655f1.", "README.md")), 1)

    def test_a_guide_page_with_a_date(self):
        for text in ("made on 2026-11-23", "since 24 November", "the 3rd November"):
            self.assertEqual(len(self.guide(text)), 1, text)
        self.assertEqual(self.guide("accepted 23 November 2004", "docs/references.md"), [])

    def test_a_guide_page_with_a_past(self):
        for text in ("0.74 where it was 0.62", "They were slower.", "It no longer reads them.", "Found at commit twelve."):
            self.assertEqual(len(self.guide(text)), 1, text)

    def test_a_page_of_the_book(self):
        self.assertEqual(self.book(PAGE), [])

    def test_a_page_of_the_book_without_its_rows(self):
        for name in ("date", "commit", "machine", "call"):
            self.assertEqual(len(self.book(PAGE.replace(f"| {name} |", "| other |"))), 1, name)
        self.assertEqual(len(self.book(PAGE.replace("ca655f1", "the newest"))), 1)
        self.assertEqual(len(self.book(PAGE.replace("`listric run lis1`", "as ever"))), 1)

    def test_a_page_that_the_index_lacks(self):
        self.assertEqual(len(self.book(PAGE, index="[b](2026-11/b.md)")), 1)


class Documents(unittest.TestCase):
    def test_guide_and_book_are_apart(self):
        self.assertEqual(violations(read_documents()), [])


if __name__ == "__main__":
    unittest.main()
