"""The program that tests call, where its sources are, and what it says on a terminal."""

import os
import signal
import subprocess
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("LISTRIC_PROGRAM", SOURCES / "build/native/listric")).resolve()
NO_FIGURES = {"LISTRIC_PYTHON": "/bin/false"}  # they take longer than small runs

# Tests may run in a shell's background or under nohup, where programs do not hear of signals that tests send.
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1):
    if signal.getsignal(number) == signal.SIG_IGN:
        signal.signal(number, signal.SIG_DFL)


def listric(*words, **options):
    """A call, by itself from the sources' folder, and all that it says in one text."""
    return subprocess.run([PROGRAM, *map(str, words)], **{"cwd": SOURCES, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT,
                                                          "text": True, **options})


def read_terminal(leader):
    """Text written to a terminal, up to where its last writer closed it. It arrives in pieces."""
    said = b""
    while True:
        try:
            part = os.read(leader, 65536)
        except OSError:  # Linux reports the end of a terminal as an error
            part = b""
        if not part:
            os.close(leader)
            return said.decode()
        said += part
