#!/usr/bin/env python3
"""Runs clang-tidy on the units of a build whose texts have changed since it found nothing in them.

    .ci/tidy.py BUILD [FOLDER...]      all of the project's, or those below the folders

A unit's text is what its compiler makes of it and its headers, comments and all; with `.clang-tidy` it is the key of a
stamp in BUILD/tidy. Units that are compiled are looked at, so that headers are read once for several files.
"""

import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("dem", "fluid", "thermal", "coupling", "fem", "apps")
TIDY = "clang-tidy-14"


def units(build, folders):
    """Entries of compile_commands.json, without the headers that gcc has precompiled and clang cannot read."""
    rooms = "|".join(re.sub(r"^apps/", "apps/(?:CMakeFiles/listric_)?", folder.rstrip("/")) for folder in folders)
    wanted = re.compile(rf"{re.escape(str(ROOT))}/(?:{re.escape(str(build.relative_to(ROOT)))}/)?(?:{rooms})[./]")
    for entry in json.loads((build / "compile_commands.json").read_text()):
        if wanted.match(entry["file"]) and "cmake_pch" not in entry["file"]:
            yield dict(entry, command=re.sub(r" -Winvalid-pch -include \S*", "", entry["command"]))


def key(entry):
    words = shlex.split(entry["command"])
    words = words[words[0].endswith("ccache"):]
    end = words.index("-o")
    text = subprocess.run([*words[:end], "-E", "-C", entry["file"]], cwd=entry["directory"], check=True,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
    return hashlib.sha256(text + (ROOT / ".clang-tidy").read_bytes() + entry["command"].encode()).hexdigest()


def check(entry, folder):
    """What clang-tidy says; None where it found nothing in this text before."""
    stamp = folder / f"{key(entry)}.clean"
    if stamp.exists():
        stamp.touch()
        return None
    ended = subprocess.run([TIDY, "-p", folder, "--quiet", "--extra-arg=-Wno-unknown-warning-option", entry["file"]],
                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    said = re.sub(r"^\d+ warnings? generated\.\n", "", ended.stdout, flags=re.MULTILINE)
    if ended.returncode == 0 and not said:
        stamp.touch()
    return said or (f"{TIDY} ended with {ended.returncode}\n" if ended.returncode else "")


def main(build, *folders):
    build = Path(build).resolve()
    folder = build / "tidy"
    folder.mkdir(exist_ok=True)
    entries = list(units(build, folders or FOLDERS))
    if not entries:
        return f"{build}: has no units below {' '.join(folders)}"
    (folder / "compile_commands.json").write_text(json.dumps(entries))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        said = list(pool.map(lambda entry: check(entry, folder), entries))
    sys.stdout.write("".join(filter(None, said)))
    print(f"{sum(one is not None for one in said)} of {len(entries)} units looked at, the others are as they were")
    return any(said)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
