"""Panels of a figure: strata, bonds, behaviour, strain, sediment or kinematics.

Every panel is drawn by a function of its axes, the axes of its colour bar and the frame.
"""
import math

from axes import (bar, depth_axis, describe, distance_axis, draw_faults, exaggeration, section_axes, stroke,
                  swatch)
from discs import draw_discs
from frame import Frame, Layer
from page import PANEL_WIDTH, PROFILE_HEIGHT, strain_remark, time_texts, window_text
from picture import read_picture
from plot import FAINT, INK, RASTER_DPI
from scales import strain_colours, strain_ticks, stratum_ticks
from vocabulary import (BED_COLOURS, INKS, LAYER, LAYER_COLOURS, ROCK_CLASSES, VOCABULARY, layer_colours,
                        palette, stratum_colours)

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm, LinearSegmentedColormap, ListedColormap, Normalize, to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter

SEDIMENT, SEDIMENT_EDGE, SEDIMENT_PALE = "#fbeab4", "#b07d00", "#fdf6dc"
WEAK = "#d7301f"
BOND, BOND_SEDIMENT = INKS["bonds"], "#a87a10"
UNDEFINED = VOCABULARY["scale"]["undefined"]
NO_SEDIMENT = "#e2e8ee"
PICK, HORIZON, NORMALS_BLUE = INKS["picks"], INKS["horizons"], INKS["predictions"]
LEVEL_BLUE, TOP_GREEN = INKS["target"], "#2b8a3e"
TOPS = "Tops against the regional"
ARROW_CELL = 0.025   # side of the squares that have an arrow each, over the view's width
MOST_DEPOCENTRES = 10     # that are labelled


def strata_panel(ax, cax, frame: Frame) -> None:
    """Sediment strata by age, pre-rift layers by start depth (km), faults (mm/a)."""
    section_axes(ax, frame)
    rgb = layer_colours(frame.start_depth)
    sediment = frame.stratum > 0
    if frame.beds is not None:
        bed = frame.beds > 0
        rgb[bed] = bed_colours()[(frame.beds[bed] - 1) % len(BED_COLOURS)]
    if sediment.any():
        colours = stratum_colours(frame.strata)
        rgb[sediment] = colours[frame.stratum[sediment] - 1]
        strata_bar(cax, colours, frame)
    else:
        cax.set_axis_off()
    draw_discs(ax, frame, rgb)
    handles = [(tuple(swatch(c) for c in LAYER_COLOURS), f"pre-rift, {LAYER:g} km layers"),
               *bed_handles(frame), (stroke(INK, 1.5), "detachment" if frame.has_detachment else "base")]
    if frame.level is not None:
        style = {"color": LEVEL_BLUE, "linewidth": 1.0, "dashes": (6, 3), "zorder": 6}
        if frame.target_line is None:
            ax.axhline(frame.level, **style)
        else:
            (left, right), line = ax.get_xlim(), frame.target_line
            ax.plot((left, *line[:, 0], right), (line[0, 1], *line[:, 1], line[-1, 1]), **style)
        what = "level" if frame.target_line is None else "line"
        # Where nothing is laid down or eroded it is what heights are told against, and no target.
        label = f"regional (target {what} before)" if frame.meta.get("surface_rests") else f"target {what} of sediments"
        handles.append((stroke(LEVEL_BLUE, 1.0, dashes=(4, 2)), label))
    handles += draw_layers(ax, frame)
    if frame.picked_fault is not None:
        x, y = frame.picked_fault.T
        ax.plot(x, y, linestyle="none", marker="o", markersize=2.5, markerfacecolor="none",
                markeredgecolor=INK, markeredgewidth=0.5, zorder=7)
        handles.append((Line2D([], [], linestyle="none", marker="o", markersize=3,
                               markerfacecolor="none", markeredgecolor=INK), "picked"))
    handles += draw_observed(ax, frame)
    handles += draw_faults(ax, frame)
    describe(ax, frame, "Syn-rift strata" if sediment.any() else "Pre-rift layers", handles)


def bed_colours() -> np.ndarray:
    return np.array([to_rgb(colour) for colour in BED_COLOURS])


