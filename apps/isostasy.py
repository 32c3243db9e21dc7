#!/usr/bin/python3
"""Flank uplift and deflection against the effective elastic thickness.

Usage: isostasy.py DIR

Reads DIR/isostasy.csv, writes DIR/isostasy.png under a temporary name and renames it.  On bad input:
one line on stderr, exit status 1.
"""
import csv
import os
import sys

sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import new_figure, run, save, without_frame

COLOURS = {"sediment": "#b8860b", "water": "#1f6fb4", "empty": "#525252"}


def mean(values):
    return sum(values) / len(values)


def draw(rows):
    figure = new_figure(12, 5, 130)
    left, right = figure.subplots(1, 2)
    for fill in dict.fromkeys(row["fill"] for row in rows):
        colour = COLOURS.get(fill, "#6a51a3")
        mine = [row for row in rows if row["fill"] == fill]
        thicknesses = sorted({float(row["elastic_thickness_m"]) for row in mine})

        def at(name):
            return [mean([float(row[name]) for row in mine
                          if float(row["elastic_thickness_m"]) == t]) for t in thicknesses]

        x = [t / 1e3 for t in thicknesses]
        for row in mine:
            left.plot(float(row["elastic_thickness_m"]) / 1e3, float(row["uplift_m"]), "o",
                      color=colour, ms=4, alpha=0.5)
        left.plot(x, at("uplift_m"), "o-", color=colour, lw=1.6, label=f"{fill}: breakaway")
        left.fill_between(x, at("continuous_plate_m"), at("broken_plate_m"), color=colour, alpha=0.12,
                          lw=0, label=f"{fill}: plate under the same net load, continuous to broken")
        right.plot(x, at("deflection_max_m"), "s-", color=colour, lw=1.6,
                   label=f"{fill}: largest displacement of the detachment")
    for axes in (left, right):
        axes.set_xlabel("effective elastic thickness, km")
        axes.set_xscale("log")
        axes.set_xticks([2, 5, 10, 15, 30], labels=["2", "5", "10", "15", "30"])
        axes.minorticks_off()
        axes.set_ylim(bottom=0.0)
        axes.grid(True, lw=0.4, color="#d0d0d0")
        axes.legend(frameon=False, fontsize=8)
        without_frame(axes)
    left.set_ylabel("uplift of the breakaway, m")
    right.set_ylabel("displacement, m")
    figure.tight_layout()
    return figure


def main(folder):
    with open(os.path.join(folder, "isostasy.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise ValueError("isostasy.csv has no finished run")
    save(draw(rows), folder, "isostasy")


if __name__ == "__main__":
    run(main, "isostasy.py DIR")
