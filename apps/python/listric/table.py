"""Tables of named columns with units."""

import csv
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from .errors import RunError, UnknownName

# Units as names of measures and of exported columns end (docs/measures.md), the longest first.
_ENDINGS = {"_kg_per_m": "kg/m", "_mm_per_a": "mm/a", "_pa_per_m": "Pa/m", "_n_per_m": "N/m",
            "_j_per_m": "J/m", "_per_m": "1/m", "_per_s": "1/s", "_deg": "deg", "_rad": "rad",
            "_m2": "m^2", "_pa": "Pa", "_a": "a", "_m": "m", "_s": "s"}
_WHOLE = {"cycle", "discs", "line", "stratum", "fault"}  # columns of CSV files that count


def unit_of(name: str) -> str:
    """Unit of a measure by the end of its name; "1" for a ratio or a count. a: years."""
    return next((unit for ending, unit in _ENDINGS.items() if name.endswith(ending)), "1")


class Column(np.ndarray):
    """A column's numbers, an array of shape (rows,), with their `units`.

    Parts and copies of a column keep its units; what is computed from it is a plain array.
    """

    units: str | None

    def __new__(cls, values, units: str):
        column = np.asarray(values).view(cls)
        column.units = units
        return column

    def __array_finalize__(self, origin):
        self.units = getattr(origin, "units", None)

    def __array_ufunc__(self, ufunc, method, *inputs, out=None, **options):
        if out is not None:
            options["out"] = tuple(_plain(one) for one in out)
        return getattr(ufunc, method)(*(_plain(one) for one in inputs), **options)

    def __reduce__(self):
        return Column, (_plain(self), self.units)


def _plain(values):
    return values.view(np.ndarray) if isinstance(values, Column) else values


class Table(Mapping):
    """Columns by name, in their order; each is read when it is asked for, every time anew: keep in
    a variable what is used more than once.

    `table["x"]` is a Column, `table.units` {name: unit}, `table.rows` the length of all columns,
    `table.to_pandas()` a DataFrame.
    """

    def __init__(self, where: str, rows: int, units: dict[str, str],
                 read: Callable[[str], np.ndarray]):
        self.rows = rows
        self.units = units
        self._where = where
        self._read = read

    def __getitem__(self, name: str) -> Column:
        if name not in self.units:
            raise UnknownName(name, self.units, self._where)
        return Column(self._read(name), self.units[name])

    def __iter__(self):
        return iter(self.units)

    def __len__(self) -> int:
        return len(self.units)

    def __contains__(self, name) -> bool:
        return name in self.units

    def __repr__(self) -> str:
        columns = ", ".join(name if unit in ("1", "") else f"{name} ({unit})"
                            for name, unit in self.units.items())
        return f"<{self._where}: {self.rows} rows of {columns}>"

    def to_pandas(self):
        """All columns as a pandas.DataFrame. Needs pandas."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("to_pandas() needs pandas: install the package python3-pandas, or "
                              "`pip install pandas`") from error
        return pandas.DataFrame({name: np.asarray(self[name]) for name in self})


def read_csv(path: Path) -> Table:
    """Table of a CSV file that the program wrote: numbers, NaN where a cell is empty; int64 where a
    column counts; words, as objects, where it has no number. Throws RunError."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            names, *rows = csv.reader(file)
        columns = {name: _values(name, cells)
                   for name, cells in zip(names, zip(*rows) if rows else [()] * len(names))}
    except FileNotFoundError:
        raise RunError(f"{path}: is not there") from None
    except (OSError, ValueError) as error:
        raise RunError(f"{path}: cannot be read as a table: {error}") from error
    return Table(str(path), len(rows), {name: unit_of(name) for name in names},
                 lambda name: columns[name].copy())


def _values(name: str, cells) -> np.ndarray:
    if name in _WHOLE:
        return np.array(cells, dtype=np.int64)
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells], dtype=np.float64)
    except ValueError:
        return np.array(cells, dtype=object)
