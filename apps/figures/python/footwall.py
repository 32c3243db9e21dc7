#!/usr/bin/python3
"""Figure of an elastic footwall: the bent section, its stress, the discs on it, and the uplift.

Usage: footwall.py RUN_DIR DATA_DIR FIGURES_DIR ORDER

Reads, in SI units,
  RUN_DIR/footwall.csv  extension_m, in a scene with stages also travel_m, x_m (negative on the
                        surface, else on the detachment), uplift_m
  DATA_DIR/patches.npy  patches of elements: x, y, ux, uy of four corners, stresses xx, yy, xy, and
                        1 where the rock is relaxed
  DATA_DIR/end.npy      where the scale of the largest shear stress ends, MPa
  DATA_DIR/discs.npy    x, y, radius, stratum, y at the start
Writes footwall.png under a temporary name and renames it.  Vertical displacement is exaggerated, of
the discs by that of the base below them.  On bad input: one line on stderr, exit status 2.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from frame import load_array
from plot import (FAINT, InputError, colormaps, moment_label, new_figure, read_order, read_table,
                  rows_by_moment, run, save, without_frame)
from vocabulary import VOCABULARY, layer_colours, palette, stratum_colours

import numpy as np
from matplotlib.collections import EllipseCollection, PolyCollection
from matplotlib.colors import ListedColormap

FOOTWALL = VOCABULARY["layers"]["footwall"]
# Not to black, so that lines on it are seen.
FOOTWALL_COLOURS = ListedColormap(palette(FOOTWALL["palette"])[:round(256 * FOOTWALL["darkest"])])
DRAWN_UPLIFT = 5.0  # km, about, of the largest uplift


def load(folder: str) -> tuple[str, dict[float, np.ndarray]]:
    """The clock of the moments, and rows of (x, uplift) in m by it in m, ascending."""
    clock, moments = rows_by_moment(read_table(os.path.join(folder, "footwall.csv"), may_be_empty=True),
                                    "x_m", "uplift_m")
    if not moments:
        raise InputError("footwall.csv has no moment")
    return clock, moments


def exaggeration(largest: float) -> int:
    """Largest plain factor with which an uplift (m) is not drawn too high."""
    return max([n for n in (1, 2, 5, 10, 20, 50, 100) if n * largest / 1e3 <= DRAWN_UPLIFT],
               default=1)


def draw_section(figure, axes, patches: np.ndarray, end: float, discs: np.ndarray,
                 uplift: np.ndarray, factor: int) -> None:
    rock, bottom = draw_rock(axes, patches, end, factor)
    top = draw_discs(axes, discs, uplift, factor)
    surface = uplift[uplift[:, 0] < 0.0]
    x = patches[:, 0:16:4] / 1e3
    axes.set_xlim(max(-60.0, x.min()), min(discs[:, 0].max() / 1e3 + 25.0, x.max()))
    axes.set_ylim(bottom - 0.5, max((factor * surface[:, 1]).max(initial=0.0) / 1e3, top) + 2.0)
    axes.set_aspect("equal")
    axes.axhline(0.0, color=FAINT, lw=0.6, ls=(0, (6, 4)))
    axes.text(axes.get_xlim()[0] + 1.0, 0.3, "original surface", fontsize=8, color=FAINT,
              va="bottom")
    label_relaxed_rock(axes, patches)
    axes.set_ylabel("height, km")
    bar = figure.colorbar(rock, ax=axes, pad=0.01, fraction=0.025, extend="max")
    bar.set_label("largest shear stress, MPa\n(change since the start)", fontsize=9)


def label_relaxed_rock(axes, patches: np.ndarray) -> None:
    """The name in the middle of the relaxed rock between the left end and the breakaway, if any."""
    x, y = (patches[:, k:16:4].mean(axis=1) / 1e3 for k in (0, 1))
    left = axes.get_xlim()[0]
    relaxed = y[(patches[:, 19] > 0.0) & (x > left) & (x < 0.0)]
    if len(relaxed):
        axes.text(0.5 * left, 0.5 * (relaxed.min() + relaxed.max()), "relaxed rock", fontsize=9,
                  color="#8c7a5a", ha="center", va="center")


def draw_rock(axes, patches: np.ndarray, end: float, factor: int) -> tuple[PolyCollection, float]:
    """Patches coloured by their largest shear stress; these and their lowest height in km."""
    corners = patches[:, :16].reshape(-1, 4, 4)
    shape = np.stack((corners[..., 0] + corners[..., 2],
                      corners[..., 1] + factor * corners[..., 3]), axis=-1) / 1e3
    xx, yy, xy = patches[:, 16:19].T
    shear = np.hypot(0.5 * (xx - yy), xy) / 1e6
    rock = PolyCollection(shape, array=shear, cmap=FOOTWALL_COLOURS, edgecolors="face",
                          linewidths=0.2, rasterized=True)
    rock.set_clim(0.0, end)
    axes.add_collection(rock, autolim=False)
    return rock, shape[..., 1].min()


def draw_discs(axes, discs: np.ndarray, uplift: np.ndarray, factor: int) -> float:
    """Discs by layer and stratum, lifted with the base; the highest one's height in km."""
    x, y, radius, stratum, start = discs.T
    below = uplift[uplift[:, 0] >= 0.0]
    lifted = y + (factor - 1) * np.interp(x, below[:, 0], below[:, 1])
    stratum = stratum.astype(int)
    colours = layer_colours(-start / 1e3)
    colours[stratum > 0] = stratum_colours(stratum.max())[stratum[stratum > 0] - 1]
    axes.add_collection(EllipseCollection(
        2e-3 * radius, 2e-3 * radius, np.zeros(len(x)), units="xy",
        offsets=np.column_stack((x, lifted)) / 1e3, offset_transform=axes.transData,
        facecolors=colours, edgecolors="none", linewidths=0, rasterized=True), autolim=False)
    return lifted.max() / 1e3


