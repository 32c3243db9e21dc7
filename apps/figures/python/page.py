"""A page of sections: its measures in inches, its headline and its small print."""
import math
import re
import textwrap
from collections.abc import Sequence
from decimal import Decimal

from frame import Frame, printable
from plot import FAINT, Figure, length_unit

DPI = 150
WIDTH, LEFT, RIGHT = 12.0, 0.72, 1.13
PANEL_WIDTH = WIDTH - LEFT - RIGHT
MAX_PANEL_HEIGHT = 8.0
PROFILE_HEIGHT = 2.5
TOPS_HEIGHT = 3.4         # of a panel with the tops of all strata
ROW_ABOVE = 0.34          # description and legend above each panel
TITLE = 0.42
XLABEL = 0.52
GAP = 0.20                # between the panels of the overview, below tick marks
FOOTER_LINE = 0.155


def panel_size(frame: Frame) -> tuple[float, float]:
    """Width and height of a section at equal scales."""
    height = min(PANEL_WIDTH * frame.rise / frame.span, MAX_PANEL_HEIGHT)
    return height * frame.span / frame.rise, height


def extension_text(frame: Frame) -> str:
    """Extension in km, as in names of files: as the program writes it, with as many decimals as distinguish
    the run's moments; else one decimal, two when one is not enough."""
    value = frame.extension
    plain = f"{value:.1f}" if abs(value * 10 - round(value * 10)) < 0.05 else f"{value:.2f}"
    return str(frame.meta.get("extension_km", plain))


def length_text(kilometres: str, unit: str) -> str:
    """A length in the unit of an axis, without the unit, with the digits that it has in km."""
    return kilometres if unit == "km" else f"{Decimal(kilometres).scaleb(3):f}"


def unit_of(frame: Frame) -> str:
    """Unit of lengths on the frame's axes."""
    return length_unit(frame.span)[0]


def moment_text(frame: Frame) -> str:
    """How far the wall is: "5.0 km of extension"; with stages of motion also by which way."""
    return moment_words(frame.meta, extension_text(frame), unit_of(frame))


def timed_text(frame: Frame) -> str:
    """How far the wall is, and when: the wall stands in a pause."""
    return f"{moment_text(frame)}, {time_text(frame)}"


def moments_text(frames: Sequence[Frame]) -> str:
    """How far the wall is in each of the frames: "5.0 and 10.0 km of extension"."""
    if any("way_m" in frame.meta for frame in frames):
        return " and ".join(map(timed_text, frames))
    unit = unit_of(frames[-1])
    return " and ".join(length_text(extension_text(frame), unit) for frame in frames) + f" {unit} of extension"


def moment_words(meta: dict, way: str, unit: str = "km") -> str:
    """How far the wall is, told in a unit, after a way in km, where `meta` has its extension_m and way_m, or no way_m;
    wall_m is the way without the pauses that way_m counts."""
    if "way_m" not in meta:
        return f"{length_text(way, unit)} {unit} of extension"
    least = 1e-4 * abs(meta["way_m"])   # a cycle ends near a round number: what is below that is 0
    extension = length_text(f"{round(meta['extension_m'] / least) * least / 1000 + 0.0:.3g}" if least else "0", unit)
    if "wall_m" in meta:
        way = f"{meta['wall_m'] / 1000:.4g}"
        if abs(meta["wall_m"] - meta["extension_m"]) < least:
            return f"{extension} {unit} of extension"
    return f"{extension} {unit} of net extension after {length_text(way, unit)} {unit} of wall motion"


def time_texts(times: Sequence[float], gap: float, end: float) -> tuple[list[str], str]:
    """Times, a, of a run that ends at `end`, and their unit: Myr, or a where the run is shorter than 10,000 a,
    as in the report. With as many decimals as tell apart what is `gap` apart; Myr have two at least."""
    unit, years, decimals = ("Myr", 1e6, 2) if end >= 1e4 else ("a", 1.0, 0)
    while years * 10.0**-decimals > 1.01 * gap and decimals < 9:   # events come a cycle late
        decimals += 1
    return [f"{time / years:.{decimals}f}" for time in times], unit


def time_text(frame: Frame) -> str:
    """When the frame is: "0.50 Myr"."""
    meta = frame.meta
    [text], unit = time_texts([meta["time_a"]], meta.get("interval_a", math.inf), meta.get("end_a", math.inf))
    return f"{text} {unit}"


