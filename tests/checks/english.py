#!/usr/bin/env python3
"""English of the documents: constructions that a stranger has to decode.

    python3 tests/checks/english.py     prints lines that have one, and what to write

Sentences go subject, verb, object; a row of a table begins with a noun or a verb; "the same", "that of" and "what is"
need a name; say, tell, ask and take are for people. The lab book is as it was written.
"""

import re

from links import CODE, read_documents
from source_tree import report

# The lab book and the changelog of old are records; the two others are generated from declarations.
NOT_READ = ("docs/record/", "docs/measures.md", "docs/parameters.md", "docs/glossary.md", "docs/architecture.md")

THING = (r"(?:page|file|scene|table|run|test|program|call|option|message|key|report|row|launcher|summary|header|schema|plan"
         r"|document|name|log|warning|error|figure|record|paper|model|study|measure|it)s?")
PATTERNS = (
    (rf"\b{THING} (?:says?|tells?|asks?)\b", "people say, tell and ask; a thing has, lists, prints, requires, shows"),
    (r"\b(?:is|are|be) (?:told|said)\b", "name who reports it: the program prints, the message names"),
    (r"\b(?:LIS1|LIS2|RFR|strain|rock|resolution) (?:and \w+ )?asks? for\b", "improves with, needs"),
    (r"\bsays? otherwise\b|\bsaid otherwise\b|\bunless it says\b", "unless given, unless noted"),
    (r"\bto whoever\b|\bif it shall be\b|\bif for anything\b", "name the subject"),
    (r"\bas ever\b|\bhere as there\b|\bthere as here\b", "name both places"),
    (r"\bfor (?:ever|good)\b", "permanently, always"),
    (r"(?:^|(?<=[.!] ))What (?![^.?|]*\?)[^.?|]{3,}\.(?=\s|$)", "begin with the subject, not with What"),
    (r"(?:^|(?<=[.!] ))Of (?!course\b)[^.|]{3,}\.", "begin with the subject, not with Of"),
    (r"^\| *(?:the same|that of|those of|of that|of the|what is|what it|what they)\b", "begin a row with a noun or a verb"),
    (r"\| (?:the same|that of|those of|of that|what is|what it|what they) (?!for\b)", "begin a cell with a noun or a verb"),
    (r"(?:^|(?<=[.!:] ))The same(?: of| for| by| at|[.,:])", "name the thing again"),
    (r"\bthe same (?:of|less|is so)\b", "name the thing again"),
    (r"\banew\b", "again"),
    (r"\bbut for\b", "except"),
    (r"\bto that end\b|\bwhat for\b|\bwhereof\b|\bthereof\b", "name the purpose"),
    (r"\bcomes? of (?:it|that|this)\b|\bcomes? out of it\b|\bwhat came and went\b", "results, follows from"),
    (r"\bno clock of its own\b|\boutgrows?\b|\blet go\b|\bhas the last word\b", "say it without the image"),
    (r"\bit is so (?:within|by|for)\b|\bso is the\b", "repeat the verb"),
    (r"\bwhat (?:is|are) (?:there|that|left|so)\b", "name the thing that is there"),
    (r"\bone sees\b|\bwhere one sees\b", "you see; the picture shows"),
    (r"\b[Mm]any a\b|\bnone such\b|\bsuch as it is\b|\bno such is\b", "plain words"),
    (r"\bby halves\b|\bin its turn\b|\bof late\b|\bof old\b", "plain words"),
    (r"\bwhich (?:says|tells|asks)\b|\band (?:says|tells|asks)\b", "people say, tell and ask; prints, lists, requires"),
)
COMPILED = [(re.compile(pattern, re.MULTILINE), cure) for pattern, cure in PATTERNS]


def prose(text):
    """The text without code and without heads of tables; lines of one paragraph are joined."""
    text = CODE.sub(lambda code: re.sub(r"[^\n]", "_", code[0]), text)
    text = re.sub(r"^\|.*\n(?=\|[-|: ]+$)", "", text, flags=re.MULTILINE)
    return re.sub(r"(?<=[^\n|:])\n(?=[^\n|#*\-\d>_])", " ", text)


def violations(documents):
    found = []
    for path, text in documents.items():
        if path.startswith(NOT_READ):
            continue
        for pattern, cure in COMPILED:
            for match in pattern.finditer(prose(text)):
                found.append(f"{path}: \"{match[0][:60]}\": {cure}")
    return found


if __name__ == "__main__":
    raise SystemExit(report(violations(read_documents())))