def bed_handles(frame: Frame) -> list:
    """Legend entries of the layers of rock: one for each colour, with the names that have it."""
    names: dict[str, list[str]] = {}
    for n, name in enumerate(frame.bed_names):
        names.setdefault(BED_COLOURS[n % len(BED_COLOURS)], []).append(name)
    return [(swatch(colour), ", ".join(some)) for colour, some in names.items()]


def draw_layers(ax, frame: Frame) -> list:
    """Bands and lines of effects; returns legend entries."""
    handles = []
    for layer in frame.layers:
        if layer.kind == "band":
            ax.fill_between(*layer.rows.T, color=layer.ink, linewidth=0, zorder=1.5)
            handles.append((swatch(layer.ink), layer.label))
        elif layer.kind == "line":
            ax.plot(*layer.rows.T, color=layer.ink, linewidth=1.2, zorder=6)
            handles.append((stroke(layer.ink, 1.2), layer.label))
    return handles


def underlay_panel(ax, cax, frame: Frame) -> None:
    """The model's horizons and faults over a picture of a section."""
    section_axes(ax, frame)
    cax.set_axis_off()
    underlay = frame.meta["underlay"]
    left, top, right, bottom = (value / 1000.0 for value in underlay["corners_m"])
    draw_picture(ax, underlay["image"], (left, -top, right, -bottom))
    style = dict(color=HORIZON, linewidth=0.9)
    for number in np.unique(frame.horizons[:, 0]):
        x, y = frame.horizons[frame.horizons[:, 0] == number, 1:].T
        ax.plot(x, y, zorder=7, **style)
    handles = [(Line2D([], [], **style), "horizons of the model")]
    handles += draw_observed(ax, frame)
    handles += draw_faults(ax, frame)
    describe(ax, frame, "Model over the section", handles)


def draw_picture(ax, path: str, corners: tuple[float, float, float, float]) -> None:
    """A picture with its left, upper, right and lower edge there (km, heights), as far as it is in view."""
    (west, east), (low, high) = ax.get_xlim(), ax.get_ylim()
    left, top, right, bottom = corners
    box, dots = ax.get_window_extent(), max(1.0, RASTER_DPI / ax.figure.dpi)
    size = (dots * box.width * (right - left) / (east - west), dots * box.height * (top - bottom) / (high - low))
    edges = [(max(left, west) - left) / (right - left), (top - min(top, high)) / (top - bottom),
             (min(right, east) - left) / (right - left), (top - max(bottom, low)) / (top - bottom)]
    if edges[0] >= edges[2] or edges[1] >= edges[3]:   # beside the view
        return
    picture, (first_x, first_y, end_x, end_y) = read_picture(path, size, tuple(edges))
    ax.imshow(picture, extent=(left + first_x * (right - left), left + end_x * (right - left),
                               top - end_y * (top - bottom), top - first_y * (top - bottom)),
              aspect="equal", interpolation="antialiased", zorder=1.2)
    ax.set(xlim=(west, east), ylim=(low, high))


def draw_observed(ax, frame: Frame) -> list:
    """Picked horizons as crosses, the model's beside them as lines, picked faults dashed."""
    handles = []
    for name, style, label in (
            ("compared_horizons", dict(color=PICK, linewidth=1.2), "compared with"),
            ("picked_horizons", dict(color=PICK, linestyle="none", marker="+", markersize=4.5,
                                     markeredgewidth=0.9), "picked horizon"),
            ("picked_faults", dict(color=PICK, linewidth=1.2, dashes=(4, 2)), "picked fault")):
        lines = getattr(frame, name)
        if lines is None or len(lines) == 0:
            continue
        for number in np.unique(lines[:, 0]):
            x, y = lines[lines[:, 0] == number, 1:].T
            ax.plot(x, y, zorder=8, **style)
        handles.append((Line2D([], [], **style), label))
    return handles


