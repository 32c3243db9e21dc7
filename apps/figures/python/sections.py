"""Figures of one frame: panels above each other on one x axis."""
from collections.abc import Sequence

from frame import Frame
from page import (DPI, GAP, LEFT, PROFILE_HEIGHT, ROW_ABOVE, TITLE, WIDTH, add_axes, below,
                  extension_text, footer, name_distance, panel_size, set_ticks, write_around)
from panels import PANELS, layer_panel
from plot import Figure, Order, new_figure, save


LAYER_PICTURE = "layer-"   # and the layer's name


def draw_figure(frame: Frame, names: Sequence[str], dpi: float = DPI) -> Figure:
    """Figure with the panels of these names."""
    width, section_height = panel_size(frame)
    heights = [PROFILE_HEIGHT if name == "sediment" else section_height for name in names]
    lines = footer(frame)
    total = TITLE + below(lines) + sum(heights) + ROW_ABOVE * len(names) + GAP * (len(names) - 1)
    figure = new_figure(WIDTH, total, dpi)
    write_around(figure, f"{frame.meta['scene'].upper()}, {extension_text(frame)} km of extension "
                         f"({frame.meta['time_a'] / 1e6:.2f} Myr)", lines)
    y = total - TITLE
    for index, (name, height) in enumerate(zip(names, heights)):
        y -= ROW_ABOVE + height
        ax = add_axes(figure, LEFT, y, width, height)
        cax = add_axes(figure, LEFT + width + 0.16, y, 0.17, height)
        panel = PANELS.get(name) or layer_panel(name.removeprefix(LAYER_PICTURE))
        panel(ax, cax, frame)
        set_ticks(ax)
        name_distance(ax, lowest=index + 1 == len(names))
        y -= GAP
    return figure


def figures_of(frame: Frame) -> dict[str, list[str]]:
    """The figures that a frame gets, by name: their panels."""
    overview = [name for name in PANELS if name not in ("kinematics", "underlay")]
    known = (overview + (["kinematics"] if frame.predicted_shear is not None else [])
             + (["underlay"] if frame.horizons is not None else []))
    known += [LAYER_PICTURE + layer.name for layer in frame.layers if layer.is_graded]
    return {**{name: [name] for name in known}, "overview": overview}


def save_sections(frames: Sequence[Frame], folder: str, order: Order) -> None:
    """Every panel of every frame, and the overview of all: NAME-<extension>km."""
    for frame in frames:
        for name, panels in figures_of(frame).items():
            save(draw_figure(frame, panels), folder, f"{name}-{extension_text(frame)}km",
                 order)
