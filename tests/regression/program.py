"""The program that tests call, and where its sources are."""

import os
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("LISTRIC_PROGRAM", SOURCES / "build/native/listric")).resolve()
