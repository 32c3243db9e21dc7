#!/usr/bin/env python3
"""Share of the weight that damping carries, by depth, of what sinks (by a tenth of the wall's speed or more) and of all.

damping.py FILE.csv...: lines of extension m, column of 2.5 km, depth km, 1 sediment or 0 rock, weight N, vertical damping N,
sum of unbalanced N, momentum kg m/s, mass kg, discs. Files are means over their lines, then over files ± standard error.
"""
import collections
import statistics
import sys


def shares(path):
    """Share of weight by (kind, sinks, depth); weight by column."""
    cells = collections.defaultdict(lambda: [0.0] * 5)
    with open(path, encoding="utf-8") as file:
        for line in file:
            _, column, depth, kind, weight, damping, unbalanced, momentum, mass, _ = map(float, line.split(","))
            for k, value in enumerate((weight, damping, unbalanced, momentum, mass)):
                cells[int(column), int(depth), int(kind)][k] += value
    sums = collections.defaultdict(lambda: [0.0, 0.0])
    for (_, depth, kind), (weight, damping, _, momentum, mass) in cells.items():
        for key in ((kind, "all", depth), (kind, "all", -1)) + (
                ((kind, "sinks", depth), (kind, "sinks", -1)) if momentum / mass < -0.1 else ()):
            sums[key][0] += weight
            sums[key][1] += damping
    return {key: damping / weight for key, (weight, damping) in sums.items()}, sums


def main():
    runs = [shares(path) for path in sys.argv[1:]]
    print("| depth, km | rock that sinks | sediment that sinks | all rock | all sediment |")
    print("|---|---|---|---|---|")
    for depth in [*range(0, 16), -1]:
        row = []
        for kind, which in ((0, "sinks"), (1, "sinks"), (0, "all"), (1, "all")):
            values = [s[kind, which, depth] for s, w in runs
                      if (kind, which, depth) in s and w[kind, which, depth][0] > 0.003 * w[kind, "all", -1][0]]
            error = f" ± {statistics.stdev(values) / len(values) ** 0.5:.3f}" if len(values) > 1 else ""
            row.append(f"{statistics.mean(values):.3f}{error}" if values else "")
        if any(row):
            print(f"| {'all' if depth < 0 else f'{depth} to {depth + 1}'} | " + " | ".join(row) + " |")


if __name__ == "__main__":
    main()
