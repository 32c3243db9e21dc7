#!/usr/bin/env python3
"""The reference pages are the declarations: each parameter and measure has a heading of its own, a unit, and
sentences; usual ranges lie within the allowed ones and hold the default.

    python3 tests/checks/reference.py     prints the entries that lack something
"""

import importlib.util
import re
import sys
from collections import Counter

from links import FENCE, HEADING
from source_tree import ROOT, report

sys.path.append(str(ROOT / "docs"))
import parameters as parameter_page  # noqa: E402

# measures is also a check's name
spec = importlib.util.spec_from_file_location("measure_pages", ROOT / "docs/measures.py")
measure_pages = importlib.util.module_from_spec(spec)
spec.loader.exec_module(measure_pages)

PARAMETERS, MEASURES = "docs/reference/parameters.md", "docs/reference/measures.md"
UNITS = {"_m": "m", "_m2": "m2", "_deg": "deg", "_a": "a", "_s": "s", "_pa": "Pa", "_per_s": "1/s", "_per_km": "1/km",
         "_kg_per_m3": "kg/m3", "_m_per_s": "m/s", "_m_per_a": "m/a", "_n_per_m": "N/m", "_j_per_m": "J/m",
         "_mm_per_a": "mm/a", "_per_m": "1/m", "_pa_s": "Pa s", "_per_pa": "1/Pa", "_m_per_s2": "m/s2", "_diameters": "",
         "_mw_per_m2": "mW/m2", "_w_per_m_k": "W/m/K", "_w_per_m3": "W/m3", "_percent": "%"}
LEANS = re.compile(r"(?:of|where|what|the same|those|that|its|it|which|in|at|to|as)\b", re.IGNORECASE)


def unit_objection(name, unit):
    """A key that ends with a unit has it; the longest ending counts."""
    ending = max((end for end in UNITS if name.endswith(end)), key=len, default=None)
    if ending and UNITS[ending] and unit != UNITS[ending]:
        yield f"{name}: has the unit {unit or 'none'}, and its name another"


def text_objections(name, doc):
    if not doc:
        yield f"{name}: has no definition"
    elif LEANS.match(doc):
        yield f"{name}: \"{doc[:40]}\": begin with a noun"


def range_objections(name, one):
    usual = one["x-listric"].get("usual")
    if not usual:
        return
    if not one.get("minimum", -float("inf")) <= usual[0] < usual[1] <= one.get("maximum", float("inf")):
        yield f"{name}: the usual range {usual} is not in the allowed one"
    if isinstance(one.get("default"), (int, float)) and not usual[0] <= one["default"] <= usual[1]:
        yield f"{name}: the default {one['default']} is not in the usual range {usual}"


def parameter_objections(schema):
    for name, one in parameter_page.reference(schema):
        declared = one["x-listric"]
        yield from text_objections(name, declared["doc"])
        if not re.match(r'["A-Z0-9a-z].* .*\.$', declared["changes"]):
            yield f"{name}: has no sentence that says what it changes"
        if one.get("type") in ("number", "integer"):
            yield from unit_objection(name, declared.get("unit", ""))
        yield from range_objections(name, one)


def measure_objections(entries):
    for name, one in measure_pages.reference(entries):
        yield from text_objections(name, one["doc"])
        if one["unit"]:
            yield from unit_objection(name, one["unit"])


def page_objections(page, text, names):
    headings = Counter(heading.lower() for heading in HEADING.findall(FENCE.sub("", text)))
    for name in names:
        if headings[name.lower()] != 1:
            yield f"{page}: {headings[name.lower()]} headings {name}, should be one"


def violations(schema, entries, pages):
    """`pages`: texts by path."""
    found = [*parameter_objections(schema), *measure_objections(entries)]
    if pages[PARAMETERS] != parameter_page.page(schema):
        found.append(f"{PARAMETERS}: is not of the declarations: docs/parameters.sh")
    found += page_objections(PARAMETERS, pages[PARAMETERS], [name for name, _ in parameter_page.reference(schema)])
    text = pages[MEASURES]
    found += [f"{MEASURES}: has no table {table}" for table in measure_pages.missing(text, entries)]
    if measure_pages.page(text, entries) != text:
        found.append(f"{MEASURES}: is not of the declarations: docs/parameters.sh")
    tables = [name for match in measure_pages.MARKED.finditer(text) for name in match[2].split()]
    return [*found, *page_objections(MEASURES, text, [name for name, _ in measure_pages.reference(entries, tables)])]


def read_all():
    return (parameter_page.read_schema(), measure_pages.read_dictionary(),
            {page: (ROOT / page).read_text(encoding="utf-8") for page in (PARAMETERS, MEASURES)})


if __name__ == "__main__":
    raise SystemExit(report(violations(*read_all())))
