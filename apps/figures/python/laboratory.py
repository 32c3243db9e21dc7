#!/usr/bin/python3
"""Figure of a laboratory test.

Usage: laboratory.py DIR

DIR holds what `listric laboratory` wrote (SI units): summary.json, curves.csv of the samples, and
envelopes.csv (biaxial), profiles.csv (shear box) or faults.csv (pure shear).  It gets uniaxial.png,
biaxial.png, shear-box.png or pure-shear.png.  The file is written under a temporary name and then
renamed.  On bad input: one line on stderr, exit status 2.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import (FAINT, STYLE, InputError, matplotlib, name_powers, new_figure, read_json,
                  read_table, run, save)

import numpy as np

DPI = 150
TARGET, RANGE = "#d7301f", "#f0f0f0"
DASHED = {"color": TARGET, "dashes": (5, 3), "linewidth": 1.2}
# One colour per stress, light to dark.
COLOURS = ("#9ecae1", "#6baed6", "#4292c6", "#2171b5", "#08519c", "#08306b")
CRUST_YOUNG, CRUST_POISSON = 50e9, 0.25    # Pa, none: rock that uniaxial samples should match
ZONE_FRICTION, ZONE_STRAINS = 0.5, (0.1, 0.3)  # wanted of a shear zone, mean over these strains

# Measures of a slab under pure shear: key, label, colour, line and marker.
SHARES = (("strain_top10", "strain in the most strained tenth", COLOURS[4], "o-"),
          ("healed_share", "healed share of new contacts", "#41ab5d", "s-"),
          ("weak_fraction", "weakened discs", "#fd8d3c", "^-"))


def load_summary(directory: str) -> dict:
    path = os.path.join(directory, "summary.json")
    summary = read_json(path)
    if summary.get("test") not in PANELS:
        raise InputError(f"{path}: not the summary of a laboratory test")
    return summary


def colour(index: int, count: int) -> str:
    """Colour of the index-th of so many stresses."""
    return COLOURS[round(index * (len(COLOURS) - 1) / max(1, count - 1))]


def groups(table: dict[str, np.ndarray], key: str) -> list[tuple[float, np.ndarray]]:
    """(value, mask) for every value of a column, ascending."""
    return [(value, table[key] == value) for value in np.unique(table[key])]


def curves(ax, table: dict[str, np.ndarray], key: str, x: str, y: str, scale_x: float,
           scale_y: float) -> None:
    """One thin line per seed and one colour per stress, which is the column key (Pa)."""
    stresses = groups(table, key)
    for index, (stress, of_stress) in enumerate(stresses):
        for number, seed in enumerate(np.unique(table["seed"][of_stress])):
            chosen = of_stress & (table["seed"] == seed)
            ax.plot(table[x][chosen] * scale_x, table[y][chosen] * scale_y, linewidth=0.9,
                    color=colour(index, len(stresses)),
                    label=f"{stress / 1e6:g} MPa" if number == 0 else None)


def spread(value: dict[str, float], scale: float = 1.0, digits: int = 1) -> str:
    return f"{value['mean'] * scale:.{digits}f} ± {value['sd'] * scale:.{digits}f}"


# -------------------------------------------------------------------- panels

def uniaxial(figure, directory, summary):
    table = read_table(os.path.join(directory, "curves.csv"))
    left, right = figure.subplots(1, 2)
    for _, chosen in groups(table, "seed"):
        left.plot(table["gauge_axial_strain"][chosen] * 1e3,
                  table["axial_stress_pa"][chosen] / 1e6, linewidth=0.9, color=COLOURS[3])
        right.plot(table["gauge_axial_strain"][chosen] * 1e3,
                   -table["gauge_lateral_strain"][chosen] * 1e3, linewidth=0.9,
                   color=COLOURS[3])
    strain = np.array([0.0, table["gauge_axial_strain"].max()])
    nu = CRUST_POISSON / (1 - CRUST_POISSON)    # as a two-dimensional material shows them
    young = CRUST_YOUNG / (1 - CRUST_POISSON ** 2)
    left.plot(strain * 1e3, strain * young / 1e6, **DASHED,
              label=f"E {CRUST_YOUNG / 1e9:g} GPa, ν {CRUST_POISSON:g} in plane strain")
    right.plot(strain * 1e3, strain * nu * 1e3, **DASHED)
    left.set(xlabel="Axial strain (‰)", ylabel="Axial stress (MPa)",
             title=f"E {spread(summary['young_modulus_pa'], 1e-9)} GPa in plane strain, "
                   f"{spread(summary['young_modulus_2d_pa'], 1e-9)} GPa in 2D")
    right.set(xlabel="Axial strain (‰)", ylabel="Lateral extension (‰)",
              title=f"ν {spread(summary['poisson_ratio'], 1, 2)} in plane strain, "
                    f"{spread(summary['poisson_ratio_2d'], 1, 2)} in 2D")
    left.legend(loc="upper left")


def envelopes(directory: str) -> dict[str, np.ndarray]:
    """Peak axial stress by confining stress, Pa: Byerlee's law, and the fit if there is one."""
    return read_table(os.path.join(directory, "envelopes.csv"))


