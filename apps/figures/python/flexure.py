#!/usr/bin/python3
"""Figure of a flexure scene: the elastic base's deflection against theory.

Usage: flexure.py RUN_DIR FIGURES_DIR ORDER

Reads RUN_DIR/summary.json and deflection.csv (x_m; deflection_m, plate_m, perhaps layer_m, down).
Writes flexure.png under a temporary name and renames it.  On bad input: one line on stderr, exit
status 2.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import (FAINT, new_figure, read_json, read_order, read_table, run, save,
                  without_frame)

import numpy as np

PLATE, LAYER = "#1f6fb4", "#d7301f"

TITLES = {"line": "Line load on a continuous plate", "broken": "Load on the end of a broken plate",
          "strip": "Strip load", "sinusoid": "Sinusoidal load"}


def load(folder: str) -> tuple[dict, dict[str, np.ndarray]]:
    return (read_json(os.path.join(folder, "summary.json")),
            read_table(os.path.join(folder, "deflection.csv")))


def draw(summary: dict, columns: dict[str, np.ndarray]):
    figure = new_figure(10, 6, 150)
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1.2))
    draw_deflection(upper, summary, columns)
    draw_difference(lower, summary, columns)
    without_frame(upper, lower)
    figure.tight_layout()
    return figure


def draw_deflection(axes, summary: dict, columns: dict[str, np.ndarray]) -> None:
    x = columns["x_m"] / 1e3
    axes.plot(x, columns["plate_m"], color=PLATE, lw=1.4, ls="--", label="thin plate")
    if "layer_m" in columns:
        axes.plot(x, columns["layer_m"], color=LAYER, lw=3.2, alpha=0.45,
                  label="exact elastic layer")
    axes.plot(x, columns["deflection_m"], color="#1a1a1a", lw=1.3,
              label="finite elements, middle of the base")
    axes.axhline(0.0, color=FAINT, lw=0.6)
    if "bulge_m" in summary:
        place, height = summary["bulge_x_m"] / 1e3, summary["bulge_m"]
        axes.annotate(f"bulge {height:.1f} m at {place:.0f} km", (place, -height),
                      xytext=(0, -18), textcoords="offset points", ha="center", fontsize=9)
    axes.invert_yaxis()
    axes.set_ylabel("deflection, m (down)")
    axes.margins(x=0.0)
    axes.legend(frameon=False, loc="lower right", fontsize=9)
    axes.set_title(title(summary), fontsize=10, loc="left")


def title(summary: dict) -> str:
    """The load, the plate, and how well theory is met at the centre."""
    text = (f"{TITLES.get(summary['load'], summary['load'])}: elastic thickness "
            f"{summary['elastic_thickness_m'] / 1e3:g} km, "
            f"E {summary['young_modulus_pa'] / 1e9:g} GPa, "
            f"flexural parameter {summary['alpha_m'] / 1e3:.1f} km\n"
            f"at the centre {summary['w0_m']:.2f} m; thin plate {summary['analytic_w0_m']:.2f} m "
            f"(differs by {100 * summary['relative_error']:.2g} %)")
    if "exact_w0_m" in summary:
        text += (f"; exact layer {summary['exact_w0_m']:.2f} m (worst difference "
                 f"{summary['exact_relative_error']:.1e})")
    return text


def draw_difference(axes, summary: dict, columns: dict[str, np.ndarray]) -> None:
    """Deflection less theory, in percent of the largest deflection."""
    x, deflection = columns["x_m"] / 1e3, columns["deflection_m"]
    largest = np.abs(deflection).max()

    def share(name):
        return 100 * (deflection - columns[name]) / largest

    axes.plot(x, share("plate_m"), color=PLATE, lw=1.2, ls="--", label="less thin plate")
    if "layer_m" in columns:
        axes.plot(x, share("layer_m"), color=LAYER, lw=1.2, label="less exact layer")
    axes.axhline(0.0, color=FAINT, lw=0.6)
    axes.set_ylabel("difference,\n% of the largest")
    axes.set_xlabel("distance from the load, km" if summary["load"] != "sinusoid"
                    else "distance from a crest of the load, km")
    axes.legend(frameon=False, fontsize=9)


def main(folder: str, figures: str, order: str) -> None:
    save(draw(*load(folder)), figures, "flexure", read_order(order))


if __name__ == "__main__":
    run(main, "flexure.py RUN_DIR FIGURES_DIR ORDER")
