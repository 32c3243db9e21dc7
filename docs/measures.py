#!/usr/bin/env python3
"""Writes the measures of docs/reference/measures.md from apps/python/listric/dictionary.json, which the build makes. Between
`<!-- measures: TABLE ... -->` and `<!-- end -->` stand the measures of these tables, each with a heading
and so an anchor; the rest of the page is by hand. Measures of validation have a page on the site alone
(site_hooks.py).
"""

import re
import sys

from parameters import ROOT, anchor, read_declared, sentence

PAGE = ROOT / "docs/reference/measures.md"
OF_VALIDATION = ("snapshots",)  # tables
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
        parts.append(f"### {name}\n" + " ".join(filter(None, (sentence(one["doc"]), " · ".join(facts(one))))))
    return "\n\n".join(filter(None, parts)) + "\n\n"


def page(text, entries):
    """The page with its measures as they are declared."""
    return MARKED.sub(lambda m: m[1] + block(entries, m[2].split()) + m[3], text)


def of_validation(entries):
    """The page of measures that `listric validate` takes from snapshots."""
    return ("# Measures of validation\n\n[Measures](measures.md#measures-of-validation) says how they are taken.\n\n"
            + block(entries, OF_VALIDATION))


def missing(text, entries):
    """Tables of the dictionary that the page does not show."""
    shown = {name for m in MARKED.finditer(text) for name in m[2].split()}
    return sorted({entry["table"] for entry in entries} - shown - set(OF_VALIDATION))


def read_dictionary():
    return read_declared(DICTIONARY)


if __name__ == "__main__":
    words, document = read_dictionary(), PAGE.read_text(encoding="utf-8")
    if missing(document, words):
        sys.exit(f"{PAGE}: has no table {', '.join(missing(document, words))}")
    PAGE.write_text(page(document, words), encoding="utf-8")