def biaxial(figure, directory, summary):
    table = read_table(os.path.join(directory, "curves.csv"))
    left, right = figure.subplots(1, 2)
    curves(left, table, "confining_pa", "axial_strain", "axial_stress_pa", 100.0, 1e-6)
    left.set(xlabel="Axial strain (%)", ylabel="Axial stress (MPa)",
             title="Compression at confining stress")
    left.set_ylim(bottom=0)
    left.legend(loc="upper left", title="confining")
    draw_envelopes(right, envelopes(directory), summary)


def draw_envelopes(axes, lines: dict[str, np.ndarray], summary: dict) -> None:
    """Strength by confining stress: Byerlee's law, the fit and the peaks of the samples."""
    axes.plot(lines["confining_pa"] / 1e6, lines["byerlee_axial_pa"] / 1e6, **DASHED,
              label="Byerlee")
    if "fitted_axial_pa" in lines:
        axes.plot(lines["confining_pa"] / 1e6, lines["fitted_axial_pa"] / 1e6, color=FAINT,
                  linewidth=0.9, label=f"friction {summary['friction']:.2f}, "
                                       f"cohesion {summary['cohesion_pa'] / 1e6:.0f} MPa")
    confining, peak, sd = (np.array([p[name] for p in summary["points"]]) / 1e6
                           for name in ("confining_pa", "peak_axial_pa", "sd_pa"))
    axes.errorbar(confining, peak, sd, fmt="o", color=COLOURS[4], markersize=5, capsize=3,
                  label="peak, mean ± sd")
    axes.set(xlabel="Confining stress (MPa)", ylabel="Peak axial stress (MPa)",
             title="Strength envelope")
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.legend(loc="upper left")


def by_strain(strain: np.ndarray, table: dict[str, np.ndarray], values: np.ndarray,
              chosen: np.ndarray) -> list[np.ndarray]:
    """Values at these shear strains, for every seed that has chosen rows."""
    rows = [chosen & of_seed for _, of_seed in groups(table, "seed")]
    return [np.interp(strain, table["shear_strain"][row], values[row]) for row in rows if row.any()]


def shear_box(figure, directory, summary):
    table = read_table(os.path.join(directory, "curves.csv"))
    profiles = read_table(os.path.join(directory, "profiles.csv"))
    left, middle, right = figure.subplots(1, 3, width_ratios=(1.4, 1, 1))
    stresses = groups(table, "normal_pa")
    for index, (stress, of_stress) in enumerate(stresses):
        draw_stress((left, middle, right), table, of_stress, profiles, stress,
                    colour(index, len(stresses)))
    left.axvspan(*ZONE_STRAINS, color=RANGE, zorder=0, linewidth=0)
    left.axhline(ZONE_FRICTION, **DASHED)
    left.set(xlabel="Shear strain of the zone", ylabel="Shear stress over normal stress",
             title="Bulk friction, mean ± sd")
    left.set_ylim(bottom=0)
    left.legend(loc="upper right", title="normal stress")
    half = summary["zone_width_m"] / 2
    middle.axhspan(-half, half, color=RANGE, zorder=0, linewidth=0)
    middle.set(xlabel="Displacement (m)", ylabel="Height above the zone's middle (m)",
               title="Displacement profile")
    right.set(xlabel="Shear strain of the zone", ylabel="Share (%)",
              title="Bonds broken outside the zone")
    right.set_ylim(bottom=0)


def draw_stress(all_axes, table, of_stress: np.ndarray, profiles, stress: float,
                hue: str) -> None:
    """Friction, displacement profile and broken bonds of one normal stress (Pa)."""
    left, middle, right = all_axes
    strain = np.unique(np.round(table["shear_strain"][of_stress], 3))
    friction = by_strain(strain, table, table["shear_stress_pa"] / table["normal_stress_pa"],
                         of_stress)
    mean, sd = np.mean(friction, axis=0), np.std(friction, axis=0)
    left.fill_between(strain, mean - sd, mean + sd, linewidth=0, alpha=0.2, color=hue)
    left.plot(strain, mean, color=hue, linewidth=1.2, label=f"{stress / 1e6:g} MPa")
    chosen = profiles["normal_pa"] == stress
    heights = np.unique(profiles["y_m"][chosen])
    middle.plot([profiles["displacement_m"][chosen & (profiles["y_m"] == y)].mean()
                 for y in heights], heights, color=hue, linewidth=1.2)
    broken = by_strain(strain, table, table["broken_outside"], of_stress)
    right.plot(strain, np.mean(broken, axis=0) * 100, color=hue, linewidth=1.2)


