"""Reads the blueprint in the arguments of a command. ``-`` means standard input."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli.output import note, report_error
from smsl_studio.errors import Place, ReadError
from smsl_studio.front.inputs import read, read_bytes
from smsl_studio.smsl.document.limits import LARGEST_FILE

STDIN = "<stdin>"


def read_argument(file: str) -> Blueprint:
    """The blueprint in a file, or on standard input; a note tells what was read instead of a
    file."""
    blueprint = read(file) if file != "-" else read_bytes(standard_input(), STDIN)
    note_stand_ins(blueprint)
    return blueprint


def note_stand_ins(blueprint: Blueprint) -> None:
    """Print a note for each file that was read instead of another."""
    for document in blueprint.documents:
        if document.stands_in:
            note_stand_in(document.file, document.stands_in)


def note_stand_in(file: str, stands_in: str) -> None:
    """Print a note that another file was read, because a save of several files was interrupted."""
    note(f"{file}: read from {stands_in}, because a save was interrupted")
    note("Open it in the window, which asks whether to finish that save or to undo it.")


def inputs_of(blueprint: Blueprint) -> tuple[str | int, ...]:
    """Return the files that a blueprint was read from. No output may replace them."""
    return tuple(0 if one.file == STDIN else one.file for one in blueprint.documents)


def read_each(files: Iterable[str], command: str) -> Iterator[Blueprint | ReadError]:
    """Yield the blueprint of every file. A file that cannot be read is reported and gives its
    error."""
    for file in files:
        try:
            blueprint = read_argument(file)
        except ReadError as error:
            report_error(error, command)
            yield error
        else:
            yield blueprint


def standard_input() -> bytes:
    """Return all bytes of standard input. ReadError if it is closed or cannot be read."""
    try:
        if sys.stdin is not None:
            stream, most = getattr(sys.stdin, "buffer", None), LARGEST_FILE + 1
            return stream.read(most) if stream else sys.stdin.read(most).encode()
        reason = "it is closed"
    except OSError as error:
        reason = error.strerror or str(error)
    place = Place(STDIN, 1, 1)
    raise ReadError(f"standard input cannot be read: {reason}", place, "Name a file instead of -.")
