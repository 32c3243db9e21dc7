#!/usr/bin/env python3
"""A measure is declared once: its name is a text in one C++ file. Others take it by its declaration.

    python3 tests/checks/measures.py      prints the names that stand in more files

Not looked at are names that are ordinary words ("faults") and names that parameters, states or other
files have, too (COMMON).
"""

import json
import re

from source_tree import ROOT, is_cpp, main

LITERAL = re.compile(r'"((?:\\.|[^"\\\n])*)"')
#: with what else has the name
COMMON = {
    "length_m": "parameter of the hanging wall",
    "x_m": "column of exports", "depth_m": "column of exports",
    "extension_m": "key of status.json, figures and the report",
    "state_hash": "key of studies' summaries", "cycle_level": "key of bench.json",
    "disc_steps_per_s": "key of bench.json", "wall_s": "key of laboratory.json",
    "predicted_wall_s": "key of summary.json of a base without discs",
    "time_by_part_s": "key of summary.json of a base without discs",
    "thickness_m": "parameter of the hanging wall",
}


def names(dictionary):
    """Names that are to stand in one file."""
    found = set()
    for entry in dictionary:
        found.add(entry["name"])
        if entry["table"] == "faults":
            found |= {part["name"] for part in entry.get("parts", ())}
    return {name for name in found if "_" in name} - COMMON.keys()


def violations(tree, wanted):
    where = {}
    for path, text in tree.items():
        if is_cpp(path):
            for literal in LITERAL.findall(text):
                if literal in wanted:
                    where.setdefault(literal, set()).add(path)
    return [f"{name}: declared in one place, but written in {', '.join(sorted(paths))}"
            for name, paths in sorted(where.items()) if len(paths) > 1]


def read_dictionary():
    return json.loads((ROOT / "apps/python/listric/dictionary.json").read_text(encoding="utf-8"))


if __name__ == "__main__":
    main(lambda tree: violations(tree, names(read_dictionary())))
