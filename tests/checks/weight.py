#!/usr/bin/env python3
"""What the tree weighs: lines by room, lines and cases of tests, files, bytes, lines of documents.

    python3 tests/checks/weight.py                  of the working tree
    python3 tests/checks/weight.py COMMIT           of a commit
    python3 tests/checks/weight.py COMMIT OTHER     both and the difference, and cases that one lacks; `.` is the working tree

A case is a TEST of C++ or a `test_` function of Python. Documents are Markdown below docs, without the lab book.
"""

import re
import subprocess
import sys
from collections import Counter
from pathlib import PurePosixPath

from source_tree import ROOT, room

LANGUAGES = {".cpp": "C++", ".hpp": "C++", ".py": "Python", ".js": "JavaScript"}
CASE = re.compile(r"^(?:TYPED_)?TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)|^ +def (test_\w+)", re.MULTILINE)


def git(*words, **how):
    return subprocess.run(["git", "-C", str(ROOT), *words], check=True, stdout=subprocess.PIPE, **how).stdout


def read_files(commit):
    """{path: bytes} of a commit, or of what the working tree would commit."""
    if commit == ".":
        names = git("ls-files", "-z", "--cached", "--others", "--exclude-standard").decode().split("\0")
        return {name: (ROOT / name).read_bytes() for name in sorted(set(names)) if (ROOT / name).is_file()}
    entries = [entry.split("\t") for entry in git("ls-tree", "-r", "-z", commit).decode().split("\0") if entry]
    hashes = "".join(f"{about.split()[2]}\n" for about, _ in entries)
    blobs, start, files = git("cat-file", "--batch", input=hashes.encode()), 0, {}
    for _, name in entries:
        end = blobs.index(b"\n", start)
        size = int(blobs[start:end].split()[2])
        files[name] = blobs[end + 1:end + 1 + size]
        start = end + 2 + size
    return files


def cases(files):
    """Names of test cases, with the unit where Python's names are not unique."""
    found = set()
    for path, data in files.items():
        if path.startswith("tests/") and path.endswith((".cpp", ".py")):
            found |= {f"{suite}.{name}" if suite else f"{PurePosixPath(path).stem}.{own}"
                      for suite, name, own in CASE.findall(data.decode())}
    return found


def weigh(files):
    """{what: number}."""
    weight = Counter({"files": len(files), "bytes": sum(map(len, files.values())), "test cases": len(cases(files))})
    for path, data in files.items():
        lines, language = data.count(b"\n"), LANGUAGES.get(PurePosixPath(path).suffix)
        if language and path.startswith("tests/"):
            weight[f"lines of tests, {language}"] += lines
        elif language:
            weight[f"lines, {language}"] += lines
            weight[f"lines in {room(path)}"] += lines
        elif path.startswith("docs/") and path.endswith(".md"):
            weight["lines of the lab book" if path.startswith("docs/record/") else "lines of documents"] += lines
    weight["lines outside tests"] = sum(weight[f"lines, {language}"] for language in set(LANGUAGES.values()))
    return weight


def table(*weights):
    """Rows of all that one of the weights has, with the difference of two."""
    for what in sorted(set().union(*weights), key=lambda what: (what.startswith("lines in "), what)):
        numbers = [weight[what] for weight in weights]
        if len(numbers) == 2:
            numbers.append(numbers[1] - numbers[0])
        yield f"{what:<28}" + "".join(f"{number:>12,}" for number in numbers)


if __name__ == "__main__":
    states = [read_files(commit) for commit in sys.argv[1:3] or ["."]]
    print(*table(*map(weigh, states)), sep="\n")
    if len(states) == 2:
        for mark, one, other in (("-", *states), ("+", *reversed(states))):
            print(*(f"{mark} {name}" for name in sorted(cases(one) - cases(other))), sep="\n", end="\n")
