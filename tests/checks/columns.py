#!/usr/bin/env python3
"""A column that several files read has one name, in a columns.hpp of the room that owns it. Where else
does a literal name one, and which column of its own does a room read that another one owns?

    python3 tests/checks/columns.py      prints these lines
"""

import re

from source_tree import is_cpp, main

DECLARED = re.compile(r'\b(\w+)\{"(\w+)", "[^"]*"')
TABLES = r"(?:discs|contacts|base_nodes)"  # of a state
USED = re.compile(TABLES + r'\.(?:has|get(?:<[\w:]+>)?|add(?:_like|_note)?(?:<[\w:]+>)?|mark_note|remove)'
                  r'\((?:"\w+", "[^"]*", )?"(\w+)"')


def declared(tree):
    """{column: files that declare it}."""
    found = {}
    for path, text in tree.items():
        if path.endswith("/columns.hpp"):
            for constant, name in DECLARED.findall(text):
                found.setdefault(name, []).append(path)
                if constant != name:
                    found.setdefault(name, []).append(f"{path} as {constant}")
    return found


def violations(tree):
    """Columns that are declared twice or otherwise named, literals of declared ones, and literals of
    one column in two files."""
    columns, users = declared(tree), {}
    found = [f"{name}: is declared in {', '.join(places)}" for name, places in columns.items()
             if len(places) > 1]
    for path, text in tree.items():
        if not is_cpp(path) or path.endswith("/columns.hpp"):
            continue
        for match in USED.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            if match[1] in columns:
                found.append(f"{path}:{line}: \"{match[1]}\" is columns::{match[1]} "
                             f"of {columns[match[1]][0]}")
            else:
                users.setdefault(match[1], set()).add(path)
    found += [f"{name}: a literal in {', '.join(sorted(paths))}; declare it in a columns.hpp"
              for name, paths in users.items() if len(paths) > 1]
    return found


if __name__ == "__main__":
    main(violations)
