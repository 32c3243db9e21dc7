import unittest

from columns import violations
from source_tree import read_tree

OWNER = {"dem/columns.hpp": 'inline constexpr ColumnName<double> porosity{"porosity", "1", 0.0};\n'}


class Columns(unittest.TestCase):
    def found(self, **texts):
        return violations(OWNER | {f"apps/run/{name}.cpp": text for name, text in texts.items()})

    def test_a_literal_of_a_declared_column(self):
        for text in ('state.discs.has("porosity")', 'discs.get<double>("porosity")[0]',
                     'state.discs.add_like<double>("window_porosity", "1", "porosity");'):
            self.assertEqual(self.found(run=f"int a;\n{text}\n"),
                             ['apps/run/run.cpp:2: "porosity" is columns::porosity of dem/columns.hpp'], text)

    def test_a_literal_in_two_files(self):
        text = 'discs.add<double>("rested", "a", 0.0); discs.get<double>("rested")'
        self.assertEqual(self.found(run=text), [])
        self.assertEqual(self.found(run=text, stop='state.discs.has("rested")'),
                         ["rested: a literal in apps/run/run.cpp, apps/run/stop.cpp; declare it in a columns.hpp"])

    def test_two_declarations_and_another_name(self):
        other = {"fluid/columns.hpp": 'constexpr ColumnName<double> pores{"porosity", "1", 0.0};'}
        self.assertEqual(len(violations(OWNER | other)), 1)

    def test_other_words(self):
        self.assertEqual(self.found(run='options.has("porosity"); {"porosity", numbers(p)}'), [])

    def test_this_tree(self):
        self.assertEqual(violations(read_tree()), [])


if __name__ == "__main__":
    unittest.main()
