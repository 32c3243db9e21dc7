#!/usr/bin/python3
"""Figure of wells: a row a well, with a panel for what it has of pressure, porosity, mud weight,
temperature and maturity by depth; above them what is measured along the section.

Usage: wells.py DATA_DIR FIGURES_DIR ORDER

Reads DATA_DIR/wells.json: frames, each with scene, extension_km, time_a, options in the name of its figure, in a
scene with stages also extension_m and way_m, and wells; a well has a name, x_m and columns of numbers from the ground down.
A frame may have profiles: label, unit, x_m and values along the section.
Writes well-<extension>km and options under a temporary name and renames it.  On bad input: one line on stderr,
exit status 2.
"""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import (FAINT, INK, STYLE, InputError, matplotlib, new_figure, read_json, read_order, run,
                  save, without_frame)

from page import moment_words, time_texts

import numpy as np

PASCAL, KILOMETRE, GRAM = 1e-6, 1e-3, 1e-3     # in MPa, km, g/cm3
WATER, GRAINS, OPEN, MUD, WARM, COAL = "#1f6fb4", "#7a5230", "#d7301f", "#4a148c", "#c2410c", "#3f2204"
OIL = (0.6, 1.3)   # vitrinite reflectance, %: the oil window
# By panel: name of the axis, and (column, factor, label, style) of its lines. A well has those whose columns it has.
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
      ("total_stress_pa", None, "lithostat", {"color": GRAINS, "lw": 1.3}))),
    ("Temperature (°C)",
     (("max_temperature_c", 1.0, "highest so far", {"color": FAINT, "ls": "--", "lw": 1.1}),
      ("temperature_c", 1.0, "temperature", {"color": WARM, "lw": 2.0}))),
    ("Vitrinite reflectance (%)",
     (("vitrinite_percent", 1.0, "%Ro", {"color": COAL, "lw": 2.0}),)),
    ("Porosity",
     (("porosity", 1.0, "porosity", {"color": MUD, "lw": 2.0}),)))


def columns_of(well: dict) -> dict[str, np.ndarray]:
    """Numbers of a well by name."""
    try:
        columns = {name: np.array(values, dtype=float) for name, values in well["columns"].items()}
        lengths = {len(values) for values in columns.values()}
    except (AttributeError, KeyError, TypeError, ValueError) as failure:
        raise InputError(f"wells.json: not a well ({failure!r})") from failure
    if len(lengths) != 1 or "depth_m" not in columns or not panels_of(columns):
        raise InputError("wells.json: a well has depth_m and the columns of a panel, of one length")
    return columns


def panels_of(columns: dict) -> list:
    """The panels whose columns there are; of those with one name the first."""
    panels = {}
    for name, lines in PANELS:
        if {column for column, *_ in lines} <= set(columns):
            panels.setdefault(name, (name, lines))
    return list(panels.values())


def values_of(columns: dict[str, np.ndarray], column: str, factor: float | None) -> np.ndarray:
    """In the unit of a panel; without a factor a pressure as the weight of mud, g/cm3."""
    if factor is not None:
        return factor * columns[column]
    return columns[column] * columns["mud_weight_kg_per_m3"] / columns["pressure_pa"] * GRAM


def draw_well(axes, well: dict, top: float) -> None:
    columns = columns_of(well)
    depth = columns["depth_m"] * KILOMETRE
    panels = panels_of(columns)
    for ax in axes[len(panels):]:
        ax.set_axis_off()
    for ax, (name, lines) in zip(axes, panels):
        for column, factor, label, style in lines:
            ax.plot(values_of(columns, column, factor), depth, label=label, **style)
        if name.startswith("Vitrinite"):
            ax.axvspan(*OIL, color="#e3efd8", label="oil window")
        ax.set_xlabel(name)
        ax.set_ylim(top, 0.0)
        ax.grid(color="#e4e4e4", lw=0.6)
        ax.set_axisbelow(True)
        if not name.startswith("Equivalent"):   # which has the lines of the pressures
            ax.set_xlim(left=0.0)
            if len(lines) > 1 or name.startswith("Vitrinite"):
                ax.legend(frameon=False, fontsize=8.5)
    axes[0].set_ylabel("Depth below the ground (km)")
    axes[0].set_title(f"{well['name'].capitalize()}, x {well['x_m'] * KILOMETRE:.1f} km", loc="left",
                      fontsize=10.5, weight="semibold")
    without_frame(*axes)


def draw_profile(ax, profile: dict) -> None:
    """A number along the section."""
    try:
        x, values = (np.array(profile[name], dtype=float) for name in ("x_m", "values"))
        words = f"{profile['label'].capitalize()} ({profile['unit'].replace('m2', 'm²')})"
    except (AttributeError, KeyError, TypeError, ValueError) as failure:
        raise InputError(f"wells.json: not a profile ({failure!r})") from failure
    if x.shape != values.shape:
        raise InputError("wells.json: a profile has x_m and values of one length")
    ax.plot(x * KILOMETRE, values, color=WARM, lw=2.0)
    ax.set_xlabel("Distance from the breakaway (km)")
    ax.set_ylabel(words)
    ax.set_ylim(bottom=0.0)
    ax.grid(color="#e4e4e4", lw=0.6)
    without_frame(ax)


def draw(frame: dict):
    wells, profiles = frame["wells"], frame.get("profiles", [])
    height = 0.5 + 4.4 * len(wells) + 2.6 * len(profiles)
    figure = new_figure(11.5, height, 120)
    [time], unit = time_texts([frame["time_a"]], math.inf, frame["time_a"])
    figure.text(0.01, 1.0 - 0.1 / height,
                f"{frame['scene'].upper()}, {moment_words(frame, frame['extension_km'])}, {time} {unit}",
                fontsize=13, weight="bold", va="top", color=INK)
    columns = max(len(panels_of(columns_of(well))) for well in wells)
    grid = figure.add_gridspec(len(profiles) + len(wells), columns,
                               height_ratios=[2.6] * len(profiles) + [4.4] * len(wells))
    for row, profile in enumerate(profiles):
        draw_profile(figure.add_subplot(grid[row, :]), profile)
    top = 1.03 * KILOMETRE * max(max(columns_of(well)["depth_m"]) for well in wells)
    for row, well in enumerate(wells, len(profiles)):
        draw_well([figure.add_subplot(grid[row, column]) for column in range(columns)], well, top)
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 1.0 - 0.4 / height))
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
