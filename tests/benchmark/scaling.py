#!/usr/bin/python3
"""Cycles on threads and on ranks of this machine, and a model of more machines.

Usage: tests/benchmark/scaling.py measure RADIUS_M...   appends to docs/benchmarks/scaling.csv
       tests/benchmark/scaling.py model                 prints the table of docs/guides/scaling.md

Needs a build with tests and MPI: ./listric test -N, whose preset LISTRIC_PRESET names as ever.
Packings of lis1 before extension; one thread, two threads and two ranks take turns, so that a
machine that is slow for a while is so for all.
"""
import math
import os
import re
import statistics
import subprocess
import sys

import benchmark

REPEATS = 7
ROOT_MAY = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def cycles(radius, steps, ranks, threads):
    """Million disc-steps per second, and bytes per disc."""
    program = benchmark.ROOT / "build" / os.environ.get("LISTRIC_PRESET", "native") / "tests" / \
        "ranked_cycles"
    start = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
    said = subprocess.run([*start, str(program), "lis1", "standard", str(radius), str(steps), "3",
                           str(threads)], check=True, text=True, capture_output=True,
                          env=os.environ | ROOT_MAY).stdout
    discs, memory = re.search(r"(\d+) discs, (\d+) bytes", said).groups()
    return max(float(line) for line in said.split("\n")[:3]), int(memory), int(discs)


def measure(radii):
    for radius in radii:
        steps = max(60, int(6000 * (float(radius) / 83) ** 2))
        runs = {how: [] for how in ((1, 1), (1, 2), (2, 1))}
        for _ in range(REPEATS):
            for (ranks, threads), found in runs.items():
                found.append(cycles(radius, steps, ranks, threads))
        alone = statistics.median(speed for speed, _, _ in runs[1, 1])
        benchmark.record("scaling", [benchmark.circumstances() | {
            "discs": found[0][2], "ranks": ranks, "threads": threads,
            "million_disc_steps_per_s": f"{statistics.median(f[0] for f in found):.1f}",
            "greatest": f"{max(f[0] for f in found):.1f}",
            "times_one": f"{statistics.median(f[0] for f in found) / alone:.2f}",
            "bytes_per_disc": round(statistics.median(f[1] for f in found))}
            for (ranks, threads), found in runs.items()])


# Measured on two cores (docs/guides/scaling.md); what a network adds is assumed.
DISC = ((2e4, 10.2e-9), (2e5, 10.9e-9), (1e6, 11.5e-9))  # s per disc-step of one core, by discs
GHOST = 20e-9      # s per ghost and cycle: its motion, its contacts, packing
EXCHANGE = 1.7e-6  # s per exchange by messages, behind the sweep
BORDER = 256       # discs at either end of a share that are swept before the exchange begins
LOOK = 16          # cycles between reductions
BYTES = 40         # per ghost and exchange
NETWORKS = {"none": (0.0, 1e10), "2 µs, 10 GB/s": (2e-6, 1e10),
            "20 µs, 1.2 GB/s": (20e-6, 1.2e9)}


def seconds_per_disc(discs):
    logs = [(math.log(n), s) for n, s in DISC]
    x = min(max(math.log(discs), logs[0][0]), logs[-1][0])
    for (a, s), (b, t) in zip(logs, logs[1:]):
        if x <= b:
            return s + (t - s) * (x - a) / (b - a)
    return logs[-1][1]


def efficiency(discs, ranks, network):
    """Against one core with all discs; None where a share is no wider than two strips."""
    latency, bandwidth = NETWORKS[network]
    own, side = discs / ranks, 0.8 * math.sqrt(discs)
    if own < 2 * side:
        return None
    ghosts = 2 * side
    sweep = own * seconds_per_disc(own)
    hidden = sweep * max(0.0, 1.0 - 2 * BORDER / own)
    cycle = sweep + ghosts * GHOST + EXCHANGE + \
        max(0.0, latency + BYTES * ghosts / bandwidth - hidden) + \
        2 * math.log2(ranks) * (latency + EXCHANGE / 2) / LOOK
    return discs * seconds_per_disc(discs) / (ranks * cycle)


def model():
    counts = (2, 16, 64, 256, 1024, 10000)
    print("| discs | between ranks |", " | ".join(f"{n:,}" for n in counts), "|")
    print("|---|---|" + "---|" * len(counts))
    for discs in (2e4, 2e5, 1e6, 1e7, 1e8):
        for network in NETWORKS:
            found = [efficiency(discs, n, network) for n in counts]
            print(f"| {discs:,.0f} | {network} |",
                  " | ".join(f"{100 * e:.0f}" if e else "–" for e in found), "|")


if __name__ == "__main__":
    if sys.argv[1:2] == ["measure"] and sys.argv[2:]:
        measure(sys.argv[2:])
    elif sys.argv[1:] == ["model"]:
        model()
    else:
        sys.exit(__doc__)
