#!/usr/bin/python3
"""Figures of a Listric run.

Usage: figures.py KIND DATA_DIR FIGURES_DIR

Every folder in DATA_DIR is a frame: frame.json and the .npy arrays written by
the program (SI units, y up, original surface at y = 0, breakaway at the origin).
KIND is
  sections    of every frame: strata-, bonds-, behaviour-, strain-, sediment-,
              kinematics- and overview-<extension>km.png
  experiment  all frames side by side: experiment-<extension>km.png
  animation   one picture per frame: animation-<extension>km.mp4, or .gif
              where there is no ffmpeg
  gallery     frames of different runs below each other, small: gallery.png
Every file is written under a temporary name and then renamed.  On bad input: one
line on stderr, exit status 1.
"""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import textwrap
from dataclasses import dataclass
from typing import Optional

try:
    import numpy as np
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.cm import ScalarMappable
    from matplotlib.collections import EllipseCollection, LineCollection
    from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize, to_rgb
    from matplotlib.figure import Figure
    from matplotlib.legend_handler import HandlerTuple
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch
    from matplotlib.patheffects import Normal, Stroke
    from matplotlib.ticker import FuncFormatter, MultipleLocator
except ImportError as failure:
    sys.stderr.write(f"figures.py: cannot import {failure.name or failure}\n")
    sys.exit(1)

DPI = 150
RASTER_ABOVE = 80_000     # discs; beyond this the section is painted as an image
RASTER_OVERSAMPLING = 3   # image cells per output pixel, each way

# Layout, inches.
WIDTH, LEFT, RIGHT = 12.0, 0.72, 1.13
PANEL_WIDTH = WIDTH - LEFT - RIGHT
MAX_PANEL_HEIGHT = 8.0
PROFILE_HEIGHT = 2.5
ROW_ABOVE = 0.34          # description and legend above each panel
TITLE = 0.42
XLABEL = 0.52
GAP = 0.20                # between the panels of the overview, below tick marks
FOOTER_LINE = 0.155
SHEET_WIDTH, SHEET_GAP = 19.0, 0.30
ANIMATION_DPI = 80
GALLERY_DPI = 75

LAYER_COLOURS = ("#cdbfa6", "#9c8b72")
PRE_RIFT, SEDIMENT, WEAK = "#d6d6d6", "#fbeab4", "#d7301f"
FOOTWALL, INK, FAINT = "#efeeeb", "#1a1a1a", "#6b6b6b"
WEAK_PALE, SEDIMENT_PALE = "#e9a59a", "#fdf6dc"
BOND, BOND_SEDIMENT = "#3a3a3a", "#a87a10"
# Types of rock behaviour [paper, Fig. 9b]: colour, label.
BEHAVIOUR = (("#4b5560", "elastic"), ("#98a3ad", "plastic: minor faults"),
             ("#e8b48c", "weakened: major faults"), ("#f6f1df", "unconsolidated"))
NORMALS_BLUE = "#1f5fb4"
LEVEL_BLUE, TOP_GREEN, WATER = "#1f6fb4", "#2b8a3e", "#c6dcef"
# Slip-rate classes of active faults: upper bound (mm/a), line width (pt), label.
FAULT_CLASSES = ((0.5, 0.8, "slip < 0.5 mm/a"), (1.0, 1.5, "slip 0.5–1 mm/a"),
                 (math.inf, 2.4, "slip > 1 mm/a"))

STYLE = {
    "font.family": "DejaVu Sans", "font.size": 10, "axes.linewidth": 0.8,
    "axes.edgecolor": INK, "axes.labelsize": 10.5, "text.color": INK,
    "xtick.labelsize": 9.5, "ytick.labelsize": 9.5, "legend.fontsize": 9,
    "xtick.direction": "out", "ytick.direction": "out",
}


class InputError(Exception):
    """Input that is missing or makes no sense; the message is for the user."""


@dataclass
class Frame:
    """One frame, lengths in km (y up), rates in mm/a, time in a."""
    meta: dict
    x: np.ndarray
    y: np.ndarray
    radius: np.ndarray
    stratum: np.ndarray
    start_depth: np.ndarray
    strain: np.ndarray
    weak: Optional[np.ndarray]
    broken: Optional[np.ndarray]
    bonded: Optional[np.ndarray]
    unbonded_share: Optional[np.ndarray]
    detachment: np.ndarray
    profile: Optional[np.ndarray]
    depocentres: Optional[np.ndarray]
    faults: Optional[np.ndarray]
    water: Optional[np.ndarray] = None   # x, floor, level
    predicted_shear: Optional[np.ndarray] = None
    predicted_normals: Optional[np.ndarray] = None
    view: tuple = ()                     # xmin, xmax, ymin, ymax (km)
    owner: Optional[np.ndarray] = None   # disc index of each image cell, -1 = none
    strain_top: Optional[float] = None   # end of the colour scale, where frames share it
    legends: Optional[dict] = None       # collects legend entries by panel, instead of drawing

    @property
    def extension(self):
        return self.meta["extension_m"] / 1000.0

    @property
    def wall(self):
        return self.meta["right_wall_x_m"] / 1000.0

    @property
    def level(self):
        return self.meta["level_m"] / 1000.0


# --------------------------------------------------------------------- input

