#!/usr/bin/python3
"""Figure of an elastic base: how the detachment has moved, by extension.

Usage: base.py RUN_DIR FIGURES_DIR ORDER

Reads RUN_DIR/base.csv: extension_m, in a scene with stages also travel_m, and of every node x_m, y_m
at the start and its displacement ux_m, uy_m.  Writes base.png under a temporary name and renames it: vertical displacement along the
detachment, the detachment itself with its displacement ten times too large, and the breakaway's
uplift over travel.  On bad input: one line on stderr, exit status 2.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import (FAINT, InputError, colormaps, moment_label, new_figure, read_order, read_table,
                  rows_by_moment, run, save, without_frame)

import numpy as np

EXAGGERATION = 10.0


def load(folder: str) -> tuple[str, dict[float, np.ndarray]]:
    """The clock of the moments, and nodes (x, y, ux, uy in m) by it in m, ascending."""
    clock, moments = rows_by_moment(read_table(os.path.join(folder, "base.csv"), may_be_empty=True),
                                    "x_m", "y_m", "ux_m", "uy_m")
    if not moments:
        raise InputError("base.csv has no moment: the base does not deform")
    return clock, moments


def shown(travels: list[float]) -> list[float]:
    """About five moments, evenly over the run, the last among them."""
    step = max(1, round(len(travels) / 5))
    return travels[::-1][::step][::-1]


def draw(clock: str, moments: dict[float, np.ndarray]):
    figure = new_figure(11, 10.5, 120)
    profile, section, history = figure.subplots(3, 1, height_ratios=(1.1, 1.3, 0.8))
    draw_displacement(profile, section, clock, moments)
    draw_history(history, clock, moments)
    without_frame(profile, section, history)
    figure.tight_layout()
    return figure


def draw_displacement(profile, section, clock: str, moments: dict[float, np.ndarray]) -> None:
    """Uplift by distance, and the detachment's shape, at about five moments."""
    travels = list(moments)
    colours = colormaps["viridis_r"]
    last = travels[-1] or 1.0
    x, y = moments[travels[-1]].T[:2] / 1e3
    section.plot(x, y, color=FAINT, lw=1.0, ls="--", label="at the start")
    for travel in shown(travels):
        x, y, ux, uy = moments[travel].T
        options = {"color": colours(0.15 + 0.8 * travel / last), "lw": 1.6,
                   "label": moment_label(travel, last)}
        profile.plot(x / 1e3, uy, **options)
        section.plot((x + EXAGGERATION * ux) / 1e3, (y + EXAGGERATION * uy) / 1e3, **options)
    profile.axhline(0.0, color=FAINT, lw=0.6)
    profile.set_ylabel("uplift of the detachment, m")
    profile.set_title("Vertical displacement since the settled start", loc="left", fontsize=10.5)
    section.set_ylabel("height, km")
    section.set_aspect("equal")
    section.set_title(f"Detachment, displacement × {EXAGGERATION:g}", loc="left", fontsize=10.5)
    for axes in (profile, section):
        axes.set_xlabel("distance from the breakaway, km")
        axes.legend(frameon=False, fontsize=8.5, title=clock, loc="center left",
                    bbox_to_anchor=(1.0, 0.5))


def draw_history(axes, clock: str, moments: dict[float, np.ndarray]) -> None:
    """Uplift of the breakaway, and of the highest and lowest place, by travel (extension, where the wall never turns)."""
    travel = [t / 1e3 for t in moments]
    uplifts = [nodes[:, 3] for nodes in moments.values()]
    axes.plot(travel, [uy[0] for uy in uplifts], "o-", color="#1f6fb4", ms=3.5, lw=1.3,
              label="breakaway")
    axes.plot(travel, [uy.max() for uy in uplifts], color="#d7301f", lw=1.0, ls="--",
              label="highest place")
    axes.plot(travel, [uy.min() for uy in uplifts], color="#525252", lw=1.0, ls=":",
              label="lowest place")
    axes.set_xlabel(f"{clock}, km")
    axes.set_ylabel("uplift, m")
    axes.legend(frameon=False, fontsize=8.5, loc="center left", bbox_to_anchor=(1.0, 0.5))


def main(folder: str, figures: str, order: str) -> None:
    save(draw(*load(folder)), figures, "base", read_order(order))


if __name__ == "__main__":
    run(main, "base.py RUN_DIR FIGURES_DIR ORDER")
