#!/usr/bin/env python3
"""Does a section of mud drain to its sides? Its depocentre beside a column with its own burial.

    python3 docs/record/2026-11/pore-fluid/section.py RUN [RUN ...]

For 4 and 10 km of extension of runs of lis1-mud and the sediment at x = 2.5 to 5 km: overpressure ratio and porosity at depths, then
those of two columns of column.py, which are fed with the grains of its strata, each at its time: one as it is, one with a sink, the
sideways part d(darcy_x)/dx of the divergence of flow at the discs of each stratum on their way, from the run's snapshots.
"""
import sys
from pathlib import Path

import column as mud
import numpy as np
from scipy.spatial import cKDTree

sys.path.insert(0, str(Path(__file__).resolve().parents[4] / "apps/python"))
import listric

LEFT, RIGHT, NEAR = 2500.0, 5000.0, 700.0           # m
DEPTHS = (1e3, 2e3, 3e3, 4e3, 6e3)
STEP, STRATUM, YEARS_PER_METRE = 2500.0, 10_000.0, 100.0   # a, a, of lis1-mud
LAYERS = 4                                          # of the column in a stratum
COLUMNS = ("id", "x", "y", "mass", "stratum", "darcy_x", "excess_pressure", "wanted_porosity", "porosity")


def sediment(moment):
    wet = np.asarray(moment.discs["stratum"]) > 0
    return {name: np.asarray(moment.discs[name])[wet] for name in COLUMNS}


def sideways(s, chosen):
    """d(darcy_x)/dx at the chosen discs by a plane through the discs within NEAR, 1/s."""
    tree = cKDTree(np.column_stack((s["x"], s["y"])))
    slopes = np.zeros(len(chosen))
    for n, i in enumerate(chosen):
        near = tree.query_ball_point((s["x"][i], s["y"][i]), NEAR)
        if len(near) >= 12:
            a = np.column_stack((np.ones(len(near)), s["x"][near] - s["x"][i], s["y"][near] - s["y"][i]))
            slopes[n] = np.linalg.lstsq(a, s["darcy_x"][near], rcond=None)[0][1]
    return slopes


def mean_by(strata, numbers, values):
    """Mean of values in each stratum; NaN where it has none."""
    return np.array([values[strata == k].mean() if (strata == k).any() else np.nan for k in numbers])


def fed(grains, times, until, sink=None):
    """Pressure and porosity by stratum of a column that gets grains (m) at times (a); sink(stratum, time), 1/s."""
    c, owner = mud.Column(1e-18), np.zeros(0, int)
    for now in np.arange(STEP, until + 1.0, STEP):
        for k in np.flatnonzero((times > now - STEP - 1.0) & (times <= now - 1.0)):   # at the moment's end, as in a run
            fresh = np.full(LAYERS, grains[k] / LAYERS)
            for name, value in (("grains", fresh), ("water", fresh * mud.SURFACE / (1.0 - mud.SURFACE)),
                                ("pressure", 0.0 * fresh), ("burial", 0.0 * fresh)):
                setattr(c, name, np.r_[getattr(c, name), value])
            owner = np.r_[owner, np.full(LAYERS, k)]
        if sink and len(owner):
            c.water -= np.array([sink(k, now) for k in owner]) * c.thickness() * STEP * mud.YEAR
        c.drain(STEP * mud.YEAR, None)
    values = [v.reshape(-1, LAYERS).mean(axis=1) for v in (c.pressure, mud.porosity_at(c.burial))]
    return [np.pad(v, (0, len(grains) - len(v)), constant_values=np.nan) for v in values]


def compare(run, extension):
    last = sediment(run.at(extension))
    chosen = (last["x"] >= LEFT) & (last["x"] <= RIGHT)
    strata = last["stratum"][chosen]
    numbers = np.unique(strata)
    of = {name: mean_by(strata, numbers, last[name][chosen]) for name in COLUMNS}
    depth = -of["y"]
    grains = np.array([last["mass"][chosen][strata == k].sum() for k in numbers]) / 2600.0 / (RIGHT - LEFT)
    # The program's height of grains is depth times their mean share: what is between discs counts as they do.
    thickness = grains / (1.0 - of["porosity"])
    reached = np.cumsum(thickness[::-1])[::-1] - 0.5 * thickness
    upper = (reached > 500.0) & (reached < 0.7 * reached.max())   # strata from side to side
    grains *= (depth * reached)[upper].sum() / (reached**2)[upper].sum()

    times, ids, at, slopes = STRATUM * numbers, last["id"][chosen], [], []
    for snapshot in run.snapshots:
        if 0.0 < snapshot.extension_m <= extension + 1.0:
            s = sediment(snapshot)
            here = np.flatnonzero(np.isin(s["id"], ids))
            if len(here):
                at.append(YEARS_PER_METRE * snapshot.extension_m)
                slopes.append(mean_by(s["stratum"][here], numbers, sideways(s, here)))
    at, slopes = np.array(at), np.array(slopes)

    def sink(k, now):
        known = np.isfinite(slopes[:, k])
        return np.interp(now, at[known], slopes[known, k])

    until = YEARS_PER_METRE * extension
    laid_down = np.where(times < until - 1.0, grains, 0.0)   # the newest stratum weighs from the next update on
    weight = mud.WEIGHT * (np.cumsum(laid_down[::-1])[::-1] - 0.5 * laid_down)
    pairs = [(of["excess_pressure"], of["wanted_porosity"]), fed(grains, times, until), fed(grains, times, until, sink)]
    print(f"{run.folder} {extension / 1e3:g} km, grains {grains.sum():.0f} m; section, column, column with sideways flow")
    for z in DEPTHS:
        near = np.flatnonzero((np.abs(depth - z) < 300.0) & (laid_down > 0.0))
        if len(near):
            print(f"  {z / 1e3:g} km  lambda*", *(f"{(u[near] / weight[near]).mean():.3f}" for u, _ in pairs),
                  " porosity", *(f"{phi[near].mean():.3f}" for _, phi in pairs), flush=True)


for folder in sys.argv[1:]:
    for extension in (4000.0, 10_000.0):
        compare(listric.Run(folder), extension)
