#!/usr/bin/env python3
"""Functions of the C library whose bits depend on library or processor, and which we have of our own.

    python3 tests/checks/same_bits.py      prints where they are called all the same

`fem` may: what it computes goes through BLAS and MUMPS, whose bits are the system's in any case.
"""

import re

from source_tree import is_cpp, main, room

# {called: instead}
OWN = {
    "hypot": "hypotenuse() of dem/numbers/hypotenuse.hpp",
    **{
        of_library: f"{own}() of dem/numbers/elementary.hpp"
        for of_library, own in {
            "sin": "sine",
            "cos": "cosine",
            "tan": "tangent",
            "asin": "arc_sine",
            "acos": "arc_tangent",
            "atan": "arc_tangent",
            "atan2": "arc_tangent",
            "exp": "exponential",
            "exp2": "power",
            "expm1": "exponential_less_one",
            "log": "logarithm",
            "log1p": "logarithm_of_one_and",
            "log2": "logarithm_to_base_2",
            "log10": "logarithm_to_base_10",
            "pow": "power",
            "cbrt": "power",
        }.items()
    },
    **{
        name: "what dem/numbers/elementary.hpp has"
        for name in ("sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "erf", "erfc", "lgamma", "tgamma")
    },
}
# Texts hold formulas, and comments, too.
NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
CALL = re.compile(rf"(std::\s*|(?<![\w.>]))({'|'.join(OWN)})[fl]?\s*\(")


def violations(tree):
    """Every such call of a tree, one line each."""
    found = []
    for path, text in tree.items():
        if not is_cpp(path) or room(path) == "fem":
            continue
        # What is left out leaves its line ends, by which lines are counted.
        code = NO_CODE.sub(lambda left_out: "\n" * left_out[0].count("\n"), text)
        for call in CALL.finditer(code):
            if call[2] == "log" and not call[1]:
                continue  # the record of a run
            line = code.count("\n", 0, call.start()) + 1
            found.append(f"{path}:{line}: {call[2]}: use {OWN[call[2]]}")
    return found


if __name__ == "__main__":
    main(violations)
