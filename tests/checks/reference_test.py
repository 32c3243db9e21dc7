import copy
import unittest

from reference import MEASURES, PARAMETERS, measure_pages, parameter_page, read_all, violations

SLIP = {"type": "number", "minimum": 0.001, "maximum": 1e6, "default": 62.0,
        "x-listric": {"doc": "least slip of a fault", "changes": "Raising it leaves rock sound.", "type": "number",
                      "default": "62.0", "unit": "m", "allowed": "at least 0.001", "usual": [43.4, 62]}}
SCHEMA = {"properties": {"fault_weakening": {"description": "effect: finds faults", "properties": {"least_slip_m": SLIP}}}}
ENTRIES = [{"name": "area_m2", "table": "structure", "unit": "m2", "doc": "area of the basin", "usual": "above 0"}]


class PlantedViolations(unittest.TestCase):
    def found(self, change=None, entry=None, pages=None):
        schema, entries = copy.deepcopy(SCHEMA), [dict(ENTRIES[0], **(entry or {}))]
        slip = schema["properties"]["fault_weakening"]["properties"]["least_slip_m"]
        slip["x-listric"].update((change or {}).pop("x-listric", {}))
        slip.update(change or {})
        made = {PARAMETERS: parameter_page.page(schema), MEASURES:
                measure_pages.page("# Measures\n<!-- measures: structure -->\n<!-- end -->\n", entries)}
        return violations(schema, entries, {**made, **(pages or {})})

    def test_what_is_no_violation(self):
        self.assertEqual(self.found(), [])

    def test_a_parameter_that_lacks_something(self):
        for change, said in (({"changes": ""}, "no sentence"), ({"changes": "raises"}, "no sentence"),
                             ({"doc": ""}, "no definition"), ({"doc": "of a fault"}, "begin with a noun"),
                             ({"unit": "km"}, "its name another"), ({"usual": [1e-6, 100]}, "not in the allowed"),
                             ({"usual": [100, 50]}, "not in the allowed"), ({"usual": [70, 80]}, "default 62.0 is not in")):
            found = self.found({"x-listric": change})
            self.assertTrue(found and said in found[0], (change, found))

    def test_a_measure_that_lacks_something(self):
        for entry, said in (({"doc": ""}, "no definition"), ({"doc": "where it is"}, "begin with a noun"),
                            ({"unit": "1"}, "its name another")):
            found = self.found(entry=entry)
            self.assertTrue(found and said in found[0], (entry, found))

    def test_a_page_that_is_behind(self):
        found = self.found(pages={PARAMETERS: parameter_page.page(SCHEMA).replace("62.0", "61.0")})
        self.assertEqual(len(found), 1, found)
        found = self.found(pages={PARAMETERS: parameter_page.page(SCHEMA).replace("### ", "")})
        self.assertIn("0 headings fault_weakening.least_slip_m", found[1])
        found = self.found(entry={"doc": "another area"}, pages={MEASURES: measure_pages.page(
            "<!-- measures: structure -->\n<!-- end -->\n", ENTRIES)})
        self.assertEqual(len(found), 1, found)
        self.assertIn("has no table structure", self.found(pages={MEASURES: "# Measures\n"})[0])

    def test_anchors_of_the_page(self):
        self.assertIn("[`least_slip_m`](#fault_weakeningleast_slip_m)", parameter_page.page(SCHEMA))


class Documents(unittest.TestCase):
    def test_the_reference_is_of_the_declarations(self):
        self.assertEqual(violations(*read_all()), [])


if __name__ == "__main__":
    unittest.main()