def load_meta(directory):
    """frame.json as a dict with its numbers checked."""
    path = os.path.join(directory, "frame.json")
    try:
        with open(path, encoding="utf-8") as file:
            meta = json.load(file)
    except OSError as failure:
        raise InputError(f"{path}: {failure.strerror or failure}")
    except ValueError as failure:
        raise InputError(f"{path}: not valid JSON ({failure})")
    if not isinstance(meta, dict):
        raise InputError(f"{path}: not a JSON object")
    for key in ("extension_m", "time_a", "level_m", "right_wall_x_m", "strata",
                "layer_m", "strain_window_m"):
        value = meta.get(key)
        if isinstance(value, bool) or not isinstance(value, (int, float)) \
                or not math.isfinite(value):
            raise InputError(f"{path}: '{key}' is missing or not a finite number")
    if not isinstance(meta.get("scene"), str):
        raise InputError(f"{path}: 'scene' is missing or not a string")
    if meta["layer_m"] <= 0 or meta["right_wall_x_m"] <= 0:
        raise InputError(f"{path}: 'layer_m' and 'right_wall_x_m' must be positive")
    return meta


def load_array(directory, name, columns=None, optional=False, finite=True):
    """Numeric array name.npy: 1-D, or 2-D with the given number of columns."""
    path = os.path.join(directory, name + ".npy")
    if optional and not os.path.exists(path):
        return None
    try:
        array = np.load(path, allow_pickle=False)
    except OSError as failure:
        raise InputError(f"{path}: {failure.strerror or failure}")
    except (ValueError, EOFError, SyntaxError, KeyError) as failure:
        raise InputError(f"{path}: corrupt or not an .npy file ({failure})")
    if not isinstance(array, np.ndarray) or array.dtype.kind not in "buif":
        raise InputError(f"{path}: not a plain numeric array")
    if columns is None:
        if array.ndim != 1:
            raise InputError(f"{path}: expected one dimension, shape is {array.shape}")
    elif array.size == 0:
        array = np.zeros((0, columns))
    elif array.ndim != 2 or array.shape[1] != columns:
        raise InputError(f"{path}: expected {columns} columns, shape is {array.shape}")
    if finite and not np.all(np.isfinite(array)):
        raise InputError(f"{path}: holds values that are not finite")
    return array


def load_frame(directory):
    """All arrays of the frame, converted to km."""
    if not os.path.isdir(directory):
        raise InputError(f"{directory}: no such directory")
    meta = load_meta(directory)
    discs = {name: load_array(directory, "discs_" + name)
             for name in ("x", "y", "radius", "stratum")}
    # Undefined for sediment (start depth) and for discs younger than the window.
    for name in ("start_depth", "shear_strain"):
        discs[name] = load_array(directory, "discs_" + name, finite=False)
    weak = load_array(directory, "discs_weak", optional=True)
    count = len(discs["x"])
    if count == 0:
        raise InputError(f"{directory}: discs_x.npy holds no discs")
    for name, array in list(discs.items()) + [("weak", weak)]:
        if array is not None and len(array) != count:
            raise InputError(f"{directory}: discs_{name}.npy has {len(array)} values, "
                             f"discs_x.npy {count}")
    if np.any(discs["radius"] <= 0):
        raise InputError(f"{directory}: discs_radius.npy holds radii that are not positive")
    if max(meta["strata"], discs["stratum"].max()) > 10_000:
        raise InputError(f"{directory}: more than 10,000 strata")
    detachment = load_array(directory, "detachment", columns=2)
    if len(detachment) < 2:
        raise InputError(f"{directory}: detachment.npy needs at least two points")

    def km(array):
        return None if array is None else np.asarray(array, dtype=float) / 1000.0

    def contacts(name):   # ends in km; whether both discs are sediment
        array = load_array(directory, name, columns=5, optional=True)
        return None if array is None else array * np.array([1e-3] * 4 + [1.0])

    faults = load_array(directory, "faults", columns=4, optional=True)
    if faults is not None:
        faults = faults * np.array([1.0, 1e-3, 1e-3, 1.0])
    profile = km(load_array(directory, "profile", columns=3, optional=True, finite=False))
    if profile is not None and len(profile) < 2:
        profile = None
    frame = Frame(
        meta=meta, x=km(discs["x"]), y=km(discs["y"]), radius=km(discs["radius"]),
        stratum=discs["stratum"].astype(int), start_depth=km(discs["start_depth"]),
        strain=np.asarray(discs["shear_strain"], dtype=float),
        weak=None if weak is None else weak.astype(bool),
        broken=contacts("broken"), bonded=contacts("bonded"),
        unbonded_share=load_array(directory, "discs_unbonded_share", optional=True),
        detachment=km(detachment), profile=profile,
        depocentres=km(load_array(directory, "depocentres", columns=3, optional=True)),
        faults=faults,
        water=km(load_array(directory, "water", columns=3, optional=True)),
        predicted_shear=km(load_array(directory, "predicted_shear", columns=2, optional=True)),
        predicted_normals=km(load_array(directory, "predicted_normals", columns=2,
                                        optional=True)))
    frame.view = view_of(frame)
    if count > RASTER_ABOVE:
        frame.owner = owner_map(frame)
    return frame


def view_of(frame):
    """Extent of the section (km): 1 km left of the breakaway to right of the wall."""
    tops = np.append(np.quantile(frame.y + frame.radius, 0.9999), (frame.level, 0.0))
    bottom = min(frame.detachment[:, 1].min(),
                 np.quantile(frame.y - frame.radius, 0.0001))
    return (-1.0, frame.wall + 0.5, bottom - 0.6, tops.max() + 0.5)


# ------------------------------------------------------------------- drawing

def panel_size(frame):
    """Width and height (in) of a section at equal scales."""
    xmin, xmax, ymin, ymax = frame.view
    height = min(PANEL_WIDTH * (ymax - ymin) / (xmax - xmin), MAX_PANEL_HEIGHT)
    return height * (xmax - xmin) / (ymax - ymin), height


def owner_map(frame):
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


