#!/usr/bin/env python3
"""A program for any x86-64 processor has instructions beyond SSE2 only in what is compiled for a
level (dem/cycle/fast_cycle_kernels.cpp) and called on processors that have it; and fused multiply-add,
whose results differ, nowhere.

    python3 tests/checks/instructions.py PROGRAM      prints the violations
"""

import re
import subprocess
import sys

from source_tree import report

LEVEL = re.compile(r"\blistric::dem::fast::v[34]::")
FUNCTION = re.compile(r"^[0-9a-f]+ <(.*)>:$")
INSTRUCTION = re.compile(r"^ +[0-9a-f]+:\t(?:(?:bnd|data16|lock|notrack|rep|repz|repnz|cs|ds) )*(\w+)")
# AVX and AVX-512, whose names begin with v or work on masks (k); BMI, and what came with it; SSE3 to SSE4.2. Not
# tzcnt: of old processors it is bsf, for which gcc writes it where zeros do not occur.
BEYOND_SSE2 = re.compile(r"v(?!err|erw|mcall|mlaunch)|k(?:add|and|mov|not|or|shift|test|unpck|xn?or)"
                         r"|andn(?!p)|bextr|bls|bzhi|mulx|pdep|pext(?!rw)|rorx|sarx|shlx|shrx|movbe|lzcnt"
                         r"|popcnt|crc32|cmpxchg16b|[ls]ahf|ad[co]x|aes|pclmul|sha(?:1|256)"
                         r"|addsub|h(?:add|sub)p|ph(?:add|sub|min)|lddqu|fisttp|mov(?:d|s[hl])dup|movntdqa"
                         r"|pabs|psign|palignr|pshufb|pmaddub|pmulhrsw|pmul(?:ld|dq)|pmov[sz]x"
                         r"|p(?:max|min)(?:s[bd]|u[wd])|packusdw|pcmp(?:eqq|gtq|[ei]str)|ptest"
                         r"|p?blend|round[sp][sd]|dpp[sd]|pinsr[bdq]|insertps|extractps|mpsadbw")
FUSED = re.compile(r"vfn?m(?:add|sub)")


def violations(disassembly):
    """One line for every function of `objdump -d -C` with an instruction that it must not have, or a line if
    it has none at all."""
    found, function, count = {}, "", 0
    for line in disassembly:
        if head := FUNCTION.match(line):
            function = head[1]
        elif instruction := INSTRUCTION.match(line):
            name, count = instruction[1], count + 1
            if FUSED.match(name) or (BEYOND_SSE2.match(name) and not LEVEL.search(function)):
                found.setdefault(function, name)
    return [f"{function}: {name}" for function, name in found.items()] if count else ["has no instructions"]


def violations_of(program):
    """Those of a program, and of objdump where it fails."""
    with subprocess.Popen(["objdump", "-d", "-C", "--no-show-raw-insn", program], text=True,
                          stdout=subprocess.PIPE) as objdump:
        found = violations(objdump.stdout)
    return found + ([f"objdump fails with exit code {objdump.returncode}"] if objdump.returncode else [])


if __name__ == "__main__":
    sys.exit(report(violations_of(sys.argv[1])))
