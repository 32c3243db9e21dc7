import unittest

from front_door import read_all, violations

MENU = "nav:\n  - Start:\n      - A: a.md\n  - How to:\n      - B: b.md\n  - Explain:\n      - C: c.md\n"
PAGES = {"README.md": "![x](x.webp) three words", "docs/index.md": "![x](x.webp)", "docs/a.md": "![x](x.webp)",
         "docs/b.md": "![x](x.webp)", "docs/c.md": "no picture", "docs/gallery.md": "# Gallery\n\n## lis1\n\n![x](x.webp)\n"}


class PlantedViolations(unittest.TestCase):
    def found(self, menu=MENU, scenes=("lis1",), sizes=None, **pages):
        documents = {**PAGES, **{f"docs/{name}.md": text for name, text in pages.items()}}
        documents["README.md"] = pages.get("README", PAGES["README.md"])
        return violations(documents, menu, scenes, sizes or {})

    def test_a_good_front_door(self):
        self.assertEqual(self.found(sizes={"docs/pictures/a.webp": 150_000, "docs/pictures/lis1.webp": 1_900_000}), [])

    def test_a_long_readme(self):
        self.assertEqual(len(self.found(README="![x](x.webp) " + "word " * 900)), 1)

    def test_a_page_without_a_picture(self):
        self.assertEqual(self.found(b="text"), ["docs/b.md: has no picture"])
        self.assertEqual(self.found(README="text"), ["README.md: has no picture"])

    def test_a_menu_without_a_part(self):
        self.assertEqual(len(self.found(menu=MENU.replace("Start", "Begin"))), 1)

    def test_a_scene_without_a_place(self):
        lacks = ["docs/gallery.md: lacks the scene lis3, with a picture"]
        self.assertEqual(self.found(scenes=("lis1", "lis3")), lacks)
        self.assertEqual(self.found(scenes=("lis1", "lis3"), gallery=PAGES["docs/gallery.md"] + "## lis3\n`lis3`\n"), lacks)

    def test_a_large_picture(self):
        self.assertEqual(len(self.found(sizes={"docs/pictures/a.webp": 150_001})), 1)
        self.assertEqual(len(self.found(sizes={"docs/pictures/lis1.webp": 2_000_001})), 1)


class Documents(unittest.TestCase):
    def test_front_door(self):
        self.assertEqual(violations(*read_all()), [])


if __name__ == "__main__":
    unittest.main()
