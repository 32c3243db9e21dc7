"""Folders for a call of the program about one snapshot."""

import tempfile
from contextlib import contextmanager
from pathlib import Path

from .errors import ProgramError


@contextmanager
def stand_in(snapshot):
    """The folder of a snapshot's run, and one that vanishes, for `--output`: the run's may be read-only. The words
    that name the snapshot in a call of the program are `--at`, at_words(snapshot).

    A snapshot that lies elsewhere is a run of its own, made for the call. Errors of the program name the file.
    """
    path = snapshot.path.absolute()
    run = path.parents[1]
    with tempfile.TemporaryDirectory(prefix="listric-") as folder:
        written = Path(folder, "written")
        if path.parent.name == "snapshots" and (run / "scene.toml").is_file():
            yield run, written
            return
        Path(folder, "snapshots").mkdir()
        name = f"extension-{snapshot.travel_m:08.2f}m.h5"
        Path(folder, "snapshots", name).symlink_to(path)
        Path(folder, "scene.toml").write_text(snapshot.scene_text, encoding="utf-8")
        try:
            yield Path(folder), written
        except ProgramError as error:
            raise ProgramError(str(error).replace(folder, str(path)), error.code) from None


def at_words(snapshot) -> str:
    return f"{snapshot.travel_m!r}m"
