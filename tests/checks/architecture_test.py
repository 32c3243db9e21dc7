import unittest

from architecture import DOWN, DRAWING, FLOORS, drawing, room_graph
from layering import APPS, LIBRARIES
from source_tree import ROOT, read_tree


class Drawing(unittest.TestCase):
    def test_shows_an_include(self):
        plain = {"apps/run/run.cpp": "#include <vector>\n"}
        planted = {"apps/run/run.cpp": '#include "apps/scene/scene.hpp"\n'}
        self.assertEqual(room_graph(planted)["apps/run"], {"apps/scene"})
        self.assertNotIn("includes", drawing(plain))
        self.assertIn("apps/run includes apps/scene", drawing(planted))
        self.assertNotIn(DOWN, drawing(planted))

    def test_shows_a_room_that_looks_up_in_red(self):
        self.assertIn(DOWN, drawing({"apps/scene/a.cpp": '#include "apps/run/run.hpp"\n'}))

    def test_has_every_room_in_its_order(self):
        self.assertEqual([name for name in FLOORS if name in APPS], APPS[::-1])
        self.assertEqual({name for name in FLOORS if name not in APPS}, set(LIBRARIES))

    def test_is_current(self):
        call = "write it anew: python3 tests/checks/architecture.py"
        self.assertEqual(DRAWING.read_text(encoding="utf-8"), drawing(read_tree()), call)

    def test_stands_in_the_document(self):
        self.assertIn(DRAWING.name, (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
