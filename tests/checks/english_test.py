import unittest

from english import PATTERNS, all_violations, comment_violations, program_texts, violations

# One for each pattern, in its order; most stood in a page.
PLANTED = (
    "The header tells which it is.",
    "What was fitted is said in metres.",
    "LIS1 and LIS2 ask for friction.",
    "A rank has one thread unless `--threads` says otherwise.",
    "A fault offers nothing to whoever slips on it.",
    "Then as ever: pictures and a report.",
    "The first graben takes all of the extension, for good.",
    "What that leaves undamped, a dashpot ends.",
    "Of more than two points the log lists the residuals.",
    "| key | what |\n|---|---|\n| the same less the control's | 0.12 |",
    "| key | what |\n|---|---|\n| `age` | that of the rift |",
    "RFR: a figure. The same at 5 km.",
    "The top is the same of a thinner layer.",
    "Its table is made anew.",
    "All but for pictures is kept.",
    "The source thereof is named.",
    "The margin is small, and nothing comes of it.",
    "Rock that rubs has no clock of its own.",
    "In lis1 it is so within 1.7 %.",
    "It writes what is left.",
    "At first one sees next to nothing.",
    "Many a run ends early.",
    "A library that is there by halves is left out.",
    "The page stops, and says why.",
)


class PlantedViolations(unittest.TestCase):
    def found(self, text, path="docs/a.md"):
        return violations({path: text})

    def test_each_pattern_is_seen(self):
        self.assertEqual(len(PLANTED), len(PATTERNS))
        for text, (_, cure) in zip(PLANTED, PATTERNS):
            self.assertTrue([one for one in self.found(text) if one.endswith(cure)], text)

    def test_a_violation_over_two_lines(self):
        self.assertEqual(len(self.found("It is kept, but\nfor the log.")), 1)

    def test_plain_sentences(self):
        for text in ("The message names the file.", "Mean and standard deviation over seeds 1 to 5.", "What does it cost?",
                     "Two runs with the same seed have equal bits.", "| `age` | age of the rift |",
                     "Ask a colleague, who says why.", "`the page says` is code", "A run takes two minutes.", "Of course."):
            self.assertEqual(self.found(text), [], text)

    def test_the_record_is_as_it_was_written(self):
        self.assertEqual(self.found("Made anew.", "docs/record/2026-11/a.md"), [])


    def program(self, source, path="apps/a.cpp"):
        return violations({}, program_texts({path: source}))

    def test_texts_of_the_program(self):
        for source in ('fail("the plan asks for " "{} runs");', '{"a_m", "share of the rock. What that leaves, it "\n "ends."},',
                       'say("see http://a.b: it " // why\n "says no");', "say('\"', \"the file says no\");"):
            self.assertEqual(len(self.program(source)), 1, source)
        for source in ('"""What every script does."""', 'fail(f"{path}: the file says {what}, not {that}")', 'fail("a scene " "asks for it")'):
            self.assertEqual(len(self.program(source, "apps/a.py")), 1, source)

    def test_other_text_of_sources(self):
        for source in ('// the file says why', '#include "what is there"', '"the file"; says("no")', 'x = "anew";'):
            self.assertEqual(self.program(source), [], source)
        self.assertEqual(self.program("says = 1  # the file says why", "apps/a.py"), [])

    def test_comments(self):
        for source in ("/// What a state holds.", "    // Of a wall, m.", "int a; ///< Of a wall", "int a; ///< the same", "  // The same of a wall.", "/// Those of a scene."):
            self.assertEqual(len(comment_violations({"dem/a.hpp": source})), 1, source)
        for source in ("/// Energy of a state.", "// a list: what is\n// what it was", "int a; ///< the same of b", "int a; ///< of a wall, m",
                       "// Office", '"/// What"'):
            self.assertEqual(comment_violations({"dem/a.hpp": source}), [], source)


class Sources(unittest.TestCase):
    def test_documents_and_program_are_plain(self):
        self.assertEqual(all_violations(), [])


if __name__ == "__main__":
    unittest.main()
