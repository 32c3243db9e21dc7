"""A run's folder."""

import re
import tomllib
import warnings
from functools import cached_property
from html import escape
from pathlib import Path

import numpy as np

from .dictionary import dictionary, doc_of, unit_of
from .errors import BadValue, Named, RunError, UnknownName, metres, reading
from .origin import read_summary, reservations
from .picture import Picture
from .snapshot import Snapshot
from .table import Table, html_table, read_csv

# As the program names them; what is named otherwise is somebody else's.
_SNAPSHOT = re.compile(r"extension-(?:[0-9]{5}|[1-9][0-9]{5,})\.[0-9]{2,}m\.h5")


class Run:
    """The folder that `listric run` writes. Opening it reads nothing; each thing is read when it is
    first asked for.

    folder     path
    snapshots  tuple of Snapshot, by extension, with [[stage]] by travel: the ends of windows, and the newest
    """

    def __init__(self, folder):
        """Throws RunError if the folder holds no run."""
        self.folder = Path(folder)
        with reading(self.folder):
            is_run = (self.folder / "scene.toml").is_file()
        if not is_run:
            why = "holds no run (no scene.toml)" if self.folder.is_dir() else "no such folder"
            raise RunError(f"{folder}: {why}; a run's folder is what `listric run` writes, such as "
                           "out/lis1")
        self._is_told = False

    def __repr__(self) -> str:
        return f"<run {self.folder}: {len(self.snapshots)} snapshots>"

    def _repr_html_(self) -> str:
        """Opens to the measures at the end, or so far."""
        table = html_table(("measure", "value", "unit", "definition"),
                           ((name, f"{value:.6g}", self._unit_of(name) or "", doc_of(name))
                            for name, value in self._last_measures().items() if np.isfinite(value)))
        return f"<details><summary>{escape(repr(self)[1:-1])}</summary>{table}</details>"

    @property
    def snapshots(self) -> tuple[Snapshot, ...]:
        """Throws RunError if other runs have made some of them."""
        found = self._snapshots
        self._tell_reservations()
        return found

    @cached_property
    def _snapshots(self) -> tuple[Snapshot, ...]:
        with reading(self.folder / "snapshots", "make it readable"):
            found = [Snapshot(path) for path in (self.folder / "snapshots").glob("extension-*m.h5")
                     if _SNAPSHOT.fullmatch(path.name) and path.is_file()]
        return _moments(sorted(found, key=lambda one: (one.named_extension_m, len(one.path.name))))

    def at(self, extension_m: float | str) -> Snapshot:
        """The snapshot at an extension, with [[stage]] at a travel: in m, or as "5km". Another moment of the run gives the
        nearest one with a warning. Throws RunError if there is none at all, BadValue beyond the run, and for a number
        that is a moment only in km."""
        wanted = metres("extension_m", extension_m)
        snapshots = self._some_snapshots()
        moments = np.array([one.named_extension_m for one in snapshots])
        near = 0.005 * self._interval_m()  # names of older versions are those of cycles
        found = int(np.argmin(np.abs(moments - wanted)))
        apart = abs(moments[found] - wanted)
        if not -near <= wanted <= moments[-1] + near:
            raise BadValue(f"at {wanted:g} m: no snapshot there; there are some from {moments[0]:g} to {moments[-1]:g} m")
        if apart > 0.02 and not isinstance(extension_m, str) and np.any(np.abs(moments - 1000.0 * wanted) <= near):
            raise BadValue(f"at {wanted:g}: numbers are metres, and there is no snapshot at {wanted:g} m; for {wanted:g} km "
                           f"give {1000.0 * wanted:g} or '{wanted:g}km'")
        if apart > near:
            warnings.warn(f"{self.folder}: no snapshot at {wanted:g} m; the nearest is taken, at {moments[found]:g} m",
                          stacklevel=2)
        return snapshots[found]

    def plot(self, kind: str = "strata", at: float | str | None = None) -> Picture:
        """The section at an extension, as at() has it, or the newest, as Snapshot.plot()."""
        return (self._some_snapshots()[-1] if at is None else self.at(at)).plot(kind)

    @cached_property
    def history(self) -> Table:
        """history.csv: a row at the start and after every `output.interval_m`, a column per measure
        (docs/reference/measures.md), NaN where it has no meaning; units as the program declares them, or as the last
        snapshot has them. An end between two rows has none: `summary` has its measures."""
        self._tell_reservations()
        table = read_csv(self.folder / "history.csv", self._unit_of)
        if why := self._objection_to_history(table):
            warnings.warn(f"{self.folder / 'history.csv'}: {why}: `listric run ... --resume` makes it again", stacklevel=3)
        return table

    @cached_property
    def summary(self) -> Named:
        """summary.json as it stands: measures at the end of the run by name (docs/reference/measures.md)."""
        self._tell_reservations()
        return read_summary(self.folder)

    @cached_property
    def scene(self) -> Named:
        """scene.toml: every parameter in force, as `run.scene["hanging_wall"]["length_m"]`."""
        path = self.folder / "scene.toml"
        with reading(path):
            return Named(tomllib.loads(path.read_text(encoding="utf-8")), str(path))

    @property
    def faults(self) -> list[dict]:
        """The faults of summary.json in its order, a dict each with its names (docs/reference/measures.md).
        `points_m` is an array of shape (points, 2) of x and depth; `throw_m` is {horizon: throw in m},
        numbered as `stratum` of `run.horizons`, `throw_error_m` its errors. `snapshot.lines("faults")` has those of any moment."""
        found = self.summary["faults"]
        with reading(self.folder / "summary.json"):
            return [{**fault, "points_m": np.array(fault["points_m"], dtype=float).reshape(-1, 2),
                     **{name: {int(horizon): value for horizon, value in fault[name].items()}
                        for name in ("throw_m", "throw_error_m") if isinstance(fault.get(name), dict)}}
                    for fault in found]

    @property
    def horizons(self) -> list[dict]:
        """Tops of strata and of pre-rift layers at the end, cut at faults: a dict per line with
        `name`, `stratum`, `x_m`, `depth_m` and the others of docs/guides/export.md, which explains how they are
        found. `snapshot.lines("horizons")` has the lines of any moment, with their source."""
        return self._some_snapshots()[-1].lines("horizons")

    def _last_measures(self) -> dict[str, float]:
        """What history tells, as summary.json has it; the last row while there is none."""
        history = self.history
        if (self.folder / "summary.json").is_file():
            return {name: self.summary[name] for name in history
                    if isinstance(self.summary.get(name), (int, float))}
        return {name: history[name][-1] for name in history if history.rows}

    def _unit_of(self, name: str) -> str | None:
        """Entry of a measure; an unknown one may belong to an effect of the reader's own."""
        if name not in dictionary() and self.snapshots:
            return self.snapshots[-1].table("run/history").units.get(name)
        return unit_of(name)

    def _interval_m(self) -> float:
        with reading(self.folder / "scene.toml"):
            return float(self.scene.get("output", {}).get("interval_m", 500.0))

    def _objection_to_history(self, table) -> str:
        """Compares history.csv with the history that the newest snapshot has kept; empty where none can be read."""
        try:
            kept = self.snapshots[-1].table("run/history")
            if kept.rows > table.rows:
                return f"is older than the newest snapshot, whose history has {kept.rows} rows instead of {table.rows}"
            same = [np.array_equal(kept[name], table[name][:kept.rows], equal_nan=True)
                    for name in kept if name in table and kept.rows]
        except (IndexError, RunError, UnknownName, TypeError):
            return ""
        return "" if all(same) else "is of another run than the newest snapshot"

    def _tell_reservations(self) -> None:
        """Warns once, at the first look into the run's results."""
        if not self._is_told:
            self._is_told = True
            for one in reservations(self):
                warnings.warn(f"{self.folder}: {one}", stacklevel=4)

    def _some_snapshots(self) -> tuple[Snapshot, ...]:
        if not self.snapshots:
            raise RunError(f"{self.folder}: has no snapshots; only runs of discs write some: run the "
                           "scene again if they have been removed")
        return self.snapshots


