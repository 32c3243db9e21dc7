#!/usr/bin/python3
"""Soak: a small scene with every effect for very many cycles, in parts that resume each other.

Usage: tests/soak/soak.py PROGRAM FOLDER [PARTS]

Runs soak.toml into FOLDER/run in PARTS parts (default: 20, of 5 million cycles each) and appends a row
for each part to FOLDER/soak.csv: cycles and discs at its end, CPU seconds, memory soon after the part's
beginning and before its end, errors of mass, volume and energy, and the order of strata. A part that is
there is not run again: the same call goes on. No test of CI: it takes half an hour of a core.

resident_begin_kib, resident_end_kib  resident memory (VmRSS) at a tenth and at nine tenths of the part: its
                                      end has the check of the base with a finer mesh
disc_steps_per_cpu_s                  of the part, the making of the base's matrix included
strata_in_order                       share of pairs of sediment discs of different strata, closer in x
                                      than a mean radius, of which the younger lies above the older;
                                      empty without such pairs
"""

import csv
import os
import pathlib
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "apps/python"))
import listric

DISTANCE_M, MEAN_RADIUS_M = 600.0, 115.0
COLUMNS = ["part", "extension_m", "cycles", "discs", "cpu_s", "disc_steps_per_cpu_s", "resident_begin_kib",
           "resident_end_kib", "mass_error_fraction", "volume_error_fraction", "energy_residual", "strata",
           "strata_in_order"]
FROM_SUMMARY = ["mass_error_fraction", "volume_error_fraction", "energy_residual"]


def resident(process):
    """Resident memory of a process, KiB; none once it has ended."""
    try:
        status = pathlib.Path(f"/proc/{process}/status").read_text()
    except OSError:
        return None
    lines = [line for line in status.splitlines() if line.startswith("VmRSS")]
    return int(lines[0].split()[1]) if lines else None


def run(words):
    """Runs the program; CPU seconds and readings of its memory, one every two seconds."""
    process = os.posix_spawn(words[0], words, {**os.environ, "LISTRIC_PYTHON": "/bin/false"})
    readings = []
    while True:
        ended, status, usage = os.wait4(process, os.WNOHANG)
        if ended:
            break
        readings.append(resident(process))
        time.sleep(2.0)
    if status:
        sys.exit(f"{' '.join(words)}: exit code {os.waitstatus_to_exitcode(status)}")
    return usage.ru_utime + usage.ru_stime, [reading for reading in readings if reading]


def order_of_strata(discs):
    """Number of strata and share of pairs in order; none without pairs."""
    sediment = [(x, y, stratum) for x, y, stratum in zip(discs["x"], discs["y"], discs["stratum"]) if stratum > 0]
    pairs = [(one[1] > other[1]) == (one[2] > other[2])
             for n, one in enumerate(sediment) for other in sediment[:n]
             if one[2] != other[2] and abs(one[0] - other[0]) < MEAN_RADIUS_M]
    return len({stratum for _, _, stratum in sediment}), sum(pairs) / len(pairs) if pairs else None


def main(program, folder, parts=20):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    table = folder / "soak.csv"
    rows = list(csv.DictReader(table.open())) if table.exists() else []
    if not rows:
        with table.open("w") as out:
            csv.writer(out, lineterminator="\n").writerow(COLUMNS)
    for part in range(len(rows) + 1, parts + 1):
        cpu, memory = run([program, "run", str(pathlib.Path(__file__).with_name("soak.toml")), "--threads", "1",
                           "--quiet", "--no-report", "--resume", "--output", str(folder / "run"), "--until",
                           f"{DISTANCE_M * part / parts:.6f}m"])
        result = listric.Run(folder / "run")
        cycles, before = result.summary["cycles"], int(rows[-1]["cycles"]) if rows else 0
        strata, in_order = order_of_strata(result.snapshots[-1].discs)
        rows.append({
            "part": part, "extension_m": f"{result.summary['extension_m']:.3f}", "cycles": cycles,
            "discs": result.summary["discs"], "cpu_s": f"{cpu:.1f}",
            "disc_steps_per_cpu_s": f"{(cycles - before) * result.summary['discs'] / cpu:.4g}",
            "resident_begin_kib": memory[len(memory) // 10] if memory else "",
            "resident_end_kib": memory[len(memory) * 9 // 10] if memory else "",
            **{name: f"{result.summary[name]:.3g}" for name in FROM_SUMMARY},
            "strata": strata, "strata_in_order": "" if in_order is None else f"{in_order:.3f}"})
        with table.open("a") as out:
            csv.DictWriter(out, COLUMNS, lineterminator="\n").writerow(rows[-1])


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(os.path.abspath(sys.argv[1]), sys.argv[2], *map(int, sys.argv[3:]))
