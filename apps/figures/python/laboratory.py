#!/usr/bin/python3
"""Figure of a laboratory test.

Usage: laboratory.py DIR

DIR holds summary.json and the CSV files that `listric laboratory` wrote (SI
units); it gets uniaxial.png, biaxial.png, shear-box.png
or pure-shear.png.  The file is written
under a temporary name and then renamed.  On bad input: one line on stderr, exit
status 1.
"""
import csv
import json
import os
import sys

try:
    import numpy as np
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
except ImportError as failure:
    sys.stderr.write(f"laboratory.py: cannot import {failure.name or failure}\n")
    sys.exit(1)

DPI = 150
INK, FAINT = "#1a1a1a", "#6b6b6b"
TARGET = "#d7301f"
# One colour per stress, light to dark.
COLOURS = ("#9ecae1", "#6baed6", "#4292c6", "#2171b5", "#08519c", "#08306b")
STYLE = {
    "font.family": "DejaVu Sans", "font.size": 10, "axes.linewidth": 0.8,
    "axes.edgecolor": INK, "axes.labelsize": 10.5, "text.color": INK,
    "xtick.labelsize": 9.5, "ytick.labelsize": 9.5, "legend.fontsize": 8.5,
    "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
}


class InputError(Exception):
    """Input that is missing or makes no sense; the message is for the user."""


def load_summary(directory):
    path = os.path.join(directory, "summary.json")
    try:
        with open(path, encoding="utf-8") as file:
            summary = json.load(file)
    except OSError as failure:
        raise InputError(f"{path}: {failure.strerror or failure}")
    except ValueError as failure:
        raise InputError(f"{path}: not valid JSON ({failure})")
    if not isinstance(summary, dict) or summary.get("test") not in PANELS:
        raise InputError(f"{path}: not the summary of a laboratory test")
    return summary


