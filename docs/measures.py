#!/usr/bin/env python3
"""Writes the generated parts of docs/measures.md and docs/validation-measures.md from
apps/python/listric/dictionary.json, which the program prints (docs/parameters.sh). Between
`<!-- measures: TABLE ... -->` and `<!-- end -->` stand the measures of these tables, each with a heading
and so an anchor; the rest of a page is by hand.
"""

import json
import re
import sys

from parameters import ROOT, anchor, sentence

PAGES = (ROOT / "docs/measures.md", ROOT / "docs/validation-measures.md")
DICTIONARY = ROOT / "apps/python/listric/dictionary.json"
MARKED = re.compile(r"(<!-- measures: ([^>]*?) -->\n).*?(<!-- end -->\n)", re.DOTALL)


def reference(entries, tables=None):
    """(name, declaration) of measures and of what the objects of lists have."""
    for entry in entries:
        if tables is None or entry["table"] in tables:
            yield entry["name"], entry
            for part in entry.get("parts", ()):
                yield f"{entry['name']}.{part['name']}", part


def facts(one):
    if one["unit"]:
        yield f"**Unit** {one['unit']}"
    if "usual" in one:
        yield f"**Usual** {one['usual']}"


def block(entries, tables):
    listed = list(reference(entries, tables))
    parts = [" · ".join(f"[`{name}`](#{anchor(name)})" for name, _ in listed)]
    for name, one in listed:
        parts += [f"### {name}", sentence(one["doc"]), " · ".join(facts(one))]
    return "\n\n".join(filter(None, parts)) + "\n\n"


def page(text, entries):
    """The page with its measures as they are declared."""
    return MARKED.sub(lambda m: m[1] + block(entries, m[2].split()) + m[3], text)


def missing(texts, entries):
    """Tables of the dictionary that no page shows."""
    shown = {name for text in texts for m in MARKED.finditer(text) for name in m[2].split()}
    return sorted({entry["table"] for entry in entries} - shown)


def read_dictionary():
    return json.loads(DICTIONARY.read_text(encoding="utf-8"))


if __name__ == "__main__":
    words = read_dictionary()
    documents = [file.read_text(encoding="utf-8") for file in PAGES]
    if missing(documents, words):
        sys.exit(f"{PAGES[0]}: has no table {', '.join(missing(documents, words))}")
    for file, document in zip(PAGES, documents):
        file.write_text(page(document, words), encoding="utf-8")
