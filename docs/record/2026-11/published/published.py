#!/usr/bin/env python3
"""Tilt of the conjugate pair and the weight that damping carries: PFC's damping against today's, seed by seed.

published.py MEASURES.csv PUBLISHED.csv

MEASURES.csv has the runs lis1, lis2 and rfr, PUBLISHED.csv those with the ending -pfc or -pfc-table, of equal seeds.
A difference is published less today's, mean over seeds ± standard error.
"""
import csv
import statistics
import sys


def read(path):
    rows = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            rows[row["run"], int(row["seed"]), round(float(row["at_m"]) / 500) * 500] = row
    return rows


MEASURES = {
    "antithetic_edge_dip_deg": ("antithetic edge, dip, °", 1),
    "synthetic_active_edge_dip_deg": ("synthetic edge above the branch point, dip, °", 1),
    "synthetic_edge_dip_deg": ("synthetic edge, dip, °", 1),
    "sediment_stress_ratio": ("contact stress in sediment over the weight above", 3),
    "sediment_damping_share": ("sediment's weight that damping carries", 3),
    "unbalanced_ratio_mean": ("mean unbalanced over contact force", 5),
    "old_sediment_bonded_fraction": ("bonded contacts in old sediment", 3),
    "strain_top10_cumulative": ("strain in the most strained tenth", 3),
    "fault_width_diameters": ("width of faults, diameters", 2),
    "area_balance": ("basin area over extension × thickness", 4),
}


def mean(values, digits):
    if len(values) < 2:
        return f"{values[0]:.{digits}f}" if values else ""
    return f"{statistics.mean(values):.{digits}f} ± {statistics.stdev(values) / len(values) ** 0.5:.{digits}f}"


def main():
    today, published = read(sys.argv[1]), read(sys.argv[2])
    print("| experiment | at, km | measure | seeds | today | published | difference |")
    print("|---|---|---|---|---|---|---|")
    for run in sorted({run for run, _, _ in published if not run.endswith("-0")}):
        plain = run.split("-")[0]
        for at in sorted({at for name, _, at in published if name == run}):
            for measure, (what, digits) in MEASURES.items():
                pairs = [(float(today[plain, seed, at][measure]), float(row[measure]))
                         for (name, seed, place), row in sorted(published.items())
                         if (name, place) == (run, at) and (plain, seed, at) in today
                         and row.get(measure) and today[plain, seed, at].get(measure)]
                if pairs:
                    print(f"| {run} | {at / 1000:g} | {what} | {len(pairs)} | {mean([a for a, _ in pairs], digits)} | "
                          f"{mean([b for _, b in pairs], digits)} | {mean([b - a for a, b in pairs], digits)} |")


if __name__ == "__main__":
    main()
