"""Start of every script: libraries that the caller's settings do not change, errors of one line.

Exit statuses are the program's own (docs/reference/exit-codes.md), and one that says that a library is not there.
"""
import contextlib
import importlib
import logging
import os
import sys
import tempfile
from collections.abc import Callable
from types import ModuleType

BAD_INPUT, NO_ROOM, NO_LIBRARY, MISTAKE, INTERRUPTED = 2, 4, 69, 70, 130


class InputError(Exception):
    """Input that is missing or makes no sense; the message is for the user."""


def end(status: int, text: str) -> None:
    """Ends the script with one line on stderr."""
    sys.stderr.write(f"{os.path.basename(sys.argv[0])}: {' '.join(text.split())}\n")
    sys.exit(status)


if sys.version_info < (3, 10):
    end(NO_LIBRARY, f"Python is {sys.version.split()[0]}; needed: 3.10 or later")


@contextlib.contextmanager
def elsewhere():
    """Within the scripts' folder: Matplotlib reads settings from the current one, which may also be
    gone."""
    try:
        here = os.open(".", os.O_PATH | os.O_DIRECTORY | os.O_CLOEXEC)
    except OSError:
        here = None
    os.chdir(os.path.dirname(os.path.realpath(__file__)))
    try:
        yield
    finally:
        if here is not None:
            with contextlib.suppress(OSError):
                os.fchdir(here)
            os.close(here)


def forget_settings() -> None:
    """Neither the caller's matplotlibrc nor backend is read. Its cache of fonts is, where there is a
    place for one."""
    os.environ.pop("MPLBACKEND", None)
    os.environ["MATPLOTLIBRC"] = os.devnull
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    if os.path.expanduser("~") == "~" and not os.environ.get("MPLCONFIGDIR"):
        os.environ["HOME"] = tempfile.gettempdir()


def library(name: str) -> ModuleType:
    """The module of that name; without it the script ends with the reason."""
    try:
        with elsewhere():
            return importlib.import_module(name)
    except Exception as failure:  # one that is there and fits no other fails with any of them
        end(NO_LIBRARY, f"cannot import {name}: {failure}")


def status_of(failure: Exception) -> int:
    if isinstance(failure, InputError):
        return BAD_INPUT
    return NO_ROOM if isinstance(failure, (OSError, MemoryError)) else MISTAKE


def run(main: Callable[..., None], usage: str) -> None:
    """Calls main with the script's arguments, as many as the usage names, without those in
    brackets or with them; the last may be given several times where it ends with dots. Errors are
    one line."""
    try:
        words = usage.split()
        least = len([word for word in words if word[0] != "["])
        most = sys.maxsize if words[-1].endswith("...") else len(words)
        if not least <= len(sys.argv) <= most:
            raise InputError(f"usage: {usage}")
        main(*sys.argv[1:])
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
    except Exception as failure:  # also a full disk: one line, no traceback
        kind = "" if isinstance(failure, InputError) else f"{type(failure).__name__}: "
        end(status_of(failure), f"{kind}{failure}")