def draw_uplift(axes, clock: str, moments: dict[float, np.ndarray]) -> None:
    """Uplift by distance from the breakaway, a line per moment."""
    colours = colormaps["viridis_r"]
    last = max(moments) or 1.0
    for extension, rows in moments.items():
        axes.plot(rows[:, 0] / 1e3, rows[:, 1], lw=1.8,
                  color=colours(0.15 + 0.8 * extension / last), label=moment_label(extension, last))
    axes.axhline(0.0, color=FAINT, lw=0.6)
    axes.axvline(0.0, color=FAINT, lw=0.6, ls=":")
    top = axes.get_ylim()[1]
    axes.text(-1.0, top, "surface of the footwall", ha="right", va="top", fontsize=8.5, color=FAINT)
    axes.text(1.0, top, "detachment", ha="left", va="top", fontsize=8.5, color=FAINT)
    axes.set_title("Uplift w(x)", loc="left", fontsize=11)
    axes.set_ylabel("m")
    axes.set_xlabel("distance from the breakaway, km")
    axes.legend(frameon=False, fontsize=9, title=clock, loc="best")


def draw(clock: str, moments: dict[float, np.ndarray], patches: np.ndarray, end: float,
         discs: np.ndarray):
    figure = new_figure(13, 8.0, 120)
    figure.set_layout_engine("constrained")
    section, profile = figure.subplots(2, 1, height_ratios=(1.5, 1.0))
    last = max(moments)
    factor = exaggeration(np.abs(moments[last][:, 1]).max())
    draw_section(figure, section, patches, end, discs, moments[last], factor)
    scale = "true to scale" if factor == 1 else f"vertical displacement × {factor}"
    section.set_title(f"After {moment_label(last, last)} of {clock}, {scale}", loc="left",
                      fontsize=11)
    if factor != 1:
        section.set_ylabel("height before bending, km")
    draw_uplift(profile, clock, moments)
    profile.set_xlim(section.get_xlim())
    without_frame(section, profile)
    return figure


def main(folder: str, data: str, figures: str, order: str) -> None:
    patches = load_array(data, "patches", columns=20, finite=False)
    discs = load_array(data, "discs", columns=5, finite=False)
    end = float(load_array(data, "end")[0])
    save(draw(*load(folder), patches, end, discs), figures, "footwall", read_order(order))


if __name__ == "__main__":
    run(main, "footwall.py RUN_DIR DATA_DIR FIGURES_DIR ORDER")