def draw_discs(ax, frame, rgb, segments=(), segment_width=0.5, alpha=None):
    """Discs at true size in colours rgb (n x 3), then segments: (n x 4 km, colour) pairs."""
    if frame.owner is not None:
        draw_raster(ax, frame, rgb, segments, alpha)
        return
    shown = slice(None) if alpha is None else alpha > 0
    ax.add_collection(EllipseCollection(
        2 * frame.radius[shown], 2 * frame.radius[shown], np.zeros(len(frame.x))[shown],
        units="xy", offsets=np.column_stack((frame.x, frame.y))[shown],
        transOffset=ax.transData, facecolors=rgb[shown], edgecolors="none", linewidths=0,
        zorder=2), autolim=False)
    for lines, colour in segments:
        if len(lines):
            ax.add_collection(LineCollection(
                lines.reshape(-1, 2, 2), colors=colour, linewidths=segment_width,
                capstyle="butt", zorder=3), autolim=False)


def draw_raster(ax, frame, rgb, segments, alpha):
    """The same as an image, for very many discs."""
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
        if not len(lines):
            continue
        ink = np.round(np.append(to_rgb(colour), 1.0) * 255).astype(np.uint8)
        longest = np.hypot(*(lines[:, 2:] - lines[:, :2]).T).max()
        for t in np.linspace(0, 1, min(200, int(longest / cell) + 2)):
            points = (1 - t) * lines[:, :2] + t * lines[:, 2:]
            column = np.floor((points[:, 0] - xmin) / cell).astype(int)
            row = np.floor((ymax - points[:, 1]) / cell).astype(int)
            ok = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
            image[row[ok], column[ok]] = ink
    ax.imshow(image, extent=(xmin, xmin + columns * cell, ymax - rows * cell, ymax),
              aspect="auto", interpolation="antialiased", zorder=2)


def section_axes(ax, frame):
    """Axes of a section: equal scales in km, footwall, detachment, right wall."""
    xmin, xmax, ymin, ymax = frame.view
    line = frame.detachment
    if line[0, 0] > line[-1, 0]:                # left to right
        line = line[::-1]
    if line[-1, 0] < frame.wall:                # flat sole up to the right wall
        line = np.vstack((line, (frame.wall, line[-1, 1])))
    left, right = (xmin, line[0, 1]), (xmax, line[-1, 1])
    ax.fill(*np.vstack((left, line, right, (xmax, ymin), (xmin, ymin))).T,
            color=FOOTWALL, linewidth=0, zorder=1)
    ax.plot((xmin, line[0, 0]), (line[0, 1],) * 2, color=FAINT, linewidth=0.8, zorder=5)
    ax.plot(*line.T, color=INK, linewidth=1.5, zorder=5, solid_joinstyle="round")
    ax.plot((frame.wall,) * 2, (line[-1, 1], ymax - 0.3), color=FAINT, linewidth=1.0,
            zorder=5)
    ax.text(xmin + 0.3, ymin + 0.25, "footwall", color=FAINT, fontsize=9,
            style="italic", va="bottom", zorder=6)
    ax.set_xlim(xmin, xmax)
    ax.set_ylim(ymin, ymax)
    ax.set_aspect("equal", adjustable="box")
    depth_axis(ax, "Depth (km)")
    distance_axis(ax, frame)


def depth_axis(ax, label):
    """Label a y-up axis in km as depth, positive down."""
    span = abs(ax.get_ylim()[1] - ax.get_ylim()[0])
    step = next((s for s in (0.1, 0.2, 0.5, 1, 2, 5, 10) if span / s <= 7), 20)
    ax.yaxis.set_major_locator(MultipleLocator(step))
    if step >= 1:
        ax.yaxis.set_minor_locator(MultipleLocator(1 if step <= 5 else step / 5))
    ax.yaxis.set_major_formatter(FuncFormatter(
        lambda value, _: f"{0.0 - value + 0.0:g}".replace("-", "−")
        if abs(value) > 1e-9 else "0"))
    ax.set_ylabel(label)


def distance_axis(ax, frame):
    """x ticks in km from the breakaway."""
    span = frame.view[1] - frame.view[0]
    step = 5 if 15 < span <= 80 else (20 if span > 80 else 2)
    ax.xaxis.set_major_locator(MultipleLocator(step))
    ax.xaxis.set_minor_locator(MultipleLocator(1 if step < 20 else 5))


def describe(ax, frame, text, handles=()):
    """Description at the left and legend at the right, just above the axes."""
    if frame.legends is not None:               # a sheet draws one legend for a row
        row = frame.legends.setdefault(text, {})
        for handle, label in handles:
            row.setdefault(label, handle)
        return
    ax.annotate(text, (0, 1), (0, 5), xycoords="axes fraction",
                textcoords="offset points", fontsize=10.5, weight="semibold",
                va="bottom", annotation_clip=False)
    if handles:
        ax.legend([h for h, _ in handles], [t for _, t in handles],
                  ncol=len(handles), loc="lower right", bbox_to_anchor=(1.004, 1.0),
                  frameon=False, borderpad=0.2, borderaxespad=0.1, handlelength=1.6,
                  handletextpad=0.5, columnspacing=1.4,
                  handler_map={tuple: HandlerTuple(ndivide=None, pad=0)})


def swatch(colour):
    return Patch(facecolor=colour, edgecolor=FAINT, linewidth=0.4)


def stratum_colours(count):
    """One colour per stratum, old (dark) to young; every second slightly lighter."""
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 1.0, max(count, 2)))[:count, :3]
    if count >= 6:
        colours[1::2] = 0.84 * colours[1::2] + 0.16
    return colours


def bar(cax, cmap, norm, label, **options):
    """Colour bar in the axes cax with its label."""
    colour_bar = cax.figure.colorbar(ScalarMappable(norm, cmap), cax=cax, **options)
    colour_bar.outline.set_linewidth(0.6)
    colour_bar.set_label(label, fontsize=9.5)
    cax.tick_params(labelsize=9)
    return colour_bar


