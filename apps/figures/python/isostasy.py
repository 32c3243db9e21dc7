#!/usr/bin/python3
"""Flank uplift against the effective elastic thickness, nominal and fitted, and beside thin plates.

Usage: isostasy.py DIR

Reads DIR/isostasy.csv, writes DIR/isostasy.png under a temporary name and renames it.  On bad input:
one line on stderr, exit status 1.
"""
import csv
import math
import os
import sys

sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import new_figure, run, save, without_frame

COLOURS = {"sediment": "#b8860b", "water": "#1f6fb4", "empty": "#525252"}


def mean(values):
    return sum(values) / len(values)


def draw(rows):
    figure = new_figure(12, 5.2, 130)
    left, right = figure.subplots(1, 2)
    for fill in dict.fromkeys(row["fill"] for row in rows):
        colour = COLOURS.get(fill, "#6a51a3")
        mine = [row for row in rows if row["fill"] == fill]
        thicknesses = sorted({float(row["elastic_thickness_m"]) for row in mine})

        def at(name, unit=1.0):
            return [mean([float(row[name]) for row in mine
                          if float(row["elastic_thickness_m"]) == t]) / unit for t in thicknesses]

        nominal = [t / 1e3 for t in thicknesses]
        least, most = at("fitted_continuous_thickness_m", 1e3), at("fitted_thickness_m", 1e3)
        between = [math.sqrt(a * b) for a, b in zip(least, most)]
        left.plot(between, at("uplift_m"), "o-", color=colour, lw=1.6, label=f"{fill}: breakaway")
        left.hlines(at("uplift_m"), least, most, color=colour, lw=4, alpha=0.3)
        on_the_left = fill == "water"  # its bars end where those of the empty basin begin
        for t, x, y in zip(nominal, least if on_the_left else most, at("uplift_m")):
            left.annotate(f"{t:g} km", (x, y), xytext=(-6 if on_the_left else 6, 0),
                          textcoords="offset points", ha="right" if on_the_left else "left",
                          va="center", fontsize=8, color=colour)
        for row in mine:
            right.plot(float(row["elastic_thickness_m"]) / 1e3, float(row["uplift_m"]), "o",
                       color=colour, ms=3.5, alpha=0.45, mew=0)
        local = mean([float(row["local_m"]) for row in mine]) / 1e3
        right.plot(nominal, at("uplift_m"), "o-", color=colour, lw=1.6,
                   label=f"{fill}: breakaway (local compensation: up to {local:.1f} km)")
        right.plot(nominal, at("continuous_plate_m"), ":", color=colour, lw=1.2,
                   label=f"{fill}: continuous plate")
        right.plot(nominal, at("broken_plate_m"), "--", color=colour, lw=1.2,
                   label=f"{fill}: plate broken at the breakaway")
    left.set_xlim(4.0, 80.0)
    left.set_title("Against the thickness fitted to the detachment's deflection", fontsize=10,
                   loc="left")
    left.set_xlabel("fitted elastic thickness, km: bar from continuous to broken plate; nominal beside it")
    right.set_title("Beside thin plates under the same spread loads", fontsize=10, loc="left")
    right.set_xlabel("nominal elastic thickness, km")
    for axes in (left, right):
        axes.set_xscale("log")
        axes.set_xticks([2, 5, 10, 15, 20, 30], labels=["2", "5", "10", "15", "20", "30"])
        axes.minorticks_off()
        axes.set_ylim(0.0, 1.6 * max(float(row["uplift_m"]) for row in rows))
        axes.set_ylabel("uplift of the breakaway, m")
        axes.grid(True, lw=0.4, color="#d0d0d0")
        axes.legend(frameon=False, fontsize=7)
        without_frame(axes)
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
