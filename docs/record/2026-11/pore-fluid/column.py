#!/usr/bin/env python3
"""A column of mud on a floor that sinks: a second program beside coupling/pore_column.cpp.

    python3 column.py              table of the lab book, and its convergence
    python3 column.py --cells      layers of 60 m, weight counted from the level

Equations of docs/theory/pore-fluid.md; implicit Euler, finite volumes, Newton's method with an active
set, SciPy's band solver. Lengths m, pressures Pa, per area of the column. Takes a minute a mode.
"""
import sys

import numpy as np
from scipy.linalg import solve_banded

YEAR = 31557600.0
DECAY, SURFACE = 4e-4, 0.5                    # of porosity with depth, 1/m, and at the ground
WEIGHT = (2600.0 - 1030.0) * 9.80665          # of grains in water, N/m^3
VISCOSITY, COMPRESSIBILITY, REBOUND = 5e-4, 4.4e-10, 0.1
FRACTURE = 0.9


def porosity_at(depth):
    return SURFACE * np.exp(-DECAY * depth)


def grains_at(depth):
    return depth + SURFACE / DECAY * np.expm1(-DECAY * depth)


def depth_under(grains):
    grains = np.maximum(grains, 0.0)
    depth = np.minimum(grains / (1.0 - SURFACE), grains + SURFACE / DECAY)
    for _ in range(40):
        depth = depth - (grains_at(depth) - grains) / (1.0 - porosity_at(depth))
    return depth


def permeability(at_fifth, porosity):
    porosity = np.maximum(porosity, 0.005)
    return at_fifth * porosity**3 / (1.0 - porosity)**2 / (0.2**3 / 0.8**2)


class Column:
    """Layers from the floor up.  cell: thickness of a fresh layer, none: what a step makes room for;
    gap_weighs: whether mud that there is not yet, up to the level, counts as weight."""

    def __init__(self, at_fifth, cell=None, gap_weighs=False):
        self.at_fifth, self.cell, self.gap_weighs = at_fifth, cell, gap_weighs
        self.grains, self.water, self.pressure, self.burial = (np.zeros(0) for _ in range(4))

    def thickness(self):
        return self.grains / (1.0 - porosity_at(self.burial))

    def above(self):
        return np.cumsum(self.grains[::-1])[::-1] - 0.5 * self.grains

    def deposit(self, floor):
        room = floor - self.thickness().sum()
        layers = 1 if self.cell is None else int(room // self.cell)
        if room <= 0.0 or layers == 0:
            return
        fresh = np.full(layers, room if self.cell is None else self.cell)
        for name, value in (("grains", (1.0 - SURFACE) * fresh), ("water", SURFACE * fresh),
                            ("pressure", 0.0 * fresh), ("burial", 0.0 * fresh)):
            setattr(self, name, np.r_[getattr(self, name), value])

    def stored(self, above, pressure):
        depth = depth_under(above - pressure / WEIGHT)
        phi = porosity_at(depth)
        e = phi / (1.0 - phi)
        slope = np.where(depth > 0.0, DECAY * phi / (WEIGHT * (1.0 - phi)**3), 0.0)
        least = porosity_at(self.burial) / (1.0 - porosity_at(self.burial))
        back = depth < self.burial
        e, slope = np.where(back, least + REBOUND * (e - least), e), np.where(back, REBOUND * slope, slope)
        swelling = 1.0 + COMPRESSIBILITY * pressure
        return self.grains * e * swelling, self.grains * (slope * swelling + e * COMPRESSIBILITY)

    def drain(self, seconds, floor):
        if not len(self.grains):
            return
        above, height = self.above(), self.thickness()
        if self.gap_weighs:
            above = above + grains_at(max(0.0, floor - height.sum()))
        k = permeability(self.at_fifth, porosity_at(self.burial))
        link = seconds * 2.0 * k[1:] * k[:-1] / (k[1:] + k[:-1]) / (VISCOSITY * 0.5 * (height[1:] + height[:-1]))
        drain = np.zeros(len(k))
        drain[-1] = seconds * k[-1] / (VISCOSITY * 0.5 * height[-1])
        most, u = FRACTURE * WEIGHT * above, self.pressure.copy()
        for step in range(200):
            water, slope = self.stored(above, u)
            missing, diagonal = water - self.water + drain * u, slope + drain
            flow = link * (u[:-1] - u[1:])
            missing[:-1] += flow
            missing[1:] -= flow
            diagonal[:-1] += link
            diagonal[1:] += link
            bound = u - missing / diagonal > most
            matrix = np.zeros((3, len(u)))
            matrix[1], matrix[0, 1:], matrix[2, :-1] = diagonal, -link, -link
            right = np.where(bound, most - u, -missing)
            matrix[1, bound] = 1.0
            matrix[0, 1:][bound[:-1]] = 0.0
            matrix[2, :-1][bound[1:]] = 0.0
            change = solve_banded((1, 1), matrix, right) if len(u) > 1 else right / matrix[1]
            u = u + (1.0 if step < 8 else 0.5) * change
            if np.max(np.abs(change)) < 1.0:
                break
        else:
            raise SystemExit("Newton's method does not converge")
        flow = link * (u[:-1] - u[1:])
        self.water[:-1] -= flow
        self.water[1:] += flow
        self.water -= drain * u
        self.water -= np.where(bound, np.maximum(0.0, self.water - self.stored(above, u)[0]), 0.0)
        self.pressure, self.burial = u, np.maximum(self.burial, depth_under(above - u / WEIGHT))


def sunk(at_fifth, distance, steps, **options):
    column = Column(at_fifth, **options)
    for step in range(1, steps + 1):
        floor = distance * step / steps
        column.deposit(floor)
        column.drain(1e6 * YEAR / steps, floor)
    return column


def line(at_fifth, distance, steps, **options):
    column = sunk(at_fifth, distance, steps, **options)
    height = column.thickness()
    depth = np.cumsum(height[::-1])[::-1] - 0.5 * height
    gap = distance - height.sum()
    ratio, phi = column.pressure / (WEIGHT * column.above()), porosity_at(column.burial)
    at = [z for z in (1e3, 2e3, 4e3, 6e3) if z < distance]
    numbers = lambda values: " ".join(f"{np.interp(z, depth[::-1], values[::-1]):.4f}" for z in at)
    print(f"{at_fifth:g} {distance / 1e3:g} km {steps:5d} steps  lambda* {numbers(ratio)}  phi {numbers(phi)}  "
          f"base {ratio[0]:.4f} {column.pressure[0] / 1e6:.2f} MPa  grains {column.grains.sum() / 1e3:.4f} km  "
          f"gap {gap:.0f} m", flush=True)


if __name__ == "__main__":
    if "--cells" in sys.argv:
        for k, d in ((1e-16, 9e3), (1e-17, 9e3), (1e-18, 9e3), (1e-18, 3e3), (1e-19, 3e3)):
            line(k, d, 400, cell=60.0, gap_weighs=True)
    else:
        for k, d in ((1e-16, 9e3), (1e-17, 9e3), (1e-18, 9e3), (1e-19, 9e3), (1e-20, 9e3),
                     (1e-18, 3e3), (1e-19, 3e3), (1e-20, 3e3)):
            line(k, d, 400)
        for k, d in ((1e-17, 9e3), (1e-18, 9e3)):
            for n in (100, 200, 800, 1600):
                line(k, d, n)