# -------------------------------------------------------------------- panels

def strata_panel(ax, cax, frame):
    """Sediment strata by age, pre-rift layers by start depth (km), faults (mm/a)."""
    section_axes(ax, frame)
    layer = frame.meta["layer_m"] / 1000.0
    depth = np.nan_to_num(frame.start_depth, nan=0.0, posinf=0.0, neginf=0.0)
    rgb = np.array([to_rgb(c) for c in LAYER_COLOURS])[
        np.floor(np.maximum(depth, 0.0) / layer).astype(int) % 2]
    sediment = frame.stratum > 0
    count = max(int(frame.meta["strata"]), int(frame.stratum.max()), 0)
    if sediment.any():
        colours = stratum_colours(count)
        rgb[sediment] = colours[frame.stratum[sediment] - 1]
        norm = BoundaryNorm(np.arange(count + 1) + 0.5, count)
        colour_bar = bar(cax, ListedColormap(colours), norm, "Stratum (1 is the oldest)",
                         spacing="proportional", drawedges=False)
        step = max(1, math.ceil(count / 8)) if count < 20 else 5 * math.ceil(count / 40)
        ticks = sorted({1, *range(step, count + 1, step)})
        colour_bar.set_ticks(ticks, labels=[str(t) for t in ticks])
        colour_bar.ax.minorticks_off()
    else:
        cax.set_axis_off()
    draw_discs(ax, frame, rgb)
    handles = [
        (tuple(swatch(c) for c in LAYER_COLOURS), f"pre-rift, {layer:g} km layers"),
        (Line2D([], [], color=INK, linewidth=1.5), "detachment")]
    if "sedimentation" in frame.meta.get("effects", ()):
        ax.axhline(frame.level, color=LEVEL_BLUE, linewidth=1.0, dashes=(6, 3), zorder=6)
        handles.append((Line2D([], [], color=LEVEL_BLUE, linewidth=1.0, dashes=(4, 2)),
                        "target level of sediments"))
    if frame.water is not None:
        x, floor, level = frame.water.T
        ax.fill_between(x, floor, level, color=WATER, linewidth=0, zorder=1.5)
        handles.append((swatch(WATER), "water"))
    if frame.faults is not None and len(frame.faults):
        handles += draw_faults(ax, frame.faults)
    describe(ax, frame, "Syn-rift strata" if sediment.any() else "Pre-rift layers", handles)


def bonds_panel(ax, cax, frame):
    """Contact bonds as lines; where they are broken, the section stays white."""
    section_axes(ax, frame)
    cax.set_axis_off()
    handles = []
    rgb = np.tile(to_rgb(WEAK_PALE), (len(frame.x), 1))
    if frame.bonded is None:
        describe(ax, frame, "Contact-bond pattern (bonds off)")
        return
    points = 2 * np.median(frame.radius) * PANEL_WIDTH * 72 / (frame.view[1] - frame.view[0])
    young = frame.bonded[:, 4] > 0.5
    sediment = frame.stratum > 0
    alpha = sediment.astype(float)
    rgb[sediment] = to_rgb(SEDIMENT_PALE)
    if frame.weak is not None:
        alpha[frame.weak] = 1.0
        rgb[frame.weak] = to_rgb(WEAK_PALE)
    draw_discs(ax, frame, rgb,
               ((frame.bonded[~young, :4], BOND), (frame.bonded[young, :4], BOND_SEDIMENT)),
               segment_width=float(np.clip(0.17 * points, 0.25, 0.9)), alpha=alpha)
    handles.append((Line2D([], [], color=BOND, linewidth=1.2), "bond, pre-rift"))
    if sediment.any():
        handles.append((Line2D([], [], color=BOND_SEDIMENT, linewidth=1.2), "bond, sediment"))
        handles.append((swatch(SEDIMENT_PALE), "sediment"))
    if frame.weak is not None:
        handles.append((swatch(WEAK_PALE), "weakened"))
    describe(ax, frame, "Contact-bond pattern", handles)


def behaviour_of(frame):
    """Index into BEHAVIOUR of every disc [paper, Fig. 5]."""
    kind = np.zeros(len(frame.x), dtype=int)              # mainly elastic: bonds intact
    kind[frame.unbonded_share > 0.25] = 1                 # more than a stray crack
    loose = (frame.stratum > 0) & (frame.unbonded_share > 0.5)
    kind[loose] = 3
    if frame.weak is not None:
        kind[frame.weak] = 2
    return kind


def behaviour_panel(ax, cax, frame):
    """Inferred rock behaviour in four types, and the active faults [paper, Fig. 9b]."""
    section_axes(ax, frame)
    cax.set_axis_off()
    if frame.unbonded_share is None:
        describe(ax, frame, "Rock behaviour (bonds off)")
        return
    kind = behaviour_of(frame)
    draw_discs(ax, frame, np.array([to_rgb(colour) for colour, _ in BEHAVIOUR])[kind])
    handles = [(swatch(colour), label) for k, (colour, label) in enumerate(BEHAVIOUR)
               if (kind == k).any() or k < 2]
    if frame.faults is not None and len(frame.faults):
        handles += draw_faults(ax, frame.faults)
    describe(ax, frame, "Rock behaviour", handles)


def strain_colours():
    """White through magma to black: equal steps of lightness, prints well."""
    colours = matplotlib.colormaps["magma_r"](np.linspace(0, 0.93, 256))[:, :3]
    fade = np.clip(np.arange(256) / 45.0, 0, 1)[:, None]
    return ListedColormap(fade * colours + (1 - fade) * 0.985)


