#!/usr/bin/python3
"""Draws the sections of README and gallery: SCENE-10km.webp, lis1-5km.webp and the small ones.

Usage: PYTHONPATH=apps/python docs/pictures/pictures.py RUNS [SCENE...]

RUNS has folders of finished runs named by their scenes: lis1, lis2, rfr, lis1-elastic. Needs what animate.py needs.
"""
import io
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap, to_rgba_array
from PIL import Image

import animate
import listric

SCENES = ("lis1", "lis2", "rfr", "lis1-elastic", "lis2-elastic", "rfr-elastic")
SMALL = SCENES[:4]


def small(snapshot, deposits):
    """Strata alone, without axes."""
    figure, axes = plt.subplots(figsize=(4.4, 1.5), dpi=100)
    count = 2 + deposits
    colours = ListedColormap(np.vstack([to_rgba_array(animate.BANDS),
                                        animate.strata_colours(deposits).colors]))
    animate.draw_section(axes, animate.stratum_picture(snapshot), colours,
                         BoundaryNorm(np.arange(-0.5, count + 0.5), count), animate.base(snapshot))
    axes.axis("off")
    figure.subplots_adjust(0, 0, 1, 1)
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    plt.close(figure)
    return Image.open(buffer).convert("RGB")


def bent_footwall(picture):
    """The upper panel of figures/footwall.png, where an elastic footwall shows more than strata do."""
    return Image.open(picture).convert("RGB").crop((76, 88, 1236, 484)).resize((440, 150), Image.LANCZOS)


def save(image, name):
    path = animate.HERE / f"scenes/{name}.webp"
    image.save(path, quality=70, method=6)
    print(f"{path.name}: {path.stat().st_size / 1e3:.0f} kB")


def main(runs, scenes):
    for scene in scenes:
        run = listric.Run(runs / scene)
        last = run.at(10e3)
        deposits = int(np.max(last.discs["stratum"]))
        save(animate.frame(scene, last, deposits), f"{scene}-10km")
        if scene not in SMALL:
            continue
        bent = runs / scene / "figures/footwall.png"
        save(bent_footwall(bent) if bent.exists() else small(last, deposits), f"{scene}-small")
        if scene == "lis1":
            save(animate.frame(scene, run.at(5e3), deposits), "lis1-5km")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), sys.argv[2:] or SCENES)