def strata_bar(cax, colours: np.ndarray, frame: Frame) -> None:
    """Scale of the strata: when they were laid down, or their numbers where that is not known."""
    count = len(colours)
    norm = BoundaryNorm(np.arange(count + 1) + 0.5, count)
    ages = frame.meta.get("strata_a")
    known = isinstance(ages, list) and len(ages) == count
    ticks = [t for t in stratum_ticks(count) if not known or t > 1 or count <= 8]
    label, names = "Stratum (1 is the oldest)", [str(t) for t in ticks]
    if known:
        times = [ages[t - 1] for t in ticks]
        names, unit = time_texts(times, min(np.diff(times), default=math.inf), frame.meta.get("end_a", math.inf))
        label = f"Laid down at ({unit})"
    colour_bar = bar(cax, ListedColormap(colours), norm, label, spacing="proportional", drawedges=False)
    colour_bar.set_ticks(ticks, labels=names)
    colour_bar.ax.minorticks_off()


def bonds_panel(ax, cax, frame: Frame) -> None:
    """Contact bonds as lines; where they are broken, the section stays white."""
    section_axes(ax, frame)
    cax.set_axis_off()
    if frame.bonded is None:
        describe(ax, frame, "Contact-bond pattern (bonds off)")
        return
    points = 2 * np.median(frame.radius) * PANEL_WIDTH * 72 / frame.span
    young = frame.bonded[:, 4] > 0.5
    sediment = frame.stratum > 0
    rgb = np.ones((len(frame.x), 3))
    rgb[sediment] = to_rgb(SEDIMENT_PALE)
    alpha = sediment.astype(float)
    inked = [layer for layer in frame.layers if layer.kind == "discs" and not layer.is_graded]
    for layer in inked:
        share = layer.rows[:, np.newaxis]
        rgb = (1.0 - share) * rgb + share * np.array(to_rgb(layer.ink))
        alpha[layer.rows > 0.0] = 1.0
    draw_discs(ax, frame, rgb,
               ((frame.bonded[~young, :4], BOND), (frame.bonded[young, :4], BOND_SEDIMENT)),
               segment_width=float(np.clip(0.17 * points, 0.25, 0.9)), alpha=alpha)
    handles = [(stroke(BOND, 1.2), "bond, pre-rift")]
    if sediment.any():
        handles.append((stroke(BOND_SEDIMENT, 1.2), "bond, sediment"))
        handles.append((swatch(SEDIMENT_PALE), "sediment"))
    handles += [(swatch(layer.ink), layer.label) for layer in inked]
    describe(ax, frame, "Contact-bond pattern", handles)


def behaviour_panel(ax, cax, frame: Frame) -> None:
    """Inferred rock behaviour in four types, and the active faults [paper, Fig. 9b]."""
    section_axes(ax, frame)
    cax.set_axis_off()
    kind = frame.behaviour
    if kind is None:
        describe(ax, frame, "Rock behaviour (bonds off)")
        return
    draw_discs(ax, frame, np.array([to_rgb(rock["colour"]) for rock in ROCK_CLASSES])[kind])
    handles = [(swatch(rock["colour"]), rock["label"]) for k, rock in enumerate(ROCK_CLASSES)
               if (kind == k).any() or k < 2]
    handles += draw_faults(ax, frame)
    describe(ax, frame, "Rock behaviour", handles)


def strain_panel(ax, cax, frame: Frame) -> None:
    """Shear strain (no unit) of the last whole window of extension."""
    section_axes(ax, frame)
    limit = frame.strain_end
    finite = np.isfinite(frame.strain)
    cmap, norm = strain_colours(), Normalize(0.0, limit, clip=True)
    rgb = cmap(norm(np.where(finite, frame.strain, 0.0)))[:, :3]
    rgb[~finite] = to_rgb(UNDEFINED["colour"])
    draw_discs(ax, frame, rgb)
    strain_bar(cax, limit, frame.strain[finite].max() if finite.any() else 0.0)
    handles = []
    if not finite.all():
        handles.append((swatch(UNDEFINED["colour"]), UNDEFINED["label"]))
    if frame.profile is not None and (frame.stratum > 0).any():
        ax.plot(frame.profile[:, 0], frame.profile[:, 1], color=TOP_GREEN, linewidth=1.0,
                zorder=6)
        handles.append((stroke(TOP_GREEN, 1.0), "pre-rift top"))
    handles += draw_faults(ax, frame)
    describe(ax, frame, f"Shear strain{strain_remark(frame)}, {window_text(frame)}", handles)


