#!/usr/bin/env python3
"""Writes the tables of docs/measures.md anew from apps/python/listric/dictionary.json, which the
program says (docs/parameters.sh). Between `<!-- measures: TABLE ... -->` and `<!-- end -->` stand the
measures of these tables; the rest of the page is by hand.
"""

import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/measures.md"
DICTIONARY = ROOT / "apps/python/listric/dictionary.json"
MARKED = re.compile(r"(<!-- measures: ([^>]*?) -->\n).*?(<!-- end -->\n)", re.DOTALL)


def rows(entries, tables):
    for entry in entries:
        if entry["table"] not in tables:
            continue
        yield f"`{entry['name']}`", entry
        for part in entry.get("parts", ()):
            yield f"`{entry['name']}`: `{part['name']}`", part


def table(entries, tables):
    lines = ["| name | unit | what |", "|---|---|---|"]
    lines += [f"| {name} | {one['unit']} | {one['doc']} |" for name, one in rows(entries, tables)]
    return "\n".join(lines) + "\n"


def page(text, entries):
    """The page with its tables made anew."""
    return MARKED.sub(lambda m: m[1] + table(entries, m[2].split()) + m[3], text)


def missing(text, entries):
    """Tables of the dictionary that the page does not show."""
    shown = {name for m in MARKED.finditer(text) for name in m[2].split()}
    return sorted({entry["table"] for entry in entries} - shown)


if __name__ == "__main__":
    words = json.loads(DICTIONARY.read_text(encoding="utf-8"))
    document = PAGE.read_text(encoding="utf-8")
    if missing(document, words):
        sys.exit(f"{PAGE}: has no table {', '.join(missing(document, words))}")
    PAGE.write_text(page(document, words), encoding="utf-8")
