#!/usr/bin/env python3
"""An effect is its physics (a file pair in dem/events or coupling) and one description. Which other
lines of apps name it, by its table or by the type of its parameters?

    python3 tests/checks/one_place.py      prints these lines, and what is wrong with them

Painters, in Python, JavaScript and what these read, name none at all: effects declare what is drawn of
them. Comments count, longer identifiers that hold the name (attach_base_motion), and names put together
from pieces ("fault_" "weakening", or a format of them).
"""

import re
import sys
from fnmatch import fnmatch
from itertools import count
from pathlib import PurePosixPath
from typing import NamedTuple

from source_tree import CPP, PAGE, PYTHON, is_cpp, read_tree, report

DESCRIPTIONS = "apps/model/effects/"
LIST = "apps/model/effect_list.hpp"  # one line each
MOST_EXCEPTIONS = 3
GENERATED = ("apps/*.schema.json", "apps/python/listric/dictionary.json")  # from the descriptions


class Effect(NamedTuple):
    table: str
    parameters: str      # their type
    own: str = ""        # files beside those that the table's name begins
    trade: bool = False  # the table's name is a word of the trade: the type alone counts


EFFECTS = (
    Effect("gravity", "GravityParameters", trade=True),
    Effect("bonds", "RockBonds", trade=True),
    Effect("fault_weakening", "FaultWeakeningParameters"),
    Effect("layer", "SceneLayer", own="apps/scene/parameters/scene_layer*", trade=True),
    Effect("old_fault", "OldFault", own="apps/scene/picks/old_fault*"),
    Effect("bond_healing", "BondHealingParameters"),
    Effect("sedimentation", "SedimentationParameters"),
    Effect("pore_fluid", "PoreFluidParameters"),
    Effect("compaction", "CompactionParameters"),
    Effect("bed", "SedimentBed", own="apps/scene/parameters/sediment_bed*", trade=True),
    Effect("heat", "HeatParameters", trade=True),
    Effect("energy", "EnergyParameters", trade=True),
    Effect("elastic_base", "ElasticBaseParameters"),
    Effect("lower_crust_thinning", "LowerCrustThinningParameters"),
    Effect("basin_water", "BasinWaterParameters"),
    Effect("footwall_erosion", "FootwallErosionParameters"),
    Effect("base_motion", "BaseMotionParameters", own="apps/scene/parameters/flat_base*"),
    Effect("stage", "StageParameters", own="apps/scene/parameters/stage*", trade=True),
)


class Exempt(NamedTuple):
    path: str
    holds: str  # text of the line
    reason: str


EXCEPTIONS = (
    Exempt("apps/scene/parameters/stages.cpp", "surface_work", "a stage switches deposition and erosion off"),
    Exempt("apps/laboratory/pure_shear.cpp", "weakening_rate", "option --weakening-rates varies it"),
    Exempt("apps/laboratory/pure_shear.cpp", "healing_rate", "option --healing-rates varies it"),
)


class Line(NamedTuple):
    effect: str
    path: str
    number: int
    text: str

    def __str__(self):
        return f"{self.effect}: {self.path}:{self.number}: {self.text.strip()}"


NEEDS = re.compile(r"\s*\.needs = \{")
LITERAL = re.compile(r'"((?:\\.|[^"\\\n])*)"|\'((?:\\.|[^\'\\\n])*)\'')


def is_own(effect, path):
    return (fnmatch(path, f"{DESCRIPTIONS}{effect.table}*")
            or bool(effect.own) and fnmatch(path, effect.own))


def is_painter(path):
    return PurePosixPath(path).suffix in PYTHON | PAGE


def whole(word):
    """Matches the word, alone or between underscores."""
    return re.compile(rf"(?<![A-Za-z0-9]){word}(?![A-Za-z0-9])")


def lines_with_word(word, text):
    """Numbers of the lines that hold the word, from 1."""
    return {i for i, line in enumerate(text.split("\n"), 1) if whole(word).search(line)}


def lines_with_pieces(word, text):
    """Numbers of the lines where a statement's literals, in their order, begin to make the word."""
    found, start = set(), 0
    for end in (*(match.start() for match in re.finditer(r"[;{}]|\n[ \t]*\n", without_literals(text))),
                len(text)):
        pieces = [(piece.start(), piece.group(1) or piece.group(2) or "")
                  for piece in LITERAL.finditer(text, start, end)]
        for between in ("", "_"):
            joined, starts = "", []
            for position, piece in pieces:
                starts.append((len(joined), position))
                joined += piece + between
            for match in whole(word).finditer(joined):
                first = max(place for place in starts if place[0] <= match.start())
                last = max(place for place in starts if place[0] < match.end())
                if first != last:  # else it stands in one literal, where it is found as a word
                    found.add(text.count("\n", 0, first[1]) + 1)
        start = end
    return found


def without_literals(text):
    """The text with what stands in literals blanked, at the same positions."""
    return LITERAL.sub(lambda literal: " " * len(literal.group()), text)


def pasted(word, text):
    """Numbers of the lines where tokens are pasted to the word by a macro: fault_##weakening."""
    return {i for i, line in enumerate(text.split("\n"), 1)
            if "##" in line and whole(word).search(re.sub(r"\s*##\s*", "", line))}


def mentions(effect, tree):
    """Lines of apps outside the effect's own files that name it."""
    for path, text in tree.items():
        if not path.startswith("apps/") or is_own(effect, path) or any(fnmatch(path, made) for made in GENERATED):
            continue
        numbers = lines_with_word(effect.parameters, text)
        if is_painter(path) and "_" in effect.table:
            first, *others = effect.table.split("_")
            numbers |= lines_with_word(first + "".join(map(str.capitalize, others)), text)
        if not effect.trade or is_painter(path) and "_" in effect.table:
            numbers |= lines_with_word(effect.table, text) | lines_with_pieces(effect.table, text)
            numbers |= pasted(effect.table, text)
        lines = text.split("\n")
        if path.startswith(DESCRIPTIONS):  # a description says which others its effect needs
            numbers = {number for number in numbers if not NEEDS.match(lines[number - 1])}
        yield from (Line(effect.table, path, number, lines[number - 1]) for number in sorted(numbers))


def read_sources():
    return read_tree(layers=("apps",), suffixes=CPP | PYTHON | PAGE)


def violations(tree, effects=EFFECTS, exceptions=EXCEPTIONS):
    """What names an effect beyond its line of the list and the exceptions; useless exceptions; and
    descriptions of effects that are not in the table above."""
    found, used = [], set()
    for effect in effects:
        listed = count()
        for line in mentions(effect, tree):
            if line.path == LIST and next(listed) == 0:
                continue
            reasons = {exception for exception in exceptions
                       if exception.path == line.path and exception.holds in line.text}
            used |= reasons
            if not reasons:
                found.append(str(line))
    found += [f"an exception that is not needed: {exception.path}: {exception.holds}"
              for exception in exceptions if exception not in used]
    if len(exceptions) > MOST_EXCEPTIONS:
        found.append(f"{len(exceptions)} exceptions, at most {MOST_EXCEPTIONS}")
    found += [f"{path}: of no effect that this check knows" for path in tree
              if path.startswith(DESCRIPTIONS) and is_cpp(path)
              and not any(is_own(effect, path) for effect in effects)]
    return found


if __name__ == "__main__":
    sources = read_sources()
    for known in EFFECTS:
        for mention in mentions(known, sources):
            print(mention)
    wrong = violations(sources)
    print(f"\n{len(wrong)} of them too many, or exceptions without need:" if wrong else "\nall in order")
    sys.exit(report(wrong))