def strain_bar(cax, limit: float, highest: float) -> None:
    above = highest > limit * (1 + 1e-9)
    colour_bar = bar(cax, strain_colours(), Normalize(0.0, limit),
                     f"Shear strain (max.\u00a0{highest:.2g})" if above else "Shear strain",
                     extend="max" if above else "neither", extendfrac=0.04)
    colour_bar.set_ticks(strain_ticks(limit))
    colour_bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:.3g}"))


def sediment_panel(ax, cax, frame: Frame) -> None:
    """Thickness of sediments and depth of the pre-rift top (km, both down)."""
    cax.set_axis_off()
    ax.set_xlim(*frame.view[:2])
    distance_axis(ax, frame)
    if frame.profile is None:
        ax.set_yticks([])
        ax.text(0.5, 0.5, "no thickness profile in this frame", color=FAINT,
                ha="center", va="center", transform=ax.transAxes)
        describe(ax, frame, "Sediment thickness")
        return
    x, top, thickness = frame.profile.T
    known = np.isfinite(thickness)
    shown = -np.where(known, thickness, np.nan)
    deepest = max(np.nanmax(-shown, initial=0.0), np.nanmax(-top, initial=0.0), 0.5 * frame.unit)
    highest = max(np.nanmax(top, initial=0.0), 0.0)
    # Room for the numbers of depocentres; a small panel has less of it.
    ax.set_ylim(-(1.32 if frame.legends is None else 1.6) * deepest, highest + 0.10 * deepest)
    depth_axis(ax, "Thickness, depth (km)" if frame.legends is None else "Depth (km)")
    if frame.legends is None:                   # a page
        ax.text(0.99, 0.04, f"heights × {exaggeration(ax):.1f}", transform=ax.transAxes, ha="right", va="bottom", fontsize=9,
                color=FAINT, zorder=8)
    ax.grid(axis="y", color="#dddddd", linewidth=0.6, zorder=0)
    ax.set_axisbelow(True)
    ax.fill_between(x, 0.0, shown, where=known, color=SEDIMENT, linewidth=0, zorder=1)
    ax.plot(x, shown, color=SEDIMENT_EDGE, linewidth=1.4, zorder=3)
    ax.plot(x, top, color=INK, linewidth=1.1, dashes=(4, 2), zorder=4)
    ax.axhline(0.0, color=FAINT, linewidth=0.8, zorder=2)
    handles = [
        (Patch(facecolor=SEDIMENT, edgecolor=SEDIMENT_EDGE, linewidth=1.2), "sediment thickness, mean over 1 km"),
        (stroke(INK, 1.1, dashes=(3, 1.5)), "depth of pre-rift top")]
    if frame.depocentres is not None and len(frame.depocentres):
        draw_depocentres(ax, frame.depocentres, is_small=frame.legends is not None)
        handles.append((Line2D([], [], color=WEAK, marker="^", markersize=7,
                               linestyle="none"),
                        "depocentre: thickness, prominence (km)" if frame.legends is None else "depocentre: thickness (km)"))
    describe(ax, frame, "Sediment thickness and pre-rift top", handles)


def draw_depocentres(ax, depocentres: np.ndarray, is_small: bool) -> None:
    """Mark depocentres below the curve; labels of the most prominent ones, shorter on a small panel."""
    points = depocentres[np.argsort(-depocentres[:, 2], kind="stable")]
    xmin, xmax = ax.get_xlim()
    ymin, ymax = ax.get_ylim()
    inches_y = PROFILE_HEIGHT / (ymax - ymin)
    inches_x = inches_y / exaggeration(ax)
    if is_small:                            # as if in the inches of a page
        inches_x, inches_y = 0.4 * PANEL_WIDTH / (xmax - xmin), 0.4 * inches_y
    half, height = (0.15 if is_small else 0.37) / inches_x, 0.17 / inches_y
    placed = []
    for index, (x, thickness, prominence) in enumerate(points):
        ax.plot(x, -thickness - 0.05 / inches_y, marker="^", markersize=7, color=WEAK,
                markeredgecolor="white", markeredgewidth=0.5, zorder=6, clip_on=False)
        if index >= MOST_DEPOCENTRES:
            continue
        cx = min(max(x, xmin + 1.1 * half), xmax - 1.1 * half)
        cy = free_height(placed, cx, -thickness - 0.21 / inches_y, 2 * half, height)
        if cy < ymin + 0.4 * height:        # no room left: marker only
            continue
        placed.append((cx, cy))
        ax.text(cx, cy, f"{thickness:.1f}" if is_small else f"{thickness:.1f}, {prominence:.1f}", fontsize=9, ha="center",
                va="center", zorder=7, bbox={"facecolor": "white", "alpha": 0.75,
                                             "linewidth": 0, "pad": 0.6})


