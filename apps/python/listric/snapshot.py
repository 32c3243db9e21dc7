"""One moment of a run: the program's whole state in an HDF5 file."""

import tomllib
from contextlib import contextmanager
from copy import deepcopy
from functools import partial
from pathlib import Path

import numpy as np

from .errors import ListricError, Named, RunError, UnknownName
from .lines import exported_lines
from .picture import Picture, draw_section
from .raster import Raster, draw_raster
from .dictionary import unit_of
from .table import Table

try:
    import h5py
except ImportError as error:
    raise ImportError("listric reads snapshots with h5py: install the package python3-h5py, or "
                      "`pip install h5py`") from error

FORMAT = 8  # of the snapshots that the program writes
_OLDEST = 5  # that is read, too: its scene is an attribute, which is nothing that is asked for here
_RENAMED = {("discs", "start_extension"): "start_travel"}  # up to format 7, which named the travel so
_KIND = "listric snapshot "
_END = b"listric checksum"  # in front of the last eight bytes of a whole file


class Snapshot:
    """A file of a run's folder `snapshots`. It is opened when something of it is asked for, and closed
    at once: a run may have any number of them.

    Tables are those of the file, SI units, bit for bit; y points up from the original surface.

        discs          a row per disc: id, x, y, radius, stratum, start_x, window_strain, ...
        contacts       a row per pair of neighbours; `first` and `second` are rows of discs
        base_contacts  a row per disc at the detachment or a wall
        base_nodes     a row per node of a base that deforms; ux, uy is its displacement
    """

    def __init__(self, path):
        self.path = Path(path)
        self._tables, self._lines = {}, {}

    def __repr__(self) -> str:
        return f"<snapshot {self.path}>"

    @property
    def discs(self) -> Table:
        return self.table("discs")

    @property
    def contacts(self) -> Table:
        return self.table("contacts")

    @property
    def base_contacts(self) -> Table:
        return self.table("base_contacts")

    @property
    def base_nodes(self) -> Table:
        return self.table("base_nodes")

    @property
    def extension_m(self) -> float:
        """Displacement of base and right wall, m; with [[stage]] it may shrink again."""
        return self.numbers["extension"]

    @property
    def travel_m(self) -> float:
        """Way of base and right wall back and forth, and in pauses: the run's clock, m. Without
        [[stage]] the extension."""
        numbers = self.numbers
        return numbers["travel"] if "travel" in numbers else numbers["extension"]

    @property
    def named_extension_m(self) -> float:
        """Extension by the file's name, to its decimals, with [[stage]] the travel; the file is not
        opened."""
        return float(self.path.stem.removeprefix("extension-").removesuffix("m"))

    @property
    def numbers(self) -> Named:
        """Numbers of the state by name: seed, cycle, extension (m), mean_radius (m), ..."""
        with self._open() as file:
            return Named({name: value.item() for name, value in file.attrs.items()
                          if isinstance(value, np.generic) and not isinstance(value, np.bytes_)},
                         str(self.path))

    @property
    def scene(self) -> dict:
        """The parameters that determine the run, as the snapshot holds them: {"table.key": value}."""
        with self._open() as file:
            document = tomllib.loads(_scene_text(file))
        flat = {}
        for name, value in document.items():
            if isinstance(value, dict):
                flat.update({f"{name}.{key}": one for key, one in value.items()})
            else:
                flat[name] = value
        return {name: value for name, value in flat.items() if name not in ("name", "description")
                and (not name.startswith("output.") or name == "output.interval_m")}

    @property
    def made_by(self) -> str:
        """Versions of the program that made the run up to here: "A, B"; empty if the file does not tell."""
        with self._open() as file:
            earlier = _text(file["run/earlier_versions"][()]).split("\n") if "run/earlier_versions" in file else []
            return ", ".join([*earlier, _text(file.attrs.get("version", b""))])

    @property
    def scene_text(self) -> str:
        """The scene in force, as TOML."""
        with self._open() as file:
            return _scene_text(file)

    def table(self, name: str) -> Table:
        """Any table of the file by its path: "discs" or, what an effect remembers, "events/NAME".

        Throws UnknownName, RunError.
        """
        if name not in self._tables:
            with self._open() as file:
                group = file.get(name)
                if not isinstance(group, h5py.Group) or "rows" not in group.attrs:
                    raise UnknownName(name, _tables(file), str(self.path))
                columns = sorted(group.items(), key=lambda item: item[1].attrs["position"])
                stored = {_RENAMED.get((name, key), key): key for key, _ in columns}
                units = {key: _text(group[stored[key]].attrs["unit"]) or unit_of(key) for key in stored}
                rows = int(group.attrs["rows"])
            self._tables[name] = Table(f"{self.path} {name}", rows, units,
                                       partial(self._column, name, stored))
        return self._tables[name]

    def lines(self, kind: str) -> list[dict]:
        """Lines of `listric export KIND` at this moment: "horizons", "faults", "surfaces", "base",
        "layers", "well" where pore water is under pressure, and "burial" of the strata in a well.

        A dict per line with the columns of docs/guides/export.md: one value for those of a line, an array of
        shape (points,) for those of a point, among them x_m and depth_m (positive down from the level of
        `depth_reference`). Wells are those of a call without `--x`. Read from the run's folder `export` if
        they are there and younger than the snapshots up to this one and than the program; else the program is called, which takes seconds and
        leaves nothing behind. Throws UnknownName, where the moment has
        no such lines, too, ProgramError, RunError.
        """
        if kind not in self._lines:
            self._lines[kind] = exported_lines(self, kind)
        return deepcopy(self._lines[kind])  # what a caller does to it is nobody else's

    def raster(self, column: str, spacing: float = 100.0, extent=None) -> Raster:
        """A column of discs on a grid: `x, depth, values = snapshot.raster("window_strain")`.

        spacing  of the grid, m
        extent   (least x, greatest x, least depth, greatest depth), m; without it, around all discs

        draw_raster says which disc a cell is of. Throws UnknownName, RunError, BadValue.
        """
        discs, mean_radius = self.discs, self.numbers["mean_radius"]
        return draw_raster(discs, discs[column], spacing, extent, reach=0.5 * mean_radius)

    def plot(self, kind: str = "strata") -> Picture:
        """The section as `listric figures` draws it: "strata", "strain", "bonds", "behaviour",
        "sediment", "kinematics" or "overview", all of them. A notebook shows the picture;
        `picture.save("strata.png")` writes it. Takes seconds. Throws UnknownName, ProgramError."""
        return draw_section(self, kind)

    def _column(self, table: str, stored: dict[str, str], name: str) -> np.ndarray:
        with self._open() as file:
            return file[table][stored[name]][()]

    @contextmanager
    def _open(self):
        """The file; what HDF5 says of it becomes a RunError."""
        try:
            _check_end(self.path)
            with h5py.File(self.path, "r") as file:
                _check_format(file, self.path)
                yield file
        except FileNotFoundError:
            raise RunError(f"{self.path}: is not there any more; open the run again") from None
        except PermissionError as error:
            raise RunError(f"{self.path}: cannot be read: {error.strerror}") from error
        except ListricError:
            raise
        except Exception as error:  # whatever h5py, or what reads by it, makes of a damaged file
            why = " ".join(str(error.args[0] if error.args else error).split())
            raise RunError(f"{self.path}: is damaged ({why}); take a copy of it, or run the scene "
                           "again") from error


def _check_end(path: Path) -> None:
    """Refuses a file that was cut short, by its end: HDF5 might read beyond it."""
    with open(path, "rb") as file:
        size = file.seek(0, 2)
        file.seek(max(0, size - len(_END) - 8))
        if not file.read().startswith(_END):
            raise RunError(f"{path}: is no snapshot, or cut short; take a copy of it, or run the scene "
                           "again")


def _check_format(file, path: Path) -> None:
    found = _text(file.attrs.get("format", b""))
    if found not in (f"{_KIND}{number}" for number in range(_OLDEST, FORMAT + 1)):
        version = _text(file.attrs.get("version", b"unknown"))
        raise RunError(f"{path}: is of format {found.removeprefix(_KIND) or 'unknown'}, written by "
                       f"version {version}, and this package reads formats {_OLDEST} to {FORMAT}; "
                       "take the package of that version")


def _scene_text(file) -> str:
    run = file["run"]
    return _text(run["scene"][()] if "scene" in run else run.attrs["scene"])


def _tables(file) -> list[str]:
    """Paths of all groups that are tables."""
    found = []
    file.visititems(lambda path, item: found.append(path) if "rows" in item.attrs else None)
    return found


def _text(value) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)
