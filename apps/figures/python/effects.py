#!/usr/bin/python3
"""Effects of a sweep's parameters.

Usage: effects.py DIR

DIR holds effects.csv as `listric sweep` wrote it; it gets effects.png: a panel a measure, a bar a
term, the largest first, with what holds the truth in 95 of 100 sweeps (Student's t).  A bar is dark
where p < 0.05, so where that does not reach 0.  The file is written under a temporary name and then
renamed.  On bad input: one line on stderr, exit status 2.
"""
import os
import sys
from dataclasses import dataclass

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import FAINT, INK, STYLE, matplotlib, new_figure, read_rows, run, save, without_frame

COLUMNS = 3
WIDTH, LABELS = 4.9, 2.3       # inches of a panel with its labels, of these alone
BAR, AROUND = 0.21, 0.75       # inches of a bar, around the bars
MOST_BARS = 15
CLEAR_P = 0.05                 # chance alone gives such an effect in one of twenty sweeps
CLEAR, UNCLEAR = "#1f6fb4", "#b9cfe3"


@dataclass(frozen=True)
class Effect:
    term: str
    effect: float
    p: float | None       # None: nothing is known of chance
    ends: tuple[float, float] | None   # that hold the truth in 95 of 100 sweeps

    @property
    def is_clear(self) -> bool:
        return self.p is not None and self.p < CLEAR_P


def load(folder: str) -> dict[str, list[Effect]]:
    """By measure; the largest effect first."""
    measures = {}
    for row in read_rows(os.path.join(folder, "effects.csv")):
        known = bool(row.get("p"))
        measures.setdefault(row["measure"], []).append(Effect(
            row["term"], float(row["effect"]), float(row["p"]) if known else None,
            (float(row["low_95"]), float(row["high_95"])) if known else None))
    for effects in measures.values():
        effects.sort(key=lambda effect: -abs(effect.effect))
    return measures


def shown_names(terms: set[str]) -> dict[str, str]:
    """Terms without the tables of their parameters, where their keys alone tell these apart."""
    parameters = {parameter for term in terms for parameter in term.split(":")}
    keys = [parameter.split(".")[-1] for parameter in parameters]
    return {term: " × ".join(parameter.split(".")[-1]
                             if keys.count(parameter.split(".")[-1]) == 1 else parameter
                             for parameter in term.split(":")) for term in terms}


def draw_panel(ax, measure: str, effects: list[Effect], names: dict[str, str]) -> None:
    shown = effects[:MOST_BARS]
    for y, effect in enumerate(shown):
        ax.barh(y, effect.effect, color=CLEAR if effect.is_clear else UNCLEAR, height=0.7)
        if effect.ends is not None:
            low, high = effect.ends
            ax.errorbar(0.5 * (low + high), y, xerr=0.5 * (high - low), color=INK, linewidth=0.9,
                        capsize=2)
    ax.axvline(0.0, color=INK, linewidth=0.8)
    ax.set_yticks(range(len(shown)), [names[effect.term] for effect in shown], fontsize=7)
    ax.set_ylim(len(shown) - 0.4, -0.6)
    left_out = len(effects) - len(shown)
    # From the panel's left edge: a measure's name may be longer than the bars' axis.
    ax.annotate(measure + (f" ({left_out} smaller ones left out)" if left_out else ""), (0.0, 1.0),
                (-72.0 * (LABELS - 0.1), 6.0), "axes fraction", "offset points", fontsize=10,
                weight="semibold")
    without_frame(ax)


def main(folder: str) -> None:
    measures = load(folder)
    names = shown_names({effect.term for effects in measures.values() for effect in effects})
    columns = min(COLUMNS, len(measures))
    rows = -(-len(measures) // columns)
    height = AROUND + BAR * max(min(len(e), MOST_BARS) for e in measures.values())
    across, up = columns * WIDTH, rows * height + 0.35
    with matplotlib.rc_context(STYLE):
        figure = new_figure(across, up, 130)
        for index, (measure, effects) in enumerate(measures.items()):
            column, row = index % columns, index // columns
            x, y = column * WIDTH + LABELS, up - (row + 1) * height
            draw_panel(figure.add_axes((x / across, (y + 0.3) / up, (WIDTH - LABELS - 0.25) / across,
                                        (height - AROUND) / up)), measure, effects, names)
        figure.text(0.1 / across, 0.1 / up, "change from the least to the greatest value of a "
                    "parameter; bars: 95 %, by Student's t from the spread between seeds; dark: "
                    f"p < {CLEAR_P:g}",
                    fontsize=7.5, color=FAINT)
        save(figure, folder, "effects")


if __name__ == "__main__":
    run(main, "effects.py DIR")
