"""Runs of Listric, the numerical sandbox for halfgrabens, in Python.

    import listric
    run = listric.Run("out/lis1")                    # reads nothing yet
    x = run.snapshots[-1].discs["x"]                 # an array; x.units is "m"
    run = listric.simulate("lis1", set={"extension.distance_m": 5000.0}, accuracy="draft")

SI units, except years (a) where a name ends with _a. x is measured from the breakaway into the hanging
wall. Columns of snapshots are those of the file, bit for bit: there y points up, from the original
surface. All else that has a depth has it positive down. docs/guides/python.md says more.
"""

from .dataset import Dataset
from .errors import BadValue, ListricError, ProgramError, RunError, UnknownName
from .picture import Picture
from .program import call, find_program, simulate
from .raster import Raster
from .run import Run
from .snapshot import Snapshot
from .table import Column, Table

__all__ = ["BadValue", "Column", "Dataset", "ListricError", "Picture", "ProgramError", "Raster", "Run", "RunError",
           "Snapshot", "Table", "UnknownName", "call", "find_program", "simulate"]
