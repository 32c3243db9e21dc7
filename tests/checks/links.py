#!/usr/bin/env python3
"""Links of the documents: each leads to a file that there is and to a heading that it has.

    python3 tests/checks/links.py      prints what leads nowhere

A heading's anchor must be the same where GitHub shows the file and in the site that mkdocs makes.
"""

import posixpath
import re
import unicodedata
from pathlib import Path

from source_tree import ROOT, report

DOCUMENTS = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/**/*.md", "meshes/*.md")
CODE = re.compile(r"^(```|~~~).*?^\1|(`+)(?!`).+?(?<!`)\2(?!`)", re.DOTALL | re.MULTILINE)
FENCE = re.compile(r"^(```|~~~).*?^\1", re.DOTALL | re.MULTILINE)
HEADING = re.compile(r"^#{1,6} +(.+?) *#*$", re.MULTILINE)
LINK = re.compile(r"\]\(([^)\s]+)\)")
MENTION = re.compile(r"(?<![\w/.:-])docs/[\w/-]+\.md\b")


def read_documents(root=ROOT):
    return {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8")
            for pattern in DOCUMENTS for path in sorted(Path(root).glob(pattern))}


def anchors(text):
    """Those of a document's headings; of equal ones the first."""
    found = set()
    for heading in HEADING.findall(FENCE.sub("", text)):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)|[`*]", r"\1", heading).lower()
        on_github = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        ascii_words = unicodedata.normalize("NFKD", words).encode("ascii", "ignore").decode()
        on_site = re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", ascii_words).strip())
        if on_github == on_site:
            found.add(on_site)
    return found


def links(text):
    """Targets of a document's links, but for those to other hosts."""
    return [to for to in LINK.findall(CODE.sub("", text)) if not re.match(r"[a-z]+:", to)]


def violations(documents, exists):
    """Links that lead nowhere. `exists` says of a path from the root whether there is such a file."""
    found = []
    for path, text in documents.items():
        for to in links(text):
            name, _, anchor = to.partition("#")
            target = posixpath.normpath(posixpath.join(posixpath.dirname(path), name)) if name else path
            if not exists(target):
                found.append(f"{path}: {to}: no such file")
            elif anchor and anchor not in anchors(documents.get(target, "")):
                found.append(f"{path}: {to}: no such heading, or none that mkdocs and GitHub name alike")
        if not path.startswith("docs/record/"):  # the lab book names files as they were called then
            found += [f"{path}: {name}: no such file"
                      for name in sorted(set(MENTION.findall(text))) if not exists(name)]
    return found


def in_tree(path):
    return (ROOT / path).exists()


if __name__ == "__main__":
    raise SystemExit(report(violations(read_documents(), in_tree)))
