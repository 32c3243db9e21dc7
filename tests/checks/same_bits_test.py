import unittest

from same_bits import violations
from source_tree import read_tree


class SameBits(unittest.TestCase):
    def found(self, text, path="dem/base.cpp"):
        return violations({path: text})

    def test_a_call(self):
        self.assertEqual(self.found("int a;\ndouble b = std::hypot(x, y);\n"),
                         ["dem/base.cpp:2: hypot: use hypotenuse() of dem/numbers/hypotenuse.hpp"])
        for text in ("return hypot(x, y);", "::hypot (x, y)", "hypotf(x, y)", "std::hypot(x,\n y)"):
            self.assertEqual(len(self.found(text, "apps/measures/paper/blocks.cpp")), 1, text)

    def test_elementary_functions(self):
        for text in ("std::sin(x)", "exp(x)", "::pow(x, 2)", "std::log(x)", "std::atan2f(y, x)"):
            self.assertEqual(len(self.found(text, "fluid/pore_law.cpp")), 1, text)
        for text in ("sine(x)", "dem::exponential(x)", "Log log(quiet);", '"tan(angle)"', "a.array().exp()"):
            self.assertEqual(self.found(text), [], text)

    def test_other_words(self):
        for text in ("hypotenuse(x, y)", "// Without std::hypot(x, y)\n", "/* hypot(\n) */", "my_hypot(1, 2)"):
            self.assertEqual(self.found(text), [], text)
        self.assertEqual(self.found("std::hypot(x, y)", "fem/vector.hpp"), [])
        self.assertEqual(self.found("math.hypot(x, y)", "apps/figures/python/discs.py"), [])

    def test_the_tree(self):
        self.assertEqual(violations(read_tree()), [])


if __name__ == "__main__":
    unittest.main()
