#!/usr/bin/env python3
"""The record: a page that shows recorded pictures or tables names the commit that made them.

    python3 tests/checks/record.py     prints pages that do not
"""

import re

from links import links, read_documents
from source_tree import report

RECORDED = (".png", ".csv")
COMMIT = re.compile(r"\b(?:commit\s+|\d+\.\d+\.\d+\+)`?[0-9a-f]{7,40}\b")


def recorded(text):
    return [to for to in links(text) if to.endswith(RECORDED)]


def violations(documents):
    """Pages of docs/ that link to recorded files and name no commit."""
    return [f"{path}: {recorded(text)[0]}: made by which commit?" for path, text in documents.items()
            if path.startswith("docs/") and recorded(text) and not COMMIT.search(text)]


if __name__ == "__main__":
    raise SystemExit(report(violations(read_documents())))
