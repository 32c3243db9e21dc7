#!/usr/bin/python3
"""Figure of wells: pressure, porosity and mud weight by depth, a row a well.

Usage: wells.py DATA_DIR FIGURES_DIR ORDER

Reads DATA_DIR/wells.json: frames, each with scene, extension_km, options in the name of its figure, in a
scene with stages also extension_m and way_m, and wells; a well has a name, x_m and columns of numbers from the ground down.
Writes well-<extension>km and options under a temporary name and renames it.  On bad input: one line on stderr,
exit status 2.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import (FAINT, INK, STYLE, InputError, matplotlib, new_figure, read_json, read_order, run,
                  save, without_frame)

from page import moment_words

import numpy as np

PASCAL, KILOMETRE, GRAM = 1e-6, 1e-3, 1e-3     # in MPa, km, g/cm3
WATER, GRAINS, OPEN, MUD = "#1f6fb4", "#7a5230", "#d7301f", "#4a148c"
# By panel: name of the axis, and (column, factor, label, style) of its lines.
PANELS = (
    ("Pressure, stress (MPa)",
     (("rest_pressure_pa", PASCAL, "hydrostat", {"color": WATER, "ls": "--", "lw": 1.1}),
      ("pressure_pa", PASCAL, "pore pressure", {"color": WATER, "lw": 2.0}),
      ("fracture_pressure_pa", PASCAL, "fracture line", {"color": OPEN, "ls": ":", "lw": 1.3}),
      ("total_stress_pa", PASCAL, "lithostat", {"color": GRAINS, "lw": 1.3}))),
    ("Porosity",
     (("normal_porosity", 1.0, "with water at rest", {"color": FAINT, "ls": "--", "lw": 1.1}),
      ("porosity", 1.0, "porosity", {"color": MUD, "lw": 2.0}))),
    ("Equivalent mud weight (g/cm³)",
     (("rest_pressure_pa", None, "hydrostat", {"color": WATER, "ls": "--", "lw": 1.1}),
      ("mud_weight_kg_per_m3", GRAM, "pore pressure", {"color": WATER, "lw": 2.0}),
      ("fracture_pressure_pa", None, "fracture line", {"color": OPEN, "ls": ":", "lw": 1.3}),
      ("total_stress_pa", None, "lithostat", {"color": GRAINS, "lw": 1.3}))))


def columns_of(well: dict) -> dict[str, np.ndarray]:
    """Numbers of a well by name."""
    try:
        columns = {name: np.array(values, dtype=float) for name, values in well["columns"].items()}
        lengths = {len(values) for values in columns.values()}
    except (AttributeError, KeyError, TypeError, ValueError) as failure:
        raise InputError(f"wells.json: not a well ({failure!r})") from failure
    needed = {"depth_m"}.union(*({column for column, *_ in lines} for _, lines in PANELS))
    if not needed <= set(columns) or len(lengths) != 1:
        raise InputError(f"wells.json: a well has {', '.join(sorted(needed))}, of one length")
    return columns


def values_of(columns: dict[str, np.ndarray], column: str, factor: float | None) -> np.ndarray:
    """In the unit of a panel; without a factor a pressure as the weight of mud, g/cm3."""
    if factor is not None:
        return factor * columns[column]
    return columns[column] * columns["mud_weight_kg_per_m3"] / columns["pressure_pa"] * GRAM


def draw_well(axes, well: dict, top: float) -> None:
    columns = columns_of(well)
    depth = columns["depth_m"] * KILOMETRE
    for ax, (name, lines) in zip(axes, PANELS):
        for column, factor, label, style in lines:
            ax.plot(values_of(columns, column, factor), depth, label=label, **style)
        ax.set_xlabel(name)
        ax.set_ylim(top, 0.0)
        ax.grid(color="#e4e4e4", lw=0.6)
        ax.set_axisbelow(True)
    for ax in axes[:2]:   # the third has the lines of the first
        ax.legend(frameon=False, fontsize=8.5)
    axes[0].set_xlim(left=0.0)
    axes[1].set_xlim(left=0.0)
    axes[0].set_ylabel("Depth below the ground (km)")
    axes[0].set_title(f"{well['name'].capitalize()}, x {well['x_m'] * KILOMETRE:.1f} km", loc="left",
                      fontsize=10.5, weight="semibold")
    without_frame(*axes)


def draw(frame: dict):
    wells = frame["wells"]
    figure = new_figure(11.5, 0.5 + 4.4 * len(wells), 120)
    figure.text(0.01, 1.0 - 0.1 / (0.5 + 4.4 * len(wells)),
                f"{frame['scene'].upper()}, {moment_words(frame, frame['extension_km'])}", fontsize=13,
                weight="bold", va="top", color=INK)
    rows = figure.subplots(len(wells), len(PANELS), squeeze=False)
    top = 1.03 * KILOMETRE * max(max(columns_of(well)["depth_m"]) for well in wells)
    for axes, well in zip(rows, wells):
        draw_well(axes, well, top)
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 1.0 - 0.4 / (0.5 + 4.4 * len(wells))))
    return figure


def main(data: str, figures: str, order: str) -> None:
    path = os.path.join(data, "wells.json")
    frames = read_json(path).get("frames")
    if not isinstance(frames, list) or not frames:
        raise InputError(f"{path}: holds no frames")
    with matplotlib.rc_context(STYLE):
        for frame in frames:
            save(draw(frame), figures, f"well-{frame['extension_km']}km{frame.get('options', '')}", read_order(order))


if __name__ == "__main__":
    run(main, "wells.py DATA_DIR FIGURES_DIR ORDER")
