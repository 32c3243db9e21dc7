#!/usr/bin/python3
"""Figure of an elastic base: how the detachment has moved, by extension.

Usage: base.py RUN_DIR FIGURES_DIR

Reads base.csv, writes base.png under a temporary name and renames
it: vertical displacement along the detachment, the detachment itself with its displacement ten times
too large, and the breakaway's uplift over extension.  On bad input: one line on stderr, exit status 1.
"""
import csv
import os
import sys

sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import colormaps, new_figure, run, save, without_frame

EXAGGERATION = 10.0


def load(folder):
    moments = {}
    with open(os.path.join(folder, "base.csv"), encoding="utf-8") as file:
        for row in csv.DictReader(file):
            moments.setdefault(float(row["extension_m"]), []).append(
                [float(row[name]) for name in ("x_m", "y_m", "ux_m", "uy_m")])
    if not moments:
        raise ValueError("base.csv has no moment: the base does not deform")
    return dict(sorted(moments.items()))


def shown(extensions):
    """About five moments, evenly over the run, the last among them."""
    step = max(1, round(len(extensions) / 5))
    return extensions[::-1][::step][::-1]


def draw(moments):
    figure = new_figure(11, 10.5, 120)
    profile, section, history = figure.subplots(3, 1, height_ratios=(1.1, 1.3, 0.8))
    extensions = list(moments)
    colours = colormaps["viridis_r"]
    last = extensions[-1] or 1.0
    nodes = moments[extensions[-1]]
    section.plot([n[0] / 1e3 for n in nodes], [n[1] / 1e3 for n in nodes], color="#6b6b6b", lw=1.0,
                 ls="--", label="at the start")
    for extension in shown(extensions):
        nodes, colour = moments[extension], colours(0.15 + 0.8 * extension / last)
        name = f"{extension / 1e3:.1f} km"
        profile.plot([n[0] / 1e3 for n in nodes], [n[3] for n in nodes], color=colour, lw=1.6,
                     label=name)
        section.plot([(n[0] + EXAGGERATION * n[2]) / 1e3 for n in nodes],
                     [(n[1] + EXAGGERATION * n[3]) / 1e3 for n in nodes], color=colour, lw=1.6,
                     label=name)
    profile.axhline(0.0, color="#6b6b6b", lw=0.6)
    profile.set_ylabel("uplift of the detachment, m")
    profile.set_title("Vertical displacement since the settled start", loc="left", fontsize=10.5)
    section.set_ylabel("height, km")
    section.set_aspect("equal")
    section.set_title(f"Detachment, displacement × {EXAGGERATION:g}", loc="left", fontsize=10.5)
    for axes in (profile, section):
        axes.set_xlabel("distance from the breakaway, km")
        axes.legend(frameon=False, fontsize=8.5, title="extension", loc="center left",
                    bbox_to_anchor=(1.0, 0.5))
    history.plot([e / 1e3 for e in extensions], [moments[e][0][3] for e in extensions], "o-",
                 color="#1f6fb4", ms=3.5, lw=1.3, label="breakaway")
    history.plot([e / 1e3 for e in extensions], [max(n[3] for n in moments[e]) for e in extensions],
                 color="#d7301f", lw=1.0, ls="--", label="highest place")
    history.plot([e / 1e3 for e in extensions], [min(n[3] for n in moments[e]) for e in extensions],
                 color="#525252", lw=1.0, ls=":", label="lowest place")
    history.set_xlabel("extension, km")
    history.set_ylabel("uplift, m")
    history.legend(frameon=False, fontsize=8.5, loc="center left", bbox_to_anchor=(1.0, 0.5))
    without_frame(profile, section, history)
    figure.tight_layout()
    return figure


def main(folder, figures):
    save(draw(load(folder)), figures, "base")


if __name__ == "__main__":
    run(main, "base.py RUN_DIR FIGURES_DIR")
