#!/usr/bin/python3
"""Figures of a Listric run.

Usage: figures.py KIND DATA_DIR FIGURES_DIR [ORDER]

Every folder in DATA_DIR is a frame (frame.py says what it holds).  KIND is
  sections    of every frame: strata-, bonds-, behaviour-, strain-, sediment-,
              kinematics- and overview-<extension>km.png
  experiment  all frames side by side: experiment-<extension>km.png
  animation   one picture per frame: animation-<extension>km.mp4, or .gif
              where there is no ffmpeg
  gallery     frames of different runs below each other, small: gallery.png
  multiples   the strain of frames of different runs in a grid: multiples.png
ORDER is a JSON object: formats, in which sections and experiments are written, and what pictures
say of their origin: software, provenance (null: of no single run).
Every file is written under a temporary name and then renamed.  On bad input: one
line on stderr, exit status 2.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import STYLE, InputError, Order, matplotlib, read_order, run

from animation import save_animation
from frame import load_frame
from sections import save_sections
from sheet import save_gallery, save_multiples, save_sheet

KINDS = {"sections": save_sections, "experiment": save_sheet, "animation": save_animation,
         "gallery": save_gallery, "multiples": save_multiples}
USAGE = f"figures.py {'|'.join(KINDS)} DATA_DIR FIGURES_DIR [ORDER]"


def main(kind: str, data: str, folder: str, order: str = "") -> None:
    if kind not in KINDS:
        raise InputError(f"usage: {USAGE}")
    if not os.path.isdir(data):
        raise InputError(f"{data}: no such directory")
    frames = [load_frame(os.path.join(data, name)) for name in sorted(os.listdir(data))]
    if not frames:
        raise InputError(f"{data}: holds no frames")
    os.makedirs(folder, exist_ok=True)
    with matplotlib.rc_context({**STYLE, "legend.fontsize": 9, "xtick.direction": "out",
                                "ytick.direction": "out"}):
        KINDS[kind](frames, folder, read_order(order) if order else Order())


if __name__ == "__main__":
    run(main, USAGE)
