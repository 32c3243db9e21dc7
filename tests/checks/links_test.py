import unittest

from links import anchors, in_tree, links, read_documents, violations


class PlantedViolations(unittest.TestCase):
    def found(self, text, other="# Faults\n\n## What is a fault?\n"):
        documents = {"docs/theory/a.md": text, "docs/b.md": other}
        return violations(documents, lambda path: path in documents or path in ("docs", "dem/law.hpp"))

    def test_a_good_link(self):
        for link in ("../b.md", "../b.md#what-is-a-fault", "#here", "../../dem/law.hpp",
                     "https://other.host/b.md"):
            self.assertEqual(self.found(f"# Here\n\n[x]({link})\n"), [], link)

    def test_no_such_file(self):
        self.assertEqual(self.found("[x](b.md)"), ["docs/theory/a.md: b.md: no such file"])
        self.assertEqual(self.found("![x](../b.png)"), ["docs/theory/a.md: ../b.png: no such file"])
        self.assertEqual(self.found("see docs/c.md"), ["docs/theory/a.md: docs/c.md: no such file"])

    def test_the_lab_book_names_files_of_its_time(self):
        text = "see docs/c.md"
        self.assertEqual(violations({"docs/record/2026-11/a.md": text}, lambda path: False), [])

    def test_no_such_heading(self):
        for link in ("../b.md#faults-and-more", "#here", "../../dem/law.hpp#faults"):
            self.assertEqual(len(self.found(f"[x]({link})")), 1, link)

    def test_a_heading_that_the_site_names_otherwise(self):
        self.assertEqual(len(self.found("[x](../b.md#a--b)", "# A & B\n")), 1)
        self.assertEqual(len(self.found("[x](../b.md#a-b)", "# A & B\n")), 1)

    def test_code_has_no_links_and_no_headings(self):
        self.assertEqual(links("`[x](b.md)`\n\n```\n[x](b.md)\n```\n"), [])
        self.assertEqual(anchors("```\n# no heading\n```\n# One `two` [three](x.md)\n"),
                         {"one-two-three"})


class Documents(unittest.TestCase):
    def test_links_lead_somewhere(self):
        self.assertEqual(violations(read_documents(), in_tree), [])

    def test_ones_own_section_is_a_click_away(self):
        documents = read_documents()
        self.assertIn("docs/start/your-own-section.md", links(documents["README.md"]))
        self.assertIn("start/your-own-section.md", links(documents["docs/index.md"]))


if __name__ == "__main__":
    unittest.main()
