"""Tables of named columns with units."""

import csv
import re
from collections.abc import Callable, Mapping
from functools import partial
from html import escape
from pathlib import Path

import numpy as np

from .dictionary import doc_of, unit_of
from .errors import RunError, UnknownName

_WHOLE = {"cycle", "discs", "line", "stratum", "fault"}  # columns of CSV files that count


class Column(np.ndarray):
    """A column's numbers, an array of shape (rows,), with their `units` and `doc`, its definition.

    Parts and copies of a column keep both; what is computed from it is a plain array.
    """

    units: str | None
    doc: str

    def __new__(cls, values, units: str | None, doc: str = ""):
        column = np.asarray(values).view(cls)
        column.units = units
        column.doc = doc
        return column

    def __array_finalize__(self, origin):
        self.units = getattr(origin, "units", None)
        self.doc = getattr(origin, "doc", "")

    def __array_ufunc__(self, ufunc, method, *inputs, out=None, **options):
        if out is not None:
            options["out"] = tuple(_plain(one) for one in out)
        return getattr(ufunc, method)(*(_plain(one) for one in inputs), **options)

    def __reduce__(self):
        return Column, (_plain(self), self.units, self.doc)


def _plain(values):
    return values.view(np.ndarray) if isinstance(values, Column) else values


class Table(Mapping):
    """Columns by name, in their order; each is read when it is asked for, every time again: keep in
    a variable what is used more than once.

    `table["x"]` is a Column, `table.units` {name: unit}, None where it is not known, `table.rows` the length of all columns,
    `table.to_pandas()` a DataFrame.
    """

    def __init__(self, where: str, rows: int, units: dict[str, str | None],
                 read: Callable[[str], np.ndarray]):
        self.rows = rows
        self.units = units
        self._where = where
        self._read = read

    def __getitem__(self, name: str) -> Column:
        if name not in self.units:
            raise UnknownName(name, self.units, self._where)
        return Column(self._read(name), self.units[name], doc_of(name))

    def __iter__(self):
        return iter(self.units)

    def __len__(self) -> int:
        return len(self.units)

    def __contains__(self, name) -> bool:
        return name in self.units

    def __repr__(self) -> str:
        columns = ", ".join(name if unit in ("1", None) else f"{name} ({unit})"
                            for name, unit in self.units.items())
        return f"<{self._where}: {self.rows} rows of {columns}>"

    def _repr_html_(self) -> str:
        """The columns, not their numbers, which would all be read."""
        return f"<p>{escape(self._where)}: {self.rows} rows</p>" + html_table(
            ("column", "unit", "definition"),
            ((name, unit or "", doc_of(name)) for name, unit in self.units.items()))

    def to_pandas(self):
        """All columns as a pandas.DataFrame. Needs pandas."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("to_pandas() needs pandas: install the package python3-pandas, or "
                              "`pip install pandas`") from error
        return pandas.DataFrame({name: np.asarray(self[name]) for name in self})


def html_table(heads, rows) -> str:
    """Rows of words as a table of HTML; words between backticks are code."""
    def row(words, cell):
        cells = (re.sub("`([^`]*)`", r"<code>\1</code>", escape(word)) for word in words)
        return "<tr>" + "".join(f'<{cell} style="text-align: left">{one}</{cell}>' for one in cells) + "</tr>\n"
    return f"\n<table>\n{row(heads, 'th')}{''.join(row(words, 'td') for words in rows)}</table>"


def read_csv(path: Path, units: Callable[[str], str | None] = unit_of) -> Table:
    """Table of a CSV file that the program wrote: numbers, NaN where a cell is empty; int64 where a
    column counts; words, as objects, where it has no number. Throws RunError."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            names, *rows = _rows(csv.reader(file))
        columns = {name: _values(name, cells)
                   for name, cells in zip(names, zip(*rows) if rows else [()] * len(names))}
    except FileNotFoundError:
        raise RunError(f"{path}: is not there") from None
    except (OSError, ValueError, OverflowError, csv.Error) as error:
        raise RunError(f"{path}: cannot be read as a table: {error}") from error
    return Table(str(path), len(rows), {name: units(name) for name in names},
                 partial(_copy_of, columns))


def _copy_of(columns, name):
    return columns[name].copy()


def _rows(reader):
    """Rows of a CSV reader, all as long as the first. Throws ValueError."""
    width = None
    for row in reader:
        width = len(row) if width is None else width
        if len(row) != width:
            raise ValueError(f"line {reader.line_num} has {len(row)} fields, the head {width}")
        yield row


def _values(name: str, cells) -> np.ndarray:
    if name in _WHOLE:
        return np.array(cells, dtype=np.int64)
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells], dtype=np.float64)
    except ValueError:
        return np.array(cells, dtype=object)
