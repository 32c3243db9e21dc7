"""A folder in which the program may write what is asked of one snapshot."""

import tempfile
from contextlib import contextmanager
from pathlib import Path

from .errors import ProgramError


@contextmanager
def stand_in(snapshot, without: str):
    """A folder that stands for that of the snapshot's run, which may be read-only; the words that name
    the snapshot in a call of the program are `--at`, EXTENSION.

    without  what the program is to write there: `export` or `figures`

    A snapshot that lies elsewhere is a run of its own. Errors of the program name the run's folder.
    """
    path = snapshot.path.absolute()
    run = path.parents[1]
    with tempfile.TemporaryDirectory(prefix="listric-") as folder:
        if path.parent.name == "snapshots" and (run / "scene.toml").is_file():
            for entry in run.iterdir():
                if entry.name != without:
                    Path(folder, entry.name).symlink_to(entry)
        else:
            run = path
            Path(folder, "snapshots").mkdir()
            name = f"extension-{snapshot.travel_m:08.2f}m.h5"
            Path(folder, "snapshots", name).symlink_to(path)
            Path(folder, "scene.toml").write_text(snapshot.scene_text, encoding="utf-8")
        try:
            yield Path(folder)
        except ProgramError as error:
            raise ProgramError(str(error).replace(folder, str(run)), error.code) from None
