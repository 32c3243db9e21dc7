#!/usr/bin/env python3
"""Draws the rooms and who includes whom, from the includes, as build/architecture.svg or the file; docs/site_hooks.py puts it on the site.

    python3 tests/checks/architecture.py [FILE]

A room is a floor. Its shaft rises from it through the floors above, and opens (a dot) at each that
includes it. Where it had to go down, to a floor that includes what lies above it, it is red.
"""

import sys
from html import escape
from pathlib import Path

from layering import APPS
from source_tree import ROOT, includes, is_cpp, is_ours, read_tree, room

DRAWING = ROOT / "build" / "architecture.svg"

# From the top floor to the ground.
FLOORS = {
    "apps/page": "scenes read and run in a browser: a module",
    "apps/commands": "the command line: one file per call",
    "apps/studies": "many runs: validation, accuracy against time",
    "apps/laboratory": "samples under test: what rock microproperties make",
    "apps/run": "simulates a scene from genesis or snapshot to its end",
    "apps/figures": "report and drawing page, figures, seismics, ParaView",
    "apps/archive": "a run's folder: snapshots, history, summary",
    "apps/measures": "numbers from states; no files, no scene",
    "apps/model": "the objects a scene asks for; effects, one file each",
    "apps/scene": "what the user writes, read and checked",
    "apps/support": "errors, files, text, statistics",
    "thermal": "temperature of discs and of the rock around",
    "fluid": "water in the pores of sediment",
    "coupling": "discs on the elastic footwall",
    "fem": "the elastic footwall (plug-in: deal.II, PETSc)",
    "dem": "the hanging wall: discs, contacts, cycle, events",
}
FLOOR, SHAFT, LEFT, TOP = 38, 44, 480, 20  # pixels
UP, DOWN = "#44546a", "#c0392b"


def room_graph(tree):
    """{room: other rooms whose headers its files include}."""
    graph = {name: set() for name in FLOORS}
    for path, text in tree.items():
        if is_cpp(path) and room(path) in graph:
            graph[room(path)] |= {room(name) for name in includes(text) if is_ours(name)}
    return {name: (others & set(FLOORS)) - {name} for name, others in graph.items()}


def shaft(column, name, users, level):
    """The lines and dots of one room's shaft, the part below the room in red."""
    x = LEFT + SHAFT * (column + 0.5)
    y = {floor: TOP + FLOOR * (level[floor] + 0.5) for floor in (name, *users)}
    for end, colour in ((min(y.values()), UP), (max(y.values()), DOWN)):
        if end != y[name]:
            yield (f'<line x1="{x}" y1="{y[name]}" x2="{x}" y2="{end}" stroke="{colour}" '
                   'stroke-width="2"/>')
    yield (f'<rect x="{x - 5}" y="{y[name] - 5}" width="10" height="10" fill="{UP}">'
           f'<title>{name}</title></rect>')
    for user in users:
        yield (f'<circle cx="{x}" cy="{y[user]}" r="5" fill="{UP if y[user] < y[name] else DOWN}">'
               f'<title>{user} includes {name}</title></circle>')
    foot = TOP + FLOOR * len(level) + 14
    yield (f'<text x="{x}" y="{foot}" transform="rotate(35 {x} {foot})" class="foot">'
           f'{name.removeprefix("apps/")}</text>')


def drawing(tree):
    """The SVG text of a tree's rooms."""
    graph = room_graph(tree)
    level = {name: i for i, name in enumerate(FLOORS)}
    width, height = LEFT + SHAFT * len(FLOORS) + 50, TOP + FLOOR * len(FLOORS) + 80
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
             f'width="{width}" height="{height}" font-family="sans-serif">',
             "<style>.room {font-size: 15px; font-weight: bold} .purpose, .foot {font-size: 12px} "
             "text {fill: #222}</style>",
             f'<rect width="{width}" height="{height}" fill="white"/>']
    for name, purpose in FLOORS.items():
        y = TOP + FLOOR * level[name]
        fill = "#eef3f8" if name in APPS else "#f6efe2"
        parts.append(f'<rect x="10" y="{y + 2}" width="{width - 60}" height="{FLOOR - 4}" rx="4" '
                     f'fill="{fill}"/>')
        parts.append(f'<text x="20" y="{y + 24}" class="room">{name.removeprefix("apps/")}</text>')
        parts.append(f'<text x="130" y="{y + 24}" class="purpose">{escape(purpose)}</text>')
    for column, name in enumerate(FLOORS):
        users = [user for user in FLOORS if name in graph[user]]
        parts.extend(shaft(column, name, users, level))
    return "\n".join([*parts, "</svg>", ""])


if __name__ == "__main__":
    drawn = Path(*sys.argv[1:2] or [DRAWING])
    drawn.parent.mkdir(exist_ok=True)
    drawn.write_text(drawing(read_tree()), encoding="utf-8")
