"""What water in the pores does to faults: runs of `lis1-mud` with and without it, packing by packing.

    python3 faults.py FOLDER

FOLDER has runs named CASE-SEED (rest, 18, 19, 19dry), each with the files of `listric export faults`. What each run has
goes into faults.csv in this script's folder; tables are printed. Dips, throws and widths are means over the traced
faults of all moments from 2.5 km on, by length, so that a packing gives one number; differences are taken packing by
packing. A difference over its standard error of 2.8 or more has one chance in twenty to come from five equal pairs;
seven measures in three comparisons show one by chance.
"""

import csv
import json
import statistics
import sys
from pathlib import Path

CASES = {"rest": "water at rest", "18": "1e-18", "19": "1e-19", "19dry": "1e-19, no pushes"}
COMPARED = (("18", "rest"), ("19", "rest"), ("19", "19dry"))
SEEDS = range(1, 6)
FROM = 2500.0   # m of extension


def lines(run):
    """Traced faults of all moments, a row each, with the moment."""
    for file in sorted(run.glob("export/faults-extension-*.csv")):
        extension = float(file.stem.split("-")[-1].rstrip("m"))
        if extension > FROM - 1.0:
            seen = {}
            for row in csv.DictReader(file.open(encoding="utf-8")):
                seen.setdefault(row["line"], row)
            yield extension, list(seen.values())


def by_length(rows, value):
    kept = [(float(row["length_m"]), abs(float(row[value]))) for row in rows if row[value] not in ("", "nan")]
    return sum(length * x for length, x in kept) / sum(length for length, _ in kept) if kept else float("nan")


def measures(run):
    """State hash of a run, and its numbers."""
    moments = list(lines(run))
    rows = [row for _, some in moments for row in some]
    with (run / "history.csv").open(encoding="utf-8") as file:
        history = [row for row in csv.DictReader(line for line in file if not line.startswith("#"))
                   if float(row["extension_m"]) > FROM - 1.0]
    summary = json.loads((run / "summary.json").read_text(encoding="utf-8"))
    return summary["state_hash"], {
        "length of traced faults, km": sum(float(r["length_m"]) for r in rows) / len(moments) / 1e3,
        "dip, degrees": by_length(rows, "dip_deg"),
        "throw, m": by_length(rows, "pre_rift_throw_m"),
        "width, diameters": by_length(rows, "width_diameters"),
        "bonded share of old sediment": summary["old_sediment_bonded_fraction"],
        "strain in the top tenth, by window": statistics.mean(float(row["strain_top10"]) for row in history),
        "strain in the top tenth, in all": summary["strain_top10_cumulative"],
    }


def mean_and_error(values):
    return statistics.mean(values), statistics.stdev(values) / len(values) ** 0.5


def main():
    folder = Path(sys.argv[1])
    found = {}
    with (Path(__file__).parent / "faults.csv").open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        for case in CASES:
            for seed in SEEDS:
                state_hash, one = measures(folder / f"{case}-{seed}")
                if not found:
                    table.writerow(["case", "seed", "state_hash", *one])
                table.writerow([case, seed, state_hash, *(f"{x:.5g}" for x in one.values())])
                found.setdefault(case, []).append(one)
    print("| measure |", " | ".join(CASES.values()), "|")
    for name in found["rest"][0]:
        cells = ["%.3g +- %.2g" % mean_and_error([one[name] for one in found[case]]) for case in CASES]
        print(f"| {name} |", " | ".join(cells), "|")
    print()
    print("| difference |", " | ".join(f"{CASES[a]} less {CASES[b]}" for a, b in COMPARED), "|")
    for name in found["rest"][0]:
        cells = []
        for a, b in COMPARED:
            mean, error = mean_and_error([x[name] - y[name] for x, y in zip(found[a], found[b])])
            cells.append(f"{mean:+.2g} +- {error:.2g} ({mean / error:+.1f})")
        print(f"| {name} |", " | ".join(cells), "|")


if __name__ == "__main__":
    main()
