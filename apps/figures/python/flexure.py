#!/usr/bin/python3
"""Figure of a flexure scene: the elastic base's deflection against theory.

Usage: flexure.py RUN_DIR FIGURES_DIR

Reads deflection.csv and summary.json, writes flexure.png under a temporary name and renames it.
On bad input: one line on stderr, exit status 1.
"""
import csv
import json
import os
import sys

sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import new_figure, run, save, without_frame

TITLES = {"line": "Line load on a continuous plate", "broken": "Load on the end of a broken plate",
          "strip": "Strip load", "sinusoid": "Sinusoidal load"}


def load(folder):
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    with open(os.path.join(folder, "deflection.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    columns = {name: [float(row[name]) for row in rows] for name in rows[0]}
    return summary, columns


def draw(summary, columns):
    figure = new_figure(10, 6, 150)
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1.2))
    x = [value / 1e3 for value in columns["x_m"]]
    deflection = columns["deflection_m"]
    w0 = max(abs(value) for value in deflection)

    upper.plot(x, columns["plate_m"], color="#1f6fb4", lw=1.4, ls="--", label="thin plate")
    if "layer_m" in columns:
        upper.plot(x, columns["layer_m"], color="#d7301f", lw=3.2, alpha=0.45,
                   label="exact elastic layer")
    upper.plot(x, deflection, color="#1a1a1a", lw=1.3, label="finite elements, middle of the base")
    upper.axhline(0.0, color="#6b6b6b", lw=0.6)
    if "bulge_m" in summary:
        place, height = summary["bulge_x_m"] / 1e3, summary["bulge_m"]
        upper.annotate(f"bulge {height:.1f} m at {place:.0f} km", (place, -height),
                       xytext=(0, -18), textcoords="offset points", ha="center", fontsize=9)
    upper.invert_yaxis()
    upper.set_ylabel("deflection, m (down)")
    upper.margins(x=0.0)
    upper.legend(frameon=False, loc="lower right", fontsize=9)
    upper.set_title(
        f"{TITLES.get(summary['load'], summary['load'])}: elastic thickness "
        f"{summary['elastic_thickness_m'] / 1e3:g} km, E {summary['young_modulus_pa'] / 1e9:g} GPa, "
        f"flexural parameter {summary['alpha_m'] / 1e3:.1f} km\n"
        f"at the centre {summary['w0_m']:.2f} m; thin plate {summary['analytic_w0_m']:.2f} m "
        f"(differs by {100 * summary['relative_error']:.2g} %)"
        + (f"; exact layer {summary['exact_w0_m']:.2f} m (worst difference "
           f"{summary['exact_relative_error']:.1e})" if "exact_w0_m" in summary else ""),
        fontsize=10, loc="left")

    def share(name):
        return [100 * (a - b) / w0 for a, b in zip(deflection, columns[name])]

    lower.plot(x, share("plate_m"), color="#1f6fb4", lw=1.2, ls="--", label="less thin plate")
    if "layer_m" in columns:
        lower.plot(x, share("layer_m"), color="#d7301f", lw=1.2, label="less exact layer")
    lower.axhline(0.0, color="#6b6b6b", lw=0.6)
    lower.set_ylabel("difference,\n% of the largest")
    lower.set_xlabel("distance from the load, km" if summary["load"] != "sinusoid"
                     else "distance from a crest of the load, km")
    lower.legend(frameon=False, fontsize=9)
    without_frame(upper, lower)
    figure.tight_layout()
    return figure


def main(folder, figures):
    save(draw(*load(folder)), figures, "flexure")


if __name__ == "__main__":
    run(main, "flexure.py RUN_DIR FIGURES_DIR")
