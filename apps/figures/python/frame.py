"""A frame: one moment of a run, as the program wrote it into a folder.

Read are frame.json and plain arrays (SI units, y up, original surface at y = 0, breakaway at the
origin), n discs:

    discs_x, discs_y, discs_radius   m
    discs_stratum                    0 before the rift, then 1 for the oldest stratum
    discs_start_depth                m, NaN for sediment
    discs_layer                      0, or the number of its layer of rock; only where there are layers
    discs_shear_strain               of the last whole window of extension, NaN for younger discs
    discs_behaviour                  class of rock behaviour; only where there are bonds
    bonded                           contacts: x, y of both discs, 1 where both are sediment
    detachment                       x, y
    profile                          x, height of the pre-rift top, thickness of sediment
    depocentres                      x, thickness, prominence
    faults                           number of the fault, x, y, slip rate in m/a
    target_line                      x, y of the line that sediment is filled up to; only where it is no level
    picked_fault                     x, y of the points that the detachment was fitted to
    picked_horizons, picked_faults   number of the line, x, y; only where there are picks
    horizons                         all tops of the model, likewise; only with an underlay
    compared_horizons                the model's tops that they are compared with, likewise
    tops                             of strata and layers of rock, after a turn: stratum (0: pre-rift
                                     top, below 0: layers), number of the piece, x, height above
                                     the regional
    predicted_shear, predicted_normals  x, y of the pre-rift top by kinematic constructions
    seismic, seismic_depth           amplitudes, a row per trace; only where they are asked for
    seismic_axes, seismic_depth_axes x of the first trace, distance of traces (m), first sample (s or m
                                     below the original surface, above it negative), frequency (Hz),
                                     distance of samples, width of the point-spread function (m)

    layer_NAME                       of an effect, which frame.json declares: of a band x, bottom, top,
                                     of a line x, y, of discs the share of ink from 0 to 1
    layer_NAME_arrows                velocity of discs, x and y, m/s, where the layer has arrows; none: not yet

An array that is not there says that the run knows no such thing.
"""
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass

from plot import InputError, read_json
from vocabulary import ROCK_CLASSES

import numpy as np

NUMBERS = ("extension_m", "time_a", "right_wall_x_m", "strata", "strain_end", "strain_window_m")
MOST_STRATA = 10_000
USUAL_THICKNESS = 15.0        # km, of a model
MM_PER_A = 365.25 * 86400e3   # of a m/s

COLUMNS = {"band": 3, "line": 2, "discs": None}   # of layers, by kind


@dataclass(frozen=True)
class Layer:
    """Layers that an effect adds to a frame."""
    kind: str
    label: str
    ink: str
    rows: np.ndarray      # lengths in km; of discs the share of ink
    name: str = ""
    full: float = 1.0     # number that full ink stands for
    arrows: np.ndarray | None = None   # velocity by disc, mm/a
    arrows_label: str = ""

    @property
    def is_graded(self) -> bool:
        """Whether ink on discs has shades, and so wants a picture of its own."""
        return self.kind == "discs" and bool(((self.rows > 0.0) & (self.rows < 1.0)).any())


