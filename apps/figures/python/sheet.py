"""Frames beside each other at one scale: of an experiment, of all, of the runs of a sweep."""
import textwrap
from collections.abc import Sequence

from axes import LEGEND
from frame import Frame
from page import (DPI, GAP, LEFT, RIGHT, ROW_ABOVE, TITLE, XLABEL, add_axes, below, extension_text,
                  footer, letter, timed_text, moments_text, name_distance, set_ticks, title_of, write_around)
from panels import PANELS
from plot import Figure, Order, new_figure, save
from scales import share_scales

SHEET_WIDTH, SHEET_GAP = 19.0, 0.30   # inches
LABELS = 0.3                          # inches, for the extension above each column
ON_SHEET = ("strata", "bonds", "behaviour", "strain")
ONLY_WITH_BONDS = ("bonds", "behaviour")
IN_GALLERY = ("strata", "strain")
GALLERY_DPI = 75
MULTIPLES_ACROSS = 4
GALLERY_ROW_ABOVE = 0.36
GALLERY_STRAIN_TOP = 0.5              # strain where the colours end


def draw_sheet(frames: Sequence[Frame]) -> Figure:
    """A column per frame, a row per kind of section."""
    kinds = [name for name in ON_SHEET
             if frames[0].bonded is not None or name not in ONLY_WITH_BONDS]
    share_scales(frames)
    inch = (SHEET_WIDTH - LEFT - RIGHT - SHEET_GAP * (len(frames) - 1)) \
        / sum(frame.span for frame in frames)
    height = inch * max(frame.rise for frame in frames)
    lines = footer(frames[-1])
    total = TITLE + LABELS + below(lines) + len(kinds) * (height + ROW_ABOVE) \
        + GAP * (len(kinds) - 1)
    figure = new_figure(SHEET_WIDTH, total, DPI)
    write_around(figure, f"{title_of(frames[-1])}: {moments_text(frames)}", lines)
    y = total - TITLE - LABELS
    for row, name in enumerate(kinds):
        y -= ROW_ABOVE + height
        letters = [letter(row * len(frames) + column) for column in range(len(frames))]
        all_axes, texts, entries = draw_row(figure, frames, name, y, inch)
        for column, ax in enumerate(all_axes):
            mark_letter(ax, letters[column])
            if row == 0:
                name_column(ax, frames[column])
            name_distance(ax, frames[column], lowest=row + 1 == len(kinds))
        draw_legend(figure, row_text(texts, letters), entries, y + height)
        y -= GAP
    return figure


def draw_row(figure: Figure, frames: Sequence[Frame], name: str, y: float, inch: float) -> tuple[list, list[str], dict]:
    """Axes with one kind of section of all frames, their descriptions, and the entries of the row's legend."""
    all_axes, texts, legend, x = [], [], {}, LEFT
    for column, frame in enumerate(frames):
        frame.legends = {}
        ax = add_axes(figure, x, y, inch * frame.span, inch * frame.rise)
        cax = add_axes(figure, SHEET_WIDTH - RIGHT + 0.16, y, 0.17, inch * frame.rise)
        PANELS[name](ax, cax, frame)
        cax.set_visible(column + 1 == len(frames))
        if column > 0:
            ax.set_ylabel("")
            ax.tick_params(labelleft=False)
        set_ticks(ax)
        all_axes.append(ax)
        [(text, entries)] = frame.legends.items()
        texts.append(text)
        legend |= entries
        x += inch * frame.span + SHEET_GAP
    return all_axes, texts, legend


def row_text(texts: Sequence[str], letters: Sequence[str]) -> str:
    """Description of a row's panels: one for all, or each with the letters of its own."""
    own: dict[str, list[str]] = {}
    for text, name in zip(texts, letters):
        own.setdefault(text, []).append(name)
    return texts[0] if len(own) == 1 else "; ".join(f"{text} ({', '.join(names)})" for text, names in own.items())


def mark_letter(ax, name: str) -> None:
    ax.text(0.974, 0.86, name, transform=ax.transAxes, fontsize=13, weight="bold", ha="right",
            va="top", zorder=9, bbox={"facecolor": "white", "linewidth": 0.6, "pad": 2.5})


def name_column(ax, frame: Frame) -> None:
    ax.annotate(timed_text(frame), (0.5, 1), (0, 26),
                xycoords="axes fraction", textcoords="offset points", ha="center",
                fontsize=11.5, weight="semibold", annotation_clip=False)


