#!/usr/bin/python3
"""Distance between the cutoffs of faults above and below a layer that was level.

Usage: cutoffs.py RUN_DIR TOP_M BOTTOM_M TRAVEL_M

Reads the snapshot nearest to a travel.  Two horizons, two mean diameters thick, lie above the layer's
top and below its bottom.  Where normal faults cut a horizon it has become longer; the distance is the
area between the cumulated shares of this stretch of both horizons, along the beds as they lay at the start.
"""
import glob
import re
import sys

import h5py
import numpy as np


def snapshot(folder: str, travel: float) -> tuple[dict[str, np.ndarray], float]:
    """Columns of pre-rift discs, and their mean diameter, m."""
    def off(path: str) -> float:
        return abs(float(re.search(r"extension-([\d.]+)m", path)[1]) - travel)
    with h5py.File(min(glob.glob(f"{folder}/snapshots/*.h5"), key=off)) as file:
        is_rock = file["discs/stratum"][:] == 0
        columns = {name: file["discs"][name][:][is_rock] for name in ("start_x", "start_y", "x", "y")}
        return columns, 2.0 * float(file.attrs["mean_radius"])


def stretch(discs: dict[str, np.ndarray], top: float, bottom: float, places: np.ndarray) -> np.ndarray:
    """Growth of a horizon between two depths, m, in each of the even steps between places at the start."""
    lies = (-discs["start_y"] > top) & (-discs["start_y"] < bottom)
    start, x, y = (discs[name][lies] for name in ("start_x", "x", "y"))
    step = places[1] - places[0]
    weights = np.exp(-0.5 * ((start - places[:, None]) / step) ** 2)
    weights /= weights.sum(axis=1, keepdims=True)
    return np.maximum(np.hypot(np.diff(weights @ x), np.diff(weights @ y)) - step, 0.0)


def main(folder: str, top: float, bottom: float, travel: float) -> None:
    discs, diameter = snapshot(folder, travel)
    places = np.arange(12e3, discs["start_x"].max() - 500.0, diameter)
    above = stretch(discs, top - 2.0 * diameter, top, places)
    below = stretch(discs, bottom, bottom + 2.0 * diameter, places)
    shares = [np.cumsum(one / one.sum()) for one in (above, below)]
    print(f"stretch above {above.sum():.0f} m, below {below.sum():.0f} m; "
          f"distance of cutoffs {np.abs(shares[0] - shares[1]).sum() * diameter:.0f} m")


if __name__ == "__main__":
    main(sys.argv[1], *map(float, sys.argv[2:5]))