def _moments(found: list[Snapshot]) -> tuple[Snapshot, ...]:
    """Without those at which the run was stopped and has gone on since; the newest one that can be
    read says which these are."""
    for newest in reversed(found):
        try:
            history = newest.table("run/history")
            ends = np.asarray(history["travel_m" if "travel_m" in history else "extension_m"])
            scene = newest.scene
            interval = float(scene.get("output.interval_m", 500.0))
        except (RunError, UnknownName):
            continue
        older = found[:found.index(newest)]
        for one in older:
            _require_scene(one, scene, newest)
        return tuple(one for one in found if one not in older or _is_end(one, ends, interval))
    return tuple(found)


def _is_end(snapshot: Snapshot, ends: np.ndarray, interval: float) -> bool:
    """Whether a name is that of a window's end: of its multiple of the interval or, as older versions had it,
    of the cycle in which it came."""
    decimals = len(snapshot.path.name.removesuffix("m.h5").split(".")[1])
    named = np.append(ends, interval * np.round(ends / interval))
    return bool(np.any(np.abs(named - snapshot.named_extension_m) <= 0.5000005 * 10.0 ** -decimals))


def _require_scene(snapshot: Snapshot, scene: dict, newest: Snapshot) -> None:
    try:
        found = snapshot.scene
    except RunError:
        return  # damaged: reading it raises the error
    for name in sorted(scene.keys() | found.keys()):
        if found.get(name) != scene.get(name):
            raise RunError(f"{snapshot.path}: another run has made it: {name} = {_short(found.get(name))} "
                           f"there, {_short(scene.get(name))} in {newest.path.name}; take it away, or what "
                           "it was copied over")


def _short(value) -> str:
    """A value in a message: lists may have thousands of points."""
    text = str(value)
    return text if len(text) <= 60 else text[:60] + "..."
