#!/usr/bin/env python3
"""Verdicts of the criteria of faulting: today's damping beside PFC's, twenty seeds each.

shown.py TODAY/verdicts.json PUBLISHED/verdicts.json
"""
import collections
import json
import sys

VERDICTS = ("shown", "open", "not shown")


def experiments(path):
    with open(path, encoding="utf-8") as file:
        return {one["title"].lower(): one for one in json.load(file)["experiments"]}


def counts(one):
    number = collections.Counter(row["verdict"] for row in one["rows"])
    return " | ".join(str(number[verdict]) for verdict in VERDICTS)


def main():
    today, published = map(experiments, sys.argv[1:3])
    pairs = [(today[title.split("-")[0]], one) for title, one in sorted(published.items())]
    print("| experiment | seeds | criteria | shown | open | not shown | kinematics | conservation |\n|---|---|---|---|---|---|---|---|")
    for pair in pairs:
        for one in pair:
            print(f"| {one['title'].lower()} | {one['seeds']} | {len(one['rows'])} | {counts(one)} | "
                  f"{one['kinematics']} | {one['conservation']} |")
    print("\n| experiment | criterion | today | published |\n|---|---|---|---|")
    for base, one in pairs:
        before = {row["what"]: row for row in base["rows"]}
        for row in one["rows"]:
            old = before[row["what"]]
            if old["verdict"] != row["verdict"]:
                print(f"| {one['title'].lower()} | {row['what']} | " + " | ".join(
                    f"{r['verdict']}, {r['met']} of {r['of']}" for r in (old, row)) + " |")


if __name__ == "__main__":
    main()