@dataclass
class Frame:
    """One frame, lengths in km (y up), rates in mm/a, time in a."""
    meta: dict
    x: np.ndarray
    y: np.ndarray
    radius: np.ndarray
    stratum: np.ndarray
    start_depth: np.ndarray
    strain: np.ndarray
    detachment: np.ndarray
    strata: int                                # number that the colours are for
    strain_end: float                          # of the colour scale
    layers: tuple[Layer, ...] = ()
    beds: np.ndarray | None = None             # layer of rock by disc, 0: none
    bed_names: tuple[str, ...] = ()
    behaviour: np.ndarray | None = None
    bonded: np.ndarray | None = None
    profile: np.ndarray | None = None
    depocentres: np.ndarray | None = None
    faults: np.ndarray | None = None
    picked_fault: np.ndarray | None = None
    picked_horizons: np.ndarray | None = None
    picked_faults: np.ndarray | None = None
    compared_horizons: np.ndarray | None = None
    horizons: np.ndarray | None = None
    tops: np.ndarray | None = None
    predicted_shear: np.ndarray | None = None
    predicted_normals: np.ndarray | None = None
    seismic: np.ndarray | None = None          # these four in SI units
    seismic_axes: np.ndarray | None = None
    seismic_depth: np.ndarray | None = None
    seismic_depth_axes: np.ndarray | None = None
    level: float | None = None                 # that sediment is filled up to, where there is no line
    target_line: np.ndarray | None = None
    view: tuple = ()                           # xmin, xmax, ymin, ymax
    owner: np.ndarray | None = None            # disc of each cell of an image, -1: none
    legends: dict | None = None                # collects legend entries by panel, undrawn

    @property
    def extension(self) -> float:
        return self.meta["extension_m"] / 1000.0

    @property
    def has_detachment(self) -> bool:
        return bool(self.meta.get("has_detachment", True))

    @property
    def left_end(self) -> str:
        """What is at x = 0."""
        return "breakaway" if self.has_detachment else "left wall"

    @property
    def wall(self) -> float:
        return self.meta["right_wall_x_m"] / 1000.0

    @property
    def wall_rate(self) -> float:
        """Geological rate of the wall, mm/a; the paper's where a frame says none."""
        return 1000.0 * self.meta.get("rate_m_per_a", 0.01)

    @property
    def unit(self) -> float:
        """Length of margins (km): 1 km in a model of USUAL_THICKNESS, as large a share of others. Two digits
        of it, so that a base that bends changes no margin."""
        thickness = max(-self.detachment[:, 1].min(), 2.0 * self.radius.max())
        return float(f"{thickness / USUAL_THICKNESS:.2g}")

    @property
    def span(self) -> float:
        """Width of the view."""
        return self.view[1] - self.view[0]

    @property
    def rise(self) -> float:
        """Height of the view."""
        return self.view[3] - self.view[2]


