#!/usr/bin/python3
"""Dips of shear zones in layers and in the rock between them, from the displacement between snapshots.

Usage: zone_dips.py RUN_DIR [TOP_M-BOTTOM_M,...]

The second argument gives bands of depth at the start in place of layers, for a run without any.  Between each
two snapshots every pre-rift disc gets the gradient of its neighbours' displacement (within 1.5 mean diameters,
least squares) and the simple shear that is nearest to it: of all directions of slip s, normal to n, the one that
leaves the least |G - g s n|.  A disc counts if its |g| is above 0.05 and in the tenth that shears most, and if no
more than half of |G| is left.  Dips are weighted by |g|; steep zones are those of 30 degrees and more.
"""
import glob
import re
import sys

import h5py
import numpy as np
from scipy.spatial import cKDTree

ANGLES = np.radians(np.arange(-90.0, 90.0))
SLIP = np.c_[np.cos(ANGLES), np.sin(ANGLES)]
NORMAL = np.c_[-np.sin(ANGLES), np.cos(ANGLES)]
STEEP = 30.0  # degrees


def snapshots(folder: str):
    """Columns of discs by rising id, and their mean radius, m, in order of travel."""
    def travel(path: str) -> float:
        return float(re.search(r"extension-([\d.]+)m", path)[1])
    for path in sorted(glob.glob(f"{folder}/snapshots/*.h5"), key=travel):
        with h5py.File(path) as file:
            order = np.argsort(file["discs/id"][:])
            yield {name: column[:][order] for name, column in file["discs"].items()}, file.attrs["mean_radius"]


def gradients(place: np.ndarray, moved: np.ndarray, reach: float) -> np.ndarray:
    """Gradient of displacement at each of n places, n x 2 x 2; not a number with fewer than five neighbours."""
    found = np.full((len(place), 2, 2), np.nan)
    for k, near in enumerate(cKDTree(place).query_ball_point(place, reach)):
        if len(near) >= 5:
            a = place[near] - place[near].mean(axis=0)
            found[k] = np.linalg.lstsq(a, moved[near] - moved[near].mean(axis=0), rcond=None)[0].T
    return found


def nearest_shear(gradient: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Dip of the slip, degrees, its |shear|, and the share of |G| that is left, for each of n gradients."""
    shear = np.abs(np.einsum("ki,dij,kj->dk", SLIP, gradient, NORMAL))
    best = shear.argmax(axis=1)
    amount = shear.max(axis=1)
    total = (gradient ** 2).sum(axis=(1, 2))
    return np.abs(np.degrees(ANGLES[best])), amount, np.sqrt(np.maximum(0.0, 1.0 - amount ** 2 / total))


def layers_of(discs: dict[str, np.ndarray], bands: list[list[float]]) -> np.ndarray:
    """1 in a layer or band, 0 between, -1 above the first and below the last."""
    depth = -discs["start_y"]
    if bands:
        inside = np.any([(depth > top) & (depth < bottom) for top, bottom in bands], axis=0)
    else:
        inside = discs["layer"] > 0
    first, last = (bands[0][0], bands[-1][1]) if bands else (depth[inside].min(), depth[inside].max())
    return np.where((depth < first) | (depth > last), -1, inside.astype(int))


def zones(folder: str, bands: list[list[float]]) -> np.ndarray:
    """Rows of layer, dip, |shear|, depth at the start and number of the window, for each disc that counts."""
    rows, before = [], None
    for number, (now, radius) in enumerate(snapshots(folder)):
        if before is not None:
            _, i, j = np.intersect1d(before["id"], now["id"], return_indices=True)
            rock = before["stratum"][i] == 0
            i, j = i[rock], j[rock]
            place = np.c_[before["x"][i], before["y"][i]]
            gradient = gradients(place, np.c_[now["x"][j], now["y"][j]] - place, 3.0 * radius)
            known = np.isfinite(gradient).all(axis=(1, 2))
            dip, shear, left = nearest_shear(gradient[known])
            where = layers_of(before, bands)[i][known]
            counts = (shear > max(0.05, np.quantile(shear, 0.9))) & (left <= 0.5) & (where >= 0)
            depth = -before["start_y"][i][known]
            rows.append(np.c_[where, dip, shear, depth, np.full(len(dip), number)][counts])
        before = now
    return np.concatenate(rows)


def weighted(values: np.ndarray, weights: np.ndarray) -> tuple[float, float]:
    mean = np.average(values, weights=weights)
    return mean, np.sqrt(np.average((values - mean) ** 2, weights=weights))


def main(folder: str, bands: list[list[float]]) -> None:
    rows = zones(folder, bands)
    for depths in ((0.0, 15e3), (0.0, 4e3), (4e3, 8e3), (8e3, 15e3)):
        for name, layer in (("in", 1), ("between", 0)):
            some = rows[(rows[:, 0] == layer) & (rows[:, 3] > depths[0]) & (rows[:, 3] < depths[1])]
            steep = some[some[:, 1] >= STEEP]
            if len(steep) > 1:
                print(f"{folder} {depths[0] / 1e3:.0f} to {depths[1] / 1e3:.0f} km, {name}: steep zones "
                      "{:.1f} +- {:.1f} degrees".format(*weighted(steep[:, 1], steep[:, 2])),
                      f"({len(steep)} discs), {steep[:, 2].sum() / some[:, 2].sum():.2f} of all shear")


if __name__ == "__main__":
    main(sys.argv[1], [list(map(float, band.split("-"))) for band in sys.argv[2].split(",")] if len(sys.argv) > 2 else [])
