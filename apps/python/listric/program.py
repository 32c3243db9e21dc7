"""The program, found and called."""

import contextlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import tomllib
import warnings
from pathlib import Path

from .errors import ProgramError, metres

_HERE = Path(__file__).resolve().parent


def find_program() -> Path:
    """Path of the program: the environment's LISTRIC_PROGRAM, else the one installed with this
    package, else `listric` on the PATH, else, in the source tree, the launcher, which builds what is
    missing.

    Throws ProgramError.
    """
    if wanted := os.environ.get("LISTRIC_PROGRAM"):
        if not os.access(wanted, os.X_OK) or os.path.isdir(wanted):
            raise ProgramError(f"LISTRIC_PROGRAM: {wanted}: is no program; name bin/listric of an "
                               "installation, or build/native/listric of the source tree")
        return Path(wanted).absolute()
    # PREFIX/lib/python3/dist-packages/listric, and apps/python/listric of the source tree.
    is_installed = _HERE.parent.name in ("dist-packages", "site-packages")
    installed, launcher = _HERE.parents[3] / "bin/listric", _HERE.parents[2] / "listric"
    on_path = shutil.which("listric")
    for found in (is_installed and installed, on_path and Path(on_path), launcher):
        if found and found.is_file() and os.access(found, os.X_OK):
            return found.absolute()
    raise ProgramError("the program listric is not found: put it on the PATH, or name it in "
                       "LISTRIC_PROGRAM")


def call(*words, quiet: bool = True) -> str:
    """Calls the program, as `call("sweep", "plan.toml")`, and returns what it prints.

    Its progress appears on stderr unless `quiet`; then its warnings are Python's. Throws ProgramError with
    its last line and exit code. Interrupted (Ctrl-C, the stop button), the program saves what it has reached.
    """
    return _call(words, quiet)


def _call(words, quiet) -> str:
    """As call(); a warning names the line that called the caller of this."""
    command = [str(find_program()), *map(str, words)]
    last = ""
    with tempfile.TemporaryFile("w+", encoding="utf-8") as printed:
        try:
            process = subprocess.Popen(command, stdout=printed, stderr=subprocess.PIPE, text=True,
                                       encoding="utf-8", errors="replace")
        except OSError as error:
            raise ProgramError(f"{command[0]}: cannot be started: {error.strerror}") from error
        with process:
            try:
                for line in process.stderr:
                    last = line.strip() or last
                    if not quiet:
                        sys.stderr.write(line)
                    elif last.startswith("listric: warning: "):
                        warnings.warn(last.removeprefix("listric: warning: "), stacklevel=3)
            except KeyboardInterrupt:
                _stop(process)
                raise
        if process.returncode:
            said = last or "listric says nothing"
            raise ProgramError(f"{said} (exit code {process.returncode} of "
                               f"`listric {' '.join(map(str, words))}`)", process.returncode)
        printed.seek(0)
        return printed.read()


def _stop(process) -> None:
    """Waits for a program that saves what it has reached. A terminal's Ctrl-C has reached it; a signal to this
    process alone has not, so it is handed on."""
    try:
        process.communicate(timeout=1)
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGINT)
        process.communicate()


def simulate(scene, *, set=None, without=(), accuracy=None, seed=None, threads=None, until_m=None,
             output=None, resume=False, force=False, figures=True, report=True, quiet=True):
    """Runs a scene to its end and returns the Run.

    scene      name (`listric scenes`), or a path to a file
    set        {"table.key": value} of parameters; units are in their names (docs/reference/parameters.md)
    without    names of effects to switch off
    accuracy   "draft", "standard", "fine" or "sandbox"
    seed       of the packing and of everything random
    threads    processor cores to use
    until_m    ends at this extension, m, or a length with its unit: "5km"
    output     folder of results; without it out/NAME, by the scene's key `name` or its file's, as the program has it
    resume     goes on from the newest snapshot of that folder
    force      replaces a run that is in that folder; else this is refused
    figures, report  False: none are made, which many short runs spend most of their time with
    quiet      False: progress on stderr; else the program's warnings are Python's

    Throws ProgramError.
    """
    from .run import Run  # which finds lines by the program
    output = Path(output or Path("out", (set or {}).get("name") or _name_of(scene)))
    words = ["run", scene, "--output", output]
    for name, value in (set or {}).items():
        words += ["--set", f"{name}={_toml(value)}"]
    for effect in [without] if isinstance(without, str) else without:
        words += ["--without", effect]
    options = {"--accuracy": accuracy, "--seed": seed, "--threads": threads,
               "--until": None if until_m is None else f"{metres('until_m', until_m)}m"}
    for option, value in options.items():
        if value is not None:
            words += [option, value]
    flags = {"--resume": resume, "--force": force, "--quiet": quiet, "--no-figures": not figures, "--no-report": not report}
    _call([*words, *(flag for flag, on in flags.items() if on)], quiet)
    return Run(output)


def _name_of(scene) -> str:
    """Name of a scene, given by its file or by its name; errors of a file are left to the program."""
    path = Path(scene)
    if not path.is_file():
        return path.name.removesuffix(".toml")
    name = None
    with contextlib.suppress(OSError, ValueError, RecursionError):
        name = tomllib.loads(path.read_text(encoding="utf-8")).get("name")
    return str(name or path.stem)


def _toml(value, nested: bool = False) -> str:
    """As `--set` reads it: a word stands without quotes, except in a list."""
    if hasattr(value, "tolist"):
        value = value.tolist()  # of NumPy
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(key)} = {_toml(one, True)}" for key, one in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(one, True) for one in value) + "]"
    return _quoted(str(value)) if nested and isinstance(value, (str, Path)) else str(value)


def _key(name) -> str:
    return str(name) if re.fullmatch("[A-Za-z0-9_-]+", str(name)) else _quoted(str(name))


def _quoted(text: str) -> str:
    """TOML's string: it is JSON's, which leaves DEL as it is."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
