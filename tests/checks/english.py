#!/usr/bin/env python3
"""English of documents and of what the program prints (declarations, help, errors): constructions that a stranger
has to decode.

    python3 tests/checks/english.py     prints lines that have one, and what to write

Sentences go subject, verb, object; a row of a table begins with a noun or a verb; "the same", "that of" and "what is"
need a name; say, tell, ask and take are for people. The lab book is as it was written.
"""

import ast
import re

from links import CODE, read_documents
from source_tree import CPP, LAYERS, PYTHON, is_cpp, read_tree, report

NOT_READ = ("docs/record/",)
# Texts of the program with fewer words are names, keys and pieces of sentences.
LEAST_WORDS = 3

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
    (r"\| (?:the same|that of|those of|of that|what) (?!for\b|\|)", "begin a cell with a noun or a verb"),
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


# Comments of C++ that begin so, at the start of a line or as a member's.
COMMENT = re.compile(r"(?:^[ \t]*///? |///< )((?:Of|What|The same|That of|Those of)\b[^\n?]{0,40}|the same$)", re.MULTILINE)
# A literal's text, or what is none: comments, characters, any other sign.
TOKEN = re.compile(r"""//[^\n]*|'(?:\\[^']*|[^'\\\n])'|"((?:\\.|[^"\\\n])*)"|\S""")


def texts_of_cpp(source):
    """Texts of literals, those beside each other joined."""
    parts = []
    for token in TOKEN.finditer(source):
        if token[1] is not None:
            parts.append(token[1])
        elif parts and not token[0].startswith("//"):
            yield "".join(parts).replace("\\n", "\n")
            parts = []


def texts_of_python(source):
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.JoinedStr):
            yield "".join(part.value if isinstance(part, ast.Constant) else "_" for part in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value


def program_texts(tree):
    """{path: texts of several words} of C++ and Python."""
    return {path: [text for text in (texts_of_cpp if is_cpp(path) else texts_of_python)(source)
                   if len(text.split()) >= LEAST_WORDS]
            for path, source in tree.items()}


def comments(source):
    """Comments of C++ that begin without their subject."""
    for match in COMMENT.finditer(source):
        yield f"// \"{match[1]}\": begin with the thing"


def constructions(text):
    plain = prose(text)
    for pattern, cure in COMPILED:
        for match in pattern.finditer(plain):
            yield f"\"{match[0][:60]}\": {cure}"


def violations(documents, texts=None):
    """`documents` by path, and `texts` of the program, a list by path."""
    found = [f"{path}: {one}" for path, text in documents.items() if not path.startswith(NOT_READ)
             for one in constructions(text)]
    for path, many in (texts or {}).items():
        found += dict.fromkeys(f"{path}: {one}" for text in many for one in constructions(text))
    return found


def comment_violations(tree):
    return [f"{path}: {one}" for path, source in tree.items() if is_cpp(path) for one in comments(source)]


def all_violations():
    commented = read_tree(layers=LAYERS + ("tests", "examples"), suffixes=CPP)
    return violations(read_documents(), program_texts(read_tree(suffixes=CPP | PYTHON))) + comment_violations(commented)


if __name__ == "__main__":
    raise SystemExit(report(all_violations()))
