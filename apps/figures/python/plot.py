"""What the small figure scripts share: a figure, how it gets to its file, how a script fails."""
import os
import sys

try:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import colormaps
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
except ImportError as failure:
    sys.stderr.write(f"{os.path.basename(sys.argv[0])}: cannot import {failure.name or failure}\n")
    sys.exit(1)


def new_figure(width, height, dpi):
    """A figure of that size in inches."""
    figure = Figure(figsize=(width, height), dpi=dpi)
    FigureCanvasAgg(figure)
    return figure


def without_frame(*all_axes):
    for axes in all_axes:
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)


def save(figure, folder, name):
    """Writes folder/name.png, whole or not at all."""
    os.makedirs(folder, exist_ok=True)
    temporary = os.path.join(folder, f".{name}-{os.getpid()}.tmp")
    try:
        figure.savefig(temporary, format="png")
        os.replace(temporary, os.path.join(folder, f"{name}.png"))
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)


def run(main, usage):
    """Calls main with the script's arguments, as many as the usage names; errors are one line."""
    try:
        if len(sys.argv) != len(usage.split()):
            raise ValueError(f"usage: {usage}")
        main(*sys.argv[1:])
    except Exception as failure:  # one line, no traceback
        text = " ".join(f"{type(failure).__name__}: {failure}".split())
        sys.stderr.write(f"{os.path.basename(sys.argv[0])}: {text}\n")
        sys.exit(1)
