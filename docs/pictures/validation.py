#!/usr/bin/python3
"""Draws docs/pictures/validation.webp: criteria of faulting by experiment, a square per seed that meets one.

Usage: docs/pictures/validation.py RECORD.md [PICTURE.webp]

RECORD.md is what `listric validate` wrote. Needs python3-matplotlib and python3-pil.
"""
import io
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from PIL import Image

HERE = Path(__file__).resolve().parent
EXPERIMENTS = {"lis1": "LIS1", "lis2": "LIS2", "rfr": "RFR"}
MET, MISSED, INK = "#2e7d5b", "#e9e6df", "#1d2730"


def rows(text):
    """(experiment, seeds of five that meet a criterion) of the rows of kind faults."""
    found = []
    for name, title in EXPERIMENTS.items():
        section = re.search(rf"^## {title}: .*?(?=^## )", text, re.DOTALL | re.MULTILINE)[0]
        for line in section.splitlines():
            seeds = re.search(r"(\d+) (?:of|in) 5|in (\d+) of 5", line.rsplit(" | ", 1)[-1])
            if line.startswith("| faults") and seeds:
                found.append((name, int(seeds[1] or seeds[2])))
    return found


def draw(found, picture):
    figure, axes = plt.subplots(figsize=(9.0, 2.35), dpi=110, layout="constrained")
    at = 0.0
    for name, title in EXPERIMENTS.items():
        seeds = sorted((met for one, met in found if one == name), reverse=True)
        for met in seeds:
            for k in range(5):
                axes.add_patch(plt.Rectangle((at, k), 0.86, 0.86, color=MET if k < met else MISSED, lw=0))
            at += 1.0
        most = sum(met >= 3 for met in seeds)
        axes.text(at - len(seeds) / 2, 5.25, f"{title}: {most} of {len(seeds)} in most seeds", ha="center",
                  va="bottom", fontsize=10, color=INK)
        at += 1.2
    axes.text(0.0, -0.35, "each column is a criterion of faulting; each green square one of five seeds that meets it",
              va="top", fontsize=9, color=INK)
    axes.set(xlim=(-0.2, at - 1.0), ylim=(-1.0, 6.0))
    axes.axis("off")
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    Image.open(buffer).convert("RGB").save(picture, quality=88, method=6)


def main(record, picture):
    found = rows(Path(record).read_text())
    for name in (*EXPERIMENTS, None):
        seeds = [met for one, met in found if name in (one, None)]
        print(name or "all", len(seeds), *(f"{k}+: {sum(met >= k for met in seeds)}" for k in (5, 4, 3)),
              "0 or 1:", sum(met <= 1 for met in seeds), "none:", sum(met == 0 for met in seeds))
    draw(found, picture)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2] if len(sys.argv) == 3 else HERE / "validation.webp")
