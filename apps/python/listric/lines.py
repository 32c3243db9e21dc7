"""Lines of a section as the program exports them: horizons, faults, surfaces, the base."""

from pathlib import Path

import numpy as np

from .errors import ProgramError, RunError, UnknownName
from .program import call, find_program
from .stand_in import at_words, stand_in
from .table import read_csv


def exported_lines(snapshot, kind: str) -> list[dict]:
    """Lines of a snapshot from its run's folder `export`, or else from the program.

    Throws UnknownName, where the moment has no such lines, too, ProgramError, RunError.
    """
    path = snapshot.path.absolute()
    exported = path.parents[1] / "export" / f"{kind}-{path.stem}.csv"   # of a call with options: another name
    if is_newer(exported, path) and is_of_today(exported) and is_newer_than_program(exported):
        return read_lines(exported)
    with stand_in(snapshot) as (run, folder):
        call("export", "well" if kind == "burial" else kind, run, "--format", "csv", "--at", at_words(snapshot),
             "--output", folder)
        written = {file.name.split("-")[0]: file for file in folder.glob("*-*.csv")}
        if kind not in written:
            raise UnknownName(kind, written, f"lines of {path} at {snapshot.travel_m:g} m")
        return read_lines(written[kind])


def is_newer(exported: Path, snapshot: Path) -> bool:
    """Whether a file is there and younger than all that it was made of: the run's scene, the snapshot and
    those before it, as lines know the past."""
    def order(path):
        return len(path.name.partition(".")[0]), path.name

    past = [one for one in snapshot.parent.glob("extension-*m.h5") if order(one) <= order(snapshot)]
    try:
        made = exported.stat().st_mtime_ns
        return all(source.stat().st_mtime_ns < made for source in (*past, snapshot.parents[1] / "scene.toml"))
    except OSError:
        return False


def is_newer_than_program(exported: Path) -> bool:
    """Whether the program that would be asked may have written a file: another version's may differ. Without a program
    there is only the file."""
    try:
        program = find_program()
    except ProgramError:
        return True
    built = [program, *program.parent.glob("build/*/listric")]  # of the launcher
    return max(one.stat().st_mtime_ns for one in built) < exported.stat().st_mtime_ns


def is_of_today(exported: Path) -> bool:
    """Whether a file has the column depth_reference: before, calls with other options wrote under its name, too."""
    try:
        with open(exported, encoding="utf-8", errors="replace") as file:
            return "depth_reference" in file.readline().strip().split(",")
    except OSError:
        return False


def read_lines(path: Path) -> list[dict]:
    """A dict per line of an exported CSV file: values of the line, and arrays of shape (points,) of
    what the columns from x_m on say of its points. Throws RunError."""
    table = read_csv(path)
    if missing := [name for name in ("line", "x_m") if name not in table]:
        raise RunError(f"{path}: has no column {missing[0]}; export it again")
    columns = {name: np.asarray(table[name]) for name in table}
    of_points = list(columns)[list(columns).index("x_m"):]
    number = columns.pop("line")
    starts = np.flatnonzero(np.diff(number, prepend=-1))
    return [{name: values[start:end] if name in of_points else values[start]
             for name, values in columns.items()}
            for start, end in zip(starts, [*starts[1:], len(number)])]