def letter(n: int) -> str:
    """Letter of panel n, from 0: a to z, then aa, ab, ..."""
    return (letter(n // 26 - 1) if n >= 26 else "") + chr(ord("a") + n % 26)


WINDOW_END = 2e-4   # share of a window: a moment as near as that to its end is its end


def window_text(frame: Frame) -> str:
    """The window of the frame's strain, which ends at its multiples whenever a frame is made: "last 500 m of
    extension", and some way after its end "1.5 to 2 km of extension"."""
    meta = frame.meta
    window, way = meta["strain_window_m"], meta.get("way_m", meta["extension_m"])
    until = meta.get("strain_until_m", window * math.floor(way / window + WINDOW_END))
    if until < window * (1.0 - WINDOW_END):
        return "since the start"
    of = "the way" if "way_m" in meta else "extension"
    if way - until <= WINDOW_END * window:
        return f"last {window:g} m of {of}"
    return f"{(until - window) / 1000:g} to {until / 1000:g} km of {of}"


def strain_remark(frame: Frame) -> str:
    """Words for the strain that is left out, since rock gets lower where nothing shears, or for that it is in, after a
    blank; empty where there is none."""
    return printable(str(frame.meta.get("strain_remark", "")))


LONGEST_TITLE = 80        # letters
LONGEST_HEADLINE = 110    # letters that fit on the page's width


def title_of(frame: Frame, longest: int = LONGEST_TITLE) -> str:
    """The scene's description, without its source and in at most so many letters: a longer one up to its
    colon, else some of its words; a scene without one has its name."""
    title = without_source(str(frame.meta.get("title") or frame.meta["scene"].upper()))
    if len(title) > longest:
        title = title.partition(": ")[0]
    return textwrap.shorten(title, longest, placeholder="…")


def without_source(title: str) -> str:
    """A description without the source in brackets behind it, which the scene keeps."""
    return re.sub(r" \[[^\]]*\]$", "", title)


def headline(frame: Frame) -> str:
    """Description and moment."""
    moment = f": {moment_text(frame).removesuffix(' of extension')}, {time_text(frame)}"
    return title_of(frame, min(LONGEST_TITLE, LONGEST_HEADLINE - len(moment))) + moment


def footer(frame: Frame) -> list[str]:
    """Provenance of the run, as wrapped lines of small print."""
    meta, parts = frame.meta, []
    parts.append(f"scene {meta['scene']}")
    title = without_source(str(meta.get("title", "")))
    if not headline(frame).startswith(title):   # it has the title's beginning
        parts.append(title)
    radius = meta.get("mean_radius_m", frame.radius.mean() * 1000)
    parts.append(f"{len(frame.x):,} discs, mean radius {radius:.3g} m")
    parts += [f"{key} {meta[key]}" for key in ("accuracy", "seed") if key in meta]
    if isinstance(meta.get("effects"), list):
        parts.append("effects: " + (", ".join(map(str, meta["effects"])) or "none"))
    return textwrap.wrap("  ·  ".join(parts), 190)[:3]


def below(lines: list[str]) -> float:
    """Height between the lowest panel and the page's end."""
    return XLABEL + FOOTER_LINE * len(lines) + 0.12


def add_axes(figure: Figure, x: float, y: float, width: float, height: float):
    """Axes at a place in inches from the lower left corner."""
    across, up = figure.get_size_inches()
    return figure.add_axes((x / across, y / up, width / across, height / up))


def write_around(figure: Figure, headline: str, lines: list[str]) -> None:
    """The headline and the small print at the foot."""
    across, up = figure.get_size_inches()
    figure.text(LEFT / across, 1 - 0.13 / up, headline, fontsize=12.5, weight="bold", va="top")
    for index, line in enumerate(reversed(lines)):
        figure.text(LEFT / across, (0.09 + FOOTER_LINE * index) / up, line, fontsize=7.5,
                    color=FAINT, va="bottom")


def set_ticks(ax) -> None:
    ax.tick_params(which="major", length=4)
    ax.tick_params(which="minor", length=2)


def name_distance(ax, frame: Frame, lowest: bool) -> None:
    """Numbers and name of the x axis, under the lowest panel only."""
    if lowest:
        left, right = ax.get_xlim()
        ax.set_xlabel(f"Distance from the {frame.left_end} ({length_unit(right - left)[0]})")
    else:
        ax.tick_params(labelbottom=False)
