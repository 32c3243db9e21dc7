#!/usr/bin/env python3
"""Functions of the C library whose bits depend on the processor, and which we have of our own.

    python3 tests/checks/same_bits.py      prints where they are called all the same

`fem` may: what it computes goes through BLAS and MUMPS, whose bits are the system's in any case.
"""

import re

from source_tree import is_cpp, main, room

# {called: instead}
OWN = {"hypot": "hypotenuse() of dem/numbers/hypotenuse.hpp"}
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
CALL = re.compile(rf"(?<![\w])({'|'.join(OWN)})[fl]?\s*\(")


def violations(tree):
    """Every such call of a tree, one line each."""
    found = []
    for path, text in tree.items():
        if not is_cpp(path) or room(path) == "fem":
            continue
        # Comments leave their line ends, by which lines are counted.
        code = COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), text)
        for call in CALL.finditer(code):
            line = code.count("\n", 0, call.start()) + 1
            found.append(f"{path}:{line}: {call[1]}: use {OWN[call[1]]}")
    return found


if __name__ == "__main__":
    main(violations)