def is_finite(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def load_meta(folder: str) -> dict:
    """frame.json with its numbers checked."""
    path = os.path.join(folder, "frame.json")
    meta = read_json(path)
    for key in NUMBERS:
        if not is_finite(meta.get(key)):
            raise InputError(f"{path}: '{key}' is missing or not a finite number")
    if not is_finite(meta.get("level_m", 0.0)):
        raise InputError(f"{path}: 'level_m' is not a finite number")
    if not isinstance(meta.get("scene"), str):
        raise InputError(f"{path}: 'scene' is missing or not a string")
    if meta["strain_end"] <= 0 or meta["right_wall_x_m"] <= 0:
        raise InputError(f"{path}: 'strain_end' and 'right_wall_x_m' must be positive")
    for key in ("scene", "title"):
        if isinstance(meta.get(key), str):
            meta[key] = printable(meta[key])
    return meta


def printable(text: str) -> str:
    """A text whose characters a font and an SVG file may hold; others are blanks."""
    return "".join(letter if letter.isprintable() else " " for letter in text)


def load_array(folder: str, name: str, columns: int | None = None, optional: bool = False,
               finite: bool = True) -> np.ndarray | None:
    """Numeric array name.npy: 1-D, or 2-D with the given number of columns."""
    path = os.path.join(folder, name + ".npy")
    if optional and not os.path.exists(path):
        return None
    try:
        array = np.load(path, allow_pickle=False)
    except OSError as failure:
        raise InputError(f"{path}: {failure.strerror or failure}") from failure
    except (ValueError, EOFError, SyntaxError, KeyError) as failure:
        raise InputError(f"{path}: corrupt or not an .npy file ({failure})") from failure
    if not isinstance(array, np.ndarray) or array.dtype.kind not in "buif":
        raise InputError(f"{path}: not a plain numeric array")
    if columns is None:
        if array.ndim != 1:
            raise InputError(f"{path}: expected one dimension, shape is {array.shape}")
    elif array.size == 0:
        array = np.zeros((0, columns))
    elif array.ndim != 2 or array.shape[1] != columns:
        raise InputError(f"{path}: expected {columns} columns, shape is {array.shape}")
    if finite and not np.all(np.isfinite(array)):
        raise InputError(f"{path}: holds values that are not finite")
    return array


def load_image(folder: str, name: str) -> np.ndarray | None:
    """Amplitudes, a row per trace; none if the frame has no such image."""
    path = os.path.join(folder, name + ".npy")
    if not os.path.exists(path):
        return None
    columns = np.load(path, mmap_mode="r", allow_pickle=False).shape[-1]
    return load_array(folder, name, columns=columns)


def load_discs(folder: str) -> dict[str, np.ndarray | None]:
    """The arrays of the discs by name, all of one length."""
    discs = {name: load_array(folder, "discs_" + name) for name in ("x", "y", "radius", "stratum")}
    for name in ("start_depth", "shear_strain"):  # not defined for all discs
        discs[name] = load_array(folder, "discs_" + name, finite=False)
    for name in ("behaviour", "layer"):
        discs[name] = load_array(folder, "discs_" + name, optional=True)
    count = len(discs["x"])
    if count == 0:
        raise InputError(f"{folder}: discs_x.npy holds no discs")
    for name, array in discs.items():
        if array is not None and len(array) != count:
            raise InputError(f"{folder}: discs_{name}.npy has {len(array)} values, "
                             f"discs_x.npy {count}")
    if np.any(discs["radius"] <= 0):
        raise InputError(f"{folder}: discs_radius.npy holds radii that are not positive")
    if discs["stratum"].max() > MOST_STRATA:
        raise InputError(f"{folder}: more than {MOST_STRATA:,} strata")
    if discs["behaviour"] is not None and not np.isin(discs["behaviour"], range(len(ROCK_CLASSES))).all():
        raise InputError(f"{folder}: discs_behaviour.npy holds an unknown class")
    return discs


def load_layers(folder: str, meta: dict, count: int) -> tuple[Layer, ...]:
    """Layers of effects in a frame of so many discs."""
    layers = []
    for words in meta.get("layers", ()):
        rows = load_array(folder, words["name"], columns=COLUMNS[words["kind"]])
        if words["kind"] == "discs" and len(rows) != count:
            raise InputError(f"{folder}: {words['name']}.npy has {len(rows)} values, "
                             f"discs_x.npy {count}")
        arrows = load_array(folder, f"{words['name']}_arrows", columns=2, optional=True)
        if arrows is not None and len(arrows) not in (0, count):
            raise InputError(f"{folder}: {words['name']}_arrows.npy has {len(arrows)} rows, discs_x.npy {count}")
        layers.append(Layer(words["kind"], printable(words["label"]), words["ink"],
                            np.clip(rows, 0.0, 1.0) if words["kind"] == "discs" else km(rows),
                            words["name"].removeprefix("layer_"), words.get("full", 1.0),
                            scaled(arrows, MM_PER_A) if arrows is not None and len(arrows) else None,
                            printable(words.get("arrows", ""))))
    return tuple(layers)


def scaled(array: np.ndarray | None, factors) -> np.ndarray | None:
    return None if array is None else np.asarray(array, dtype=float) * np.array(factors)


def km(array: np.ndarray | None) -> np.ndarray | None:
    return None if array is None else np.asarray(array, dtype=float) / 1000.0


def load_frame(folder: str) -> Frame:
    """All arrays of the frame, converted to km."""
    if not os.path.isdir(folder):
        raise InputError(f"{folder}: no such directory")
    meta = load_meta(folder)
    if meta["strata"] > MOST_STRATA:
        raise InputError(f"{folder}: more than {MOST_STRATA:,} strata")
    discs = load_discs(folder)
    detachment = load_array(folder, "detachment", columns=2)
    if len(detachment) < 2:
        raise InputError(f"{folder}: detachment.npy needs at least two points")

    def table(name, columns, finite=True):
        return load_array(folder, name, columns=columns, optional=True, finite=finite)

    profile = km(table("profile", 3, finite=False))
    level = target_level(meta)
    frame = Frame(
        meta=meta, x=km(discs["x"]), y=km(discs["y"]), radius=km(discs["radius"]),
        stratum=discs["stratum"].astype(int), start_depth=km(discs["start_depth"]),
        strain=np.asarray(discs["shear_strain"], dtype=float), detachment=km(detachment),
        strata=max(int(meta["strata"]), int(discs["stratum"].max()), 0),
        strain_end=meta["strain_end"], layers=load_layers(folder, meta, len(discs["x"])),
        beds=None if discs["layer"] is None else discs["layer"].astype(int),
        bed_names=tuple(printable(name) for name in meta.get("rock_layers", ())),
        behaviour=behaviour(discs),
        bonded=scaled(table("bonded", 5), [1e-3] * 4 + [1.0]),
        profile=profile if profile is not None and len(profile) > 1 else None,
        depocentres=km(table("depocentres", 3)),
        faults=scaled(table("faults", 4), [1.0, 1e-3, 1e-3, 1.0]),
        picked_fault=km(table("picked_fault", 2)),
        **{name: scaled(table(name, 3), [1.0, 1e-3, 1e-3])
           for name in ("picked_horizons", "picked_faults", "compared_horizons", "horizons")},
        tops=scaled(table("tops", 4), [1.0, 1.0, 1e-3, 1e-3]),
        predicted_shear=km(table("predicted_shear", 2)),
        predicted_normals=km(table("predicted_normals", 2)),
        **{name: load_image(folder, name) for name in ("seismic", "seismic_depth")},
        **{name: load_array(folder, name, optional=True) for name in ("seismic_axes", "seismic_depth_axes")},
        level=None if level is None else level / 1000.0, target_line=km(table("target_line", 2)))
    frame.view = view_of(frame)
    return frame


def target_level(meta: dict) -> float | None:
    """Height, m, that sediment is filled up to, if it is."""
    return meta.get("level_m")


def target_heights(frame: Frame, x: np.ndarray) -> np.ndarray:
    """Heights, km, that sediment is filled up to at places x; 0 where there is no sediment."""
    if frame.target_line is None:
        return np.full(len(x), frame.level or 0.0)
    return np.interp(x, *frame.target_line.T)


def behaviour(discs: dict[str, np.ndarray | None]) -> np.ndarray | None:
    """Class of rock behaviour of every disc [paper, Fig. 5], where there are bonds."""
    return None if discs["behaviour"] is None else discs["behaviour"].astype(int)


def view_of(frame: Frame) -> tuple[float, float, float, float]:
    """Extent of the section (km): from left of the breakaway, and of what runs over it, to right of the wall."""
    unit = frame.unit
    left = min(-unit, np.quantile(frame.x, 0.001) - 0.5 * unit)
    target = target_heights(frame, np.linspace(0.0, frame.wall, 100)).max()
    tops = np.append(np.quantile(frame.y + frame.radius, 0.9999), (target, 0.0))
    bottom = min(frame.detachment[:, 1].min(), np.quantile(frame.y - frame.radius, 0.0001))
    return (left, frame.wall + 0.5 * unit, bottom - 0.6 * unit, tops.max() + 0.5 * unit)


def share_view(frames: Sequence[Frame]) -> None:
    """Lets all frames show what any of them shows: with stages the wall is not furthest at the last one."""
    left, right, bottom, top = zip(*(frame.view for frame in frames))
    for frame in frames:
        frame.view = (min(left), max(right), min(bottom), max(top))
