#!/usr/bin/env python3
"""How long files, functions and lines may be, in C++, Python and JavaScript, how much a unit may know that others
would hand all their work to, how many files a folder may have, and what README and a picture may weigh.

    python3 tests/checks/sizes.py      prints what is longer
"""

import ast
import re
import subprocess
import sys
from collections import Counter
from pathlib import PurePosixPath

from cpp_functions import functions
from source_tree import CPP, PYTHON, ROOT, includes, is_cpp, is_ours, read_tree, report, unit

LONGEST_FILE = 600      # lines
LONGEST_FUNCTION = 80   # lines, from the first word of its declaration to its last brace
LONGEST_LINE = 120      # characters, of Python and JavaScript; clang-format keeps C++ to 100
MOST_LONGER = {".py": 44, ".js": 290}  # lines that are longer all the same: fewer is welcome
MOST_FILES = 30         # of a folder, without its folders
MOST_WORDS = 900        # of README.md
MOST_BYTES = 150_000    # of a picture of the documents
FILM = "docs/pictures/lis1.webp"
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


# At the first level and as a member of a class; what lies in a function counts as part of it.
JS_FUNCTION = re.compile(r"^( *)(?:async |static |get |set )*(?!(?:if|for|while|switch)\b)(?:function\*? )?(\w+)\([^\n]*\) \{\n.*?^\1\}",
                         re.MULTILINE | re.DOTALL)


def function_lengths(path, text):
    if path.endswith(".js"):
        return [(found[2], found[0].count("\n") + 1) for found in JS_FUNCTION.finditer(text)]
    if not is_cpp(path):
        return list(python_functions(text))
    return [(function.name, function.lines) for function in functions(text)]


def long_lines(tree, most):
    for ending, allowed in most.items():
        found = [f"{path}:{number}" for path, text in tree.items() if path.endswith(ending)
                 for number, line in enumerate(text.splitlines(), 1) if len(line) > LONGEST_LINE]
        if len(found) > allowed:
            yield f"{len(found)} lines of {ending} are longer than {LONGEST_LINE}, allowed: {allowed}; such as {found[-1]}"


def documents_too_large(words, pictures):
    """`words` of README; `pictures`: bytes by path."""
    if words > MOST_WORDS:
        yield f"README.md: {words} words, allowed: {MOST_WORDS}"
    for path, size in pictures.items():
        if size > MOST_BYTES and path != FILM:
            yield f"{path}: {size} bytes, allowed: {MOST_BYTES}"


def folders_too_full(paths):
    for folder, count in Counter(PurePosixPath(path).parent.as_posix() for path in paths).items():
        if count > MOST_FILES:
            yield f"{folder}: {count} files, allowed: {MOST_FILES}; folders below it can have more"


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


def violations(tree, exceptions=None, most_longer=None):
    """Files, units, functions and lines of a tree over the limits, and exceptions that are none (any more)."""
    exceptions = EXCEPTIONS if exceptions is None else exceptions
    found, used = [*units_too_large(tree), *long_lines(tree, MOST_LONGER if most_longer is None else most_longer)], set()
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


def read_sources():
    return read_tree(suffixes=CPP | PYTHON | {".js"})


def read_documents():
    pictures = (file for file in sorted((ROOT / "docs").rglob("*"))
                if file.suffix in (".webp", ".png", ".gif", ".svg"))
    return (len((ROOT / "README.md").read_text(encoding="utf-8").split()),
            {file.relative_to(ROOT).as_posix(): file.stat().st_size for file in pictures})


def tracked():
    """Paths of all files that git has, and of new ones; none where there is no git."""
    listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return sorted({path for path in listed.stdout.split("\0") if path and (ROOT / path).exists()})


if __name__ == "__main__":
    sys.exit(report([*violations(read_sources()), *folders_too_full(tracked()), *documents_too_large(*read_documents())]))
