#!/usr/bin/env python3
"""Throws of a run's faults by its exported horizons, beside those of its exported faults.

Usage: agree.py RUN_DIR EXTENSION_M...

Needs `listric export horizons RUN_DIR --format csv` and `listric export faults RUN_DIR --format csv`. A horizon's
cutoff is where a line through its points 3 to 12 diameters beside the trace, on one side, meets that trace; the throw
is the difference of both heights. Points within 3 diameters of another trace, or beyond it, do not count.
"""

import csv
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np

import listric


def lines(path):
    """Values and points of each line of an exported file."""
    found = defaultdict(lambda: ({}, []))
    with path.open() as file:
        for row in csv.DictReader(file):
            values, points = found[row["line"]]
            values.update(row)
            points.append((float(row["x_m"]), -float(row["depth_m"])))
    return [(values, np.array(points)) for values, points in found.values()]


def beside(trace, points):
    """Distance of points from a trace, left of its downward direction > 0, and whether its end is nearest."""
    distance, beyond, nearest = np.full(len(points), np.inf), np.zeros(len(points), bool), np.full(len(points), np.inf)
    for k, (a, b) in enumerate(zip(trace[:-1], trace[1:])):
        edge = b - a
        share = np.clip((points - a) @ edge / (edge @ edge), 0, 1)
        away = points - a - share[:, None] * edge
        size = np.hypot(*away.T)
        closer = size < nearest
        nearest[closer] = size[closer]
        side = np.sign(edge[0] * away[:, 1] - edge[1] * away[:, 0])
        distance[closer] = (side * size)[closer]
        beyond[closer] = ((k == 0) & (share == 0) | (k == len(trace) - 2) & (share == 1))[closer]
    return distance, beyond


def height_at(trace, slope, level):
    """Height where y = level + slope x meets the trace; None if it does not."""
    above = trace[:, 1] - level - slope * trace[:, 0]
    for k in np.flatnonzero((above[:-1] > 0) & (above[1:] <= 0)):
        return trace[k, 1] + above[k] / (above[k] - above[k + 1]) * (trace[k + 1, 1] - trace[k, 1])
    return None


def throws(trace, others, horizons, diameter):
    """Throw by horizon, m."""
    up = (trace[0] - trace[min(6, len(trace) - 1)])
    line = np.vstack([trace[0] + 15 * diameter * up / np.hypot(*up), trace])
    right = trace[-1, 0] > trace[0, 0]
    found = {}
    for number, points in horizons.items():
        distance, beyond = beside(line, points)
        near = ~beyond & (abs(distance) > 3 * diameter) & (abs(distance) < 12 * diameter)
        for other in others:
            away, past = beside(other, points)
            own = beside(other, trace[np.argmin(((points[:, None] - trace) ** 2).sum(2), axis=1)])
            near &= (abs(away) > 3 * diameter) & (past | own[1] | (np.sign(away) == np.sign(own[0])))
        heights = []
        for hanging in (True, False):
            side = points[near & ((distance > 0) == (right == hanging))]
            if len(side) < 8:
                break
            slope, level = np.polyfit(side[:, 0], side[:, 1], 1)
            heights.append(height_at(line, slope, level))
        if len(heights) == 2 and None not in heights:
            found[number] = heights[1] - heights[0]
    return found


def main():
    run, moments = Path(sys.argv[1]), [float(word) for word in sys.argv[2:]]
    diameter = 2 * listric.Run(run).scene["hanging_wall"]["mean_radius_m"]
    all_off = []
    for moment in moments:
        name = next(file.name.removeprefix("faults-") for file in (run / "export").glob("faults-*.csv")
                    if abs(float(file.stem.split("-")[-1].rstrip("m")) - moment) < 1)
        faults = lines(run / "export" / f"faults-{name}")
        pieces = defaultdict(list)
        for values, points in lines(run / "export" / f"horizons-{name}"):
            pieces[int(float(values["stratum"]))].append(points)
        horizons = {number: np.vstack(parts) for number, parts in pieces.items()}
        for k, (values, trace) in enumerate(faults):
            told = {int(key.split("_")[1]): float(text) for key, text in values.items()
                    if key.startswith("throw_") and not key.endswith("error_m") and text}
            errors = {int(key.split("_")[1]): float(text) for key, text in values.items()
                      if key.startswith("throw_") and key.endswith("error_m") and text}
            own = throws(trace, [other for m, (_, other) in enumerate(faults) if m != k], horizons, diameter)
            both = sorted(set(told) & set(own))
            off = [own[n] - told[n] for n in both]
            all_off += off
            print(f"{moment:6.0f} m fault {k} {values['attitude']:10} dip {float(values['dip_deg']):4.1f} born {values['born_at_m'] or '-':>8} "
                  f"greatest {values['greatest_throw_m'] or '-'} | "
                  + ", ".join(f"{n}: {told[n]:.0f}±{errors[n]:.0f} ({own[n]:.0f})" for n in both)
                  + " | alone " + " ".join(f"{n}:{told[n]:.0f}±{errors[n]:.0f}" for n in told if n not in both))
    off = np.abs(all_off)
    if len(off):
        print(f"{len(off)} throws: median difference {np.median(off):.0f} m, within a diameter {np.mean(off < diameter):.2f}, "
              f"within two {np.mean(off < 2 * diameter):.2f}, greatest {off.max():.0f} m")


if __name__ == "__main__":
    main()
