#!/usr/bin/python3
"""Sections of runs of different grain below each other: strata on the left, strain on the right.

Usage: grain.py KM PICTURE RUN...      grain.py 2.5 grain-2.5km.png out/standard out/fine out/sandbox

The runs have figures at that extension (`listric run ... --until 2.5km`).
"""
import sys
from pathlib import Path

from PIL import Image

WIDTH = 1000   # of a section, pixels


def section(run, name):
    picture = Image.open(Path(run, "figures", name)).convert("RGB")
    return picture.resize((WIDTH, round(picture.height * WIDTH / picture.width)), Image.LANCZOS)


def main(km, picture, runs):
    rows = [[section(run, f"{kind}-{km}km.png") for kind in ("strata", "strain")] for run in runs]
    sheet = Image.new("RGB", (2 * WIDTH, sum(row[0].height for row in rows)), "white")
    top = 0
    for row in rows:
        for column, image in enumerate(row):
            sheet.paste(image, (column * WIDTH, top))
        top += row[0].height
    sheet.quantize(256).save(picture, optimize=True)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
