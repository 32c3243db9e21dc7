#!/usr/bin/env python3
"""Criteria of faulting that PFC's damping and today's meet, seed by seed.

tally.py TODAY/verdicts.json PUBLISHED/verdicts.json...

Each PUBLISHED is of one experiment and one seed or more, as `listric validate` writes it.
"""
import collections
import json
import sys


def experiments(path):
    with open(path, encoding="utf-8") as file:
        found = json.load(file)
    return [(one["title"].lower(), {row["what"]: dict(zip(found["seeds"], row["cells"])) for row in one["rows"]})
            for one in found["experiments"]]


today = dict(experiments(sys.argv[1]))
published = {}
for path in sys.argv[2:]:
    for title, rows in experiments(path):
        for what, cells in rows.items():
            mine = published.setdefault(title, {}).setdefault(what, {})
            mine.update({seed: cell for seed, cell in cells.items() if cell in "mx"})
print("| experiment | criterion | seeds | today | published |\n|---|---|---|---|---|")
for title, rows in sorted(published.items()):
    base = today[title.split("-")[0]]
    of_seed = collections.Counter(seed for cells in rows.values() for seed in cells)
    # A seed of which only the control is run has few rows.
    seeds = sorted(seed for seed, count in of_seed.items() if 2 * count > max(of_seed.values()))
    sums = [0, 0, 0]
    for what, cells in rows.items():
        if what not in base:
            print(f"| {title} | {what} | not in today's | | |")
            continue
        both = [(base[what].get(seed), cells[seed]) for seed in seeds if seed in cells and base[what].get(seed) in ("m", "x")]
        mine, theirs = (sum(pair[k] == "m" for pair in both) for k in (0, 1))
        sums = [sums[0] + len(both), sums[1] + mine, sums[2] + theirs]
        if mine != theirs:
            print(f"| {title} | {what} | {len(both)} | {mine} | {theirs} |")
    print(f"| {title} | all, seeds {', '.join(map(str, seeds))} | {sums[0]} | {sums[1]} | {sums[2]} |")
