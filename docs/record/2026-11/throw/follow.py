#!/usr/bin/env python3
"""Which of a run's faults are one fault at several moments, and its throws as it goes on.

Usage: follow.py RUN_DIR

Needs `listric export faults RUN_DIR --format csv`. A trace is carried to another moment by its footwall: each point
goes with the discs within 3 diameters of a place 6 diameters below it. It is the fault traced there then if that has
the same attitude and sense and lies within 4 diameters of a third of the points carried, and half of its own points
within 4 diameters of these. A fault that is not traced in a window is looked for in the two before it.
"""

import sys
from pathlib import Path

import numpy as np
from agree import beside, lines
from from_discs import throws

import listric


class Moment:
    """The discs and the faults of a snapshot."""

    def __init__(self, snapshot, file):
        discs = snapshot.discs
        self.travel = snapshot.travel_m
        self.ids = np.asarray(discs["id"])
        self.places = np.c_[np.asarray(discs["x"]), np.asarray(discs["y"])]
        self.starts, self.stratum = np.asarray(discs["start_y"]), np.asarray(discs["stratum"])
        self.row_of = np.full(self.ids.max() + 1, -1)
        self.row_of[self.ids] = np.arange(len(self.ids))
        self.faults = lines(file) if file.exists() else []
        self.names = [None] * len(self.faults)

    def others(self, k):
        return [trace for m, (_, trace) in enumerate(self.faults) if m != k]

    def throws(self, trace, others, diameter):
        """Throws and errors of rock horizons, of those that are known to two diameters."""
        rock = self.stratum == 0
        found = throws(trace, others, self.places[rock], self.starts[rock], diameter)
        return {n: both for n, both in found.items() if both[1] <= 2 * diameter}


def carried(trace, now, then, diameter):
    """A trace of one moment as its footwall has it at another."""
    points = []
    for k, point in enumerate(trace):
        chord = trace[min(k + 3, len(trace) - 1)] - trace[max(k - 3, 0)]
        across = np.array([-chord[1], chord[0]]) / np.hypot(*chord)
        below = across if across[1] < 0 else -across
        near = np.flatnonzero(np.hypot(*(now.places - point - 6 * diameter * below).T) < 3 * diameter)
        ids = now.ids[near]
        rows = np.where(ids < len(then.row_of), then.row_of[np.minimum(ids, len(then.row_of) - 1)], -1)
        a, b = now.places[near][rows >= 0], then.places[rows[rows >= 0]]
        if len(a) < 4:
            continue
        p, q = a - a.mean(0), b - b.mean(0)
        angle = np.arctan2((p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]).sum(), (p * q).sum())
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        points.append(b.mean(0) + turn @ (point - a.mean(0)))
    return np.array(points)


def near(points, line, diameter):
    return (abs(beside(line, points)[0]) < 4 * diameter).sum()


def same(values, trace, then, diameter):
    """The fault of a moment that a carried trace lies on; None if there is none."""
    best, most = None, 0
    for k, (other, line) in enumerate(then.faults):
        if (other["attitude"], other["sense"]) != (values["attitude"], values["sense"]):
            continue
        on = near(trace, line, diameter)
        if on > most and 3 * on >= len(trace) and 2 * near(line, trace, diameter) >= len(line):
            best, most = k, on
    return best


def compared(now, k, then, match, former, diameter):
    """Throws of horizons at one fault at two moments, with errors; then along the trace as carried."""
    others = [trace for m, (_, trace) in enumerate(then.faults) if m != match]
    before = then.throws(former, others, diameter)
    after = now.throws(now.faults[k][1], now.others(k), diameter)
    return {n: (*before[n], *after[n]) for n in sorted(set(before) & set(after))}


def name_faults(moments, diameter):
    """Names faults by what they were before; yields the horizons of each fault that goes on."""
    count = 0
    for n, now in enumerate(moments):
        for k, (values, trace) in enumerate(now.faults):
            for then in moments[max(n - 3, 0):n][::-1]:
                former = carried(trace, now, then, diameter)
                match = same(values, former, then, diameter) if len(former) >= 8 else None
                if match is not None:
                    now.names[k] = then.names[match]
                    yield now, k, then, compared(now, k, then, match, former, diameter)
                    break
            if now.names[k] is None:
                count += 1
                now.names[k] = f"{values['attitude'][0]}{count}"


def print_main(moments, attitude):
    """Greatest throw of the main fault at each moment, and at each fall whether it is another one."""
    last, told = None, []
    for now in moments:
        for k, (values, _) in enumerate(now.faults):
            if values["main"] != attitude or not values["greatest_throw_m"]:
                continue
            one = now.names[k], float(values["greatest_throw_m"]), values["id"]
            if last and one[1] < last[1]:
                told.append("same" if one[0] == last[0] else "other")
                print(f"  falls at {now.travel:.0f} m: {last[0]} ({last[2]}) {last[1]:.0f} to {one[0]} ({one[2]}) {one[1]:.0f}: {told[-1]}")
            last = one
    print(f"{attitude}: {len(told)} falls, {told.count('other')} to another fault")


def main():
    run = listric.Run(sys.argv[1])
    diameter = 2 * run.scene["hanging_wall"]["mean_radius_m"]
    moments = [Moment(s, Path(sys.argv[1]) / "export" / f"faults-{s.path.stem}.csv") for s in run.snapshots]
    changes = []
    for now, k, then, horizons in name_faults(moments, diameter):
        sign = 1 if now.faults[k][0]["sense"] == "normal" else -1
        for n, (before, before_error, after, after_error) in horizons.items():
            changes.append(sign * (after - before) / np.hypot(before_error, after_error))
            if changes[-1] < -1:
                print(f"  {now.names[k]} {then.travel:.0f} to {now.travel:.0f} m, horizon {n}: "
                      f"{before:.0f} ± {before_error:.0f} to {after:.0f} ± {after_error:.0f}")
    changes = np.array(changes)
    print(f"{len(changes)} throws of a horizon at a fault at two moments: {(changes < 0).sum()} fall, {(changes < -1).sum()} by more than their error")
    for attitude in ("synthetic", "antithetic"):
        print_main(moments, attitude)
    pairs = {(name, fault["id"]) for now in moments for name, (fault, _) in zip(now.names, now.faults)}
    print(f"{len({name for name, _ in pairs})} faults by this script, {len({own for _, own in pairs})} by the program, {len(pairs)} pairs of names")


if __name__ == "__main__":
    main()
