"""Figures for print at their final size: panels below each other, letters, text of 8 points.

Lengths are in inches. Panels are those of the pages; only what is around them differs.
"""
from collections.abc import Sequence
from dataclasses import dataclass

from axes import EXAGGERATED, FOOTWALL_WORD, exaggeration, exaggeration_text
from frame import Frame
from page import add_axes, extension_text, letter, name_distance, timed_text, without_source
from panels import panel_of
from plot import FAINT, Figure, Order, new_figure

from matplotlib.collections import LineCollection
from matplotlib.font_manager import FontProperties
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D
from matplotlib.patheffects import Normal, Stroke
from matplotlib.text import Text
from matplotlib.textpath import TextPath
from matplotlib.ticker import MaxNLocator

POINTS, SMALL = 8.0, 7.0          # of text; small: legends, numbers within a panel
PRINT_DPI = 300
MM = 1 / 25.4
EDGE, BAR_GAP, BAR = 0.04, 0.06, 0.09   # of the page; between a panel and its colour bar; the bar
LABEL_LINE = 0.135                # of a label along an axis
TICK_ROOM = 0.13                  # between numbers along an axis
ABOVE, XLABEL, GAP = 0.20, 0.36, 0.10
LEGEND_LINE = 0.145
PROFILE_SHARE = 0.24              # height of the profile of sediment over a panel's width
TOPS_SHARE = 0.34                 # height of the tops of strata, of the width
LEAST_PROFILE, LEAST_TIME = 0.85, 1.1   # heights that hold the labels of their axes
THIN = 0.6                        # of the lines of a page, which are for twice the width
DEFAULT = ("strata", "strain")


@dataclass
class Row:
    """A panel with what stands around it."""
    name: str
    title: str
    entries: dict                 # of the legend: label, handle
    labels: tuple[str, str]       # of the depth axis and of the colour bar
    numbers: tuple[float, float]  # widths of the numbers along them
    wide: float = 0.0
    high: float = 0.0

    @property
    def overhang(self) -> float:
        """How far a word of a label is longer than the axis, above and below it."""
        words = max((text_width(word, POINTS) for label in self.labels for word in label.split(" ")), default=0.0)
        return max(0.0, (words - self.high) / 2)

    def folded(self, k: int) -> str:
        return folded(self.labels[k], self.high + 2 * self.overhang, POINTS)

    def beside(self, k: int) -> float:
        """Room for an axis' numbers and label."""
        lines = self.folded(k).count("\n") + 1 if self.labels[k] else 0
        return self.numbers[k] + 0.06 + LABEL_LINE * lines


def text_width(text: str, points: float) -> float:
    return TextPath((0, 0), text, size=points, prop=FontProperties(family="DejaVu Sans")).get_extents().width / 72 if text.strip() else 0.0


def folded(text: str, room: float, points: float) -> str:
    """A text in lines that fit, as far as words do."""
    lines: list[str] = []
    for word in text.split(" "):   # not at blanks that do not break
        if lines and text_width(f"{lines[-1]} {word}", points) <= room:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return "\n".join(lines)


def place_panels(rows: Sequence[Row], frame: Frame, width: float) -> float:
    """Gives panels their sizes and returns where they begin: beside them there is room for their labels, which have
    the more lines the lower a panel is."""
    left, right = 0.46, 0.58
    for _ in range(4):
        across = width - left - right
        own = {"sediment": max(PROFILE_SHARE * across, LEAST_PROFILE), "seismic": max(0.4 * across, LEAST_TIME),
               "inversion": max(TOPS_SHARE * across, LEAST_TIME)}
        for row in rows:
            row.wide, row.high = across, own.get(row.name, across * frame.rise / frame.span)
        left = max(0.46, EDGE + max(row.beside(0) for row in rows))
        right = EDGE + BAR_GAP + BAR + max(row.beside(1) for row in rows)
    for row in rows:
        row.wide = min(row.wide, width - left - right)
    return left


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


