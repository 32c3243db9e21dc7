"""Parts that all figure scripts share: Matplotlib, style, a figure, its way to a file.

Import this module first: it reports a missing library in one line, and draws without a screen
and without the caller's settings.
"""
import contextlib
import csv
import json
import math
import os
import re
from dataclasses import dataclass

from script import NO_LIBRARY, InputError, end, forget_settings, library, run  # noqa: for those who import this module

forget_settings()
np = library("numpy")
matplotlib = library("matplotlib")
if not hasattr(matplotlib, "colormaps"):
    end(NO_LIBRARY, f"matplotlib is {matplotlib.__version__}; needed: 3.5 or later")
matplotlib.use("Agg")
library("matplotlib.figure")
library("matplotlib.backends.backend_agg")
from matplotlib import colormaps  # noqa: for those who import this module
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatterSciNotation

# Nothing that is written is a formula: a user's words may hold dollars.
if "text.parse_math" in matplotlib.rcParams:
    matplotlib.rcParams["text.parse_math"] = False

INK, FAINT = "#1a1a1a", "#6b6b6b"
STYLE = {
    "font.family": "DejaVu Sans", "font.size": 10, "axes.linewidth": 0.8,
    "axes.edgecolor": INK, "axes.labelsize": 10.5, "text.color": INK,
    "xtick.labelsize": 9.5, "ytick.labelsize": 9.5,
}
# Text stays text, and equal figures are equal files.
FILES = {"pdf.fonttype": 42, "svg.fonttype": "none", "svg.hashsalt": "listric"}
RAISED = str.maketrans("-−0123456789", "⁻⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
MOST_PIXELS = 1e8
RASTER_DPI = 300   # of what is an image within PDF and SVG


class PowersOfTen(LogFormatterSciNotation):
    """Matplotlib's names of numbers on logarithmic axes, with characters that are raised."""

    def __call__(self, x, pos=None) -> str:
        text = super().__call__(x, pos)
        inner = re.fullmatch(r"\$\\mathdefault\{(.*)\}\$", text)
        if not inner:
            return text
        return re.sub(r"\^\{(.*?)\}", lambda power: power[1].translate(RAISED),
                      inner[1].replace(r"\times", "×"))


@dataclass(frozen=True)
class Order:
    """In which formats figures are written, and what they say of the run that they show."""
    formats: tuple[str, ...] = ("png",)
    software: str = "Listric"
    provenance: str = ""   # JSON; empty: of no single run
    errors: str = ""       # of what is shown, a sentence for captions
    width_mm: float = 0.0  # of a figure for print; 0: pages for a screen
    only: tuple[str, ...] = ()   # panels; none: all that are drawn unasked
    plain: bool = False    # without headline and small print
    dpi: float = 0.0       # of pictures; 0: as usual
    caption: bool = False  # write caption.txt, too

    def metadata(self, file_format: str) -> dict:
        """For savefig: no date, so that equal figures are equal files."""
        software, provenance, date = {"png": ("Software", "Provenance", None),
                                      "pdf": ("Creator", "Subject", "CreationDate"),
                                      "svg": ("Creator", "Description", "Date")}[file_format]
        return {software: self.software, **({provenance: self.provenance} if self.provenance else {}),
                **({date: None} if date else {})}


def read_order(text: str) -> Order:
    """From the JSON object that the program gives a script."""
    try:
        words = json.loads(text)
        provenance = words["provenance"]
        more = {key: words[key] for key in ("errors", "width_mm", "plain", "dpi", "caption") if key in words}
        return Order(tuple(words["formats"]), words["software"], json.dumps(provenance) if provenance else "",
                     only=tuple(words.get("only", ())), **more)
    except (ValueError, TypeError, KeyError, RecursionError) as failure:
        raise InputError(f"not an order of figures ({failure!r}): {text}") from failure


def read_json(path: str) -> dict:
    """A file's JSON object."""
    try:
        with open(path, encoding="utf-8") as file:
            value = json.load(file)
    except OSError as failure:
        raise InputError(f"{path}: {failure.strerror or failure}") from failure
    except (ValueError, RecursionError) as failure:
        raise InputError(f"{path}: not valid JSON ({failure})") from failure
    if not isinstance(value, dict):
        raise InputError(f"{path}: not a JSON object")
    return value


def read_rows(path: str) -> list[dict[str, str]]:
    """The rows of a CSV file below its head, of which there is at least one."""
    rows = []
    try:
        with open(path, encoding="utf-8", newline="") as file:
            reader = csv.DictReader(file)
            for row in reader:
                if None in row or None in row.values():
                    raise InputError(f"{path}: line {reader.line_num} has more or fewer fields than the head")
                rows.append(row)
    except OSError as failure:
        raise InputError(f"{path}: {failure.strerror or failure}") from failure
    except (ValueError, csv.Error) as failure:
        raise InputError(f"{path}: not a table ({failure})") from failure
    if not rows:
        raise InputError(f"{path}: an empty table")
    return rows


def read_table(path: str, may_be_empty: bool = False) -> dict[str, np.ndarray]:
    """A CSV file of numbers as an array per column."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
        columns = np.array(rows[1:], dtype=float).T
    except OSError as failure:
        raise InputError(f"{path}: {failure.strerror or failure}") from failure
    except (ValueError, IndexError, csv.Error) as failure:
        raise InputError(f"{path}: not a table of numbers ({failure})") from failure
    if len(rows) == 1 and may_be_empty:
        return {key: np.empty(0) for key in rows[0]}
    if len(rows) < 2 or len(columns) != len(rows[0]):
        raise InputError(f"{path}: an empty table")
    return dict(zip(rows[0], columns))


def rows_by_moment(table: dict[str, np.ndarray], *columns: str) -> tuple[str, dict[float, np.ndarray]]:
    """The clock of the moments, the extension or in a scene with stages the travel, and the rows of these
    columns by it, m, ascending."""
    clock = "travel" if "travel_m" in table else "extension"
    rows, at = np.column_stack([table[name] for name in columns]), table[f"{clock}_m"]
    return clock, {float(value): rows[at == value] for value in np.unique(at)}


def length_unit(span: float) -> tuple[str, float]:
    """Unit of the numbers on an axis that is so many km long, and how many of it a km has."""
    return ("km", 1.0) if span >= 0.1 else ("m", 1000.0)


def moment_label(extension: float, last: float) -> str:
    """An extension of at most `last`, both m: in km, or in m where 0.1 km cannot separate moments. A run of
    1 km may end some millimetres before it."""
    return f"{extension / 1e3:.1f} km" if last >= 999.5 or last == 0.0 else f"{extension:.3g} m"


def new_figure(width: float, height: float, dpi: float, **options) -> Figure:
    """A white figure of that size in inches. It is refused where its picture would take gigabytes."""
    across, up = width * dpi, height * dpi
    if across * up > MOST_PIXELS:
        raise InputError(f"a picture of {width * 25.4:.0f} x {height * 25.4:.0f} mm at {dpi:g} dpi has {across * up / 1e6:,.0f} million pixels, "
                         f"of which {MOST_PIXELS / 1e6:.0f} million are allowed: take --dpi {math.floor(dpi * math.sqrt(MOST_PIXELS / (across * up)))} "
                         "or less, or fewer panels (--only)")
    figure = Figure(figsize=(width, height), dpi=dpi, facecolor="white", **options)
    FigureCanvasAgg(figure)
    return figure


def without_frame(*all_axes) -> None:
    """Leaves axes their left and lower spine."""
    for axes in all_axes:
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)


@contextlib.contextmanager
def plain_images(figure: Figure, file_format: str):
    """Discs and bonds that are an image within PDF and SVG have hard edges: at its resolution
    nobody sees them, and a few colours take a fraction of the room."""
    kinds = (EllipseCollection, LineCollection, PolyCollection)
    shapes = figure.findobj(lambda artist: isinstance(artist, kinds) and artist.get_rasterized())
    for shape in shapes:
        shape.set_antialiased(file_format == "png")
    try:
        yield
    finally:
        for shape in shapes:
            shape.set_antialiased(True)


def name_powers(axes) -> None:
    """Powers of ten on logarithmic axes without mathematics."""
    for axis in (axes.xaxis, axes.yaxis):
        if axis.get_scale() == "log":
            axis.set_major_formatter(PowersOfTen())
            axis.set_minor_formatter(PowersOfTen())


def save(figure: Figure, folder: str, name: str, order: Order = Order()) -> str:
    """Writes folder/name in every format, each whole or not at all; returns the last one's path."""
    os.makedirs(folder, exist_ok=True)
    if figure.get_layout_engine():   # once, so that no format depends on those before it
        figure.draw_without_rendering()
        figure.set_layout_engine("none")
    temporary = os.path.join(folder, f".{name}-{os.getpid()}.tmp")
    for file_format in order.formats:
        path = os.path.join(folder, f"{name}.{file_format}")
        try:
            with matplotlib.rc_context(FILES), plain_images(figure, file_format):
                figure.savefig(temporary, format=file_format, metadata=order.metadata(file_format),
                               dpi="figure" if file_format == "png" else RASTER_DPI)
            os.replace(temporary, path)
        finally:
            if os.path.exists(temporary):
                os.remove(temporary)
    return path
