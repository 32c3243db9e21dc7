"""Lines of a section as the program exports them: horizons, faults, surfaces, the base."""

import tempfile
from pathlib import Path

import numpy as np

from .errors import ProgramError
from .program import call
from .table import read_csv


def exported_lines(snapshot: Path, kind: str) -> list[dict]:
    """Lines of a snapshot from its run's folder `export`, or else from the program.

    Throws ProgramError, RunError.
    """
    run = snapshot.absolute().parents[1]
    name = f"{kind}-{snapshot.stem}.csv"
    exported = run / "export" / name
    if exported.is_file() and exported.stat().st_mtime >= snapshot.stat().st_mtime:
        return read_lines(exported)
    with tempfile.TemporaryDirectory(prefix="listric-") as folder:
        # A stand-in for the run's folder, in which nothing is written: it may be read-only.
        for entry in run.iterdir():
            if entry.name != "export":
                Path(folder, entry.name).symlink_to(entry)
        at = snapshot.stem.removeprefix("extension-").removesuffix("m")
        try:
            call("export", kind, folder, "--format", "csv", "--at", at)
        except ProgramError as error:
            raise ProgramError(str(error).replace(folder, str(run)), error.code) from None
        return read_lines(Path(folder, "export", name))


def read_lines(path: Path) -> list[dict]:
    """A dict per line of an exported CSV file: values of the line, and arrays of shape (points,) of
    what the columns from x_m on say of its points. Throws RunError."""
    table = read_csv(path)
    columns = {name: np.asarray(table[name]) for name in table}
    of_points = list(columns)[list(columns).index("x_m"):]
    number = columns.pop("line")
    starts = np.flatnonzero(np.diff(number, prepend=-1))
    return [{name: values[start:end] if name in of_points else values[start]
             for name, values in columns.items()}
            for start, end in zip(starts, [*starts[1:], len(number)])]
