"""The sources as data: a tree is a dict {path from the root: text}, so that a check is a function of
it and a test can plant a violation without touching a file.

Also the one home of the include graph, which the layering check judges and architecture.py
draws.
"""

import re
import sys
from pathlib import Path, PurePosixPath

ROOT = Path(__file__).resolve().parents[2]
LAYERS = ("dem", "fem", "coupling", "fluid", "thermal", "apps")
CPP = {".hpp", ".cpp"}
PYTHON = {".py"}
PAGE = {".js", ".json"}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"\n]*)"|<([^>\n]*)>|(\S+))', re.MULTILINE)


def read_tree(root=ROOT, layers=LAYERS, suffixes=CPP | PYTHON):
    """All C++ and Python files of the layers, or those with these suffixes, in the order of their paths.
    Raises FileNotFoundError if there is none: nothing would be wrong with them."""
    files = (file for layer in layers for file in (Path(root) / layer).rglob("*"))
    tree = {file.relative_to(root).as_posix(): file.read_text(encoding="utf-8")
            for file in sorted(files) if file.suffix in suffixes}
    if not tree:
        raise FileNotFoundError(f"{root}: has no sources in {', '.join(layers)}")
    return tree


def is_cpp(path):
    return PurePosixPath(path).suffix in CPP


def includes(text):
    """Names in the #include lines of a text; of a macro, its name."""
    return [quoted or angled or macro for quoted, angled, macro in INCLUDE.findall(text)]


def is_ours(name):
    return name.split("/")[0] in LAYERS


def room(path):
    """`dem`, `fem`, `coupling` or `fluid`; in apps the folder, `apps/measures`, or what lies in none, `apps`."""
    parts = PurePosixPath(path).parts
    return "/".join(parts[:2]) if parts[0] == "apps" and len(parts) > 2 else parts[0]


def unit(path):
    """A source together with its header: the path without its suffix."""
    return path.rsplit(".", 1)[0]


def unit_graph(tree):
    """{unit: units whose headers it includes}, without itself."""
    graph = {unit(path): set() for path in tree if is_cpp(path)}
    for path, text in tree.items():
        if is_cpp(path):
            graph[unit(path)] |= {unit(name) for name in includes(text) if is_ours(name)}
    return {name: edges - {name} for name, edges in graph.items()}


def cycles(graph):
    """Sets of nodes of which each reaches each other (Tarjan's strongly connected components)."""
    index, lowest, stack, found = {}, {}, [], []

    def visit(node):
        index[node] = lowest[node] = len(index)
        stack.append(node)
        for other in sorted(graph.get(node, ())):
            if other not in index:
                visit(other)
            if other in stack:
                lowest[node] = min(lowest[node], lowest[other])
        if lowest[node] == index[node]:
            start = stack.index(node)
            if len(stack) - start > 1:
                found.append(sorted(stack[start:]))
            del stack[start:]

    for node in sorted(graph):
        if node not in index:
            visit(node)
    return sorted(found)


def report(violations):
    """Prints what a check found; the exit code of the call."""
    for violation in violations:
        print(violation)
    return 1 if violations else 0


def main(check):
    """Checks the tree that this file is of, or another one whose root is an argument."""
    sys.exit(report(check(read_tree(*sys.argv[1:2]))))
