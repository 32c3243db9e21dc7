"""Figures for print at their final size: panels below each other, letters, text of 8 points.

Lengths are in inches. Panels are those of the pages; only what is around them differs.
"""
import textwrap
from collections.abc import Sequence

from axes import exaggeration, exaggeration_text
from frame import Frame
from page import add_axes, extension_text, letter, moment_text, name_distance, time_text
from panels import panel_of
from plot import FAINT, Figure, Order, new_figure

from matplotlib.collections import LineCollection
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D
from matplotlib.patheffects import Normal, Stroke
from matplotlib.text import Text
from matplotlib.ticker import MaxNLocator

POINTS, SMALL = 8.0, 7.0          # of text; small: legends, numbers within a panel
PRINT_DPI = 300
MM = 1 / 25.4
LEFT, RIGHT = 0.46, 0.58          # beside a panel; right: the colour bar
NARROW, RIGHT_OF_NARROW = 4.5, 0.74   # a figure whose colour bars have labels of two lines
ABOVE, XLABEL, GAP = 0.20, 0.36, 0.10
LEGEND_LINE = 0.145
PROFILE_SHARE = 0.24              # height of the profile of sediment over a panel's width
TOPS_SHARE = 0.34                 # height of the tops of strata, of the width
LEAST_PROFILE, LEAST_TIME = 0.85, 1.1   # heights that hold the labels of their axes
THIN = 0.6                        # of the lines of a page, which are for twice the width
DEFAULT = ("strata", "strain")


def sizes(frame: Frame, names: Sequence[str], width: float) -> list[tuple[float, float]]:
    """Width and height of panels."""
    across = width - LEFT - (RIGHT_OF_NARROW if width < NARROW else RIGHT)
    own = {"sediment": max(PROFILE_SHARE * across, LEAST_PROFILE), "seismic": max(0.4 * across, LEAST_TIME),
           "inversion": max(TOPS_SHARE * across, LEAST_TIME)}
    return [(across, own.get(name, across * frame.rise / frame.span)) for name in names]


def thin_lines(figure: Figure) -> None:
    """Lines that are as wide as on a page become as wide as a column needs."""
    for artist in figure.findobj(lambda a: isinstance(a, (Line2D, LineCollection))):
        widths = artist.get_linewidth()
        artist.set_linewidth([THIN * w for w in widths] if hasattr(widths, "__len__") else THIN * widths)
        if artist.get_path_effects():
            widths = artist.get_linewidth()
            artist.set_path_effects([Stroke(linewidth=max(widths) + 0.8, foreground="white"), Normal()])
        if isinstance(artist, Line2D):
            artist.set_markersize(0.75 * artist.get_markersize())


def set_texts(figure: Figure) -> None:
    """Every text has 8 points, numbers within panels 7."""
    for text in figure.findobj(Text):
        text.set_fontsize(POINTS if text.get_fontsize() > 9.2 else SMALL)


def legend_rows(entries: dict, width: float) -> list[list[str]]:
    """Labels in lines that fit into a width, by about how wide their letters are."""
    rows, room = [], 0.0
    for label in entries:
        needed = 0.36 + 0.053 * len(label)
        if not rows or room + needed > width:
            rows.append([])
            room = 0.0
        rows[-1].append(label)
        room += needed
    return rows


def draw_legend(figure: Figure, entries: dict, x: float, top: float, width: float) -> None:
    """Lines of a legend from a height downward."""
    across, up = figure.get_size_inches()
    for line, labels in enumerate(legend_rows(entries, width)):
        legend = figure.legend(
            [entries[label] for label in labels], labels, ncol=len(labels), loc="upper left",
            bbox_to_anchor=(x / across, (top - line * LEGEND_LINE) / up), frameon=False, fontsize=SMALL,
            borderpad=0, borderaxespad=0, handlelength=1.4, handletextpad=0.4, columnspacing=1.0,
            handler_map={tuple: HandlerTuple(ndivide=None, pad=0)})
        figure.add_artist(legend)


