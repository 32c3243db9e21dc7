#!/usr/bin/python3
"""Where the way back strains rock, and how a graben's relief changes on it.

Usage: way_back.py TURN_M RUN_DIR...

Prints, for each run with `[[stage]]`, the graben's relief at the turn, 500 m after it and in the end, as
`pop_up_m` takes it; and of the pre-rift rock more than 2 km above the detachment's flat (15 km deep) the share of
strain in the tenth most strained, out and back, and the rank correlation of both where either is above 0.2.
"""
import glob
import re
import sys

import h5py
import numpy as np
from scipy.stats import spearmanr

SMOOTH = 2.5e3  # m, as in graben_relief
LAST = 1e9     # m of travel


def snapshot(folder: str, travel: float) -> tuple[dict[str, np.ndarray], float]:
    """Columns of discs of the snapshot nearest to a travel, and their mean diameter, m."""
    def off(path: str) -> float:
        return abs(float(re.search(r"extension-([\d.]+)m", path)[1]) - travel)
    with h5py.File(min(glob.glob(f"{folder}/snapshots/*.h5"), key=off)) as file:
        return {name: column[:] for name, column in file["discs"].items()}, 2.0 * float(file.attrs["mean_radius"])


def relief(discs: dict[str, np.ndarray], diameter: float) -> float:
    """Fall of the pre-rift top from the rollover's crest into the graben, m."""
    left = discs["x"].min()
    tops = np.full(int((discs["x"].max() - left) / diameter), np.nan)
    rock = discs["stratum"] == 0
    columns = ((discs["x"][rock] - left) / diameter).astype(int)
    for column, top in zip(columns, (discs["y"] + discs["radius"])[rock]):
        if column < tops.size:
            tops[column] = np.fmax(tops[column], top)
    reach = int(0.5 * SMOOTH / diameter)
    means = np.array([np.nanmean(tops[max(0, k - reach):k + reach + 1])
                      for k in range(tops.size) if not np.isnan(tops[max(0, k - reach):k + reach + 1]).all()])
    return float(np.max(np.maximum.accumulate(means) - means))


def share_of_tenth(strain: np.ndarray, area: np.ndarray) -> float:
    """Share of strain in the tenth of the area that is strained most."""
    order = np.argsort(-strain)
    in_tenth = np.cumsum(area[order]) <= 0.1 * area.sum()
    return float((strain * area)[order][in_tenth].sum() / (strain * area).sum())


def main(turn: float, folders: list[str]) -> None:
    for folder in folders:
        heights = [relief(*snapshot(folder, travel)) for travel in (turn, turn + 500.0, LAST)]
        discs, _ = snapshot(folder, LAST)
        rock = (discs["stratum"] == 0) & (discs["y"] > -13e3)
        out = discs["turn_strain"][rock]
        back = np.maximum(0.0, discs["total_strain"][rock] - out)
        area = discs["radius"][rock] ** 2
        strained = (out > 0.2) | (back > 0.2)
        print(f"{folder}: relief {heights[0]:.0f}, {heights[1]:.0f}, {heights[2]:.0f} m; most strained tenth "
              f"{share_of_tenth(out, area):.2f} out, {share_of_tenth(back, area):.2f} back; "
              f"rank correlation {spearmanr(out[strained], back[strained])[0]:.3f}")


if __name__ == "__main__":
    main(float(sys.argv[1]), sys.argv[2:])
