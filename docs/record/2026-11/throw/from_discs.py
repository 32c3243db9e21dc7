#!/usr/bin/env python3
"""Throws of pre-rift horizons at a run's faults, from the start heights of its discs, without the program's own.

Usage: from_discs.py RUN_DIR

Needs `listric export faults RUN_DIR --format csv`, whose traces it takes, at whatever moments there are. A horizon on
one side is a plane through the start heights of the discs within 3 diameters of it, 3 to 9 diameters beside the trace;
its error, the scatter about the plane, half a diameter for the trace, and what discs out to 15 diameters change. It
meets the trace within 8 diameters of one of its discs, and on this side of every other fault, or has no throw.
"""

import sys
from pathlib import Path

import numpy as np
from agree import beside, lines

import listric


def plane(places, heights):
    """Middle, coefficients and covariance of heights as a plane."""
    middle = places.mean(0)
    rows = np.c_[places - middle, np.ones(len(places))]
    coefficients = np.linalg.lstsq(rows, heights, rcond=None)[0]
    variance = ((heights - rows @ coefficients) ** 2).sum() / (len(places) - 3)
    return middle, coefficients, np.linalg.inv(rows.T @ rows) * variance


def parted(a, b, line):
    """Whether a line passes between two points."""
    def left(p, q, points):
        return (q - p)[0] * (points - p)[:, 1] - (q - p)[1] * (points - p)[:, 0] > 0
    sides = left(a, b, line)
    ends = [left(p, q, np.array([a, b])) for p, q in zip(line[:-1], line[1:])]
    return any(sides[k] != sides[k + 1] and one != other for k, (one, other) in enumerate(ends))


def cut(line, others, places, heights, diameter):
    """Height where the plane's 0 meets a line, and its error; None if it does not or has too few discs."""
    if len(places) < 10:
        return None
    middle, coefficients, covariance = plane(places, heights)
    above = np.c_[line - middle, np.ones(len(line))] @ coefficients
    found = []
    for k in np.flatnonzero((above[:-1] > 0) & (above[1:] <= 0)):
        step, fall = line[k + 1] - line[k], above[k] - above[k + 1]
        at = line[k] + above[k] / fall * step
        lever, across = np.r_[at - middle, 1], np.array([-step[1], step[0]]) / np.hypot(*step)
        scatter = np.sqrt(lever @ covariance @ lever) * step[1] / fall
        aside = (across[1] + coefficients[:2] @ across * step[1] / fall) * diameter / 2
        found.append((np.hypot(*(at - middle)), *at, np.hypot(scatter, aside)))
    if not found:
        return None
    _, x, y, error = min(found)
    if np.hypot(*(places - (x, y)).T).min() > 8 * diameter or any(parted(middle, np.array([x, y]), other) for other in others):
        return None
    return y, error


def in_the_way(trace, other, places, diameter):
    """Whether another fault's drag, or that fault itself, is between a trace and places."""
    away, beyond = beside(other, places)
    next_to = trace[np.argmin(((places[:, None] - trace) ** 2).sum(2), axis=1)]
    own, past = beside(other, next_to)
    return (abs(away) < 3 * diameter) | ~(beyond | past | (np.sign(away) == np.sign(own)))


def throws(trace, others, places, starts, diameter):
    """Throw and error by horizon, 1 km apart, m."""
    up = trace[0] - trace[6]
    line = np.vstack([trace[0] + 15 * diameter * up / np.hypot(*up), trace])
    distance, beyond = beside(line, places)
    near = np.flatnonzero(~beyond & (abs(distance) > 3 * diameter) & (abs(distance) < 15 * diameter))
    for other in others:
        near = near[~in_the_way(trace, other, places[near], diameter)]
    hanging = (distance[near] > 0) == (trace[-1, 0] > trace[0, 0])
    found = {}
    for number in range(15):
        heights, cuts, counts = starts[near] + 1000 * number, {}, {}
        for reach in (9, 15):
            for side in (True, False):
                chosen = (abs(heights) < 3 * diameter) & (abs(distance[near]) < reach * diameter) & (hanging == side)
                counts[reach, side] = chosen.sum()
                cuts[reach, side] = cut(line, others, places[near][chosen], heights[chosen], diameter)
        if cuts[9, True] is None or cuts[9, False] is None:
            continue
        thrown, other = cuts[9, False][0] - cuts[9, True][0], diameter
        if cuts[15, True] and cuts[15, False] and sum(counts[15, s] for s in (True, False)) > 1.2 * sum(counts[9, s] for s in (True, False)):
            other = cuts[15, False][0] - cuts[15, True][0] - thrown
        found[-number] = thrown, np.sqrt(cuts[9, True][1] ** 2 + cuts[9, False][1] ** 2 + other ** 2)
    return found


def main():
    run = listric.Run(sys.argv[1])
    diameter = 2 * run.scene["hanging_wall"]["mean_radius_m"]
    for snapshot in run.snapshots:
        file = Path(sys.argv[1]) / "export" / f"faults-{snapshot.path.stem}.csv"
        if not file.exists():
            continue
        discs, faults = snapshot.discs, lines(file)
        rock = np.asarray(discs["stratum"]) == 0
        places = np.c_[np.asarray(discs["x"]), np.asarray(discs["y"])][rock]
        starts = np.asarray(discs["start_y"])[rock]
        for k, (values, trace) in enumerate(faults):
            others = [other for m, (_, other) in enumerate(faults) if m != k]
            found = throws(trace, others, places, starts, diameter)
            known = {n: (thrown, error) for n, (thrown, error) in found.items() if error <= 2 * diameter}
            greatest = max((thrown for thrown, _ in known.values()), key=abs, default=np.nan)
            print(f"{snapshot.travel_m:6.0f} m fault {k} {values['attitude']:10} {values['sense']} dip {float(values['dip_deg']):.0f} "
                  f"length {float(values['length_m']):5.0f} greatest {greatest:5.0f} median {np.median([t for t, _ in known.values()] or [np.nan]):5.0f} | "
                  + " ".join(f"{n}: {thrown:.0f} ± {error:.0f}" for n, (thrown, error) in known.items()))


if __name__ == "__main__":
    main()
