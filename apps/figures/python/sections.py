"""Figures of one frame: panels above each other on one x axis."""
from collections.abc import Sequence
from dataclasses import replace

from axes import exaggeration, exaggeration_text
from frame import Frame
from page import (DPI, GAP, LEFT, PROFILE_HEIGHT, ROW_ABOVE, TITLE, TOPS_HEIGHT, WIDTH, add_axes, below,
                  extension_text, footer, headline, name_distance, panel_size, set_ticks, write_around)
from caption import caption, origin, write_captions
from journal import DEFAULT, look_text, save_print
from panels import PANELS, panel_of
from plot import Figure, InputError, Order, new_figure, save


LAYER_PICTURE = "layer-"   # and the layer's name


def draw_figure(frame: Frame, names: Sequence[str], dpi: float = DPI, plain: bool = False) -> Figure:
    """Figure with the panels of these names; a plain one has neither headline nor small print."""
    width, section_height = panel_size(frame)
    own = {"sediment": PROFILE_HEIGHT, "inversion": TOPS_HEIGHT}
    heights = [own.get(name, section_height) for name in names]
    lines = [] if plain else footer(frame)
    title = 0.0 if plain else TITLE
    total = title + below(lines) + sum(heights) + ROW_ABOVE * len(names) + GAP * (len(names) - 1)
    figure = new_figure(WIDTH, total, dpi)
    if not plain:
        write_around(figure, headline(frame), lines)
    y = total - title
    for index, (name, height) in enumerate(zip(names, heights)):
        y -= ROW_ABOVE + height
        ax = add_axes(figure, LEFT, y, width, height)
        cax = add_axes(figure, LEFT + width + 0.16, y, 0.17, height)
        panel_of(name)(ax, cax, frame)
        set_ticks(ax)
        name_distance(ax, frame, lowest=index + 1 == len(names))
        y -= GAP
    return figure


ON_DEMAND = ("kinematics", "inversion", "underlay", "seismic", "seismic-depth")   # not on the overview


def figures_of(frame: Frame) -> dict[str, list[str]]:
    """The figures that a frame gets, by name: their panels."""
    overview = [name for name in PANELS if name not in ON_DEMAND]
    there = {"kinematics": frame.predicted_shear, "inversion": frame.tops, "underlay": frame.horizons, "seismic": frame.seismic,
             "seismic-depth": frame.seismic_depth}
    known = overview + [name for name in ON_DEMAND if there[name] is not None]
    known += [LAYER_PICTURE + layer.name for layer in frame.layers if layer.is_graded]
    figures = {**{name: [name] for name in known}, "overview": overview}
    if "inversion" in figures:                   # heights below the section that they belong to
        figures["inversion"] = ["strata", "inversion"]
    return figures


def save_sections(frames: Sequence[Frame], folder: str, order: Order) -> None:
    """Every panel of every frame, and the overview of all: NAME-<extension>km and options; for print the
    panels in one figure. Captions of all in caption.txt, and how they were made in origin.txt, where the order wants them."""
    captions, origins = {}, {}
    for frame in frames:
        if order.width_mm:
            wanted = require_panels(frame, order.only)
            name, figure, said = save_print(frame, replace(order, only=wanted))
            save(figure, folder, name, order)
            captions[name] = caption(wanted or DEFAULT, said, frame, order)
            origins[name] = origin(wanted or DEFAULT, frame, order)
            continue
        figures = figures_of(frame)
        chosen = {name: figures[name] for name in require_panels(frame, order.only)} or figures
        for kind, panels in chosen.items():
            name = f"{kind}-{extension_text(frame)}km{options_text(kind, frame, order)}"
            figure = draw_figure(frame, panels, order.dpi or DPI, order.plain)
            scales = [None if panel == "seismic" else f"({exaggeration_text(exaggeration(ax))})"
                      for panel, ax in zip(panels, figure.axes[::2])]   # beside each its colour bar
            save(figure, folder, name, order)
            captions[name], origins[name] = caption(panels, scales, frame, order), origin(panels, frame, order)
    if order.caption:
        write_captions(captions, folder)
        write_captions(origins, folder, "origin.txt")


def options_text(kind: str, frame: Frame, order: Order) -> str:
    """Options in a page's name, so that no call replaces the figure of another: the picture below, then the look."""
    below = f"-{frame.meta['underlay']['name']}" if kind == "underlay" else ""
    return below + look_text(order, DPI)


def require_panels(frame: Frame, names: Sequence[str]) -> tuple[str, ...]:
    """Those of these panels that the frame has; there has to be one where any are wanted."""
    known = figures_of(frame)
    found = tuple(name for name in names if name in known)
    if names and not found:
        raise InputError(f"--only: this moment has none of {', '.join(names)}; it has {', '.join(known)}")
    return found