def strain_limit(strain):
    """Upper end of the colour scale: 99th percentile, rounded up to a plain number."""
    values = strain[np.isfinite(strain)]
    high = np.quantile(values, 0.99) if len(values) else 0.0
    if high <= 0:
        high = values.max() if len(values) else 0.0
    if high <= 0:
        return 0.01
    power = 10.0 ** math.floor(math.log10(high))
    return power * next(s for s in (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10)
                        if high <= s * power * (1 + 1e-9))


def strain_panel(ax, cax, frame):
    """Shear strain (no unit) of the last window of extension."""
    section_axes(ax, frame)
    limit = frame.strain_top or strain_limit(frame.strain)
    finite = np.isfinite(frame.strain)
    highest = frame.strain[finite].max() if finite.any() else 0.0
    cmap, norm = strain_colours(), Normalize(0.0, limit, clip=True)
    rgb = cmap(norm(np.where(finite, frame.strain, 0.0)))[:, :3]
    rgb[~finite] = to_rgb("#e2e8ee")
    draw_discs(ax, frame, rgb)
    above = highest > limit * (1 + 1e-9)
    colour_bar = bar(cax, cmap, Normalize(0.0, limit),
                     f"Shear strain (max. {highest:.2g})" if above else "Shear strain",
                     extend="max" if above else "neither", extendfrac=0.04)
    digit = round(limit / 10.0 ** math.floor(math.log10(limit) + 1e-9), 1)
    parts = {1.2: 4, 1.5: 3, 2: 4, 3: 3, 4: 4, 6: 3, 8: 4}.get(digit, 5)
    colour_bar.set_ticks(np.linspace(0.0, limit, parts + 1))
    colour_bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:.3g}"))
    handles = []
    if not finite.all():
        handles.append((swatch("#e2e8ee"), "not defined"))
    if frame.profile is not None and (frame.stratum > 0).any():
        ax.plot(frame.profile[:, 0], frame.profile[:, 1], color=TOP_GREEN,
                linewidth=1.0, zorder=6)
        handles.append((Line2D([], [], color=TOP_GREEN, linewidth=1.0), "pre-rift top"))
    if frame.faults is not None and len(frame.faults):
        handles += draw_faults(ax, frame.faults)
    window = frame.meta["strain_window_m"]
    describe(ax, frame, f"Shear strain, last {window:g} m of extension", handles)


def draw_faults(ax, faults):
    """Active faults, line width by slip rate (mm/a); returns legend entries."""
    handles, lower = [], -math.inf
    lines = [faults[faults[:, 0] == number] for number in np.unique(faults[:, 0])]
    for upper, width, label in FAULT_CLASSES:
        chosen = [line[:, 1:3] for line in lines
                  if lower <= line[0, 3] < upper]
        lower = upper
        if len(chosen):
            ax.add_collection(LineCollection(
                chosen, colors=INK, linewidths=width, capstyle="round",
                path_effects=[Stroke(linewidth=width + 1.2, foreground="white"), Normal()],
                zorder=7), autolim=False)
            handles.append((Line2D([], [], color=INK, linewidth=width), label))
    return handles


def sediment_panel(ax, cax, frame):
    """Thickness of sediments and depth of the pre-rift top (km, both down)."""
    cax.set_axis_off()
    ax.set_xlim(*frame.view[:2])
    distance_axis(ax, frame)
    if frame.profile is None:
        ax.set_yticks([])
        ax.text(0.5, 0.5, "no thickness profile in this frame", color=FAINT,
                ha="center", va="center", transform=ax.transAxes)
        describe(ax, frame, "Sediment thickness")
        return
    x, top, thickness = frame.profile.T
    known = np.isfinite(thickness)
    shown = -np.where(known, thickness, np.nan)
    deepest = max(np.nanmax(-shown, initial=0.0), np.nanmax(-top, initial=0.0), 0.5)
    highest = max(np.nanmax(top, initial=0.0), 0.0)
    ax.set_ylim(-1.32 * deepest, highest + 0.10 * deepest)
    depth_axis(ax, "Thickness, depth (km)")
    ax.grid(axis="y", color="#dddddd", linewidth=0.6, zorder=0)
    ax.set_axisbelow(True)
    ax.fill_between(x, 0.0, shown, where=known, color=SEDIMENT, linewidth=0, zorder=1)
    ax.plot(x, shown, color="#b07d00", linewidth=1.4, zorder=3)
    ax.plot(x, top, color=INK, linewidth=1.1, dashes=(4, 2), zorder=4)
    ax.axhline(0.0, color=FAINT, linewidth=0.8, zorder=2)
    handles = [
        (Patch(facecolor=SEDIMENT, edgecolor="#b07d00", linewidth=1.2), "sediment thickness"),
        (Line2D([], [], color=INK, linewidth=1.1, dashes=(3, 1.5)), "depth of pre-rift top")]
    if frame.depocentres is not None and len(frame.depocentres):
        draw_depocentres(ax, frame)
        handles.append((Line2D([], [], color=WEAK, marker="^", markersize=7,
                               linestyle="none"), "depocentre: thickness, prominence (km)"))
    describe(ax, frame, "Sediment thickness and pre-rift top", handles)


