import unittest

from architecture import DOWN, FLOORS, drawing, room_graph
from layering import APPS, LIBRARIES
from source_tree import read_tree


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

    def test_no_room_of_the_sources_looks_up(self):
        self.assertNotIn(DOWN, drawing(read_tree()))


if __name__ == "__main__":
    unittest.main()