def pure_shear(figure, directory, summary):
    faults = read_table(os.path.join(directory, "faults.csv"), may_be_empty=True)
    left, middle, right = figure.subplots(1, 3, width_ratios=(1.2, 1, 1))
    standard = {key: summary[f"standard_{key}_rate_per_s"] for key in ("weakening", "healing")}
    draw_dips(left, faults, standard, summary["predicted_dip_deg"])
    draw_rates(middle, summary["points"], standard, "weakening", "healing")
    draw_rates(right, summary["points"], standard, "healing", "weakening")
    middle.set_title("Critical strain rate of fault weakening")
    right.set_title("Critical strain rate of bond healing")
    middle.legend(loc="upper right")


def draw_dips(axes, faults, standard: dict[str, float], predicted: float) -> None:
    """Length of faults by dip, to either side, at the standard rates (1/s)."""
    chosen = np.full(len(faults["seed"]), True)
    for key, rate in standard.items():
        chosen &= faults[f"{key}_rate_per_s"] == rate
    axes.axvspan(predicted - 6, predicted + 6, color=RANGE, zorder=0, linewidth=0)
    axes.axvline(predicted, **DASHED, label=f"45° + φ/2 = {predicted:.0f}°, ± 6°")
    to_right = faults["falls_right"] > 0
    sides = (chosen & to_right, chosen & ~to_right)
    axes.hist([faults["dip_at_birth_deg"][side] for side in sides], np.arange(30, 91, 5),
              weights=[faults["length_m"][side] / 1e3 for side in sides], stacked=True,
              color=(COLOURS[4], COLOURS[1]), label=("to the right", "to the left"))
    axes.set(xlabel="Dip at birth (°)", ylabel="Length of faults (km)",
             title=f"Faults at {standard['weakening']:g} and {standard['healing']:g} per second")
    axes.legend(loc="upper left")


def draw_rates(axes, points: list[dict], standard: dict[str, float], key: str,
               other: str) -> None:
    """Shares by the critical strain rate of that key, the other one's being standard."""
    rate = f"{key}_rate_per_s"
    points = sorted((p for p in points if p[f"{other}_rate_per_s"] == standard[other]),
                    key=lambda p: p[rate])
    axes.axvline(standard[key], **DASHED, label="paper")
    for measure, label, hue, style in SHARES:
        axes.errorbar([p[rate] for p in points], [p[measure]["mean"] for p in points],
                      [p[measure]["sd"] for p in points], fmt=style, color=hue, markersize=4,
                      linewidth=1.1, capsize=3, label=label)
    axes.set(xscale="log", xlabel="Critical strain rate (1/s)", ylabel="Share")
    name_powers(axes)
    axes.set_ylim(0, 1)


PANELS = {"uniaxial": uniaxial, "biaxial": biaxial, "shear-box": shear_box,
          "pure-shear": pure_shear}


def subtitle(summary: dict) -> str:
    """Description of the samples, as small print."""
    parts = [f"{summary['discs']} discs, mean radius {summary['mean_radius_m']:.3g} m",
             f"{summary['seeds']} samples", f"floaters {summary['floaters']}"]
    if "accuracy" in summary:
        parts.append(f"slab: {summary['accuracy']}")
    return "  ·  ".join(parts + summary.get("set", []))


def draw(directory: str, summary: dict):
    figure = new_figure(12.0, 4.6, DPI, layout="constrained")
    title = f"{summary['test'].replace('-', ' ').capitalize()} test of {summary['material']}"
    if summary.get("vice", "none") != "none":
        title += f" in a vice of {summary['vice']}"
    figure.suptitle(title, fontsize=13, weight="bold", x=0.01, ha="left")
    figure.supxlabel(subtitle(summary), fontsize=7.5, color=FAINT, x=0.01, ha="left")
    PANELS[summary["test"]](figure, directory, summary)
    return figure


def main(directory: str) -> None:
    summary = load_summary(directory)
    with matplotlib.rc_context({**STYLE, "axes.titlesize": 10.5, "legend.fontsize": 8.5,
                                "legend.frameon": False, "axes.spines.top": False,
                                "axes.spines.right": False}):
        save(draw(directory, summary), directory, summary["test"])


if __name__ == "__main__":
    run(main, "laboratory.py DIR")