def free_height(placed: list[tuple[float, float]], x: float, y: float, width: float,
                height: float) -> float:
    """Highest place at or below y where a label of that size hits none that are placed."""
    for _ in range(12):
        hit = [p for p in placed if abs(p[0] - x) < width and abs(p[1] - y) < height]
        if not hit:
            break
        y = min(p[1] for p in hit) - height
    return y


def kinematics_panel(ax, cax, frame: Frame) -> None:
    """The model's pre-rift top beside kinematic constructions, all at true scale."""
    section_axes(ax, frame)
    cax.set_axis_off()
    handles = []
    meta = frame.meta
    if frame.profile is not None:
        x, top, _ = frame.profile.T
        ax.fill_between(x, top, 0.0, where=top < 0, color=SEDIMENT_PALE, linewidth=0, zorder=2)
        ax.plot(x, top, color=INK, linewidth=1.8, zorder=6)
        handles.append((stroke(INK, 1.8), "pre-rift top"))
    if frame.predicted_normals is not None and len(frame.predicted_normals) > 1:
        ax.add_collection(LineCollection(
            pieces(frame.predicted_normals, 0.5 * frame.unit), colors=NORMALS_BLUE, linewidths=1.8,
            linestyles=(0, (6, 2)), zorder=7), autolim=False)
        label = "normals stay normal"
        if "predicted_tilt_deg" in meta and "rollover_tilt_deg" in meta:
            label += (f" (tilt {meta['predicted_tilt_deg']:.1f}°, "
                      f"model {meta['rollover_tilt_deg']:.1f}°)")
        handles.append((stroke(NORMALS_BLUE, 1.8, dashes=(4, 1.5)), label))
    if frame.predicted_shear is not None and len(frame.predicted_shear) > 1:
        ax.plot(*frame.predicted_shear.T, color=WEAK, linewidth=1.5, dashes=(2, 1.5), zorder=7)
        handles.append((stroke(WEAK, 1.5, dashes=(1.5, 1.2)),
                        f"inclined shear, {meta.get('inclined_shear_angle_deg', 0):g}° "
                        "(best fit)"))
    ax.text(0.985, 0.06, "\n".join(areas_text(meta)), transform=ax.transAxes, ha="right",
            va="bottom", fontsize=9.5, zorder=8)
    describe(ax, frame, "Kinematics", handles)


def pieces(curve: np.ndarray, gap: float) -> list[np.ndarray]:
    """The curve without its steps above gap (km): where normals part, nothing is predicted."""
    step = np.hypot(*np.diff(curve, axis=0).T)
    return [p for p in np.split(curve, np.flatnonzero(step > gap) + 1) if len(p) > 1]


def areas_text(meta: dict) -> list[str]:
    """Measures of the basin's area."""
    text = []
    if "area_balance" in meta:
        text.append(f"basin area = {meta['area_balance']:.3f} × extension × thickness")
    if "halfgraben_area_share" in meta:
        split = f"halfgraben's share {meta['halfgraben_area_share']:.2f}"
        if "predicted_halfgraben_area_share" in meta:
            split += f" (normals: {meta['predicted_halfgraben_area_share']:.2f})"
        text.append(split)
    return text


