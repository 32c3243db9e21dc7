#!/usr/bin/python3
"""Flank uplift against the effective elastic thickness, nominal and fitted, and beside thin plates.

Usage: isostasy.py DIR

Reads DIR/isostasy.csv, a row per run: what fills the basin, nominal and fitted thickness, uplift of
the breakaway and of plates, in m.  Writes DIR/isostasy.png under a temporary name and renames it.
On bad input: one line on stderr, exit status 2.
"""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import new_figure, read_rows, run, save, without_frame

COLOURS = {"saturated": "#7a5c00", "dry": "#d8a93a", "water": "#1f6fb4", "empty": "#525252"}
LABEL_HEIGHT = 90.0  # m of uplift, so that labels do not meet


def mean(values: list[float]) -> float:
    return sum(values) / len(values)


class Fill:
    """The runs whose basin is filled alike: means over seeds, by nominal thickness."""

    def __init__(self, name: str, rows: list[dict[str, str]]):
        self.name = name
        self.rows = rows
        self.colour = COLOURS.get(name, "#6a51a3")
        self.thicknesses = sorted({float(row["elastic_thickness_m"]) for row in rows})
        self.nominal = [t / 1e3 for t in self.thicknesses]   # km
        self.uplift = self.at("uplift_m")

    def at(self, column: str, unit: float = 1.0) -> list[float]:
        """The column's mean at every thickness, in that unit."""
        return [mean([float(row[column]) for row in self.rows
                      if float(row["elastic_thickness_m"]) == t]) / unit for t in self.thicknesses]


def draw_fitted(axes, fill: Fill) -> None:
    """Uplift against the fitted thickness: a bar from the continuous to the broken plate's."""
    least, most = fill.at("fitted_continuous_thickness_m", 1e3), fill.at("fitted_thickness_m", 1e3)
    between = [math.sqrt(a * b) for a, b in zip(least, most)]
    axes.plot(between, fill.uplift, "o-", color=fill.colour, lw=1.6,
              label=f"{fill.name}: breakaway")
    axes.hlines(fill.uplift, least, most, color=fill.colour, lw=4, alpha=0.3)
    on_the_left = fill.name not in ("saturated", "empty")  # others' bars are to their left
    below = math.inf
    for t, x, y in zip(fill.nominal, least if on_the_left else most, fill.uplift):
        below = min(y, below - LABEL_HEIGHT)
        axes.annotate(f"{t:g} km", (x, below), xytext=(-6 if on_the_left else 6, 0),
                      textcoords="offset points", ha="right" if on_the_left else "left",
                      va="bottom" if fill.name == "water" else "center", fontsize=8,
                      color=fill.colour)


def draw_plates(axes, fill: Fill) -> None:
    """Uplift of every run, its mean and that of plates against the nominal thickness."""
    for row in fill.rows:
        axes.plot(float(row["elastic_thickness_m"]) / 1e3, float(row["uplift_m"]), "o",
                  color=fill.colour, ms=3.5, alpha=0.45, mew=0)
    local = mean([float(row["local_m"]) for row in fill.rows]) / 1e3
    axes.plot(fill.nominal, fill.uplift, "o-", color=fill.colour, lw=1.6,
              label=f"{fill.name}: breakaway (local compensation: up to {local:.1f} km)")
    axes.plot(fill.nominal, fill.at("continuous_plate_m"), ":", color=fill.colour, lw=1.2,
              label=f"{fill.name}: continuous plate")
    axes.plot(fill.nominal, fill.at("broken_plate_m"), "--", color=fill.colour, lw=1.2,
              label=f"{fill.name}: plate broken at the breakaway")


def draw(rows: list[dict[str, str]]):
    figure = new_figure(12, 5.2, 130)
    left, right = figure.subplots(1, 2)
    for name in dict.fromkeys(row["fill"] for row in rows):
        fill = Fill(name, [row for row in rows if row["fill"] == name])
        draw_fitted(left, fill)
        draw_plates(right, fill)
    left.set_xlim(4.0, 80.0)
    left.set_title("By thickness fitted to the deflection; nominal thickness beside it",
                   fontsize=10, loc="left")
    left.set_xlabel("fitted elastic thickness, km (bar: continuous to broken plate)")
    right.set_title("Beside thin plates under the same spread loads", fontsize=10, loc="left")
    right.set_xlabel("nominal elastic thickness, km")
    for axes in (left, right):
        axes.set_xscale("log")
        axes.set_xticks([2, 5, 10, 15, 20, 30], labels=["2", "5", "10", "15", "20", "30"])
        axes.minorticks_off()
        axes.set_ylim(0.0, 1.9 * max(float(row["uplift_m"]) for row in rows))
        axes.set_ylabel("uplift of the breakaway, m")
        axes.grid(True, lw=0.4, color="#d0d0d0")
        axes.legend(frameon=False, fontsize=7)
        without_frame(axes)
    figure.tight_layout()
    return figure


def main(folder: str) -> None:
    save(draw(read_rows(os.path.join(folder, "isostasy.csv"))), folder, "isostasy")


if __name__ == "__main__":
    run(main, "isostasy.py DIR")