def legend_rows(entries: dict, width: float) -> list[list[tuple[str, str]]]:
    """Labels, each with the text that it is shown by, in lines that fit into a width; one longer than that is folded."""
    rows, room = [], 0.0
    for label in entries:
        text = folded(label, width - 0.3, SMALL)
        needed = 0.36 + max(text_width(line, SMALL) for line in text.split("\n"))
        if not rows or room + needed > width:
            rows.append([])
            room = 0.0
        rows[-1].append((label, text))
        room += needed
    return rows


def legend_height(entries: dict, width: float) -> float:
    return LEGEND_LINE * sum(lines_of(row) for row in legend_rows(entries, width)) + (0.04 if entries else 0.0)


def lines_of(row: list[tuple[str, str]]) -> int:
    return 1 + max(text.count("\n") for _, text in row)


def draw_legend(figure: Figure, entries: dict, x: float, top: float, width: float) -> None:
    """Lines of a legend from a height downward."""
    across, up = figure.get_size_inches()
    for row in legend_rows(entries, width):
        figure.legend(
            [entries[label] for label, _ in row], [text for _, text in row], ncol=len(row), loc="upper left",
            bbox_to_anchor=(x / across, top / up), frameon=False, fontsize=SMALL,
            borderpad=0, borderaxespad=0, handlelength=1.4, handletextpad=0.4, columnspacing=1.0,
            handler_map={tuple: HandlerTuple(ndivide=None, pad=0)})
        top -= LEGEND_LINE * lines_of(row)


def draw_print(frame: Frame, names: Sequence[str], order: Order) -> tuple[Figure, list[str]]:
    """The figure, and a description of each panel for its caption."""
    width = order.width_mm * MM
    rows = [trial(frame, name) for name in names]   # what stands around a panel is known once it is drawn
    left = place_panels(rows, frame, width)
    beside = width - left - EDGE
    titles = [folded(row.title, beside, POINTS) for row in rows]
    above = [ABOVE + LABEL_LINE * title.count("\n") + row.overhang for row, title in zip(rows, titles)]
    legends = [legend_height(row.entries, beside) for row in rows]
    under = [max(row.overhang, XLABEL if row is rows[-1] else 0.0) for row in rows]
    headline = [] if order.plain else headline_lines(frame, width)   # text, weight
    top = 0.155 * len(headline) + (0.06 if headline else 0.0)
    total = top + sum(above) + sum(row.high for row in rows) + sum(under) + sum(legends) + GAP * (len(rows) - 1) + 0.04
    figure = new_figure(width, total, order.dpi or PRINT_DPI)
    across, up = figure.get_size_inches()
    for line, (text, weight) in enumerate(headline):
        figure.text(0.03 / across, 1 - (0.03 + 0.155 * line) / up, text, fontsize=10, weight=weight, va="top")
    said, y = [], total - top
    for index, (row, title) in enumerate(zip(rows, titles)):
        y -= above[index] + row.high
        ax = add_axes(figure, left, y, row.wide, row.high)
        cax = add_axes(figure, left + row.wide + BAR_GAP, y, BAR, row.high)
        frame.legends = {}
        panel_of(row.name)(ax, cax, frame)
        frame.legends = None
        fit_axes(ax, cax, row)
        for k, axis in enumerate((ax.yaxis, cax.yaxis)):
            axis.set_label_text(row.folded(k))
        lowest = index + 1 == len(rows)
        name_distance(ax, frame, lowest)
        line = (y + row.high + row.overhang + 0.05) / up
        figure.text(0.03 / across, line + LABEL_LINE * title.count("\n") / up, letter(index), fontsize=10, weight="bold", va="bottom")
        figure.text(left / across, line, title, fontsize=10, va="bottom")
        ratio = None if row.name == "seismic" else exaggeration(ax)
        if ratio is not None and abs(ratio - 1.0) >= 0.02:
            ax.text(0.99, 0.03, exaggeration_text(ratio), transform=ax.transAxes, fontsize=8, ha="right", va="bottom",
                    color=FAINT, zorder=9)
        said.append(f"{row.title[0].lower() + row.title[1:]}" + ("" if ratio is None else f" ({exaggeration_text(ratio)})"))
        draw_legend(figure, row.entries, left, y - under[index] - 0.04, beside)
        y -= under[index] + legends[index] + GAP
    thin_lines(figure)
    set_texts(figure)
    hide_what_has_no_room(figure)
    return figure, said


