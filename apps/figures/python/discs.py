"""Discs at true size: as shapes, or as an image where there are very many."""
import math

from frame import Frame
from page import DPI, PANEL_WIDTH

import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.colors import to_rgb

RASTER_ABOVE = 80_000     # discs; beyond this the section is painted as an image
RASTER_OVERSAMPLING = 3   # image cells per output pixel, each way


def draw_discs(ax, frame: Frame, rgb: np.ndarray, segments=(), segment_width: float = 0.5,
               alpha: np.ndarray | None = None) -> None:
    """Discs in colours rgb (n x 3), then segments: (n x 4 km, colour) pairs. They are an image in
    files of lines, too, which would be too large."""
    if len(frame.x) > RASTER_ABOVE:
        draw_raster(ax, frame, rgb, segments, alpha)
        return
    shown = slice(None) if alpha is None else alpha > 0
    ax.add_collection(EllipseCollection(
        2 * frame.radius[shown], 2 * frame.radius[shown], np.zeros(len(frame.x))[shown],
        units="xy", offsets=np.column_stack((frame.x, frame.y))[shown],
        offset_transform=ax.transData, facecolors=rgb[shown], edgecolors="none", linewidths=0,
        zorder=2, rasterized=True), autolim=False)
    for lines, colour in segments:
        if len(lines):
            ax.add_collection(LineCollection(
                lines.reshape(-1, 2, 2), colors=colour, linewidths=segment_width,
                capstyle="butt", zorder=3, rasterized=True), autolim=False)


def owner_map(frame: Frame) -> np.ndarray:
    """Index of the disc covering each cell of an image of the view (-1: none).

    Pores between such small discs are below a pixel and would only bleach the
    colours: discs are painted a little too large first, then at true size.
    """
    xmin, xmax, ymin, ymax = frame.view
    cell = (xmax - xmin) / (PANEL_WIDTH * DPI * RASTER_OVERSAMPLING)
    columns = int(math.ceil((xmax - xmin) / cell))
    rows = int(math.ceil((ymax - ymin) / cell))
    owner = np.full((rows, columns), -1, dtype=np.int32)
    cx, cy = (frame.x - xmin) / cell, (ymax - frame.y) / cell
    column0, row0 = np.floor(cx).astype(int), np.floor(cy).astype(int)
    for scale in (1.35, 1.0):
        squared = np.maximum(scale * frame.radius / cell, 0.71) ** 2   # >= one cell
        reach = int(math.ceil(math.sqrt(squared.max())))
        for di in range(-reach, reach + 1):
            for dj in range(-reach, reach + 1):
                row, column = row0 + di, column0 + dj
                inside = ((row + 0.5 - cy) ** 2 + (column + 0.5 - cx) ** 2 <= squared) \
                    & (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
                disc = np.flatnonzero(inside)
                owner[row[disc], column[disc]] = disc
    return owner


def draw_raster(ax, frame: Frame, rgb: np.ndarray, segments, alpha: np.ndarray | None) -> None:
    """Discs in colours rgb, then segments, as an image."""
    if frame.owner is None:
        frame.owner = owner_map(frame)
    rows, columns = frame.owner.shape
    xmin, xmax, _, ymax = frame.view
    cell = (xmax - xmin) / columns
    table = np.full((len(rgb) + 1, 4), 255, dtype=np.uint8)   # last row: no disc
    table[:-1, :3] = np.round(np.asarray(rgb) * 255)
    if alpha is not None:
        table[:-1, 3] = np.round(alpha * 255)
    table[-1, 3] = 0
    image = table[frame.owner]
    for lines, colour in segments:
        paint_lines(image, lines, colour, xmin, ymax, cell)
    ax.imshow(image, extent=(xmin, xmin + columns * cell, ymax - rows * cell, ymax),
              aspect="auto", interpolation="antialiased", zorder=2)


def paint_lines(image: np.ndarray, lines: np.ndarray, colour: str, xmin: float, ymax: float,
                cell: float) -> None:
    """Lines (n x 4 km) one cell wide into an image of cells of that size."""
    if not len(lines):
        return
    rows, columns = image.shape[:2]
    ink = np.round(np.append(to_rgb(colour), 1.0) * 255).astype(np.uint8)
    longest = np.hypot(*(lines[:, 2:] - lines[:, :2]).T).max()
    for t in np.linspace(0, 1, min(200, int(longest / cell) + 2)):
        points = (1 - t) * lines[:, :2] + t * lines[:, 2:]
        column = np.floor((points[:, 0] - xmin) / cell).astype(int)
        row = np.floor((ymax - points[:, 1]) / cell).astype(int)
        ok = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        image[row[ok], column[ok]] = ink
