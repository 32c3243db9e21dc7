#!/usr/bin/env python3
"""Criteria of faulting that each lever meets beside today's parameters, on the same seeds: a table for levers that share seeds.

A bold number meets its criterion. Of more than two seeds a cell tells how many meet it, their mean and standard deviation.

levers.py VALIDATION.toml RECORD/measures.csv LEVERS/measures.csv

Levers have no control of their own. A criterion that compares with one takes the record's, which parameters of weakened
rock do not touch; a lever of another packing has no such rows.
"""
import csv
import statistics
import sys
import tomllib

OTHER_PACKING = ("fine", "dense")
BOUNDS = ("expected", "least", "most")


def measures(path):
    with open(path, encoding="utf-8", newline="") as file:
        return {(row["run"], int(row["seed"]), float(row["at_m"])): row for row in csv.DictReader(file)}


def value(found, row, run, seed, at):
    """The criterion's number of a run; none where a part of it is missing."""
    parts = [(run, at), (row.get("minus"), at), (run, row.get("since_m"))]
    numbers = [found.get((of, seed, float(moment)), {}).get(row["measure"]) for of, moment in parts if of and moment]
    if not all(numbers):
        return None
    return (float(numbers[0]) - sum(map(float, numbers[1:]))) / row.get("unit", 1.0)


def meets(row, number):
    if "expected" in row:
        return abs(number - row["expected"]) <= row.get("tolerance", 0.0)
    return row.get("least", number) <= number <= row.get("most", number)


def asked(row):
    if "expected" in row:
        return f"{row['expected']:g} ± {row.get('tolerance', 0.0):g}"
    return ", ".join(f"at {key} {row[key]:g}" for key in ("least", "most") if key in row)


def cell(numbers, row):
    digits = row.get("digits", 2)
    if len(numbers) > 2:
        met = sum(meets(row, number) for number in numbers)
        spread = f"{statistics.mean(numbers):.{digits}f} ± {statistics.stdev(numbers):.{digits}f}"
        return f"{met} of {len(numbers)}: {spread}"
    texts = [f"{number:.{digits}f}" for number in numbers]
    return ", ".join(f"**{text}**" if meets(row, number) else text for text, number in zip(texts, numbers)) or "no case"


def table(base, rows, runs, seeds):
    """Prints a table of runs beside the base's, on the base's seeds."""
    print(f"\n| {base.upper()}, seeds {', '.join(map(str, seeds))} | asked | today | "
          + " | ".join(run.removeprefix(base + "-") for run in runs) + " |\n" + "|---" * (3 + len(runs)) + "|")
    runs = [base] + runs
    met, of = dict.fromkeys(runs, 0), dict.fromkeys(runs, 0)
    for row in rows:
        at = float(row.get("at_m", moments[base][-1]))
        cells = []
        for run in runs:
            if "minus" in row and run.endswith(OTHER_PACKING):
                cells.append("")
                continue
            numbers = [number for seed in seeds if (number := value(found, row, run, seed, at)) is not None]
            met[run] += sum(meets(row, number) for number in numbers)
            of[run] += len(numbers)
            cells.append(cell(numbers, row))
        print(f"| {row['what']}, {at / 1000:g} km | {asked(row)} | " + " | ".join(cells) + " |")
    print("| all, met by so many | | " + " | ".join(f"{met[run]} of {of[run]}" for run in runs) + " |")


with open(sys.argv[1], "rb") as file:
    plan = tomllib.load(file)
moments = {run["name"]: run["at_m"] for run in plan["run"]}
levers = measures(sys.argv[3])
found = measures(sys.argv[2]) | levers
for experiment in plan["experiment"]:
    base = experiment["name"]
    rows = [row for row in experiment.get("expect", []) if row.get("kind", "faults") == "faults"
            and any(key in row for key in BOUNDS) and row.get("run", base) == base]
    groups = {}
    for name in sorted({run for run, _, _ in levers if run.startswith(base + "-")}):
        seeds = tuple(sorted({seed for run, seed, _ in levers if run == name}))
        groups.setdefault(seeds, []).append(name)
    for seeds, runs in groups.items():
        table(base, rows, runs, seeds)