def hide_what_has_no_room(figure: Figure) -> None:
    """The word "footwall" stands where nothing else does, and within its panel; how heights are exaggerated stands at
    the first place along the bottom that is free."""
    renderer = figure.canvas.get_renderer()
    for ax in figure.axes:
        words = [text for text in ax.texts if text.get_text()]

        def is_free(text) -> bool:
            box = text.get_window_extent(renderer)
            others = [other.get_window_extent(renderer) for other in words if other is not text and other.get_visible()]
            return box.y1 <= ax.bbox.y1 and box.x1 <= ax.bbox.x1 and not any(box.overlaps(other) for other in others)

        for text in words:
            if text.get_text() == FOOTWALL_WORD and not is_free(text):
                text.set_visible(False)
            elif text.get_text().startswith(EXAGGERATED):
                for text_x, side in ((0.99, "right"), (0.5, "center"), (0.01, "left")):
                    text.set(x=text_x, ha=side)
                    if is_free(text):
                        break


def trial(frame: Frame, name: str) -> Row:
    """A panel's description, legend and labels, from a drawing of it."""
    figure = new_figure(4.0, 3.0, 72)
    ax, cax = add_axes(figure, 0.5, 0.5, 2.5, 2.0), add_axes(figure, 3.1, 0.5, BAR, 2.0)
    frame.legends = {}
    panel_of(name)(ax, cax, frame)
    (title, entries), = frame.legends.items()
    frame.legends = None
    numbers = []
    for part in (ax, cax):
        ticks = part.get_yticks()
        texts = part.yaxis.get_major_formatter().format_ticks(ticks) if part.axison else []
        numbers.append(max((text_width(text, SMALL) for text in texts), default=0.0))
    return Row(name, title, entries, (ax.get_ylabel() if ax.axison else "", cax.get_ylabel() if cax.axison else ""), tuple(numbers))


def fit_axes(ax, cax, row: Row) -> None:
    """Numbers that do not touch on small axes, short marks."""
    for part in (ax, cax):
        part.tick_params(which="major", length=2.5, pad=2)
        part.tick_params(which="minor", length=1.5)
        part.yaxis.labelpad = 2
        part.xaxis.labelpad = 2
    if row.name != "seismic":
        ax.yaxis.set_major_locator(MaxNLocator(max(1, min(5, int(row.high / 0.17))), steps=[1, 2, 5, 10]))
    for part in (ax, cax):
        if part.axison:
            thin_ticks(part, row.high)


def thin_ticks(axes, height: float) -> None:
    """Leaves the numbers along the y axis that have room, from the first on."""
    (first, last), ticks = axes.get_ylim(), axes.get_yticks()
    texts = axes.yaxis.get_major_formatter().format_ticks(ticks)
    kept: list[tuple[float, str]] = []
    for tick, text in zip(ticks, texts):
        place = (tick - first) / (last - first) * height
        if -1e-9 <= place <= height * (1 + 1e-9) and (not kept or abs(tick - kept[-1][0]) / abs(last - first) * height >= TICK_ROOM):
            kept.append((tick, text))
    axes.set_yticks([tick for tick, _ in kept], [text for _, text in kept])


def headline_lines(frame: Frame, width: float) -> list[tuple[str, str]]:
    """Lines of the description and of the moment, with their weights."""
    title = without_source(str(frame.meta.get("title") or frame.meta["scene"]))
    room = 0.88 * (width - 0.06)   # bold letters are wider
    return [(line, weight) for text, weight in ((title, "bold"), (timed_text(frame), "normal")) for line in folded(text, room, POINTS).split("\n")]


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
