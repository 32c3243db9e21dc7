import ast
import unittest
from pathlib import Path

from systems import ENVIRONMENT, INSTALL, RECIPE, read_all, violations
from source_tree import ROOT


class PlantedViolations(unittest.TestCase):
    def found(self, path, old, new=""):
        texts = read_all()
        self.assertIn(old, texts[path])
        return violations(texts | {path: texts[path].replace(old, new)})

    def test_a_package_that_nobody_is_told_of(self):
        self.assertEqual(len(self.found("apps/CMakeLists.txt", "find_package(fmt", "find_package(boost")), 2)

    def test_what_an_environment_lacks(self):
        self.assertEqual(self.found(ENVIRONMENT, "  - pugixml\n"), [f"{ENVIRONMENT}: lacks pugixml"])

    def test_what_a_recipe_lacks(self):
        self.assertEqual(self.found(RECIPE, '    depends_on("cli11")\n'), [f"{RECIPE}: lacks cli11"])

    def test_what_a_table_lacks(self):
        self.assertEqual(self.found(INSTALL, "pugixml-devel"), [f"{INSTALL}: lacks pugixml-devel"])

    def test_a_version_of_its_own(self):
        self.assertEqual(len(self.found("CITATION.cff", "\nversion: ", "\nversion: 9")), 1)
        self.assertEqual(len(self.found("docs/reference/citing.md", "  version = {", "  release = {")), 1)


class Packaging(unittest.TestCase):
    def test_names_what_cmake_asks_for(self):
        self.assertEqual(violations(read_all()), [])

    def test_recipes_are_python(self):
        recipes = sorted(Path(ROOT, "packaging").rglob("package.py"))
        self.assertEqual([recipe.parent.name for recipe in recipes], ["listric"])
        for recipe in recipes:
            ast.parse(recipe.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
