"""Functions of a C++ text, found by their braces. Not a parser: a block at the level of namespaces
and classes that is neither of these nor an initialiser is a function's body. So templates, operators
and lambdas need no rule of their own, and what lies in a function counts as part of it.
"""

import re
from typing import NamedTuple

# Comments, literals and preprocessor lines, in which braces mean nothing.
RAW_STRING = r'\bu?8?R"(?P<mark>[^ ()\\\t\n]*)\(.*?\)(?P=mark)"'
OPAQUE = re.compile("|".join((
    r"//[^\n]*", r"/\*.*?\*/", RAW_STRING, r'"(?:\\.|[^"\\\n])*"', r"(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'",
    r"(?:(?<=\n)|\A)[ \t]*#(?:\\\n|[^\n])*")), re.DOTALL)
SCOPE = re.compile(r"\s*(?:template\b|inline\b|typedef\b|static\b|const\b|constexpr\b|\s)*"
                   r"(?:(?:namespace|class|struct|union|enum)\b|extern\s*$)")
ACCESS = re.compile(r"(?:\s*\b(?:public|private|protected)\s*:)*\s*")
OPERATOR = re.compile(r"\boperator\s*(?:\(\s*\)|\[\s*\]|[-+*/%^&|~!=<>]+)")
NAME = re.compile(r"[~\w:]*(?:operator\s*[^\s(]+)?[~\w]*\s*\(")


class Function(NamedTuple):
    name: str
    first: int  # line of its first word, from 1
    last: int   # line of its closing brace

    @property
    def lines(self):
        return self.last - self.first + 1


def without_opaque(text):
    """The text with comments, literals and preprocessor lines blanked, line by line as it was."""
    return OPAQUE.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text)


def without_nested(text, *pairs):
    """The text without what stands in brackets of these kinds, and without the brackets."""
    inner = re.compile("|".join(rf"\{pair[0]}[^{re.escape(pair)}]*\{pair[1]}" for pair in pairs))
    while inner.search(text):
        text = inner.sub("", text)
    return text


def is_scope(head):
    bare = without_nested(head, "()", "[]", "<>")
    return "=" not in bare and bool(SCOPE.match(bare))


def is_initialiser(head):
    if re.search(r"=\s*\[", head):  # of a lambda
        return False
    bare = without_nested(OPERATOR.sub("operator", head), "()", "[]")
    return bare == head or bool(re.search(r"=\s*[\w:<>, ]*$", bare))


def name_of(head):
    found = NAME.search(OPERATOR.sub(lambda text: text.group().replace("(", "").replace(")", ""),
                                     head))
    return found.group()[:-1].strip() if found else head.strip()


def functions(text):
    """All functions of a text. Raises ValueError if its braces do not match."""
    bare = without_opaque(text)
    found, scopes, head, position = [], 0, 0, 0
    while position < len(bare):
        character = bare[position]
        position += 1
        if character == ";":
            head = position
        elif character == "}":
            scopes -= 1
            head = position
            if scopes < 0:
                raise ValueError("a brace too many")
        elif character == "{":
            head = ACCESS.match(bare, head).end()
            declared = bare[head:position - 1]
            if is_scope(declared):
                scopes += 1
                head = position
                continue
            position = end_of_block(bare, position)
            # After a member's initialiser or a default argument the head goes on: x{1}, y{2} {...
            if re.match(r"\s*[,{)]", bare[position:position + 200]):
                continue
            if not is_initialiser(declared):
                found.append(Function(name_of(declared), bare.count("\n", 0, head) + 1,
                                      bare.count("\n", 0, position) + 1))
            head = position
    if scopes:
        raise ValueError("a brace is not closed")
    return found


def end_of_block(text, position):
    """Position after the brace that closes the block begun before `position`."""
    depth = 1
    while depth and position < len(text):
        depth += (text[position] == "{") - (text[position] == "}")
        position += 1
    if depth:
        raise ValueError("a brace is not closed")
    return position
