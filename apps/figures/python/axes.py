"""Axes of a section: scales, footwall and detachment, active faults, legend and colour bar."""
import math

from frame import Frame
from plot import FAINT, INK, length_unit

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import Normal, Stroke
from matplotlib.ticker import FuncFormatter, MultipleLocator

FOOTWALL, FOOTWALL_WORD, EXAGGERATED = "#efeeeb", "footwall", "heights × "
# Slip-rate classes of active faults: upper bound over the rate of the wall, line width (pt), label.
FAULT_CLASSES = ((0.05, 0.8, "slip < {1:g} mm/a"), (0.1, 1.5, "slip {0:g}–{1:g} mm/a"),
                 (math.inf, 2.4, "slip > {0:g} mm/a"))
LEGEND = {"loc": "lower right", "frameon": False, "borderpad": 0.2, "borderaxespad": 0.1,
          "handlelength": 1.6, "handletextpad": 0.5, "columnspacing": 1.4,
          "handler_map": {tuple: HandlerTuple(ndivide=None, pad=0)}}


def section_axes(ax, frame: Frame) -> None:
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
    ax.plot((frame.wall,) * 2, (line[-1, 1], ymax - 0.3 * frame.unit), color=FAINT, linewidth=1.0,
            zorder=5)
    ax.text(xmin + 0.3 * frame.unit, ymin + 0.25 * frame.unit, FOOTWALL_WORD, color=FAINT, fontsize=9,
            style="italic", va="bottom", zorder=6,   # on the footwall's grey, over an image, too
            bbox={"facecolor": FOOTWALL, "linewidth": 0, "pad": 0.8})
    ax.set_xlim(xmin, xmax)
    ax.set_ylim(ymin, ymax)
    ax.set_aspect("equal", adjustable="box")
    depth_axis(ax, "Depth (km)")
    distance_axis(ax, frame)


def exaggeration(ax) -> float:
    """Height over width of a square of the axes, both in km."""
    box, (left, right), (low, high) = ax.get_window_extent(), ax.get_xlim(), ax.get_ylim()
    return (box.height / abs(high - low)) / (box.width / abs(right - left))


def exaggeration_text(ratio: float) -> str:
    return "no vertical exaggeration" if abs(ratio - 1.0) < 0.02 else f"{EXAGGERATED}{ratio:.1f}"


def depth_axis(ax, label: str) -> None:
    """Label a y-up axis in km as depth, positive down; in m where it is short."""
    span = abs(ax.get_ylim()[1] - ax.get_ylim()[0])
    step = min(plain_step(span / 7), 20)
    ax.yaxis.set_major_locator(MultipleLocator(step))
    if step >= 1:
        ax.yaxis.set_minor_locator(MultipleLocator(1 if step <= 5 else step / 5))
    unit, per_km = length_unit(span)
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: depth_text(per_km * value)))
    ax.set_ylabel(label.replace("(km)", f"({unit})"))


def depth_text(height: float) -> str:
    """A height as depth, with a true minus and no minus zero."""
    return f"{0.0 - height + 0.0:g}".replace("-", "−") if abs(height) > 1e-9 else "0"


def plain_step(least: float) -> float:
    """The least of ..., 0.5, 1, 2, 5, 10, ... that is no smaller."""
    power = 10.0 ** math.floor(math.log10(least))
    return next(digit * power for digit in (1, 2, 5, 10) if digit * power >= least * (1 - 1e-9))


def distance_axis(ax, frame: Frame) -> None:
    """x ticks in km from the breakaway; in m where the axis is short."""
    step = 5 if 15 < frame.span <= 80 else 20 if frame.span > 80 else min(2, plain_step(frame.span / 7))
    ax.xaxis.set_major_locator(MultipleLocator(step))
    if step >= 2:
        ax.xaxis.set_minor_locator(MultipleLocator(1 if step < 20 else 5))
    unit, per_km = length_unit(frame.span)
    if unit != "km":
        ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{per_km * value:g}"))


def describe(ax, frame: Frame, text: str, handles=()) -> None:
    """Description at the left and legend at the right, just above the axes."""
    if frame.legends is not None:               # a sheet draws one legend for a row
        row = frame.legends.setdefault(text, {})
        for handle, label in handles:
            row.setdefault(label, handle)
        return
    title = ax.annotate(text, (0, 1), (0, 5), xycoords="axes fraction",
                        textcoords="offset points", fontsize=10.5, weight="semibold",
                        va="bottom", annotation_clip=False)
    if not handles:
        return
    for smaller in ({}, {"fontsize": 7.5, "columnspacing": 0.9}):
        legend = ax.legend([h for h, _ in handles], [t for _, t in handles], ncol=len(handles),
                           bbox_to_anchor=(1.004, 1.0), **{**LEGEND, **smaller})
        if legend.get_window_extent().x0 > title.get_window_extent().x1:
            return
    title.set_position((0, 17))     # a line of its own above the legend


def swatch(colour: str) -> Patch:
    return Patch(facecolor=colour, edgecolor=FAINT, linewidth=0.4)


def stroke(colour: str, width: float, **options) -> Line2D:
    """A line for a legend."""
    return Line2D([], [], color=colour, linewidth=width, **options)


def bar(cax, cmap, norm, label: str, **options):
    """Colour bar in the axes cax with its label."""
    colour_bar = cax.figure.colorbar(ScalarMappable(norm, cmap), cax=cax, **options)
    colour_bar.outline.set_linewidth(0.6)
    colour_bar.set_label(label, fontsize=9.5)
    cax.tick_params(labelsize=9)
    return colour_bar


def draw_faults(ax, frame: Frame) -> list:
    """Active faults, line width by slip rate (mm/a); returns legend entries."""
    faults = frame.faults
    if faults is None:
        return []
    handles, lower = [], -math.inf
    lines = [faults[faults[:, 0] == number] for number in np.unique(faults[:, 0])]
    for share, width, label in FAULT_CLASSES:
        upper = share * frame.wall_rate
        label = label.format(*(float(f"{bound:.3g}") for bound in (lower, upper)))
        chosen = [line[:, 1:3] for line in lines if lower <= line[0, 3] < upper]
        lower = upper
        if len(chosen):
            ax.add_collection(LineCollection(
                chosen, colors=INK, linewidths=width, capstyle="round",
                path_effects=[Stroke(linewidth=width + 1.2, foreground="white"), Normal()],
                zorder=7), autolim=False)
            handles.append((stroke(INK, width), label))
    return handles
