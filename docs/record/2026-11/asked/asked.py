#!/usr/bin/python3
"""Asks `explain` for accuracy, makes the runs of its answers with unseen seeds, and compares.

Usage: docs/record/2026-11/asked/asked.py PROGRAM FOLDER SCENE SEED [SEED ...]

Writes FOLDER/asked-SCENE.csv, a row for each question and seed (or mean of as many seeds as the answer wants), and
each measure that was asked for: time predicted for one run, its processor time, what was promised, and how far
the unseen runs are from the mean of the finest recorded ones. Runs that are there are not made again.
"""

import csv
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[4]
sys.path.insert(0, str(ROOT / "apps/python"))
import listric

QUESTIONS = {
    "lis1": ["--error tilt=0.1deg", "--error cutoff=0.3km", "--error balance=0.04", "--error weak=0.2", "--within 50s"],
    "rfr": ["--error tilt=4deg", "--error cutoff=0.8km", "--error balance=0.04", "--error weak=0.2", "--within 50s"],
    "lis1-elastic": ["--error tilt=1deg", "--error cutoff=0.5km", "--error area=8km2", "--error weak=0.2",
                     "--within 60s"],
}
NAMES = {
    "rollover_tilt_deg": "tilt of the head block", "cutoff_x_m": "cutoff, x", "cutoff_z_m": "cutoff, depth",
    "basin_area_m2": "basin area", "area_balance": "basin area over extension × thickness",
    "halfgraben_area_share": "halfgraben's share of the basin",
    "strain_top10": "strain in the most strained tenth",
    "strain_top10_cumulative": "strain since the start in the most strained tenth",
    "basement_unbonded_fraction": "unbonded share of the basement", "weak_fraction": "weakened share",
    "fault_width_diameters": "width of faults in discs"}
KEYS = {"tilt": ["rollover_tilt_deg"], "cutoff": ["cutoff_x_m", "cutoff_z_m"], "balance": ["area_balance"],
        "area": ["basin_area_m2"], "weak": ["weak_fraction"]}
UNITS = {"°": 1.0, "km": 1e3, "m": 1.0, "km²": 1e6, "m²": 1.0, "": 1.0}
TIMES = {"s": 1.0, "min": 60.0, "h": 3600.0}


def number(text):
    """A number with its unit as `explain` prints it; none for unknown."""
    found = re.fullmatch(r"(-?[\d.e+-]+) ?(\D*)", text.strip())
    return float(found[1]) * UNITS[found[2].strip()] if found else None


def answer(program, scene, question):
    """Level, speed, seeds, seconds of one run, and promised errors by measure."""
    text = subprocess.run([program, "explain", scene, "--threads", "1", *question.split()], check=True, text=True,
                          stdout=subprocess.PIPE).stdout
    found = re.search(r"^  (\w+), ([\d.]+) m/s, (\d+) seeds?: ([\d.]+) (\w+) on", text, re.M)
    if not found:
        sys.exit(text)
    first = text.split("\ntwice the time")[0]
    promised = {key: number(line[52:62]) for key, name in NAMES.items() for line in first.splitlines()
                if line[2:52].strip() == name}
    return found[1], found[2], int(found[3]), float(found[4]) * TIMES[found[5]] / int(found[3]), promised


def finest(scene):
    """Mean of the finest recorded runs to 10 km, by measure."""
    rows = [row for file in (ROOT / "docs/record/runs").glob("*.csv") for row in csv.DictReader(file.open())
            if row["scene"] == scene and float(row["extension_m"]) == 10000.0]
    means = {}
    for key in NAMES:
        known = [row for row in rows if row.get(key)]
        if known:
            least = min(float(row["mean_radius_m"]) for row in known)
            values = [float(row[key]) for row in known if float(row["mean_radius_m"]) == least]
            means[key] = sum(values) / len(values)
    return means


def run(program, folder, scene, level, speed, seed):
    """Summary of a run and the processor time that it and its pictures took."""
    output = folder / f"{scene}-{level}-{speed}-{seed}"
    kept = output.with_suffix(output.suffix + ".cpu")
    if not kept.exists():
        begun = time.monotonic()
        process = os.posix_spawn(program, [program, "run", scene, "--accuracy", level, "--set",
                                           f"extension.speed_m_per_s={speed}", "--seed", str(seed), "--threads", "1",
                                           "--quiet", "--force", "--output", str(output)], os.environ)
        _, status, usage = os.wait4(process, 0)
        if status:
            sys.exit(f"{output}: {os.waitstatus_to_exitcode(status)}")
        kept.write_text(f"{usage.ru_utime + usage.ru_stime:.1f} {time.monotonic() - begun:.1f}")
    return listric.Run(output).summary, *map(float, kept.read_text().split())


def main(program, folder, scene, seeds):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    reference = finest(scene)
    rows = []
    for question in QUESTIONS[scene]:
        level, speed, wanted, seconds, promised = answer(program, scene, question)
        asked = [key for word, keys in KEYS.items() if word + "=" in question for key in keys] or \
            [key for key in NAMES if promised.get(key) is not None and key in reference]
        runs = [run(program, folder, scene, level, speed, seed) for seed in seeds]
        groups = [runs[k:k + wanted] for k in range(0, len(runs), wanted) if len(runs[k:k + wanted]) == wanted]
        for n, group in enumerate(groups):
            for key in asked:
                values = [summary.get(key) for summary, _, _ in group]
                if None in values or promised[key] is None:
                    continue
                error = sum(values) / wanted - reference[key]
                rows.append({"scene": scene, "question": question, "level": level, "speed_m_per_s": speed,
                             "seeds": "+".join(map(str, seeds[n * wanted:(n + 1) * wanted])),
                             "predicted_s": f"{seconds:.1f}",
                             "cpu_s": f"{sum(cpu for _, cpu, _ in group) / wanted:.1f}",
                             "wall_s": f"{sum(wall for _, _, wall in group) / wanted:.1f}", "measure": key,
                             "promised": f"{promised[key]:.4g}", "error": f"{error:.4g}",
                             "inside": int(abs(error) <= promised[key])})
    with (folder / f"asked-{scene}.csv").open("w") as out:
        table = csv.DictWriter(out, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


if __name__ == "__main__":
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    main(os.path.abspath(sys.argv[1]), sys.argv[2], sys.argv[3], list(map(int, sys.argv[4:])))
