"""A run's folder."""

import json
import tomllib
from functools import cached_property
from pathlib import Path

import numpy as np

from .errors import Named, RunError
from .snapshot import Snapshot
from .table import Table, read_csv


class Run:
    """The folder that `listric run` writes. Opening it lists the snapshots; each thing is read when it
    is first asked for.

    folder     path
    snapshots  tuple of Snapshot, by extension
    """

    def __init__(self, folder):
        """Throws RunError if the folder holds no run."""
        self.folder = Path(folder)
        if not (self.folder / "scene.toml").is_file():
            why = "holds no run (no scene.toml)" if self.folder.is_dir() else "no such folder"
            raise RunError(f"{folder}: {why}; a run's folder is what `listric run` writes, such as "
                           "out/lis1")
        # By extension: longer names are further.
        found = sorted((self.folder / "snapshots").glob("extension-*m.h5"),
                       key=lambda path: (len(path.name), path.name))
        self.snapshots = tuple(map(Snapshot, found))

    def __repr__(self) -> str:
        return f"<run {self.folder}: {len(self.snapshots)} snapshots>"

    def at(self, extension_m: float) -> Snapshot:
        """The snapshot nearest to an extension, m. Throws RunError if there is none at all."""
        return min(self._some_snapshots(), key=lambda one: abs(one.named_extension_m - extension_m))

    @cached_property
    def history(self) -> Table:
        """history.csv: a row per snapshot, a column per measure (docs/measures.md), NaN where it has
        no meaning; units by the names' ends."""
        return read_csv(self.folder / "history.csv")

    @cached_property
    def summary(self) -> Named:
        """summary.json as it stands: measures at the end of the run by name (docs/measures.md)."""
        path = self.folder / "summary.json"
        try:
            return Named(json.loads(path.read_text(encoding="utf-8")), str(path))
        except FileNotFoundError:
            raise RunError(f"{path}: is not there: the run has not ended; `listric run ... --resume` "
                           "goes on") from None
        except ValueError as error:
            raise RunError(f"{path}: is damaged ({error}); run the scene again") from error

    @cached_property
    def scene(self) -> Named:
        """scene.toml: every parameter in force, as `run.scene["hanging_wall"]["length_m"]`."""
        path = self.folder / "scene.toml"
        try:
            return Named(tomllib.loads(path.read_text(encoding="utf-8")), str(path))
        except ValueError as error:
            raise RunError(f"{path}: is damaged ({error})") from error

    @property
    def faults(self) -> list[dict]:
        """The faults of summary.json in its order, a dict each with its names (docs/measures.md).
        `points_m` is an array of shape (points, 2) of x and depth; `throw_m` is {stratum: throw in m},
        0 the pre-rift top. `snapshot.lines("faults")` has those of any moment."""
        return [{**fault, "points_m": np.array(fault["points_m"], dtype=float).reshape(-1, 2),
                 "throw_m": {int(stratum): throw for stratum, throw in fault["throw_m"].items()}}
                for fault in self.summary["faults"]]

    @property
    def horizons(self) -> list[dict]:
        """Tops of strata and of pre-rift layers at the end, cut at faults: a dict per line with
        `name`, `stratum`, `x_m`, `depth_m` and the others of docs/export.md, which says how they are
        found. `snapshot.lines("horizons")` has those of any moment, and says where they come from."""
        return self._some_snapshots()[-1].lines("horizons")

    def _some_snapshots(self) -> tuple[Snapshot, ...]:
        if not self.snapshots:
            raise RunError(f"{self.folder}: has no snapshots; only runs of discs write some: run the "
                           "scene again if they have been removed")
        return self.snapshots
