#!/usr/bin/python3
"""Draws docs/pictures/lis1.webp, the animation of README and home: strata over strain, a frame a snapshot.

Usage: PYTHONPATH=apps/python docs/pictures/animate.py RUN [PICTURE.webp]

RUN is the folder of a finished run, such as out/lis1 of `./listric run lis1`. Needs python3-matplotlib,
python3-pil and python3-h5py. It is quicker after `./listric export surfaces RUN` and `export faults RUN`.
"""
import io
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap, LinearSegmentedColormap
from PIL import Image

import listric

HERE = Path(__file__).resolve().parent
SPACING = 60.0                       # of the grid that colours are drawn on, m
WIDE, DEEP = (-1.5, 50.5), (15.6, -1.1)  # km
FRAME, LAST_FRAME = 380, 2400        # ms
STRAIN = LinearSegmentedColormap.from_list(
    "strain", ["#f4f1ea", "#f1d9a7", "#e8a15c", "#cf5a3c", "#8a2040", "#35102e"])
BANDS = ["#c9b79b", "#b9a686"]       # of pre-rift rock, by km of depth
GROUND, SKY, INK = "#7f8a91", "#ffffff", "#1d2730"


def strata_colours(count):
    return ListedColormap(plt.get_cmap("viridis")(np.linspace(0.0, 1.0, max(count, 2))))


def stratum_picture(snapshot):
    """Bands of pre-rift rock as 0 and 1, sediment as 2 + its stratum."""
    _, _, stratum = snapshot.raster("stratum", SPACING)
    x, depth, start = snapshot.raster("start_y", SPACING)
    band = np.where(np.isnan(start), np.nan, np.floor(-start / 1000.0) % 2)
    return x, depth, np.where(stratum > 0, 1.0 + np.asarray(stratum), band)


def base(snapshot):
    """The detachment as it stands, in km."""
    for line in snapshot.lines("surfaces"):
        if line["name"] == "detachment":
            return np.asarray(line["x_m"]) / 1e3, np.asarray(line["depth_m"]) / 1e3
    raise SystemExit("no detachment in this run")


def draw_section(axes, picture, colours, norm, detachment):
    x, depth, values = picture
    axes.set_facecolor(SKY)
    axes.imshow(np.ma.masked_invalid(values), cmap=colours, norm=norm, interpolation="nearest",
                extent=(x[0] / 1e3, x[-1] / 1e3, depth[-1] / 1e3, depth[0] / 1e3))
    foot_x, foot_z = detachment
    axes.fill(np.r_[WIDE[0] - 1, WIDE[0] - 1, foot_x, WIDE[1] + 20, WIDE[1] + 20],
              np.r_[20.0, foot_z[0], foot_z, foot_z[-1], 20.0], color=GROUND, zorder=2, lw=0)
    axes.set(xlim=WIDE, ylim=DEEP, aspect="equal", yticks=(0, 5, 10, 15))
    axes.tick_params(length=2, labelsize=8, colors=INK)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def draw_faults(axes, snapshot):
    for fault in snapshot.lines("faults"):
        axes.plot(np.asarray(fault["x_m"]) / 1e3, np.asarray(fault["depth_m"]) / 1e3, color=INK, lw=1.1,
                  zorder=3)


def frame(name, snapshot, deposits, strain_end=0.4):
    figure, (above, below) = plt.subplots(2, 1, figsize=(7.6, 5.3), dpi=125, sharex=True,
                                          layout="constrained")
    detachment = base(snapshot)
    extension = snapshot.extension_m / 1e3
    count = 2 + deposits
    colours = ListedColormap(np.vstack([plt.matplotlib.colors.to_rgba_array(BANDS),
                                        strata_colours(deposits).colors]))
    norm = BoundaryNorm(np.arange(-0.5, count + 0.5), count)
    draw_section(above, stratum_picture(snapshot), colours, norm, detachment)
    draw_section(below, snapshot.raster("window_tectonic_strain", SPACING), STRAIN,
                 plt.Normalize(0.0, strain_end), detachment)
    if extension > 0.01:
        draw_faults(below, snapshot)
    above.set_title(f"{name}: {extension:.1f} km of extension, {extension / 10.0:.2f} Myr", loc="left",
                    fontsize=11, color=INK)
    above.set_title("syn-rift strata, each 0.05 Myr", loc="right", fontsize=9, color=INK)
    below.set_title("shear strain of the last 500 m, without compaction; lines: active faults", loc="right", fontsize=9,
                    color=INK)
    below.set_xlabel("km", fontsize=9, color=INK)
    for axes in (above, below):
        axes.set_ylabel("depth, km", fontsize=9, color=INK)
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    plt.close(figure)
    return Image.open(buffer).convert("RGB")


def main(folder, picture):
    run = listric.Run(folder)
    snapshots = list(run.snapshots)
    deposits = int(np.max(snapshots[-1].discs["stratum"]))
    frames = [frame(Path(folder).name, snapshot, deposits) for snapshot in snapshots]
    frames[0].save(picture, save_all=True, append_images=frames[1:], loop=0, quality=65, method=6,
                   duration=[FRAME] * (len(frames) - 1) + [LAST_FRAME])
    print(f"{picture}: {len(frames)} frames, {Path(picture).stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2] if len(sys.argv) == 3 else HERE / "lis1.webp")
