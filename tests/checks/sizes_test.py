import unittest

from cpp_functions import functions
from sizes import (EXCEPTIONS, FILM, SMALL_UNITS, documents_too_large, folders_too_full, read_documents, read_sources,
                   tracked, violations)
from source_tree import read_tree, unit


def body(lines):
    return "".join(f"    step({i});\n" for i in range(lines))


def cpp_function(head, lines):
    """A function of so many lines, its head and last brace among them."""
    return f"{head} {{\n{body(lines - 2)}}}\n"


class PlantedViolations(unittest.TestCase):
    def found(self, path, text, **options):
        return violations({path: text}, **({"exceptions": {}} | options))

    def test_a_long_file(self):
        self.assertEqual(self.found("dem/cycle.hpp", "int step();\n" * 601),
                         ["dem/cycle.hpp: 601 lines"])
        self.assertEqual(self.found("dem/cycle.hpp", "int step();\n" * 600), [])

    def test_a_long_function(self):
        for head, name in (
                ("void advance(State& state)", "advance"),
                ("template <typename T>\nstd::vector<T> Cycle<T>::run(T x = {}) const noexcept", None),
                ("Cycle::Cycle(int n) : state_{n}, law_(n)", "Cycle::Cycle"),
                ("bool operator==(const A& a, const B& b)", "operator=="),
                ("double Law::operator()(double x) const", "Law::operator"),
                ("const auto push = [](double x)", None),
                ("auto hash() -> std::uint64_t", "hash"),
                ("extern \"C\" Footwall* make(int n)", "make")):
            with self.subTest(head):
                planted = "namespace {\n" + cpp_function(head, 81 - head.count("\n")) + "}\n"
                found = self.found("dem/cycle.cpp", planted)
                self.assertEqual(len(found), 1)
                self.assertIn("81 lines", found[0])
                if name:
                    self.assertIn(f": {name}:", found[0])
                planted = "namespace {\n" + cpp_function(head, 80 - head.count("\n")) + "}\n"
                self.assertEqual(self.found("dem/cycle.cpp", planted), [])

    def test_a_long_member_function(self):
        self.assertEqual(
            self.found("dem/cycle.hpp", "class Cycle final : public Event {\npublic:\n"
                       + cpp_function("    void apply(State& state) override", 90) + "};\n"),
            ["dem/cycle.hpp: apply: 90 lines"])

    def test_a_long_python_function(self):
        self.assertEqual(self.found("apps/figures/python/plot.py",
                                    "def draw():\n    @cache\n    def inner():\n"
                                    + "        step()\n" * 79),
                         ["apps/figures/python/plot.py: draw: 82 lines",
                          "apps/figures/python/plot.py: inner: 81 lines"])

    def test_java_script(self):
        page = "apps/figures/draw/page.js"
        self.assertEqual(self.found(page, "step();\n" * 601), [f"{page}: 601 lines"])
        self.assertEqual(self.found(page, "function show(t) {\n" + "  if (t) {\n    step();\n  }\n" * 27 + "}\n"),
                         [f"{page}: show: 83 lines"])
        self.assertEqual(self.found(page, "class Section {\n  draw({at = {}}) {\n" + "    step();\n" * 79 + "  }\n}\n"),
                         [f"{page}: draw: 81 lines"])
        self.assertEqual(self.found(page, "class Section {\n" + "  draw() {\n    step();\n  }\n" * 30 + "}\n"), [])

    def test_long_lines(self):
        for path in "apps/a.js", "apps/a.py":
            text = f"{'a' * 120}\n{'a' * 121}\n"
            found = self.found(path, text, most_longer={".py": 0, ".js": 0})
            self.assertEqual(len(found), 1)
            self.assertIn(f"such as {path}:2", found[0])
            self.assertEqual(self.found(path, text, most_longer={".py": 1, ".js": 1}), [])

    def test_documents(self):
        self.assertEqual(list(documents_too_large(900, {"docs/pictures/a.webp": 150_000, FILM: 600_000})), [])
        found = list(documents_too_large(901, {"docs/pictures/a.webp": 150_001}))
        self.assertEqual(found, ["README.md: 901 words, allowed: 900",
                                 "docs/pictures/a.webp: 150001 bytes, allowed: 150000"])

    def test_a_full_folder(self):
        shelf = [f"dem/noun_{k}.hpp" for k in range(30)]
        self.assertEqual(list(folders_too_full([*shelf, "dem/cycle/cycle.hpp"])), [])
        self.assertEqual(list(folders_too_full([*shelf, "dem/another.hpp"])),
                         ["dem: 31 files, allowed: 30; folders below it can have more"])

    def test_a_session_that_knows_every_trade(self):
        header, source = "apps/run/session.hpp", "apps/run/session.cpp"
        lines = "int step();\n"
        self.assertEqual(violations({header: lines * 50, source: lines * 150}), [])
        self.assertEqual(violations({header: lines * 50, source: lines * 151}),
                         ["apps/run/session: 201 lines, at most 200"])
        includes = "".join(f'#include "apps/run/part{i}.hpp"\n' for i in range(15))
        self.assertEqual(violations({source: includes}),
                         ["apps/run/session: includes 15 headers of ours, at most 14"])
        self.assertEqual(violations({source: "#include <cmath>\n" + includes.replace("part3", "part4")}), [])

    def test_a_text_that_cannot_be_read(self):
        self.assertEqual(self.found("dem/cycle.cpp", "void f() { {"),
                         ["dem/cycle.cpp: cannot be read: a brace is not closed"])
        self.assertEqual(len(self.found("apps/figures/python/plot.py", "def f(:")), 1)

    def test_an_exception_is_needed_and_one_of_few(self):
        long = cpp_function("void advance()", 90)
        exceptions = {"dem/cycle.cpp: advance": "a reason"}
        self.assertEqual(self.found("dem/cycle.cpp", long, exceptions=exceptions), [])
        self.assertEqual(self.found("dem/cycle.cpp", "", exceptions=exceptions),
                         ["dem/cycle.cpp: advance: an exception that is not needed"])
        four = {f"dem/cycle.cpp: f{i}": "a reason" for i in range(4)}
        self.assertIn("4 exceptions, at most 3", self.found("dem/cycle.cpp", "", exceptions=four))


