#!/usr/bin/python3
"""Work-precision figure of a study.

Usage: study.py DIR

DIR holds study.csv and study.json as `listric study` wrote them; it gets study.png: error against
wall time (left) and against disc-steps or unknowns (right), a row per panel, a curve per method
and quantity.  A cross at the upper edge is a failure, a dashed line the spread between seeds.  The
file is written under a temporary name and then renamed.  On bad input: one line on stderr, exit
status 2.
"""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import FAINT, name_powers, new_figure, read_json, read_rows, run, save, without_frame

COLOURS = ("#1f6fb4", "#d7301f", "#238b45", "#6a51a3", "#d95f0e", "#525252", "#c51b8a",
           "#0f8b8d", "#8c6d31", "#111111")
MARKERS = "os^Dv<>PhX"
Point = dict[str, float | str | bool]
Curves = dict[tuple[str, str], list[Point]]   # by method and quantity
Panels = dict[str, Curves]
ZERO = 1e-16  # an error of nothing, on a logarithmic axis


def load(folder: str) -> tuple[dict, Panels]:
    """study.json, and the points by panel and by (curve, quantity)."""
    facts = read_json(os.path.join(folder, "study.json"))
    rows = read_rows(os.path.join(folder, "study.csv"))
    panels = {}
    for row in rows:
        panel, _, curve = row["method"].rpartition(": ")
        error = float(row["error"])
        work = float(row["disc_steps"])
        name, _, value = row["parameter"].partition("=")
        point = {"error": max(error, ZERO), "wall": float(row["wall_s"]),
                 "work": work or float(value), "label": value, "value": float(value),
                 "parameter": name, "failed": not math.isfinite(error), "in_discs": work > 0.0}
        panels.setdefault(panel, {}).setdefault((curve, row["quantity"]), []).append(point)
    return facts, panels


def curve_name(curve: str, quantity: str, curves: Curves) -> str:
    """Label that distinguishes the curve from the others of its panel."""
    methods = {c for c, _ in curves}
    quantities = {q for _, q in curves}
    words = ([curve] if len(methods) > 1 or len(quantities) == 1 else []) + \
            ([quantity] if len(quantities) > 1 else [])
    return ", ".join(words) or quantity


def costs_the_same(curves: Curves) -> bool:
    """Whether all points take about as many disc-steps."""
    work = [p["work"] for points in curves.values() for p in points if not p["failed"]]
    return bool(work) and min(work) > 0.0 and max(work) < 1.1 * min(work)


def draw_panel(pair, panel: str, curves: Curves, floors: dict[str, float]) -> None:
    # Where all take as many disc-steps, what is varied tells more; the reference has none of it.
    right = "value" if costs_the_same(curves) else "work"
    if right == "value":
        name = first_of(curves)["parameter"]
        curves = {key: [p for p in points if p["parameter"] == name]
                  for key, points in curves.items()}
    draw_curves(pair, right, curves, floors)
    first = first_of(curves)
    varied = f"varied: {first['parameter']}"
    pair[0].set_xlabel("wall time, s")
    pair[1].set_xlabel(first["parameter"] if right == "value" else
                       "disc-steps" if first["in_discs"] else "unknowns")
    pair[0].set_ylabel("relative error")
    pair[0].set_title(panel or varied, fontsize=10, loc="left")
    if panel:
        pair[1].set_title(varied, fontsize=9, loc="left", color=FAINT)
    for axes in pair:
        left, right_end = axes.get_xlim()
        if right_end > 3 * max(left, ZERO):  # a narrow range has no decades to mark
            axes.set_xscale("log")
        axes.set_yscale("log")
        name_powers(axes)
        axes.grid(True, which="major", lw=0.4, color="#d0d0d0")
        without_frame(axes)
    pair[1].legend(frameon=False, fontsize=8, loc="center left", bbox_to_anchor=(1.01, 0.5))


def first_of(curves: Curves) -> Point:
    return next(iter(curves.values()))[0]


def draw_curves(pair, right: str, curves: Curves, floors: dict[str, float]) -> None:
    """Errors against wall time and against what the right axes show; failures above all."""
    top = max((p["error"] for points in curves.values() for p in points if not p["failed"]),
              default=1.0)
    for k, ((curve, quantity), points) in enumerate(curves.items()):
        colour = COLOURS[k % len(COLOURS)]
        good = [p for p in points if not p["failed"]]
        failed = [p for p in points if p["failed"]]
        for axes, key in zip(pair, ("wall", right)):
            axes.plot([p[key] for p in good], [p["error"] for p in good], color=colour, lw=1.3,
                      marker=MARKERS[k % len(MARKERS)], ms=5,
                      label=curve_name(curve, quantity, curves))
            axes.plot([p[key] for p in failed], [2.0 * top] * len(failed), "x", color=colour,
                      ms=9, mew=2)
            if quantity in floors and floors[quantity] > 0.0:
                axes.axhline(floors[quantity], color=colour, lw=0.8, ls=(0, (4, 4)))
        if k == 0:  # what the parameter was, beside one curve
            for p in good:
                pair[1].annotate(p["label"], (p[right], p["error"]), xytext=(4, 4),
                                 textcoords="offset points", fontsize=7.5, color=FAINT)


def draw(facts: dict, panels: Panels):
    figure = new_figure(13, 0.9 + 4.2 * len(panels), 120)
    grid = figure.subplots(len(panels), 2, squeeze=False, sharey="row")
    for pair, (panel, curves) in zip(grid, panels.items()):
        draw_panel(pair, panel, curves, facts["floors"])
    figure.suptitle(facts["title"], x=0.01, ha="left", fontsize=12.5, weight="bold")
    notes = [f"Listric {facts['version']} · {facts['processor']} · {facts['compiler']} · threads "
             f"{facts['threads']}"]
    in_discs = any(p["in_discs"] for curves in panels.values() for points in curves.values()
                   for p in points)
    if in_discs and facts["floors"]:
        notes.append(f"mean over {facts['seeds']} seeds; "
                     "dashed: spread of the finest runs between seeds")
    notes.append("cross: failed")
    figure.text(0.01, 0.004, " · ".join(notes), fontsize=8, color=FAINT, ha="left", va="bottom")
    figure.tight_layout(rect=(0, 0.02, 1, 0.99))
    return figure


def main(folder: str) -> None:
    save(draw(*load(folder)), folder, "study")


if __name__ == "__main__":
    run(main, "study.py DIR")