def load_table(directory, name, may_be_empty=False):
    """A CSV file as a dict of arrays by column."""
    path = os.path.join(directory, name)
    try:
        with open(path, encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
        columns = np.array(rows[1:], dtype=float).T
    except OSError as failure:
        raise InputError(f"{path}: {failure.strerror or failure}")
    except (ValueError, IndexError) as failure:
        raise InputError(f"{path}: not a table of numbers ({failure})")
    if len(rows) == 1 and may_be_empty:
        return {key: np.empty(0) for key in rows[0]}
    if len(rows) < 2 or len(columns) != len(rows[0]):
        raise InputError(f"{path}: an empty table")
    return dict(zip(rows[0], columns))


def colour(index, count):
    return COLOURS[round(index * (len(COLOURS) - 1) / max(1, count - 1))]


def groups(table, key):
    """(value, mask) for every value of a column, ascending."""
    return [(value, table[key] == value) for value in np.unique(table[key])]


def curves(ax, table, key, x, y, scale_x=1.0, scale_y=1.0, unit="MPa"):
    """One thin line per seed and one colour per stress."""
    stresses = groups(table, key)
    for index, (stress, of_stress) in enumerate(stresses):
        for number, seed in enumerate(np.unique(table["seed"][of_stress])):
            chosen = of_stress & (table["seed"] == seed)
            ax.plot(table[x][chosen] * scale_x, y(table)[chosen] * scale_y, linewidth=0.9,
                    color=colour(index, len(stresses)),
                    label=f"{stress / 1e6:g} {unit}" if number == 0 else None)


def spread(value, scale=1.0, digits=1):
    return f"{value['mean'] * scale:.{digits}f} ± {value['sd'] * scale:.{digits}f}"


# -------------------------------------------------------------------- panels

def uniaxial(figure, directory, summary):
    table = load_table(directory, "curves.csv")
    left, right = figure.subplots(1, 2)
    for seed, chosen in groups(table, "seed"):
        left.plot(table["gauge_axial_strain"][chosen] * 1e3,
                  table["axial_stress_pa"][chosen] / 1e6, linewidth=0.9, color=COLOURS[3])
        right.plot(table["gauge_axial_strain"][chosen] * 1e3,
                   -table["gauge_lateral_strain"][chosen] * 1e3, linewidth=0.9,
                   color=COLOURS[3])
    strain = np.array([0.0, table["gauge_axial_strain"].max()])
    nu = 0.25 / (1 - 0.25)             # the crust's, as a two-dimensional material shows them
    young = 50e9 / (1 - 0.25 ** 2)
    left.plot(strain * 1e3, strain * young / 1e6, color=TARGET, dashes=(5, 3), linewidth=1.2,
              label="E 50 GPa, ν 0.25 in plane strain")
    right.plot(strain * 1e3, strain * nu * 1e3, color=TARGET, dashes=(5, 3), linewidth=1.2)
    left.set(xlabel="Axial strain (‰)", ylabel="Axial stress (MPa)",
             title=f"E {spread(summary['young_modulus_pa'], 1e-9)} GPa in plane strain, "
                   f"{spread(summary['young_modulus_2d_pa'], 1e-9)} GPa in 2D")
    right.set(xlabel="Axial strain (‰)", ylabel="Lateral extension (‰)",
              title=f"ν {spread(summary['poisson_ratio'], 1, 2)} in plane strain, "
                    f"{spread(summary['poisson_ratio_2d'], 1, 2)} in 2D")
    left.legend(loc="upper left")


def byerlee(confining):
    """Axial stress, Pa, of Byerlee's law at a confining stress."""
    def axial(friction, cohesion):
        root = np.sqrt(friction ** 2 + 1) + friction
        return root ** 2 * confining + 2 * cohesion * root
    return np.minimum(axial(0.85, 0.0), axial(0.6, 60e6))


def biaxial(figure, directory, summary):
    table = load_table(directory, "curves.csv")
    left, right = figure.subplots(1, 2)
    curves(left, table, "confining_pa", "axial_strain",
           lambda t: t["axial_stress_pa"], 100.0, 1e-6)
    left.set(xlabel="Axial strain (%)", ylabel="Axial stress (MPa)",
             title="Compression at confining stress")
    left.set_ylim(bottom=0)
    left.legend(loc="upper left", title="confining")
    confining = np.array([p["confining_pa"] for p in summary["points"]])
    peak = np.array([p["peak_axial_pa"] for p in summary["points"]])
    sd = np.array([p["sd_pa"] for p in summary["points"]])
    line = np.linspace(0.0, confining.max() * 1.05, 200)
    right.plot(line / 1e6, byerlee(line) / 1e6, color=TARGET, dashes=(5, 3), linewidth=1.2,
               label="Byerlee")
    if "friction" in summary:
        root = np.sqrt(summary["friction"] ** 2 + 1) + summary["friction"]
        right.plot(line / 1e6,
                   (root ** 2 * line + 2 * summary["cohesion_pa"] * root) / 1e6, color=FAINT,
                   linewidth=0.9, label=f"friction {summary['friction']:.2f}, "
                                        f"cohesion {summary['cohesion_pa'] / 1e6:.0f} MPa")
    right.errorbar(confining / 1e6, peak / 1e6, sd / 1e6, fmt="o", color=COLOURS[4],
                   markersize=5, capsize=3, label="peak, mean ± sd")
    right.set(xlabel="Confining stress (MPa)", ylabel="Peak axial stress (MPa)",
              title="Strength envelope")
    right.set_xlim(left=0)
    right.set_ylim(bottom=0)
    right.legend(loc="upper left")


def shear_box(figure, directory, summary):
    table = load_table(directory, "curves.csv")
    profiles = load_table(directory, "profiles.csv")
    left, middle, right = figure.subplots(1, 3, width_ratios=(1.4, 1, 1))
    stresses = groups(table, "normal_pa")
    for index, (stress, of_stress) in enumerate(stresses):
        strain = np.unique(np.round(table["shear_strain"][of_stress], 3))
        friction = table["shear_stress_pa"] / table["normal_stress_pa"]
        seeds = [np.interp(strain, table["shear_strain"][chosen], friction[chosen])
                 for seed in np.unique(table["seed"])
                 for chosen in [of_stress & (table["seed"] == seed)] if chosen.any()]
        mean, sd = np.mean(seeds, axis=0), np.std(seeds, axis=0)
        left.fill_between(strain, mean - sd, mean + sd, linewidth=0, alpha=0.2,
                          color=colour(index, len(stresses)))
        left.plot(strain, mean, color=colour(index, len(stresses)), linewidth=1.2,
                  label=f"{stress / 1e6:g} MPa")
        chosen = profiles["normal_pa"] == stress
        heights = np.unique(profiles["y_m"][chosen])
        middle.plot([profiles["displacement_m"][chosen & (profiles["y_m"] == y)].mean()
                     for y in heights], heights, color=colour(index, len(stresses)),
                    linewidth=1.2)
        broken = [np.interp(strain, table["shear_strain"][one], table["broken_outside"][one])
                  for seed in np.unique(table["seed"])
                  for one in [of_stress & (table["seed"] == seed)] if one.any()]
        right.plot(strain, np.mean(broken, axis=0) * 100, color=colour(index, len(stresses)),
                   linewidth=1.2)
    left.axvspan(0.1, 0.3, color="#f0f0f0", zorder=0, linewidth=0)
    left.axhline(0.5, color=TARGET, dashes=(5, 3), linewidth=1.2)
    left.set(xlabel="Shear strain of the zone", ylabel="Shear stress over normal stress",
             title="Bulk friction, mean ± sd")
    left.set_ylim(bottom=0)
    left.legend(loc="upper right", title="normal stress")
    half = summary["zone_width_m"] / 2
    middle.axhspan(-half, half, color="#f0f0f0", zorder=0, linewidth=0)
    middle.set(xlabel="Displacement (m)", ylabel="Height above the zone's middle (m)",
               title="Displacement profile")
    right.set(xlabel="Shear strain of the zone", ylabel="Share (%)",
              title="Bonds broken outside the zone")
    right.set_ylim(bottom=0)


def pure_shear(figure, directory, summary):
    left, middle, right = figure.subplots(1, 3, width_ratios=(1.2, 1, 1))
    standard = {key: summary[f"standard_{key}_rate_per_s"] for key in ("weakening", "healing")}
    faults = load_table(directory, "faults.csv", may_be_empty=True)
    chosen = np.full(len(faults["seed"]), True)
    for key, rate in standard.items():
        chosen &= faults[f"{key}_rate_per_s"] == rate
    predicted = summary["predicted_dip_deg"]
    left.axvspan(predicted - 6, predicted + 6, color="#f0f0f0", zorder=0, linewidth=0)
    left.axvline(predicted, color=TARGET, dashes=(5, 3), linewidth=1.2,
                 label=f"45° + φ/2 = {predicted:.0f}°, ± 6°")
    falls_right = faults["falls_right"] > 0
    bins = np.arange(30, 91, 5)
    left.hist([faults["dip_at_birth_deg"][chosen & side] for side in (falls_right, ~falls_right)],
              bins, weights=[faults["length_m"][chosen & side] / 1e3
                             for side in (falls_right, ~falls_right)],
              stacked=True, color=(COLOURS[4], COLOURS[1]), label=("to the right", "to the left"))
    left.set(xlabel="Dip at birth (°)", ylabel="Length of faults (km)",
             title=f"Faults at {standard['weakening']:g} and {standard['healing']:g} per second")
    left.legend(loc="upper left")
    curves = (("strain_top10", "strain in the most strained tenth", COLOURS[4], "o-"),
              ("healed_share", "healed share of new contacts", "#41ab5d", "s-"),
              ("weak_fraction", "weakened discs", "#fd8d3c", "^-"))
    for ax, key, other, name in ((middle, "weakening", "healing", "fault weakening"),
                                 (right, "healing", "weakening", "bond healing")):
        points = sorted((p for p in summary["points"]
                         if p[f"{other}_rate_per_s"] == standard[other]),
                        key=lambda p: p[f"{key}_rate_per_s"])
        ax.axvline(standard[key], color=TARGET, dashes=(5, 3), linewidth=1.2, label="paper")
        for measure, label, hue, style in curves:
            ax.errorbar([p[f"{key}_rate_per_s"] for p in points],
                        [p[measure]["mean"] for p in points],
                        [p[measure]["sd"] for p in points], fmt=style, color=hue, markersize=4,
                        linewidth=1.1, capsize=3, label=label)
        ax.set(xscale="log", xlabel="Critical strain rate (1/s)", ylabel="Share",
               title=f"Critical strain rate of {name}")
        ax.set_ylim(0, 1)
    middle.legend(loc="upper right")


PANELS = {"uniaxial": uniaxial, "biaxial": biaxial, "shear-box": shear_box,
          "pure-shear": pure_shear}


def main(arguments):
    if len(arguments) != 1:
        raise InputError("usage: laboratory.py DIR")
    directory = arguments[0]
    summary = load_summary(directory)
    with matplotlib.rc_context({**STYLE, "axes.titlesize": 10.5}):
        width = 12.0
        figure = Figure(figsize=(width, 4.6), dpi=DPI, facecolor="white",
                        layout="constrained")
        FigureCanvasAgg(figure)
        title = f"{summary['test'].replace('-', ' ').capitalize()} test of {summary['material']}"
        if "vice" in summary and summary["vice"] != "none":
            title += f" in a vice of {summary['vice']}"
        figure.suptitle(title, fontsize=13, weight="bold", x=0.01, ha="left")
        figure.supxlabel(
            "  ·  ".join([f"{summary['discs']} discs, mean radius "
                          f"{summary['mean_radius_m']:.3g} m", f"{summary['seeds']} samples",
                          f"floaters {summary['floaters']}"]
                         + ([f"slab: {summary['accuracy']}"] if "accuracy" in summary else [])
                         + summary.get("set", [])),
            fontsize=7.5, color=FAINT, x=0.01, ha="left")
        PANELS[summary["test"]](figure, directory, summary)
        path = os.path.join(directory, summary["test"] + ".png")
        temporary = os.path.join(directory, f".{summary['test']}.{os.getpid()}.tmp")
        try:
            figure.savefig(temporary, format="png", dpi=DPI)
            os.replace(temporary, path)
        finally:
            if os.path.exists(temporary):
                os.remove(temporary)


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except InputError as failure:
        sys.stderr.write("laboratory.py: " + " ".join(str(failure).split()) + "\n")
        sys.exit(1)
    except KeyboardInterrupt:
        sys.exit(130)
    except Exception as failure:   # e.g. disk full: still one line, no traceback
        text = " ".join(f"{type(failure).__name__}: {failure}".split())
        sys.stderr.write(f"laboratory.py: {text}\n")
        sys.exit(1)
