#!/usr/bin/env python3
"""How long files and functions may be, in C++ and Python, and how much a unit may know that others
would hand all their work to.

    python3 tests/checks/sizes.py      prints what is longer
"""

import ast

from cpp_functions import functions
from source_tree import includes, is_cpp, is_ours, main, unit

LONGEST_FILE = 600      # lines
LONGEST_FUNCTION = 80   # lines, from the first word of its declaration to its last brace
MOST_EXCEPTIONS = 3

# Functions that may be longer: {"path: name": the reason}.
EXCEPTIONS = {}

# Units that stay small: {unit: (lines of its files together, headers of ours that they include)}.
SMALL_UNITS = {"apps/run/session": (200, 14)}


def python_functions(text):
    """(name, lines) of the functions of a Python text, nested ones too."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            first = min(part.lineno for part in [node, *node.decorator_list])
            yield node.name, node.end_lineno - first + 1


def function_lengths(path, text):
    if not is_cpp(path):
        return list(python_functions(text))
    return [(function.name, function.lines) for function in functions(text)]


def units_too_large(tree):
    """Small units over their limits."""
    for name, (most_lines, most_headers) in SMALL_UNITS.items():
        texts = [text for path, text in tree.items() if is_cpp(path) and unit(path) == name]
        lines = sum(len(text.splitlines()) for text in texts)
        headers = {header for text in texts for header in includes(text) if is_ours(header)}
        if lines > most_lines:
            yield f"{name}: {lines} lines, at most {most_lines}"
        if len(headers) > most_headers:
            yield f"{name}: includes {len(headers)} headers of ours, at most {most_headers}"


def violations(tree, exceptions=None):
    """Files, units and functions of a tree over the limits, and exceptions that are none (any more)."""
    exceptions = EXCEPTIONS if exceptions is None else exceptions
    found, used = list(units_too_large(tree)), set()
    for path, text in tree.items():
        lines = len(text.splitlines())
        if lines > LONGEST_FILE:
            found.append(f"{path}: {lines} lines")
        try:
            lengths = function_lengths(path, text)
        except (ValueError, SyntaxError) as error:
            found.append(f"{path}: cannot be read: {error}")
            continue
        for name, lines in lengths:
            if lines <= LONGEST_FUNCTION:
                continue
            place = f"{path}: {name}"
            if place in exceptions:
                used.add(place)
            else:
                found.append(f"{place}: {lines} lines")
    found += [f"{place}: an exception that is not needed" for place in exceptions.keys() - used]
    if len(exceptions) > MOST_EXCEPTIONS:
        found.append(f"{len(exceptions)} exceptions, at most {MOST_EXCEPTIONS}")
    return found


if __name__ == "__main__":
    main(violations)
