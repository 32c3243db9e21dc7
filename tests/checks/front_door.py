#!/usr/bin/env python3
"""The front door: README is short, pages of Start and How to have a picture, the gallery has every scene, and
pictures are small.

    python3 tests/checks/front_door.py     prints what is not so
"""

import re
from pathlib import Path

from links import read_documents
from source_tree import ROOT, report

MOST_WORDS = 900             # of README
MOST_BYTES = 150_000         # of a picture
MOST_BYTES_OF_A_FILM = 2_000_000
FILMS = ("docs/pictures/lis1.webp",)
PARTS = ("Start", "How to")
PICTURE = re.compile(r"!\[[^\]]*\]\(")


def pages(menu, part):
    """Pages of a part of mkdocs.yml's menu."""
    block = re.search(rf"^  - {part}:\n((?:      - .*\n)+)", menu, re.MULTILINE)
    return ["docs/" + page for page in re.findall(r": (\S+\.md)$", block[1], re.MULTILINE)] if block else []


def violations(documents, menu, scenes, sizes):
    """`sizes` are bytes of pictures by their paths."""
    words = len(documents["README.md"].split())
    found = [f"README.md: {words} words, allowed: {MOST_WORDS}"] if words > MOST_WORDS else []
    for part in PARTS:
        listed = pages(menu, part)
        if not listed:
            found.append(f"mkdocs.yml: has no part {part}")
        found += [f"{page}: has no picture" for page in ["README.md", "docs/index.md", *listed]
                  if page in documents and not PICTURE.search(documents[page])]
    shown = {part.partition("\n")[0] for part in documents["docs/gallery.md"].split("\n## ")[1:] if PICTURE.search(part)}
    found += [f"docs/gallery.md: lacks the scene {scene}, with a picture" for scene in scenes if scene not in shown]
    found += [f"{path}: {size} bytes, allowed: {most}" for path, size in sizes.items()
              if size > (most := MOST_BYTES_OF_A_FILM if path in FILMS else MOST_BYTES)]
    return list(dict.fromkeys(found))


def read_all():
    pictures = [file for folder in ("pictures", "report") for file in sorted(Path(ROOT, "docs", folder).glob("*.*"))
                if file.suffix in (".webp", ".png", ".svg", ".gif")]
    return (read_documents(), Path(ROOT, "mkdocs.yml").read_text(),
            sorted(file.stem for file in Path(ROOT, "apps/scenes").glob("*.toml")),
            {file.relative_to(ROOT).as_posix(): file.stat().st_size for file in pictures})


if __name__ == "__main__":
    raise SystemExit(report(violations(*read_all())))
