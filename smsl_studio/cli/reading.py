"""Reading the blueprint a command is asked about; ``-`` is standard input."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli.output import report
from smsl_studio.errors import Place, ReadError
from smsl_studio.front.reading import read, read_bytes
from smsl_studio.smsl.files import LARGEST

STDIN = "<stdin>"


def read_argument(file: str) -> Blueprint:
    """The blueprint in a file, or on standard input."""
    if file != "-":
        return read(file)
    return read_bytes(standard_input(), STDIN)


def read_each(files: Iterable[str], command: str) -> Iterator[Blueprint | None]:
    """The blueprint of every file; None for one that cannot be read, which is told."""
    for file in files:
        try:
            blueprint = read_argument(file)
        except ReadError as error:
            report(error, command)
            yield None
        else:
            yield blueprint


def standard_input() -> bytes:
    """All bytes of standard input; ReadError where there is none."""
    try:
        if sys.stdin is not None:
            stream = getattr(sys.stdin, "buffer", None)
            return stream.read(LARGEST + 1) if stream else sys.stdin.read(LARGEST + 1).encode()
        reason = "it is closed"
    except OSError as error:
        reason = error.strerror or str(error)
    place = Place(STDIN, 1, 1)
    raise ReadError(f"standard input cannot be read: {reason}", place, "Name a file instead of -.")