def draw_depocentres(ax, frame, most=10):
    """Mark depocentres below the curve; labels of the most prominent ones."""
    points = frame.depocentres[np.argsort(-frame.depocentres[:, 2], kind="stable")]
    xmin, xmax = ax.get_xlim()
    ymin, ymax = ax.get_ylim()
    inches_x, inches_y = PANEL_WIDTH / (xmax - xmin), PROFILE_HEIGHT / (ymax - ymin)
    half, height = 0.37 / inches_x, 0.17 / inches_y
    placed = []
    for index, (x, thickness, prominence) in enumerate(points):
        ax.plot(x, -thickness - 0.05 / inches_y, marker="^", markersize=7, color=WEAK,
                markeredgecolor="white", markeredgewidth=0.5, zorder=6, clip_on=False)
        if index >= most:
            continue
        cx = min(max(x, xmin + 1.1 * half), xmax - 1.1 * half)
        cy = -thickness - 0.21 / inches_y
        for _ in range(12):
            hit = [p for p in placed
                   if abs(p[0] - cx) < 2 * half and abs(p[1] - cy) < height]
            if not hit:
                break
            cy = min(p[1] for p in hit) - height
        if cy < ymin + 0.4 * height:        # no room left: marker only
            continue
        placed.append((cx, cy))
        ax.text(cx, cy, f"{thickness:.1f}, {prominence:.1f}", fontsize=9, ha="center",
                va="center", zorder=7, bbox={"facecolor": "white", "alpha": 0.75,
                                             "linewidth": 0, "pad": 0.6})


def kinematics_panel(ax, cax, frame):
    """The model's pre-rift top beside kinematic constructions, all at true scale."""
    section_axes(ax, frame)
    cax.set_axis_off()
    handles = []
    meta = frame.meta
    if frame.profile is not None:
        x, top, _ = frame.profile.T
        ax.fill_between(x, top, 0.0, where=top < 0, color=SEDIMENT_PALE, linewidth=0, zorder=2)
        ax.plot(x, top, color=INK, linewidth=1.8, zorder=6)
        handles.append((Line2D([], [], color=INK, linewidth=1.8), "pre-rift top"))
    if frame.predicted_normals is not None and len(frame.predicted_normals) > 1:
        # Where normals part, nothing is predicted but a gap.
        curve = frame.predicted_normals
        step = np.hypot(*np.diff(curve, axis=0).T)
        pieces = np.split(curve, np.flatnonzero(step > 0.5) + 1)
        ax.add_collection(LineCollection([p for p in pieces if len(p) > 1], colors=NORMALS_BLUE,
                                         linewidths=1.8, linestyles=(0, (6, 2)), zorder=7),
                          autolim=False)
        label = "normals stay normal"
        if "predicted_tilt_deg" in meta and "rollover_tilt_deg" in meta:
            label += (f" (tilt {meta['predicted_tilt_deg']:.1f}°, "
                      f"model {meta['rollover_tilt_deg']:.1f}°)")
        handles.append((Line2D([], [], color=NORMALS_BLUE, linewidth=1.8, dashes=(4, 1.5)),
                        label))
    if frame.predicted_shear is not None and len(frame.predicted_shear) > 1:
        ax.plot(*frame.predicted_shear.T, color=WEAK, linewidth=1.5, dashes=(2, 1.5), zorder=7)
        handles.append((Line2D([], [], color=WEAK, linewidth=1.5, dashes=(1.5, 1.2)),
                        f"inclined shear, {meta.get('inclined_shear_angle_deg', 0):g}° "
                        "(best fit)"))
    text = []
    if "area_balance" in meta:
        text.append(f"basin area = {meta['area_balance']:.3f} × extension × thickness")
    if "halfgraben_area_share" in meta:
        split = f"halfgraben's share {meta['halfgraben_area_share']:.2f}"
        if "predicted_halfgraben_area_share" in meta:
            split += f" (normals: {meta['predicted_halfgraben_area_share']:.2f})"
        text.append(split)
    ax.text(0.985, 0.06, "\n".join(text), transform=ax.transAxes, ha="right", va="bottom",
            fontsize=9.5, zorder=8)
    describe(ax, frame, "Kinematics", handles)


# -------------------------------------------------------------------- output

PANELS = (("strata", strata_panel), ("bonds", bonds_panel), ("behaviour", behaviour_panel),
          ("strain", strain_panel), ("sediment", sediment_panel),
          ("kinematics", kinematics_panel))
ON_SHEET = ("strata", "bonds", "behaviour", "strain")


def headline(frame):
    meta = frame.meta
    return (f"{meta['scene'].upper()}, {extension_text(frame)} km of extension "
            f"({meta['time_a'] / 1e6:.2f} Ma)")


def extension_text(frame):
    """Extension in km: one decimal, two when one is not enough."""
    value = frame.extension
    return f"{value:.1f}" if abs(value * 10 - round(value * 10)) < 0.05 else f"{value:.2f}"


def footer(frame):
    """What was computed, as wrapped lines of small print."""
    meta, parts = frame.meta, []
    if meta.get("title"):
        parts.append(str(meta["title"]))
    radius = meta.get("mean_radius_m", frame.radius.mean() * 1000)
    parts.append(f"{len(frame.x):,} discs, mean radius {radius:.3g} m")
    parts += [f"{key} {meta[key]}" for key in ("accuracy", "seed") if key in meta]
    if isinstance(meta.get("effects"), list):
        parts.append("effects: " + (", ".join(map(str, meta["effects"])) or "none"))
    return textwrap.wrap("  ·  ".join(parts), 190)[:3]


def draw_figure(frame, panels, dpi=DPI):
    """Figure with the given (name, function) panels stacked on one x axis."""
    width, section_height = panel_size(frame)
    heights = [PROFILE_HEIGHT if name == "sediment" else section_height
               for name, _ in panels]
    lines = footer(frame)
    bottom = XLABEL + FOOTER_LINE * len(lines) + 0.12
    total = TITLE + bottom + sum(heights) + ROW_ABOVE * len(panels) \
        + GAP * (len(panels) - 1)
    figure = Figure(figsize=(WIDTH, total), dpi=dpi, facecolor="white")
    FigureCanvasAgg(figure)
    figure.text(LEFT / WIDTH, 1 - 0.13 / total, headline(frame), fontsize=14,
                weight="bold", va="top")
    for index, line in enumerate(reversed(lines)):
        figure.text(LEFT / WIDTH, (0.09 + FOOTER_LINE * index) / total, line,
                    fontsize=7.5, color=FAINT, va="bottom")
    y = total - TITLE
    for index, ((name, draw), height) in enumerate(zip(panels, heights)):
        y -= ROW_ABOVE + height
        ax = figure.add_axes((LEFT / WIDTH, y / total, width / WIDTH, height / total))
        cax = figure.add_axes(((LEFT + width + 0.16) / WIDTH, y / total,
                               0.17 / WIDTH, height / total))
        draw(ax, cax, frame)
        ax.tick_params(which="major", length=4)
        ax.tick_params(which="minor", length=2)
        if index + 1 < len(panels):
            ax.tick_params(labelbottom=False)
        else:
            ax.set_xlabel("Distance from the breakaway (km)")
        y -= GAP
    return figure


