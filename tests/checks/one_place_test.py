import unittest

from one_place import EFFECTS, EXCEPTIONS, LIST, Effect, Exempt, read_sources, violations

WEAKENING = Effect("fault_weakening", "FaultWeakeningParameters")
BONDS = Effect("bonds", "BondStrength", trade=True)


class PlantedViolations(unittest.TestCase):
    def found(self, text, path="apps/run/run.cpp", effects=(WEAKENING, BONDS), exceptions=()):
        return violations({path: text}, effects, exceptions)

    def check_found(self, *lines, path="apps/run/run.cpp"):
        for line in lines:
            with self.subTest(line):
                self.assertEqual(len(self.found(line, path)), 1, line)

    def test_a_name_elsewhere(self):
        self.assertEqual(self.found("int a;\n    if (scene.fault_weakening)\n"),
                         ["fault_weakening: apps/run/run.cpp:2: if (scene.fault_weakening)"])
        self.check_found("void draw_fault_weakening();", "// before [fault_weakening]",
                         '#include "dem/events/fault_weakening.hpp"', 'find("fault_weakening");')
        self.check_found('colour = layers["fault_weakening"]', path="apps/figures/python/sheet.py")

    def test_a_type_elsewhere(self):
        self.check_found("FaultWeakeningParameters p;", "const BondStrength& strength")
        self.assertEqual(self.found("struct FaultWeakening; BondStrengthening b; auto bonds = 0;"), [])

    def test_a_name_put_together_from_pieces(self):
        self.check_found('find("fault_" "weakening");', 'find("fault_"\n     "weakening");',
                         'find(std::string("fault") + "_weakening");',
                         'find("fault" + \'_\' + "weakening");',
                         'fmt::format("{}_{}", "fault", "weakening");',
                         "auto x = s.fault_##weakening;")
        self.check_found("name = 'fault' + '_weakening'", "name = '_'.join(('fault', 'weakening'))",
                         path="apps/figures/python/sheet.py")
        self.assertEqual(self.found('find("fault"); find("weakening");'), [])

    def test_a_table_of_the_trade_counts_by_its_type_alone(self):
        self.assertEqual(self.found('auto bonds = count("bonds");'), [])

    def test_a_painter_names_none(self):
        base = Effect("elastic_base", "ElasticBaseParameters", trade=True)
        for path, line in (("section.js", 'of: run => run.head.effects.includes("elastic_base")'),
                           ("section.js", "layers.elasticBase"), ("panels.py", 'frame["elastic_base"]'),
                           ("section.js", '"elastic" + "_base"'), ("look.json", '{"elastic_base": 1}')):
            with self.subTest(line):
                self.assertEqual(len(self.found(line, "apps/figures/" + path, (base,))), 1)
        self.check_found('water: run.head.effects.includes("fault_weakening")', "faultWeakening(run)",
                         path="apps/figures/report/section.js")
        self.assertEqual(self.found('find("elastic_base");', effects=(base,)), [])
        self.assertEqual(self.found('run.has("bonds_left")', "apps/figures/report/section.js"), [])

    def test_one_line_of_the_list(self):
        line = "    &effects::fault_weakening,\n"
        self.assertEqual(self.found(line, LIST), [])
        self.assertEqual(len(self.found(line + line, LIST)), 1)

    def test_what_drives_the_base_is_known_to_none(self):
        for path in ("apps/run/session.cpp", "apps/figures/base_figure.cpp", "apps/model/effects/basin_water.cpp",
                     "apps/studies/flexure.cpp", "apps/studies/study_runs.cpp", "apps/commands/explain.cpp",
                     "apps/scene/toml/schema.cpp"):
            for line in ('if (has_effect(scene, "elastic_base"))', 'fmt::format("elastic_base.modes={}", modes)',
                         '#include "apps/model/effects/elastic_base_parameters.hpp"'):
                self.assertEqual(len(self.found(line, path, EFFECTS)), 1, path)

    def test_own_files(self):
        self.assertEqual(self.found("FaultWeakeningParameters fault_weakening;",
                                    "apps/model/effects/fault_weakening.cpp"), [])
        self.assertEqual(len(self.found("FaultWeakeningParameters p;",
                                        "apps/model/effects/bonds.cpp")), 1)

    def test_a_description_says_what_its_effect_needs(self):
        line = '        .needs = {"fault_weakening"},'
        self.assertEqual(self.found(line, "apps/model/effects/bonds.cpp"), [])
        self.assertEqual(len(self.found(line, "apps/run/run.cpp")), 1)

    def test_an_effect_that_is_not_checked(self):
        self.assertEqual(self.found("", "apps/model/effects/tides.cpp"),
                         ["apps/model/effects/tides.cpp: of no effect that this check knows"])

    def test_exceptions_are_needed_and_few(self):
        text = "materials[weak] = fault_weakening.material;"
        exempt = Exempt("apps/run/run.cpp", "materials[weak]", "a reason")
        self.assertEqual(self.found(text, exceptions=(exempt,)), [])
        self.assertEqual(self.found("", exceptions=(exempt,)),
                         ["an exception that is not needed: apps/run/run.cpp: materials[weak]"])
        many = [exempt._replace(holds=text[:n]) for n in range(12, 18)]
        self.assertEqual(self.found(text, exceptions=many), ["6 exceptions, at most 3"])


class Sources(unittest.TestCase):
    def test_an_effect_is_in_one_place(self):
        self.assertEqual(violations(read_sources()), [])

    def test_painters_are_read(self):
        sources = read_sources()
        for path in ("apps/figures/report/section.js", "apps/figures/python/panels.py", "apps/figures/vocabulary.json"):
            self.assertIn(path, sources)

    def test_exceptions_have_reasons(self):
        for exception in EXCEPTIONS:
            self.assertGreater(len(exception.reason.split()), 3, exception)

    def test_every_effect_has_a_table_of_its_own(self):
        self.assertEqual(len({effect.table for effect in EFFECTS}), len(EFFECTS))


if __name__ == "__main__":
    unittest.main()
