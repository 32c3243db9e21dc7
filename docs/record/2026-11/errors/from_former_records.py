#!/usr/bin/env python3
"""Writes docs/record/runs/validation.csv from the frozen record of validation and
docs/record/runs/as-fine-as-sand.csv from the table of that name in accuracy.md: runs of shipped
scenes whose numbers are recorded, in the columns of `listric study`'s runs.csv.

    python3 docs/record/2026-11/errors/from_former_records.py
"""

import csv
from pathlib import Path

RECORD = Path(__file__).resolve().parents[2]
MEASURES = ["rollover_tilt_deg", "cutoff_x_m", "cutoff_z_m", "basin_area_m2", "area_balance", "halfgraben_area_share",
            "strain_top10", "strain_top10_cumulative", "basement_unbonded_fraction", "weak_fraction",
            "fault_width_diameters", "antithetic_foot_x_m"]
HEAD = ["record", "scene", "made_by", "mean_radius_m", "speed_m_per_s", "extension_m", "seed"]
# Runs of the shipped scenes as they are; lis2's went on to 12 km.
SCENES = ("lis1", "lis2", "rfr")


def write(name, rows):
    with open(RECORD / "runs" / name, "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, HEAD + MEASURES, restval="", lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def of_validation():
    with open(RECORD / "2026-11/validation/measures.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["run"] in SCENES:
                yield {"record": "docs/record/2026-11/validation.md", "scene": row["run"], "made_by": row["made_by"],
                       "mean_radius_m": 93.1, "speed_m_per_s": 1, "extension_m": row["at_m"], "seed": row["seed"],
                       **{name: row[name] for name in MEASURES}}


def numbers(cell):
    return [part.split() for part in cell.split(",")]


def as_fine_as_sand():
    """Rows of standard, fine and sandbox: those of draft have been made anew."""
    text = (RECORD / "2026-11/accuracy.md").read_text(encoding="utf-8")
    for extension in ("2.5", "10"):
        table = text[text.index(f"| at {extension} km |"):].split("\n\n")[0]
        for line in table.splitlines():
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            radius = {"standard": 93.1, "fine": 46.55, "sandbox": 18.62}.get(cells[0].split("`")[1] if "`" in cells[0] else "")
            if not radius:
                continue
            tilts, balances, unbonded, weak = (cells[k].split() for k in (2, 4, 7, 6))
            top10, cumulative = numbers(cells[5])
            cutoff = cells[3].split(" (")[0].replace(",", " ").split()   # "208, 2,490"
            for k, tilt in enumerate(tilts):
                row = {"record": "docs/record/2026-11/accuracy.md", "scene": "lis1", "made_by": "0.2.0+ca655f1",
                       "mean_radius_m": radius, "speed_m_per_s": 1, "extension_m": float(extension) * 1000, "seed": k + 1,
                       "rollover_tilt_deg": tilt, "area_balance": balances[k], "strain_top10": top10[k],
                       "strain_top10_cumulative": cumulative[k], "weak_fraction": weak[k],
                       "basement_unbonded_fraction": unbonded[k]}
                if k == 0:
                    x, z = places(cutoff)
                    row |= {"cutoff_x_m": x, "cutoff_z_m": z}
                yield row


def places(words):
    """"3 221 9 288" or "208 2 490": a depth has a comma within, x where it is above 999 m."""
    return "".join(words[:-2]), "".join(words[-2:])


if __name__ == "__main__":
    write("validation.csv", of_validation())
    write("as-fine-as-sand.csv", as_fine_as_sand())
