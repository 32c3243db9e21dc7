"""Colours of strata and strain, the ends of their scales and where they are marked."""
import math
from collections.abc import Sequence

from frame import Frame
from plot import colormaps

import numpy as np
from matplotlib.colors import ListedColormap


def stratum_colours(count: int) -> np.ndarray:
    """One colour per stratum, old (dark) to young; every second slightly lighter."""
    colours = colormaps["viridis"](np.linspace(0.0, 1.0, max(count, 2)))[:count, :3]
    if count >= 6:
        colours[1::2] = 0.84 * colours[1::2] + 0.16
    return colours


def stratum_ticks(count: int) -> list[int]:
    """The strata that are numbered on the scale, about eight."""
    step = max(1, math.ceil(count / 8)) if count < 20 else 5 * math.ceil(count / 40)
    return sorted({1, *range(step, count + 1, step)})


def strain_colours() -> ListedColormap:
    """White through magma to black: equal steps of lightness, prints well."""
    colours = colormaps["magma_r"](np.linspace(0, 0.93, 256))[:, :3]
    fade = np.clip(np.arange(256) / 45.0, 0, 1)[:, None]
    return ListedColormap(fade * colours + (1 - fade) * 0.985)


def strain_limit(strain: np.ndarray) -> float:
    """Upper end of the colour scale: 99th percentile, rounded up to a plain number."""
    values = strain[np.isfinite(strain)]
    high = np.quantile(values, 0.99) if len(values) else 0.0
    if high <= 0:
        high = values.max() if len(values) else 0.0
    if high <= 0:
        return 0.01
    power = 10.0 ** math.floor(math.log10(high))
    return power * next(s for s in (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10)
                        if high <= s * power * (1 + 1e-9))


def strain_ticks(limit: float) -> np.ndarray:
    """Marks from 0 to the limit, plain numbers if the limit is one of strain_limit's."""
    digit = round(limit / 10.0 ** math.floor(math.log10(limit) + 1e-9), 1)
    parts = {1.2: 4, 1.5: 3, 2: 4, 3: 3, 4: 4, 6: 3, 8: 4}.get(digit, 5)
    return np.linspace(0.0, limit, parts + 1)


def share_scales(frames: Sequence[Frame], strain_top: float | None = None) -> None:
    """Lets a colour mean the same in all frames; without an end, strain has the highest one's."""
    strata = max(frame.strata for frame in frames)
    top = strain_top or max(strain_limit(frame.strain) for frame in frames)
    for frame in frames:
        frame.strata, frame.strain_top = strata, top
