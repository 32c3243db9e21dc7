#!/usr/bin/python3
"""Figure of an elastic footwall: the bent section with its stress and the discs on it, and the uplift.

Usage: footwall.py RUN_DIR DATA_DIR FIGURES_DIR

Reads RUN_DIR/footwall.csv and DATA_DIR/patches.npy and discs.npy, writes footwall.png under a temporary
name and renames it.  Vertical displacement is exaggerated, of the discs by that of the base below them.
On bad input: one line on stderr, exit status 1.
"""
import csv
import os
import sys

sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import colormaps, new_figure, run, save, without_frame

import numpy as np
from matplotlib.collections import EllipseCollection, PolyCollection

LAYERS = np.array([(0.84, 0.78, 0.67), (0.66, 0.58, 0.47)])   # pre-rift rock by depth
SEDIMENT = np.array([(0.97, 0.86, 0.45), (0.88, 0.66, 0.22)])  # syn-rift strata in turn
LAYER = 1.5        # km
DRAWN_UPLIFT = 5.0  # km, about, of the largest uplift


def load(folder):
    moments = {}
    with open(os.path.join(folder, "footwall.csv"), encoding="utf-8") as file:
        for row in csv.DictReader(file):
            moments.setdefault(float(row["extension_m"]), []).append(
                (float(row["x_m"]), float(row["uplift_m"])))
    if not moments:
        raise ValueError("footwall.csv has no moment")
    return {extension: np.array(rows) for extension, rows in sorted(moments.items())}


def exaggeration(largest):
    return max([n for n in (1, 2, 5, 10, 20, 50, 100) if n * largest / 1e3 <= DRAWN_UPLIFT], default=1)


def draw_section(figure, axes, patches, discs, uplift, factor):
    corners = patches[:, :16].reshape(-1, 4, 4)
    shape = np.stack((corners[..., 0] + corners[..., 2], corners[..., 1] + factor * corners[..., 3]),
                     axis=-1) / 1e3
    xx, yy, xy = patches[:, 16:].T
    shear = np.hypot(0.5 * (xx - yy), xy) / 1e6
    rock = PolyCollection(shape, array=shear, cmap="magma_r", edgecolors="face", linewidths=0.2)
    rock.set_clim(0.0, np.ceil(np.percentile(shear, 99.0) / 50.0) * 50.0)
    axes.add_collection(rock, autolim=False)
    x, y, radius, stratum, start = discs.T
    below = uplift[uplift[:, 0] >= 0.0]
    lifted = y + (factor - 1) * np.interp(x, below[:, 0], below[:, 1])
    colours = np.where((stratum > 0)[:, None], SEDIMENT[stratum.astype(int) % 2],
                       LAYERS[np.clip(-start / 1e3 // LAYER, 0, None).astype(int) % 2])
    axes.add_collection(EllipseCollection(
        2e-3 * radius, 2e-3 * radius, np.zeros(len(x)), units="xy",
        offsets=np.column_stack((x, lifted)) / 1e3, transOffset=axes.transData, facecolors=colours,
        edgecolors="none", linewidths=0), autolim=False)
    surface = uplift[uplift[:, 0] < 0.0]
    axes.set_xlim(-60.0, x.max() / 1e3 + 25.0)
    axes.set_ylim(shape[..., 1].min() - 0.5,
                  max((factor * surface[:, 1]).max() / 1e3, lifted.max() / 1e3) + 2.0)
    axes.set_aspect("equal")
    axes.axhline(0.0, color="#6b6b6b", lw=0.6, ls=(0, (6, 4)))
    axes.text(axes.get_xlim()[0] + 1.0, 0.3, "original surface", fontsize=8, color="#6b6b6b",
              va="bottom")
    axes.text(-30.0, axes.get_ylim()[0] + 8.0, "relaxed rock", fontsize=9, color="#8c7a5a",
              ha="center")
    axes.set_ylabel("height, km")
    bar = figure.colorbar(rock, ax=axes, pad=0.01, fraction=0.025, extend="max")
    bar.set_label("largest shear stress, MPa\n(change since the start)", fontsize=9)


def draw(moments, patches, discs):
    figure = new_figure(13, 8.0, 120)
    figure.set_layout_engine("constrained")
    section, profile = figure.subplots(2, 1, height_ratios=(1.5, 1.0))
    last = max(moments)
    factor = exaggeration(np.abs(moments[last][:, 1]).max())
    draw_section(figure, section, patches, discs, moments[last], factor)
    scale = "true to scale" if factor == 1 else f"vertical displacement × {factor}"
    section.set_title(f"After {last / 1e3:.1f} km of extension, {scale}", loc="left", fontsize=11)
    colours = colormaps["viridis_r"]
    for extension, rows in moments.items():
        profile.plot(rows[:, 0] / 1e3, rows[:, 1], lw=1.8,
                     color=colours(0.15 + 0.8 * extension / (last or 1.0)),
                     label=f"{extension / 1e3:.1f} km")
    profile.axhline(0.0, color="#6b6b6b", lw=0.6)
    profile.axvline(0.0, color="#6b6b6b", lw=0.6, ls=":")
    profile.text(-1.0, profile.get_ylim()[1], "surface of the footwall", ha="right", va="top",
                 fontsize=8.5, color="#6b6b6b")
    profile.text(1.0, profile.get_ylim()[1], "detachment", ha="left", va="top", fontsize=8.5,
                 color="#6b6b6b")
    profile.set_xlim(section.get_xlim())
    profile.set_title("Uplift w(x)", loc="left", fontsize=11)
    profile.set_ylabel("m")
    profile.set_xlabel("distance from the breakaway, km")
    profile.legend(frameon=False, fontsize=9, title="extension", loc="upper left")
    without_frame(section, profile)
    return figure


def main(folder, data, figures):
    patches, discs = (np.load(os.path.join(data, f"{name}.npy")) for name in ("patches", "discs"))
    save(draw(load(folder), patches, discs), figures, "footwall")


if __name__ == "__main__":
    run(main, "footwall.py RUN_DIR DATA_DIR FIGURES_DIR")
