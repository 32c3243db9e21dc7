#!/usr/bin/python3
"""What a speed that follows the force balance could gain over a constant one, from histories of runs.

Usage: docs/record/2026-11/asked/imbalance.py RUN [RUN ...]

In window i the unbalanced forces are u_i at the constant speed v. They are proportional to the speed
(docs/cost-of-accuracy.md), so that they are u_i w_i / v at a speed w_i. The time is the sum of 1 / w_i. Of
all speeds with an equal mean of unbalanced forces those proportional to u_i^-1/2 need the least time
(Lagrange): less by the factor mean(u) / mean(sqrt(u))^2. Of all with an equal largest one those proportional to
1 / u_i: less by max(u) / mean(u). What is chance in u_i counts as gain, so both are upper bounds.

history.csv has the mean since the beginning; windows are differences of its sums. The first window, in
which the wall starts from rest, is left out of the second number.
"""

import csv
import math
import pathlib
import sys


def windows(run):
    """Unbalanced forces over contact forces, by window."""
    with (pathlib.Path(run) / "history.csv").open() as file:
        means = [float(row["unbalanced_ratio_mean"]) for row in csv.DictReader(file) if float(row["extension_m"]) > 0.0]
    return [(k + 1) * mean - k * before for k, (before, mean) in enumerate(zip([0.0, *means], means))]


def mean(values):
    return sum(values) / len(values)


for name in sys.argv[1:]:
    u = windows(name)
    moving = u[1:]
    print(f"{pathlib.Path(name).name}: {len(u)} windows, mean {mean(u):.2e}, later ones {min(moving) / mean(moving):.2f} "
          f"to {max(moving) / mean(moving):.2f} of their mean; equal mean: "
          f"{mean(u) / mean([math.sqrt(max(x, 0.0)) for x in u]) ** 2:.3f}; equal largest: "
          f"{max(moving) / mean(moving):.2f}")
if len(sys.argv) < 2:
    sys.exit(__doc__)