class Functions(unittest.TestCase):
    def test_braces_that_are_none(self):
        text = ('void f() {\n    print("}{", \'}\', R"(}})", 1\'000); // }\n    /* } */\n}\n'
                '#define OPEN {\nint g() { return 1; }\n')
        self.assertEqual([(f.name, f.first, f.last) for f in functions(text)],
                         [("f", 1, 4), ("g", 6, 6)])

    def test_blocks_that_are_no_function(self):
        text = ("namespace listric {\nenum class Kind { arc, line };\nstruct Disc { double r{1.0}; };\n"
                "template <typename T = double> struct Box : Base<T> { T x = {}; };\n"
                "const std::vector<Row> rows = {{1, f(2)}, {3, g()}};\nRow row{h(1)};\n"
                "constexpr Row other = Row{h(1)};\n}\n")
        self.assertEqual(functions(text), [])


class Sources(unittest.TestCase):
    def test_keep_to_the_limits(self):
        self.assertEqual(violations(read_sources()), [])
        words, pictures = read_documents()
        self.assertIn(FILM, pictures)
        self.assertEqual(list(documents_too_large(words, pictures)), [])
        self.assertEqual(list(folders_too_full(tracked())), [])

    def test_small_units_are_there(self):
        self.assertLessEqual(SMALL_UNITS.keys(), {unit(path) for path in read_tree()})

    def test_exceptions_have_reasons(self):
        for place, reason in EXCEPTIONS.items():
            self.assertGreater(len(reason.split()), 3, place)


if __name__ == "__main__":
    unittest.main()
