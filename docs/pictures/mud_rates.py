#!/usr/bin/python3
"""Draws docs/pictures/strata/mud-rates.webp: overpressure and undercompaction at the depocentre over Gibson's number, a mark a run, and what
`explain` has for a column.

Usage: PYTHONPATH=apps/python docs/pictures/mud_rates.py PROGRAM PICTURE.webp RUN [RUN ...]

RUN is the folder of a finished run of lis1-mud, or SWEEP/runs/* of docs/guides/cookbook/permeability-and-rate.toml. Prints the numbers as a table.
"""
import re
import subprocess
import sys
import listric
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

DEPTH = 4500.0   # m, where `explain` has the column's
MARKS = {0.0025: "o", 0.005: "s", 0.01: "^"}   # by m/a


def column(program, changes):
    """Gibson's number, overpressure ratio and undercompaction of a column, as `explain` prints them."""
    text = subprocess.run([program, "explain", "lis1-mud", "--accuracy", "draft",
                           *(word for key, value in changes.items() for word in ("--set", f"{key}={value}"))],
                          check=True, text=True, stdout=subprocess.PIPE).stdout
    number = float(re.search(r"Gibson's number ([\d.e+-]+)", text)[1])
    ratio, wet, rest = map(float, re.search(r"([\d.]+) at 4\.5 km; porosity ([\d.]+) there, ([\d.]+) where", text).groups())
    return number, ratio, wet - rest


def depocentre(run):
    """Overpressure ratio and undercompaction at DEPTH."""
    profile = run.summary["pressure_profile"]
    at = [point["depth_m"] for point in profile]
    of = {name: np.interp(DEPTH, at, [point[name] for point in profile])
          for name in ("overpressure_ratio", "porosity", "normal_porosity")}
    return of["overpressure_ratio"], of["porosity"] - of["normal_porosity"]


def main(program, picture, *folders):
    rows = []
    for folder in folders:
        run = listric.Run(folder)
        changes = {"pore_fluid.permeability_m2": run.scene["pore_fluid"]["permeability_m2"],
                   "extension.rate_m_per_a": run.scene["extension"]["rate_m_per_a"]}
        rows.append((*changes.values(), *column(program, changes), *depocentre(run)))
        print("| {:g} | {:g} | {:g} | {:.2f}, {:.2f} | {:.3f}, {:.3f} |".format(
            rows[-1][0], 1e3 * rows[-1][1], rows[-1][2], rows[-1][5], rows[-1][3], rows[-1][6], rows[-1][4]))
    rows = np.array(sorted(rows, key=lambda row: row[2]))

    figure, panels = plt.subplots(1, 2, figsize=(9.0, 3.4), dpi=110)
    for panel, line, mark, label in zip(panels, (3, 4), (5, 6), ("overpressure ratio λ*", "undercompaction")):
        panel.plot(rows[:, 2], rows[:, line], color="#888", lw=1.5, label="column")
        for rate, shape in MARKS.items():
            of = rows[np.isclose(rows[:, 1], rate)]
            panel.plot(of[:, 2], of[:, mark], shape, color="#b71c1c", ms=5.5, label=f"section, {1e3 * rate:g} mm/a")
        panel.set(xscale="log", xlabel="Gibson's number", ylabel=f"{label}, 4.5 km deep")
        panel.spines[["top", "right"]].set_visible(False)
    panels[0].legend(frameon=False, fontsize=9)
    figure.tight_layout()
    figure.canvas.draw()
    Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB").save(picture, quality=60, method=6)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
