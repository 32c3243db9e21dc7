"""Scales of strata and strain: where they are marked, and how frames share them."""
import math
from collections.abc import Sequence

from frame import Frame
from vocabulary import VOCABULARY, palette

import numpy as np
from matplotlib.colors import ListedColormap

SCALE = VOCABULARY["scale"]


def stratum_ticks(count: int) -> list[int]:
    """The strata that are numbered on the scale, about eight."""
    step = max(1, math.ceil(count / 8)) if count < 20 else 5 * math.ceil(count / 40)
    return sorted({1, *range(step, count + 1, step)})


def strain_colours() -> ListedColormap:
    """White through magma to black: equal steps of lightness, prints well."""
    return ListedColormap(palette(SCALE["palette"]))


def strain_ticks(limit: float) -> np.ndarray:
    """Marks from 0 to the limit, plain numbers if the limit is a step of scales."""
    digit = round(limit / 10.0 ** math.floor(math.log10(limit) + 1e-9), 1)
    parts = dict(zip(SCALE["steps"], SCALE["parts"])).get(digit, 5)
    return np.linspace(0.0, limit, parts + 1)


def share_scales(frames: Sequence[Frame], strain_top: float | None = None) -> None:
    """Lets a colour mean the same in all frames; without an end, strain has the highest one's."""
    strata = max(frame.strata for frame in frames)
    top = strain_top or max(frame.strain_end for frame in frames)
    for frame in frames:
        frame.strata, frame.strain_end = strata, top
