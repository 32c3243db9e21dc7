#!/usr/bin/python3
"""Draws docs/pictures/validation/validation.webp: criteria of faulting by experiment, a square per seed.

Usage: docs/pictures/validation.py FOLDER [PICTURE.webp]

FOLDER holds the verdicts.json that `listric validate` wrote beside its document. Needs python3-matplotlib
and python3-pil.
"""
import io
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "apps/figures/python"))
import plot
import verdicts
from PIL import Image


def main(folder, picture):
    figure = verdicts.draw(plot.read_json(str(Path(folder) / "verdicts.json")))
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    Image.open(buffer).convert("RGB").save(picture, lossless=True, method=6)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2] if len(sys.argv) == 3 else HERE / "validation/validation.webp")
