"""Sections as the program draws them."""

from pathlib import Path

from .errors import UnknownName
from .program import call
from .stand_in import stand_in

KINDS = ("strata", "strain", "bonds", "behaviour", "sediment", "kinematics", "overview")


class Picture:
    """A picture that notebooks show; `png` are its bytes."""

    def __init__(self, png: bytes, what: str):
        self.png = png
        self._what = what

    def __repr__(self) -> str:
        return f"<picture of {self._what}>"

    def _repr_png_(self) -> bytes:
        return self.png

    def save(self, path) -> None:
        """Writes the PNG file."""
        Path(path).write_bytes(self.png)


def draw_section(snapshot, kind: str) -> Picture:
    """One of KINDS, as `listric figures` draws it. Throws UnknownName, ProgramError."""
    if kind not in KINDS:
        raise UnknownName(kind, KINDS, "plot")
    with stand_in(snapshot, without="figures") as folder:
        call("figures", folder, "--at", snapshot.travel_m)
        drawn, = (folder / "figures").glob(f"{kind}-*.png")
        return Picture(drawn.read_bytes(), f"{kind} of {snapshot.path}")
