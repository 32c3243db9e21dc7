"""Columns of discs on a regular grid."""

from typing import NamedTuple

import numpy as np

from .errors import BadValue, finite_number
from .table import Column, Table

_MOST_CELLS = 3 * 10**7  # 0.7 GB


class Raster(NamedTuple):
    """Values at the middles of square cells, as `pyplot.pcolormesh(*raster)` draws them; depth then
    grows upward unless its axis is inverted.

    x       shape (columns,), m from the breakaway
    depth   shape (rows,), m, positive down from the original surface, ascending
    values  shape (rows, columns), NaN where no disc is; `values.units`
    """

    x: Column
    depth: Column
    values: Column


def draw_raster(discs: Table, values: Column, spacing: float, extent, reach: float) -> Raster:
    """Every cell has the value of the disc to whose power cell its middle belongs: the disc for
    which distance^2 - radius^2 is least, among those whose rim is not further away than `reach` (m).
    That closes the pores between discs; at the free surface rock is thicker by up to as much.

    Radii are those of the rock; a weakened disc's own is that of a spring.
    """
    spacing = finite_number("spacing", spacing, "give metres, such as spacing=100.0")
    if not spacing > 0.0:
        raise BadValue(f"spacing = {spacing}: must be above 0 m")
    x, depth, radius = np.asarray(discs["x"]), -discs["y"], _rock_radius(discs)
    if extent is None:
        margin = radius + reach
        extent = (*_span(x, margin), *_span(depth, margin))
    elif not np.iterable(extent) or len(extent := list(extent)) != 4:
        raise BadValue(f"extent = {extent!r}: needs four numbers in m: least x, greatest x, least depth, "
                       "greatest depth")
    extent = [finite_number("extent", one, "give metres") for one in extent]
    # Grids of any extent have their cells at the same places: multiples of the spacing.
    first_column, first_row = (int(np.floor(low / spacing)) for low in extent[::2])
    columns = max(0, int(np.ceil(extent[1] / spacing)) - first_column)
    rows = max(0, int(np.ceil(extent[3] / spacing)) - first_row)
    if rows * columns > _MOST_CELLS:
        raise BadValue(f"spacing = {spacing}: gives {rows * columns:.1e} cells; at most {_MOST_CELLS:.0e}: take "
                       "a larger spacing or a smaller extent")
    owner = _owners(x / spacing - first_column - 0.5, depth / spacing - first_row - 0.5,
                    radius / spacing, reach / spacing, (rows, columns))
    drawn = np.full(rows * columns, np.nan)
    drawn[owner >= 0] = values[owner[owner >= 0]]
    return Raster(Column((first_column + 0.5 + np.arange(columns)) * spacing, "m"),
                  Column((first_row + 0.5 + np.arange(rows)) * spacing, "m"),
                  Column(drawn.reshape(rows, columns), values.units))


def _rock_radius(discs: Table) -> np.ndarray:
    radius = np.asarray(discs["radius"])
    if "rock_radius" not in discs:
        return radius
    rock = np.asarray(discs["rock_radius"])
    return np.where(rock > 0.0, rock, radius)


def _span(centre, margin):
    return (np.min(centre - margin), np.max(centre + margin)) if len(centre) else (0.0, 0.0)


def _owners(x, depth, radius, reach, shape) -> np.ndarray:
    """Row of the disc of every cell, -1 for none; lengths in cells, cell (0, 0) at the origin."""
    rows, columns = shape
    least = np.full(rows * columns, np.inf)
    owner = np.full(rows * columns, -1)
    widest = int(np.ceil(np.max(radius, initial=0.0) + reach))
    nearest_column, nearest_row = np.rint(x).astype(int), np.rint(depth).astype(int)
    for down in range(-widest, widest + 1):
        for right in range(-widest, widest + 1):
            row, column = nearest_row + down, nearest_column + right
            square = (column - x) ** 2 + (row - depth) ** 2
            here = np.flatnonzero((square <= (radius + reach) ** 2) & (row >= 0) & (row < rows)
                                  & (column >= 0) & (column < columns))
            power = square[here] - radius[here] ** 2
            cell = row[here] * columns + column[here]
            nearer = power < least[cell]
            here, power, cell = here[nearer], power[nearer], cell[nearer]
            # Of discs in one cell the last that is written stays: the one of least power.
            order = np.argsort(-power, kind="stable")
            least[cell[order]] = power[order]
            owner[cell[order]] = here[order]
    return owner
