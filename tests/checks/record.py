#!/usr/bin/env python3
"""The record: a page that shows recorded pictures or tables names the commit that made them.

    python3 tests/checks/record.py     prints pages that do not
"""

import re

from links import links, read_documents
from source_tree import report

RECORDED = (".png", ".csv")
COMMIT = re.compile(r"\b(?:commit\s+|\d+\.\d+\.\d+\+)`?[0-9a-f]{7,40}\b")


def violations(documents):
    """Pages of docs/ that link to recorded files and name no commit."""
    return [f"{path}: {recorded[0]}: made by which commit?"
            for path, text in documents.items() if path.startswith("docs/")
            for recorded in [[to for to in links(text) if to.endswith(RECORDED)]]
            if recorded and not COMMIT.search(text)]


if __name__ == "__main__":
    raise SystemExit(report(violations(read_documents())))
