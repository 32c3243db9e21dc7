#!/usr/bin/python3
"""Chart of a validation: criteria of faulting, a square per seed.

Usage: verdicts.py DIR

DIR holds verdicts.json as `listric validate` wrote it; it gets verdicts.png: a panel per experiment, in
it a row per criterion, in the order of the plan, with a square per seed, the verdict, and how many seeds
of the run beside it, such as a control, meet the criterion.  The file is written under a temporary name
and then renamed.  On bad input: one line on stderr, exit status 2.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import FAINT, INK, new_figure, read_json, run, save
from script import InputError

from matplotlib.collections import PatchCollection
from matplotlib.patches import Patch, Rectangle

COLOURS = {"m": "#2a7f62", "x": "#e08a4f", "o": "#c4c0b6"}
MEANINGS = {"m": "meets it", "x": "misses it", "o": "no case"}
VERDICTS = {"shown": "#2a7f62", "open": FAINT, "not shown": "#b4561d"}
ROW, HEAD, FOOT = 0.21, 0.62, 0.42   # heights, inches
LABELS, SEED, WORDS, BESIDE, MARGIN = 6.3, 0.19, 1.5, 1.0, 0.12   # widths, inches


def panel_height(experiment: dict) -> float:
    return HEAD + ROW * len(experiment["rows"])


def verdict_of(row: dict) -> str:
    """"shown, 18 of 20"; a row that no seed has met or missed has no count."""
    return f"{row['verdict']}, {row['met']} of {row['of']}" if row["of"] else row["verdict"]


def heading(experiment: dict) -> str:
    """"LIS1: 13 of 18 criteria of faulting shown, 4 open, 1 not shown"."""
    verdicts = [row["verdict"] for row in experiment["rows"]]
    return (f"{experiment['title']}: {verdicts.count('shown')} of {len(verdicts)} criteria of faulting shown, "
            f"{verdicts.count('open')} open, {verdicts.count('not shown')} not shown")


def machinery(experiment: dict) -> str:
    """"kinematics 7 of 7, conservation 5 of 5, in every seed"."""
    parts = [f"{kind} {experiment[kind]}" for kind in ("kinematics", "conservation") if experiment[kind]]
    return f"recorded: {experiment['seeds']} seeds" + (f"; {', '.join(parts)} in every seed" if parts else "")


def draw_panel(axes, experiment: dict, seeds: int) -> None:
    rows = experiment["rows"]
    axes.set_xlim(-LABELS / SEED, seeds + (WORDS + BESIDE) / SEED)
    axes.set_ylim(len(rows), -HEAD / ROW)
    axes.axis("off")
    left = (MARGIN - LABELS) / SEED
    axes.text(left, -1.75, heading(experiment), fontsize=11, weight="bold", va="center")
    axes.text(left, -0.65, machinery(experiment), fontsize=8.5, color=FAINT, va="center")
    for kind, colour in COLOURS.items():
        squares = [Rectangle((seed + 0.07, k + 0.1), 0.86, 0.8) for k, row in enumerate(rows)
                   for seed, cell in enumerate(row["cells"]) if cell == kind]
        axes.add_collection(PatchCollection(squares, facecolor=colour, linewidth=0))
    missing = [Rectangle((seed + 0.07, k + 0.1), 0.86, 0.8) for k, row in enumerate(rows)
               for seed, cell in enumerate(row["cells"]) if cell == "-"]
    axes.add_collection(PatchCollection(missing, facecolor="none", edgecolor="#e3e0d9", linewidth=0.5))
    for k, row in enumerate(rows):
        axes.text(-0.5, k + 0.52, f"{row['what']}: {row['expected']}", ha="right", va="center", fontsize=8.2, color=INK)
        axes.text(seeds + 0.5, k + 0.52, verdict_of(row), ha="left", va="center", fontsize=8.2,
                  color=VERDICTS.get(row["verdict"], FAINT))
        axes.text(seeds + WORDS / SEED, k + 0.52, row["beside"], ha="left", va="center", fontsize=8.2, color=FAINT)
    if any(row["beside"] for row in rows):
        axes.text(seeds + WORDS / SEED, -0.65, f"in {experiment['beside']}", ha="left", va="center", fontsize=8.5, color=FAINT)


def seeds_in_words(seeds: list[int]) -> str:
    """"51 to 70"; a list where one is left out."""
    if seeds == list(range(seeds[0], seeds[-1] + 1)):
        return f"{seeds[0]} to {seeds[-1]}"
    return ", ".join(map(str, seeds))


def draw(chart: dict):
    experiments, seeds = chart["experiments"], chart["seeds"]
    if not experiments or not seeds:
        return None
    heights = [panel_height(experiment) for experiment in experiments]
    width, height = LABELS + SEED * len(seeds) + WORDS + BESIDE, sum(heights) + FOOT
    figure = new_figure(width, height, 120)
    top = height
    for experiment, high in zip(experiments, heights):
        top -= high
        axes = figure.add_axes((0.0, top / height, 1.0, high / height))
        draw_panel(axes, experiment, len(seeds))
    figure.legend([Patch(facecolor=colour) for colour in COLOURS.values()],
                  [f"a seed that {MEANINGS[k]}" if k != "o" else MEANINGS[k] for k in COLOURS],
                  loc="lower right", ncol=3, frameon=False, fontsize=8.2, handlelength=0.9, handleheight=0.9)
    figure.text(MARGIN / width, 0.16 / height, f"seeds {seeds_in_words(seeds)}, from left to right", fontsize=8.2,
                color=FAINT, va="center")
    return figure


def main(folder: str) -> None:
    path = os.path.join(folder, "verdicts.json")
    chart = read_json(path)
    try:
        figure = draw(chart)
    except (KeyError, TypeError, ValueError, AttributeError) as failure:
        raise InputError(f"{path}: no chart of a validation ({failure!r})") from failure
    if figure:
        save(figure, folder, "verdicts")


if __name__ == "__main__":
    run(main, "verdicts.py DIR")
