#!/usr/bin/python3
"""Pictures of the guide from those of grain.py, whose runs are not kept: each panel without its headline and small print, which
said "Ma" for a duration and "standard" for all rows, with a letter, the grain and the duration of a stratum.

Usage: relabel.py PICTURE TO      relabel.py grain-10.0km.png ../../../pictures/grain-10km.webp
"""
import sys

import numpy as np
from PIL import Image, ImageDraw, ImageFont

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans{}.ttf"
GRAINS = ("standard, mean radius 93 m", "fine, mean radius 47 m", "sandbox, mean radius 18.6 m")
LINES = 7       # of ink in a row of panels: headline, heading, ..., label of the axis, two of small print
WIDTH = 1600    # pixels
HEAD = 30       # above a panel, pixels


def lines_of(picture, axis=1):
    """Begin and end of each run of rows that hold ink; of columns with axis 0."""
    ink = (np.asarray(picture.convert("L")) < 250).any(axis=axis)
    ends = np.flatnonzero(np.diff(np.concatenate(([0], ink, [0]))))
    return ends.reshape(-1, 2)


def relabelled(picture):
    lines = lines_of(picture)
    if len(lines) != 3 * LINES:
        sys.exit(f"{len(lines)} lines of ink; needs three rows of grain.py")
    bold, plain = (ImageFont.truetype(FONT.format(kind), 17) for kind in ("-Bold", ""))
    panels, half = [], picture.width // 2
    for row, grain in enumerate(GRAINS):
        top, bottom = lines[LINES * row + 1][0], lines[LINES * row + LINES - 3][1]
        panel = Image.new("RGB", (picture.width, bottom - top + HEAD + 16), "white")
        panel.paste(picture.crop((0, top, picture.width, bottom)), (0, HEAD))
        draw = ImageDraw.Draw(panel)
        for column in range(2):
            draw.text((column * half + 8, 4), "abcdef"[2 * row + column], "black", bold)
            draw.text((column * half + 58, 4), grain, "black", plain)
        left, right = lines_of(picture.crop((0, top + 20, half, bottom - 20)), axis=0)[-1]  # label of the strata's scale
        words = Image.new("RGB", (panel.height - HEAD - 40, right - left + 8), "white")
        ImageDraw.Draw(words).text((words.width / 2, 2), "Stratum, 0.05 Myr each", "black",
                                   ImageFont.truetype(FONT.format(""), 12), anchor="ma")
        panel.paste(words.rotate(90, expand=True), (left, HEAD + 16))
        panels.append(panel)
    sheet = Image.new("RGB", (picture.width, sum(panel.height for panel in panels)), "white")
    top = 0
    for panel in panels:
        sheet.paste(panel, (0, top))
        top += panel.height
    return sheet


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sheet = relabelled(Image.open(sys.argv[1]).convert("RGB"))
    sheet.resize((WIDTH, round(sheet.height * WIDTH / sheet.width)), Image.LANCZOS).save(sys.argv[2], quality=68, method=6)
