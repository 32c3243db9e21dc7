#!/usr/bin/python3
"""Discs and bonds of a Listric run as a GSD file, for OVITO.

Usage: trajectory.py DATA_DIR FILE ROCK...

Every folder in DATA_DIR is a moment, with an array per file, by row of the discs:
x_m, y_m (up), rock (number of ROCK), of-NAME for every other property; bonded has
pairs of rows, moment cycle and extension.  In FILE discs are sorted by id.
"""
import os
import sys
import warnings

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
warnings.simplefilter("ignore", FutureWarning)  # gsd 2.7 compares types with words
from script import library, run

np = library("numpy")
gsd = library("gsd")
library("gsd.hoomd")

Frame = getattr(gsd.hoomd, "Frame", None) or gsd.hoomd.Snapshot  # its name before gsd 2.8
WHOLE = {"id", "stratum", "coordination", "bonds"}  # other properties are in single precision


def load(folder):
    """Arrays of a moment by name."""
    return {os.path.splitext(name)[0]: np.load(os.path.join(folder, name))
            for name in sorted(os.listdir(folder))}


def make_frame(data, rocks):
    """A moment as gsd has it: a section of thickness 1 around the origin."""
    order = np.argsort(data["of-id"])
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    radius = data["of-radius_m"][order]
    place = np.column_stack([data["x_m"], data["y_m"], np.zeros(len(order))])[order]
    frame = Frame()
    cycle, extension = data["moment"]
    reach = np.abs(place[:, :2]).max(axis=0) + radius.max()
    frame.configuration.step = int(cycle)
    frame.configuration.dimensions = 2
    frame.configuration.box = [2 * reach[0], 2 * reach[1], 1, 0, 0, 0]
    frame.particles.N = len(order)
    frame.particles.types = rocks
    frame.particles.typeid = data["rock"][order]
    frame.particles.position = place
    frame.particles.diameter = 2 * radius
    bonds = rank[data["bonded"].reshape(-1, 2)]
    frame.bonds.N = len(bonds)
    frame.bonds.types = ["bond"]
    frame.bonds.typeid = np.zeros(len(bonds), np.uint32)
    frame.bonds.group = bonds
    frame.log = {"particles/" + name[3:]:
                 values[order].astype(np.int32 if name[3:] in WHOLE else np.float32)
                 for name, values in data.items() if name.startswith("of-")}
    frame.log["extension_m"] = np.array([extension])
    return frame


def main(folder, file, *rocks):
    """Writes under another name first, so that the file is complete or the old one."""
    half = file + ".tmp"
    with gsd.hoomd.open(half, "wb") as out:
        for name in sorted(os.listdir(folder)):
            out.append(make_frame(load(os.path.join(folder, name)), list(rocks)))
    os.replace(half, file)


if __name__ == "__main__":
    run(main, "trajectory.py DATA_DIR FILE [ROCK]...")