def draw_legend(figure: Figure, text: str, entries: dict, top: float) -> None:
    """Description and legend of a row whose axes end at that height (inches)."""
    across, up = figure.get_size_inches()
    figure.text(LEFT / across, (top + 0.07) / up, text, fontsize=10.5, weight="semibold", va="bottom")
    if entries:
        figure.legend(list(entries.values()), list(entries), ncol=len(entries),
                      bbox_to_anchor=((across - RIGHT) / across, top / up), **LEGEND)


def draw_gallery(frames: Sequence[Frame]) -> Figure:
    """A row per frame, strata beside strain, all at one scale."""
    share_scales(frames, GALLERY_STRAIN_TOP)
    span = max(frame.span for frame in frames)
    inch = 0.5 * (SHEET_WIDTH - LEFT - 2 * RIGHT - SHEET_GAP) / span
    heights = [inch * frame.rise for frame in frames]
    total = 0.35 + XLABEL + sum(heights) + GALLERY_ROW_ABOVE * len(frames)
    figure = new_figure(SHEET_WIDTH, total, GALLERY_DPI)
    y = total - 0.1
    for row, (frame, height) in enumerate(zip(frames, heights)):
        y -= height + GALLERY_ROW_ABOVE
        frame.legends = {}     # collected and not drawn
        width = inch * frame.span
        for column, name in enumerate(IN_GALLERY):
            x = LEFT + column * (inch * span + RIGHT + SHEET_GAP)
            ax = add_axes(figure, x, y, width, height)
            cax = add_axes(figure, x + width + 0.12, y, 0.15, height)
            PANELS[name](ax, cax, frame)
            cax.set_visible(row == 0)
            if column:
                ax.set_ylabel("")
            else:
                ax.annotate(str(frame.meta.get("title", "")), (0, 1), (0, 5), fontsize=13,
                            xycoords="axes fraction", textcoords="offset points",
                            weight="semibold", annotation_clip=False)
            name_distance(ax, frame, lowest=row + 1 == len(frames))
    return figure


def draw_multiples(frames: Sequence[Frame]) -> Figure:
    """Strain of every frame in a grid, small, at one scale."""
    share_scales(frames, GALLERY_STRAIN_TOP)
    columns = min(MULTIPLES_ACROSS, len(frames))
    rows = -(-len(frames) // columns)
    span, rise = max(frame.span for frame in frames), max(frame.rise for frame in frames)
    step = (SHEET_WIDTH - LEFT - RIGHT) / columns
    inch = (step - SHEET_GAP) / span
    height = inch * rise + GALLERY_ROW_ABOVE
    total = 0.2 + XLABEL + rows * height
    figure = new_figure(SHEET_WIDTH, total, GALLERY_DPI)
    for number, frame in enumerate(frames):
        row, column = divmod(number, columns)
        frame.legends = {}     # collected and not drawn
        x, y = LEFT + column * step, total - 0.1 - (row + 1) * height
        ax = add_axes(figure, x, y, inch * frame.span, inch * frame.rise)
        cax = add_axes(figure, SHEET_WIDTH - RIGHT + 0.12, y, 0.15, inch * frame.rise)
        PANELS["strain"](ax, cax, frame)
        cax.set_visible(number + 1 == columns)
        if column:
            ax.set_ylabel("")
            ax.tick_params(labelleft=False)
        title = textwrap.fill(str(frame.meta.get("title", "")), int(step * 15))
        ax.annotate(title, (0, 1), (0, 3), fontsize=7, xycoords="axes fraction",
                    textcoords="offset points", annotation_clip=False)
        name_distance(ax, frame, lowest=number + columns >= len(frames))
    return figure


def save_sheet(frames: Sequence[Frame], folder: str, order: Order) -> None:
    """experiment-<extension>km"""
    save(draw_sheet(frames), folder, f"experiment-{extension_text(frames[-1])}km", order)


def save_gallery(frames: Sequence[Frame], folder: str, _: Order) -> None:
    """gallery.png"""
    save_small(draw_gallery(frames), folder, "gallery")


def save_multiples(frames: Sequence[Frame], folder: str, _: Order) -> None:
    """multiples.png"""
    save_small(draw_multiples(frames), folder, "multiples")


def save_small(figure: Figure, folder: str, name: str) -> None:
    """With a palette of 256 colours where Pillow is there: a third of the size."""
    path = save(figure, folder, name)
    try:
        from PIL import Image
    except ImportError:
        return
    with Image.open(path) as image:
        small = image.convert("RGB").quantize(256, method=Image.Quantize.MEDIANCUT,
                                              dither=Image.Dither.NONE)
    small.save(path, optimize=True)
