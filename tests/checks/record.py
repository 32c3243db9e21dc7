#!/usr/bin/env python3
"""Guide and lab book: pages of docs/record have date, commit, machine and call, and are in its index; all
other pages name no commit, no date, and tell nothing of their own past.

    python3 tests/checks/record.py     prints pages that do otherwise
"""

import re

from links import CODE, links, read_documents
from source_tree import report

BOOK = "docs/record/"
INDEX = BOOK + "index.md"
# Dates are what these are about: releases, how to cite, and papers.
DATED = ("CHANGELOG.md", "docs/citing.md", "docs/references.md")
FIELDS = {"date": r"20\d\d-\d\d-\d\d", "commit": r"\b[0-9a-f]{7,40}\b", "machine": r"\w", "call": r"`[^`]+`"}

# A hash has a digit and a letter, or it is a number or a word.
COMMIT = re.compile(r"(?<![\w.#-])(?=[0-9a-f]*[a-f])(?=[0-9a-f]*\d)[0-9a-f]{7,40}\b")
DATE = re.compile(r"\b20\d\d-[01]\d-[0-3]\d\b|\b[0-3]?\d(?:\.|st|nd|rd|th)? (?:January|February|March|April|May|June|July"
                  r"|August|September|October|November|December)\b")
PAST = re.compile(r"\b(?:it|they|that|which) (?:was|were|had been) (?:\d|slower|faster|some \d|up to \d|off before)"
                  r"|\bno longer\b|\bused to\b|\bas before\b|\bat commit\b|\bsince commit\b"
                  r"|\bolder numbers\b|\bmade anew on\b|\bgone wrong before\b", re.IGNORECASE)


def of_a_guide(path, text):
    prose = CODE.sub("", text)
    for name, pattern in (("a commit", COMMIT), ("a date", DATE), ("a past", PAST)):
        found = pattern.search(prose)
        if found and not (path in DATED and pattern is not COMMIT):
            yield f"{path}: {name}, {found[0].strip()}: belongs into {BOOK}"


def of_the_book(path, text):
    for name, pattern in FIELDS.items():
        row = re.search(rf"^\| {name} \| (.*) \|$", text, re.MULTILINE)
        if not row or not re.search(pattern, row[1]):
            yield f"{path}: has no row | {name} | ... |"


def violations(documents):
    found = []
    for path, text in documents.items():
        if path.startswith(BOOK) and path != INDEX:
            found += of_the_book(path, text)
            if path.removeprefix(BOOK) not in links(documents.get(INDEX, "")):
                found.append(f"{path}: {INDEX} does not link to it")
        elif path != "CHANGELOG.md":
            found += of_a_guide(path, text)
    return found


if __name__ == "__main__":
    raise SystemExit(report(violations(read_documents())))
