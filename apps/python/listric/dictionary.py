"""Units and definitions of the names in the program's files, as the program declares them."""

import json
from functools import cache
from pathlib import Path


@cache
def dictionary() -> dict[str, dict]:
    """{name: {"table", "unit", "doc", ...}} of all measures (docs/reference/measures.md); "parts" are what the
    objects of a list have, by their names, too."""
    try:
        entries = json.loads(Path(__file__).with_name("dictionary.json").read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise FileNotFoundError(f"{error.filename}: is made by the build of the program: ./listric scenes") from None
    parts = {part["name"]: part for entry in entries for part in entry.get("parts", ())}
    return parts | {entry["name"]: entry for entry in reversed(entries)}


def unit_of(name: str) -> str | None:
    """Unit of a measure; "1" for a ratio or a count, None where nothing declares the name. a: years."""
    return dictionary().get(name, {}).get("unit") or None


def doc_of(name: str) -> str:
    """Definition of a measure; empty where nothing declares the name."""
    return dictionary().get(name, {}).get("doc", "")
