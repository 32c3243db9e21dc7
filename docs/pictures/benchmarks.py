#!/usr/bin/python3
"""Makes docs/pictures/benchmarks/NAME.webp of the pictures of `listric validate --plan benchmarks`.

Usage: docs/pictures/benchmarks.py FOLDER

FOLDER is the one beside the document, out/benchmarks-standard/benchmarks. Needs python3-pil.
"""
import sys
from pathlib import Path

from PIL import Image

HERE = Path(__file__).resolve().parent / "benchmarks"
WIDTH = 1100   # pixels


def main(folder):
    HERE.mkdir(exist_ok=True)
    for file in sorted(Path(folder).glob("*.png")):
        if file.stem == "verdicts":
            continue
        picture = Image.open(file).convert("RGB")
        size = (WIDTH, round(picture.height * WIDTH / picture.width))
        picture.resize(size, Image.LANCZOS).save(HERE / f"{file.stem}.webp", quality=72, method=6)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
