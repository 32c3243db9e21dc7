"""Makers of a run, and reservations that its readers must know."""

import contextlib
import json
import subprocess
from functools import cache
from pathlib import Path

from .errors import ListricError, Named, RunError, reading
from .program import find_program


def read_summary(folder: Path) -> Named:
    """summary.json. Throws RunError."""
    path = folder / "summary.json"
    with reading(path):
        try:
            text = path.read_text(encoding="utf-8")
        except FileNotFoundError:
            raise RunError(f"{path}: is not there: the run has not ended; `listric run ... --resume` "
                           "goes on") from None
        values = json.loads(text)
        if not isinstance(values, dict):
            raise TypeError("no JSON object")
        return Named(values, str(path))


def reservations(run) -> list[str]:
    """A sentence each, as the program's calls have them: the run has not ended, another version has made it, its summary
    is of another moment than its snapshots."""
    newest = run._snapshots[-1] if run._snapshots else None
    try:
        summary = read_summary(run.folder)
    except RunError as error:
        ended = (run.folder / "summary.json").exists()
        last = f", it has come to {newest.named_extension_m:g} m" if newest else ""
        said = [str(error).removeprefix(f"{run.folder}/") if ended else f"the run has not ended{last}: `listric run ... --resume` goes on"]
        made_by = ""
        with contextlib.suppress(RunError):  # whoever reads that snapshot is told
            made_by = newest.made_by if newest else ""
    else:
        said, made_by = [*_of_scene(summary, run.folder), *_of_moment(summary, newest)], makers_of(summary)
    program = program_version()
    if program and made_by and not is_same(made_by, program):
        said.append(f"listric {made_by} has made it, and this is {program}: what a new run gives may differ")
    return said


def _of_scene(summary, folder) -> list[str]:
    made = summary.get("provenance")
    if not isinstance(made, dict) or "scene_hash" not in made or made.get("earlier_versions"):
        return []
    with reading(folder / "scene.toml"):
        if made["scene_hash"] == scene_hash((folder / "scene.toml").read_bytes()):
            return []
    return ["summary.json is of another request than scene.toml: one of them has been changed or copied; "
            "`listric run ... --force` makes both"]


def _of_moment(summary, newest) -> list[str]:
    end, cycles = summary.get("travel_m", summary.get("extension_m")), summary.get("cycles")
    if newest is None or not isinstance(end, (int, float)):
        return []
    step = end / cycles if isinstance(cycles, (int, float)) and cycles > 0 else 0.0
    if abs(end - newest.named_extension_m) <= 0.02 + 2.0 * step:
        return []
    return [f"summary.json is of {end:g} m, the newest snapshot of {newest.named_extension_m:g} m: "
            "`listric run ... --resume` makes it again"]


def scene_hash(text: bytes) -> str:
    """Hash of every parameter in a scene.toml, as the program has it (apps/archive/folder/provenance.cpp)."""
    value = 1469598103934665603
    for line in text.splitlines():
        if (said := _without_comment(line)) and not said.startswith(b"report = "):
            for byte in said + b"\n":
                value = (value ^ byte) * 1099511628211 & 0xffffffffffffffff
    return f"{value:016x}"


def _without_comment(line: bytes) -> bytes:
    quote, escaped = 0, False
    for at, letter in enumerate(line):
        if escaped:
            escaped = False
        elif quote:
            escaped = quote == ord('"') and letter == ord("\\")
            quote = 0 if letter == quote else quote
        elif letter in b"\"'":
            quote = letter
        elif letter == ord("#"):
            return line[:at].rstrip(b" ")
    return line.rstrip(b" ")


def makers_of(summary) -> str:
    """Versions of the program that made a run, that which ended it last: "A, B". Empty: not recorded."""
    made = summary.get("provenance")
    if not isinstance(made, dict) or not isinstance(made.get("version"), str):
        return ""
    earlier = made.get("earlier_versions", [])
    last = "+".join(str(made[key]) for key in ("version", "commit") if made.get(key))
    return ", ".join([*(map(str, earlier) if isinstance(earlier, list) else ()), last])


@cache
def program_version() -> str:
    """Version of the program that is called from here; empty where there is none. The launcher answers without a build."""
    with contextlib.suppress(ListricError, OSError, subprocess.SubprocessError):
        done = subprocess.run([str(find_program()), "--version"], capture_output=True, text=True, timeout=20, check=True)
        return done.stdout.strip().removeprefix("listric ")
    return ""


def is_same(one: str, other: str) -> bool:
    """Whether two versions are one; of commits git tells more or fewer letters."""
    (number, _, commit), (other_number, _, other_commit) = (text.removesuffix("-dirty").partition("+") for text in (one, other))
    return number == other_number and (commit.startswith(other_commit) or other_commit.startswith(commit))