def draw_sheet(frames):
    """All frames side by side at one scale, a row per kind of section."""
    kinds = [(name, draw) for name, draw in PANELS
             if name in ON_SHEET and
             (name not in ("bonds", "behaviour") or frames[0].bonded is not None)]
    strata = max(frame.meta["strata"] for frame in frames)
    top = max(strain_limit(frame.strain) for frame in frames)
    legends = {}
    for frame in frames:
        frame.meta["strata"], frame.strain_top, frame.legends = strata, top, legends
    widths = [frame.view[1] - frame.view[0] for frame in frames]
    inch = (SHEET_WIDTH - LEFT - RIGHT - SHEET_GAP * (len(frames) - 1)) / sum(widths)
    height = inch * max(frame.view[3] - frame.view[2] for frame in frames)
    lines = footer(frames[-1])
    bottom = XLABEL + FOOTER_LINE * len(lines) + 0.12
    total = TITLE + 0.3 + bottom + len(kinds) * (height + ROW_ABOVE) + GAP * (len(kinds) - 1)
    figure = Figure(figsize=(SHEET_WIDTH, total), dpi=DPI, facecolor="white")
    FigureCanvasAgg(figure)
    meta = frames[-1].meta
    figure.text(LEFT / SHEET_WIDTH, 1 - 0.13 / total,
                f"{meta['scene'].upper()}, " +
                " and ".join(f"{extension_text(frame)}" for frame in frames) +
                " km of extension", fontsize=14, weight="bold", va="top")
    for index, line in enumerate(reversed(lines)):
        figure.text(LEFT / SHEET_WIDTH, (0.09 + FOOTER_LINE * index) / total, line,
                    fontsize=7.5, color=FAINT, va="bottom")
    letter = ord("a")
    y = total - TITLE - 0.3
    for row, (name, draw) in enumerate(kinds):
        y -= ROW_ABOVE + height
        x = LEFT
        legends.clear()
        for column, (frame, span) in enumerate(zip(frames, widths)):
            own = inch * (frame.view[3] - frame.view[2])
            ax = figure.add_axes((x / SHEET_WIDTH, y / total, inch * span / SHEET_WIDTH,
                                  own / total))
            last = column + 1 == len(frames)
            cax = figure.add_axes(((SHEET_WIDTH - RIGHT + 0.16) / SHEET_WIDTH, y / total,
                                   0.17 / SHEET_WIDTH, own / total))
            draw(ax, cax, frame)
            cax.set_visible(last)
            ax.text(0.974, 0.86, chr(letter), transform=ax.transAxes, fontsize=13,
                    weight="bold", ha="right", va="top", zorder=9,
                    bbox={"facecolor": "white", "linewidth": 0.6, "pad": 2.5})
            letter += 1
            if row == 0:
                ax.annotate(f"{extension_text(frame)} km of extension", (0.5, 1), (0, 26),
                            xycoords="axes fraction", textcoords="offset points", ha="center",
                            fontsize=11.5, weight="semibold", annotation_clip=False)
            if column > 0:
                ax.set_ylabel("")
                ax.tick_params(labelleft=False)
            ax.tick_params(which="major", length=4)
            ax.tick_params(which="minor", length=2)
            if row + 1 < len(kinds):
                ax.tick_params(labelbottom=False)
            else:
                ax.set_xlabel("Distance from the breakaway (km)")
            x += inch * span + SHEET_GAP
        for text, entries in legends.items():
            figure.text(LEFT / SHEET_WIDTH, (y + height + 0.07) / total, text, fontsize=10.5,
                        weight="semibold", va="bottom")
            if not entries:
                continue
            figure.legend(list(entries.values()), list(entries), ncol=len(entries),
                          loc="lower right",
                          bbox_to_anchor=((SHEET_WIDTH - RIGHT) / SHEET_WIDTH,
                                          (y + height) / total),
                          frameon=False, borderpad=0.2, borderaxespad=0.1, handlelength=1.6,
                          handletextpad=0.5, columnspacing=1.4,
                          handler_map={tuple: HandlerTuple(ndivide=None, pad=0)})
        y -= GAP
    return figure