def inversion_panel(ax, cax, frame: Frame) -> None:
    """Heights of the tops of all strata above the regional: shortening lifts them back through it."""
    ax.set_xlim(*frame.view[:2])
    distance_axis(ax, frame)
    if frame.tops is None or not len(frame.tops):
        cax.set_axis_off()
        ax.set_yticks([])
        ax.text(0.5, 0.5, "no shortening before this moment", color=FAINT, ha="center", va="center", transform=ax.transAxes)
        describe(ax, frame, TOPS)
        return
    heights = frame.tops[:, 3]
    lowest = heights[frame.tops[:, 0] >= 0].min(initial=-0.5 * frame.unit)
    ax.set_ylim(1.06 * lowest, max(heights.max(), 0.3 * frame.unit) * 1.12)
    colours = stratum_colours(frame.strata)
    if frame.strata:
        strata_bar(cax, colours, frame)
    else:
        cax.set_axis_off()
    handles = [(stroke(LEVEL_BLUE, 1.2, dashes=(4, 2)), "regional")]
    ax.axhline(0.0, color=LEVEL_BLUE, linewidth=1.2, dashes=(6, 3), zorder=8)
    for number in np.unique(frame.tops[:, 1]):
        piece = frame.tops[frame.tops[:, 1] == number]
        stratum = int(piece[0, 0])
        style = {"color": colours[stratum - 1], "linewidth": 1.1} if stratum > 0 else \
            {"color": INK, "linewidth": 1.8} if stratum == 0 else {"color": FAINT, "linewidth": 0.9}
        ax.plot(piece[:, 2], piece[:, 3], zorder=7 if stratum == 0 else 5, **style)
    if (frame.tops[:, 0] == 0).any():
        handles.append((stroke(INK, 1.8), "pre-rift top"))
    if (frame.tops[:, 0] < 0).any():
        handles.append((stroke(FAINT, 0.9), "boundary of layers"))
    if frame.strata:
        handles.append((tuple(stroke(colours[k], 1.4) for k in sorted({0, frame.strata // 2, frame.strata - 1})),
                        "tops of strata"))
    if frame.legends is None:                   # a page has room; captions say it, too
        ax.set_ylabel("Height above the regional (km)")
        ax.text(0.985, 0.06, "\n".join([*frame.meta.get("said", []), f"heights × {exaggeration(ax):.1f}"]), transform=ax.transAxes,
                ha="right", va="bottom", fontsize=9.5, zorder=9)
    describe(ax, frame, TOPS if frame.legends is None else f"{TOPS}, height in km", handles)


def layer_panel(name: str):
    """Panel of an effect's layer whose ink has shades."""
    def panel(ax, cax, frame: Frame) -> None:
        layer = next(layer for layer in frame.layers if layer.name == name)
        section_axes(ax, frame)
        colours = LinearSegmentedColormap.from_list(name, [SEDIMENT_PALE, layer.ink])
        rgb = colours(layer.rows)[:, :3]
        rgb[frame.stratum == 0] = to_rgb(NO_SEDIMENT)
        inked = layer.rows > 0.0
        rgb[inked] = colours(layer.rows[inked])[:, :3]
        draw_discs(ax, frame, rgb)
        bar(cax, colours, Normalize(0.0, layer.full), layer.label.capitalize(),
            extend="max" if (layer.rows >= 1.0).any() else "neither", extendfrac=0.04)
        arrows = draw_arrows(ax, frame, layer)
        describe(ax, frame, layer.label.capitalize(),
                 [(swatch(NO_SEDIMENT), "pre-rift"), *arrows, *draw_faults(ax, frame)])
    return panel


def draw_arrows(ax, frame: Frame, layer: Layer) -> list:
    """Arrows of a layer: mean velocity in squares that hold four discs of sediment or more. The root of a
    speed is drawn, as mud of 1 km passes hundreds of times the water that mud of 5 km does."""
    cells = mean_velocities(frame, layer.arrows)
    if not len(cells):
        return []
    x, y, u, v = cells.T
    speed = np.hypot(u, v)
    fastest = speed.max()
    length = ARROW_CELL * frame.span / np.sqrt(np.maximum(speed, 1e-30) * fastest)
    ax.quiver(x, y, u * length, v * length, angles="xy", scale_units="xy", scale=1.0, pivot="middle",
              color=INK, width=0.0011, headwidth=4, headlength=5, headaxislength=4.5, zorder=6.5)
    return [(Line2D([], [], color=INK, linewidth=0.8, marker=">", markersize=3, markevery=[1]),
             f"{layer.arrows_label}, up to {fastest:.2g} mm/a (lengths by its root)")]


def mean_velocities(frame: Frame, velocity: np.ndarray | None) -> np.ndarray:
    """x, y of a square's discs (km), and the mean of their velocity (mm/a): of discs that have one."""
    if velocity is None:
        return np.zeros((0, 4))
    moving = (frame.stratum > 0) & (np.abs(velocity).max(axis=1) > 0.0)
    values = np.column_stack((frame.x, frame.y, velocity))[moving]
    squares = np.floor(values[:, :2] / (ARROW_CELL * frame.span)).astype(int)
    _, square, count = np.unique(squares, axis=0, return_inverse=True, return_counts=True)
    sums = np.zeros((len(count), 4))
    np.add.at(sums, square.ravel(), values)
    return (sums / count[:, np.newaxis])[count >= 4]


def seismic_panel(ax, cax, frame: Frame) -> None:
    """Synthetic seismic image in two-way time; dark where the rock below is harder."""
    cax.set_axis_off()
    x, spacing, first, frequency, interval, _ = frame.seismic_axes
    traces, samples = frame.seismic.shape
    draw_wiggles(ax, frame.seismic, (x - spacing / 2) / 1000, (x + (traces - 0.5) * spacing) / 1000,
                 first - interval / 2, first + (samples - 0.5) * interval)
    ax.set_xlim(*frame.view[:2])
    ax.set_ylim(first + (samples - 1) * interval, first)
    ax.set_ylabel("Two-way time (s)")
    distance_axis(ax, frame)
    describe(ax, frame, f"Synthetic seismic image, {frequency:g} Hz", polarity())


def seismic_depth_panel(ax, cax, frame: Frame) -> None:
    """Synthetic seismic image in depth, at equal scales, with the active faults."""
    section_axes(ax, frame)
    cax.set_axis_off()
    x, spacing, first, frequency, interval, _ = frame.seismic_depth_axes
    traces, samples = frame.seismic_depth.shape
    limits = ax.axis()
    draw_wiggles(ax, frame.seismic_depth, (x - spacing / 2) / 1000, (x + (traces - 0.5) * spacing) / 1000,
                 (interval / 2 - first) / 1000, -(first + (samples - 0.5) * interval) / 1000)
    ax.axis(limits)
    describe(ax, frame, f"Synthetic seismic image in depth, {frequency:g} Hz", [*polarity(), *draw_faults(ax, frame)])


def polarity() -> list:
    """Legend entries of the greys."""
    pale, *_, dark = palette(VOCABULARY["layers"]["seismic"]["palette"])
    return [(swatch(dark), "rock below is harder"), (swatch(pale), "softer")]


def draw_wiggles(ax, traces: np.ndarray, left: float, right: float, top: float, bottom: float) -> None:
    """Amplitudes as greys, white to black, clipped where 90 of 100 samples of reflections are. A pixel
    has the mean of its samples."""
    box = ax.get_window_extent()
    across, down = (max(int(n // max(pixels, 1)), 1) for n, pixels in zip(traces.shape, (box.width, box.height)))
    wide, high = traces.shape[0] // across * across, traces.shape[1] // down * down
    right = left + (right - left) * wide / traces.shape[0]
    bottom = top + (bottom - top) * high / traces.shape[1]
    traces = traces[:wide, :high].reshape(wide // across, across, high // down, down).mean(axis=(1, 3))
    sizes = np.abs(traces[traces != 0.0])
    end = float(np.quantile(sizes, 0.9)) if len(sizes) else 1.0
    greys = ListedColormap(palette(VOCABULARY["layers"]["seismic"]["palette"]))
    ax.imshow(traces.T, extent=(left, right, bottom, top), cmap=greys, vmin=-end, vmax=end, aspect="auto",
              interpolation="antialiased", zorder=1.5)


PANELS = {"strata": strata_panel, "bonds": bonds_panel, "behaviour": behaviour_panel,
          "strain": strain_panel, "sediment": sediment_panel, "kinematics": kinematics_panel,
          "inversion": inversion_panel,
          "underlay": underlay_panel, "seismic": seismic_panel, "seismic-depth": seismic_depth_panel}


def panel_of(name: str):
    """The panel of a name, or of an effect's layer: layer-NAME."""
    return PANELS.get(name) or layer_panel(name.removeprefix("layer-"))
