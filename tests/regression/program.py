"""The program that tests call, and where its sources are."""

import os
import signal
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("LISTRIC_PROGRAM", SOURCES / "build/native/listric")).resolve()
NO_FIGURES = {"LISTRIC_PYTHON": "/bin/false"}  # they take longer than small runs

# Tests may run in a shell's background or under nohup, where programs do not hear of signals that tests send.
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1):
    if signal.getsignal(number) == signal.SIG_IGN:
        signal.signal(number, signal.SIG_DFL)
