#!/usr/bin/env python3
"""Criteria of faulting that each lever meets beside today's parameters, on the same seeds.

levers.py VALIDATION.toml RECORD/measures.csv LEVERS/measures.csv

Levers have no control of their own: a criterion that compares with one takes the record's, which weakened rock's
parameters do not touch; a lever that changes the packing has no such rows.
"""
import csv
import sys
import tomllib

OTHER_PACKING = ("fine", "dense")


def measures(path):
    with open(path, encoding="utf-8", newline="") as file:
        return {(row["run"], int(row["seed"]), float(row["at_m"])): row for row in csv.DictReader(file)}


def value(found, row, run, seed, at):
    """The criterion's number of a run; none where a part of it is missing."""
    def number(of, moment):
        text = found.get((of, seed, moment), {}).get(row["measure"], "")
        return float(text) if text else None
    parts = [number(run, at)]
    if "minus" in row:
        parts.append(number(row["minus"], at))
    if "since_m" in row:
        parts.append(number(run, float(row["since_m"])))
    return None if None in parts else (parts[0] - sum(parts[1:])) / row.get("unit", 1.0)


def meets(row, number):
    if "expected" in row:
        return abs(number - row["expected"]) <= row.get("tolerance", 0.0)
    return row.get("least", number) <= number <= row.get("most", number)


def cell(numbers, row):
    there = [number for number in numbers if number is not None]
    digits = row.get("digits", 2)
    texts = [f"**{n:.{digits}f}**" if meets(row, n) else f"{n:.{digits}f}" for n in there]
    return ", ".join(texts) or "no case"


with open(sys.argv[1], "rb") as file:
    plan = tomllib.load(file)
moments = {run["name"]: run["at_m"] for run in plan["run"]}
record, levers = measures(sys.argv[2]), measures(sys.argv[3])
record |= levers
names = list(dict.fromkeys(run for run, _, _ in levers))
sums = {}
for experiment in plan["experiment"]:
    base = experiment["name"]
    mine = [name for name in names if name.startswith(base + "-")]
    rows = [row for row in experiment.get("expect", []) if row.get("kind", "faults") == "faults"
            and {"least", "most", "expected"} & set(row) and row.get("run", base) == base]
    if not mine or base not in ("lis1", "lis2", "rfr"):
        continue
    print(f"\n| {base.upper()} | asked | today | " + " | ".join(name[len(base) + 1:] for name in mine) + " |")
    print("|---" * (3 + len(mine)) + "|")
    seeds = sorted({seed for run, seed, _ in levers if run in mine})
    for row in rows:
        at = float(row.get("at_m", moments[base][-1]))
        asked = " to ".join(f"{row[key]:g}" for key in ("least", "most") if key in row) \
            if "expected" not in row else f"{row['expected']:g} ± {row.get('tolerance', 0.0):g}"
        if "least" in row and "most" not in row:
            asked = "at least " + asked
        if "most" in row and "least" not in row:
            asked = "at most " + asked
        cells = []
        for name in [base, *mine]:
            if name.split("-")[-1] in OTHER_PACKING and "minus" in row:
                cells.append("")
                continue
            numbers = [value(record, row, name, seed, at) for seed in seeds]
            done = sums.setdefault((base, name), [0, 0])
            done[0] += sum(n is not None and meets(row, n) for n in numbers)
            done[1] += sum(n is not None for n in numbers)
            cells.append(cell(numbers, row))
        print(f"| {row['what']}, {at / 1000:g} km | {asked} | " + " | ".join(cells) + " |")
    print("| all, met of seeds | | " + " | ".join("{} of {}".format(*sums[base, name]) for name in [base, *mine]) + " |")