def draw_gallery(frames):
    """A row per frame, strata beside strain, all at one scale."""
    strata = max(frame.meta["strata"] for frame in frames)
    for frame in frames:
        frame.meta["strata"], frame.strain_top, frame.legends = strata, 0.5, {}
    span = max(frame.view[1] - frame.view[0] for frame in frames)
    inch = 0.5 * (SHEET_WIDTH - LEFT - 2 * RIGHT - SHEET_GAP) / span
    heights = [inch * (frame.view[3] - frame.view[2]) for frame in frames]
    total = 0.35 + XLABEL + sum(heights) + 0.36 * len(frames)
    figure = Figure(figsize=(SHEET_WIDTH, total), dpi=GALLERY_DPI, facecolor="white")
    FigureCanvasAgg(figure)
    y = total - 0.1
    for row, (frame, height) in enumerate(zip(frames, heights)):
        y -= height + 0.36
        width = inch * (frame.view[1] - frame.view[0])
        for column, draw in enumerate((strata_panel, strain_panel)):
            x = LEFT + column * (inch * span + RIGHT + SHEET_GAP)
            ax = figure.add_axes((x / SHEET_WIDTH, y / total, width / SHEET_WIDTH, height / total))
            cax = figure.add_axes(((x + width + 0.12) / SHEET_WIDTH, y / total,
                                   0.15 / SHEET_WIDTH, height / total))
            draw(ax, cax, frame)
            if row:
                cax.set_visible(False)
            if column:
                ax.set_ylabel("")
            else:
                ax.annotate(str(frame.meta.get("title", "")), (0, 1), (0, 5), fontsize=13,
                            xycoords="axes fraction", textcoords="offset points",
                            weight="semibold", annotation_clip=False)
            if row + 1 == len(frames):
                ax.set_xlabel("Distance from the breakaway (km)")
            else:
                ax.tick_params(labelbottom=False)
    return figure


def save_small(figure, directory, name):
    """A PNG with a palette of 256 colours where Pillow is there: a third of the size."""
    save(figure, directory, name, GALLERY_DPI)
    try:
        from PIL import Image
    except ImportError:
        return
    path = os.path.join(directory, name)
    with Image.open(path) as image:
        small = image.convert("RGB").quantize(256, method=Image.Quantize.MEDIANCUT,
                                              dither=Image.Dither.NONE)
    small.save(path, optimize=True)


def animate(frames, directory):
    """One picture per frame, all at the last one's scale; MP4 with ffmpeg, else GIF."""
    strata = max(frame.meta["strata"] for frame in frames)
    top = max(strain_limit(frame.strain) for frame in frames)
    name = f"animation-{extension_text(frames[-1])}km"
    with tempfile.TemporaryDirectory(dir=directory, prefix=".data-") as folder:
        for index, frame in enumerate(frames):
            frame.view = frames[-1].view
            frame.meta["strata"], frame.strain_top = strata, top
            if frame.owner is not None:
                frame.owner = owner_map(frame)
            figure = draw_figure(frame, [PANELS[0], PANELS[3]], ANIMATION_DPI)
            figure.savefig(os.path.join(folder, f"{index:05d}.png"), dpi=ANIMATION_DPI)
            frame.owner = None
        if shutil.which("ffmpeg"):
            path = os.path.join(folder, "animation.mp4")
            subprocess.run(
                ["ffmpeg", "-loglevel", "error", "-y", "-framerate", "4", "-i",
                 os.path.join(folder, "%05d.png"), "-vf",
                 "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", path], check=True)
            os.replace(path, os.path.join(directory, name + ".mp4"))
            return
        try:
            from PIL import Image
        except ImportError:
            raise InputError("an animation needs ffmpeg or Pillow (python3-pil)")
        # One palette for all, so that a colour means the same in every frame; the last has them all.
        with Image.open(os.path.join(folder, f"{len(frames) - 1:05d}.png")) as image:
            palette = image.convert("RGB").quantize(256, method=Image.Quantize.MAXCOVERAGE)
        images = []
        for index in range(len(frames)):
            with Image.open(os.path.join(folder, f"{index:05d}.png")) as image:
                images.append(image.convert("RGB").quantize(palette=palette,
                                                            dither=Image.Dither.NONE))
        path = os.path.join(folder, "animation.gif")
        durations = [250] * (len(images) - 1) + [2000]
        images[0].save(path, save_all=True, append_images=images[1:], duration=durations,
                       loop=0, optimize=False)
        os.replace(path, os.path.join(directory, name + ".gif"))


def save(figure, directory, name, dpi=DPI):
    """Write a PNG under a temporary name, then rename it."""
    path = os.path.join(directory, name)
    temporary = os.path.join(directory, f".{name}.{os.getpid()}.tmp")
    try:
        figure.savefig(temporary, format="png", dpi=dpi)
        os.replace(temporary, path)
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)


def main(arguments):
    if len(arguments) != 3 or arguments[0] not in ("sections", "experiment", "animation",
                                                      "gallery"):
        raise InputError(
            "usage: figures.py sections|experiment|animation|gallery DATA_DIR FIGURES_DIR")
    kind, data, directory = arguments
    if not os.path.isdir(data):
        raise InputError(f"{data}: no such directory")
    frames = [load_frame(os.path.join(data, name)) for name in sorted(os.listdir(data))]
    if not frames:
        raise InputError(f"{data}: holds no frames")
    os.makedirs(directory, exist_ok=True)
    with matplotlib.rc_context(STYLE):
        if kind == "experiment":
            save(draw_sheet(frames), directory, f"experiment-{extension_text(frames[-1])}km.png")
        elif kind == "animation":
            animate(frames, directory)
        elif kind == "gallery":
            save_small(draw_gallery(frames), directory, "gallery.png")
        else:
            for frame in frames:
                for name, panels in [(p[0], [p]) for p in PANELS
                                     if p[0] != "kinematics" or
                                     frame.predicted_shear is not None] + [
                        ("overview", [p for p in PANELS if p[0] != "kinematics"])]:
                    save(draw_figure(frame, panels), directory,
                         f"{name}-{extension_text(frame)}km.png")


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except InputError as failure:
        sys.stderr.write("figures.py: " + " ".join(str(failure).split()) + "\n")
        sys.exit(1)
    except KeyboardInterrupt:
        sys.exit(130)
    except Exception as failure:   # e.g. disk full: still one line, no traceback
        text = " ".join(f"{type(failure).__name__}: {failure}".split())
        sys.stderr.write(f"figures.py: {text}\n")
        sys.exit(1)
