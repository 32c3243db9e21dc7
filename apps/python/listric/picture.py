"""Sections as the program draws them."""

from pathlib import Path

from .errors import UnknownName
from .program import call
from .stand_in import at_words, stand_in

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
    """One of KINDS, as `listric figures` draws it. Throws UnknownName, where the moment has no such
    section, too, and ProgramError."""
    if kind not in KINDS:
        raise UnknownName(kind, KINDS, "plot")
    with stand_in(snapshot) as (run, folder):
        call("figures", run, "--at", at_words(snapshot), "--output", folder)
        drawn = {path.name.split("-")[0]: path for path in folder.glob("*-*.png")}
        if kind not in drawn:
            there = [one for one in KINDS if one in drawn]
            raise UnknownName(kind, there, f"plot of {snapshot.path} at {snapshot.travel_m:g} m")
        return Picture(drawn[kind].read_bytes(), f"{kind} of {snapshot.path}")