def draw_print(frame: Frame, names: Sequence[str], order: Order) -> tuple[Figure, list[str]]:
    """The figure, and a description of each panel for its caption."""
    width = order.width_mm * MM
    panel_sizes = sizes(frame, names, width)
    # Legends are known once the panels are drawn: they are drawn on a trial page first.
    legends = [trial_legend(frame, name) for name in names]
    heights = [height + ABOVE + LEGEND_LINE * len(legend_rows(entries, width - LEFT - 0.05))
               + (0.04 if entries else 0.0) for (_, height), (_, entries) in zip(panel_sizes, legends)]
    headline = [] if order.plain else headline_lines(frame, width)
    top = 0.155 * len(headline) + (0.06 if headline else 0.0)
    own_axes = [name == "seismic" for name in names]
    total = top + sum(heights) + GAP * (len(names) - 1) + XLABEL + 0.04
    figure = new_figure(width, total, order.dpi or PRINT_DPI)
    across, up = figure.get_size_inches()
    for line, text in enumerate(headline):
        figure.text(0.03 / across, 1 - (0.03 + 0.155 * line) / up, text, fontsize=10,
                    weight="bold" if line + 1 < len(headline) else "normal", va="top")
    said, y = [], total - top
    for index, (name, (wide, high), (title, entries)) in enumerate(zip(names, panel_sizes, legends)):
        y -= ABOVE + high
        ax = add_axes(figure, LEFT, y, wide, high)
        cax = add_axes(figure, LEFT + wide + 0.06, y, 0.09, high)
        frame.legends = {}
        panel_of(name)(ax, cax, frame)
        frame.legends = None
        fit_axes(ax, cax, name)
        for axis in (ax.yaxis, cax.yaxis):
            axis.set_label_text(wrapped(axis.get_label_text(), high))
        lowest = index + 1 == len(names)
        name_distance(ax, lowest)
        figure.text(0.03 / across, (y + high + 0.05) / up, letter(index), fontsize=10, weight="bold", va="bottom")
        figure.text(LEFT / across, (y + high + 0.05) / up, title, fontsize=10, va="bottom")
        ratio = None if own_axes[index] else exaggeration(ax)
        if ratio is not None and abs(ratio - 1.0) >= 0.02:
            ax.text(0.99, 0.03, exaggeration_text(ratio), transform=ax.transAxes, fontsize=8, ha="right", va="bottom",
                    color=FAINT, zorder=9)
        said.append(f"{title[0].lower() + title[1:]}" + ("" if ratio is None else f" ({exaggeration_text(ratio)})"))
        below = XLABEL if lowest else 0.0
        draw_legend(figure, entries, LEFT, y - below - 0.04, width - LEFT - 0.05)
        y -= heights[index] - ABOVE - high + GAP
    thin_lines(figure)
    set_texts(figure)
    return figure, said


def trial_legend(frame: Frame, name: str) -> tuple[str, dict]:
    """Description of a panel and its legend: label, handle."""
    trial = new_figure(3.0, 2.0, 30)
    frame.legends = {}
    panel_of(name)(trial.add_subplot(), trial.add_subplot(), frame)
    (title, entries), = frame.legends.items()
    frame.legends = None
    return title, entries


def fit_axes(ax, cax, name: str) -> None:
    """Few numbers on small axes, short marks."""
    for part in (ax, cax):
        part.tick_params(which="major", length=2.5, pad=2)
        part.tick_params(which="minor", length=1.5)
        part.yaxis.labelpad = 2
        part.xaxis.labelpad = 2
    if name != "seismic":
        ax.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))


def wrapped(text: str, height: float) -> str:
    """A label in two lines where its letters are longer than an axis."""
    if len(text) * 0.066 <= height:
        return text
    return textwrap.fill(text, max(int(height / 0.066), len(text) // 2 + 1), break_long_words=False)


def headline_lines(frame: Frame, width: float) -> list[str]:
    """Description, in lines, and the moment."""
    title = str(frame.meta.get("title") or frame.meta["scene"])
    return textwrap.wrap(title, max(int(width / 0.072), 10)) + [moment_line(frame)]


def moment_line(frame: Frame) -> str:
    return f"{moment_text(frame)}, {time_text(frame)}"


def save_print(frame: Frame, order: Order) -> tuple[str, Figure, list[str]]:
    """Name of the figure without ending, the figure, what its panels show."""
    names = order.only or DEFAULT
    figure, said = draw_print(frame, names, order)
    name = f"{'-'.join(names)}-{extension_text(frame)}km-{order.width_mm:.12g}mm{look_text(order, PRINT_DPI)}"
    return name, figure, said


def look_text(order: Order, usual_dpi: float) -> str:
    """The look in a figure's name: "-plain-600dpi"; the usual one adds nothing."""
    dpi = order.dpi or usual_dpi
    return ("-plain" if order.plain else "") + (f"-{dpi:.12g}dpi" if dpi != usual_dpi else "")
