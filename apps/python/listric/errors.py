"""Errors of this package. Every message is one line that names the file, or the call, and the cure."""

import difflib
import math
import re
from contextlib import contextmanager


class ListricError(Exception):
    """Any error of this package."""


class RunError(ListricError):
    """A folder that holds no run, a file of it that is not there or damaged."""


class UnknownName(ListricError, KeyError):
    """No column, table or number of that name."""

    __str__ = Exception.__str__  # KeyError's puts the message in quotes

    def __init__(self, name, among, where):
        """`among` are the names that there are; `where` says of what."""
        self._made_of = str(name), [str(one) for one in among], str(where)
        name, among, where = self._made_of
        close = difflib.get_close_matches(name, among, n=3)
        cure = (f"did you mean {' or '.join(close)}?" if close
                else f"there are {', '.join(among)}" if among else "there are none")
        super().__init__(f"{where}: no {name}; {cure}")

    def __reduce__(self):
        """Makes it again from what it was made of: a worker process hands it on by pickle."""
        return type(self), self._made_of


class BadValue(ListricError, ValueError):
    """A value that a call cannot take."""


@contextmanager
def reading(path, cure="run the scene again"):
    """Whatever goes wrong within is the fault of a file: a RunError that names it."""
    try:
        yield
    except ListricError:
        raise
    except OSError as error:
        raise RunError(f"{path}: cannot be read: {error.strerror or error}") from error
    except Exception as error:  # of whatever type: what is damaged may have any shape
        raise RunError(f"{path}: is damaged ({type(error).__name__}: {error}); {cure}") from error


def metres(name, value) -> float:
    """Metres of a number, or of a length with its unit as the program's calls have it: "5km". Throws BadValue."""
    if isinstance(value, str):
        found = re.fullmatch(r"\s*([0-9.]+(?:[eE][+-]?[0-9]+)?)\s*(k?)m\s*", value)
        try:
            return float(found[1]) * (1000.0 if found[2] else 1.0)
        except (TypeError, ValueError):
            raise BadValue(f"{name} = {value!r}: a length of at least 0 with its unit, such as 5km or 500m") from None
    return finite_number(name, value, "give metres, such as 5000.0, or a length with its unit: '5km'")


def finite_number(name, value, cure) -> float:
    """The number that a caller gave. Throws BadValue."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise BadValue(f"{name} = {value!r}: is no finite number; {cure}")
    return number


class ProgramError(ListricError):
    """The program is not found, or a call of it has failed.

    `code` is its exit code: 2 the call or the scene is wrong, 3 the numbers went wrong, 4 no room,
    130 interrupted; negative: the signal that ended it; None if it did not start.
    """

    def __init__(self, message, code=None):
        super().__init__(message)
        self.code = code


class Named(dict):
    """A dict that says what was meant by a name it does not have."""

    def __init__(self, values, where):
        super().__init__(values)
        self._where = where
        for name, value in values.items():
            if isinstance(value, dict):
                self[name] = Named(value, f"{where} [{name}]")

    def __missing__(self, name):
        raise UnknownName(name, self, self._where)
