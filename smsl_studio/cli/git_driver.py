"""``diff`` as an external driver of git: ``path old-file old-hex old-mode new-file new-hex
new-mode``.

A side that does not exist is /dev/null. For a side that cannot be read, its fault and the different
lines are printed. No error here may end git's own command.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from difflib import unified_diff

from smsl_studio.blueprint.comparison import Difference, compare
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli.blueprint_argument import note_stand_ins
from smsl_studio.cli.output import Output
from smsl_studio.errors import Place, ReadError
from smsl_studio.front.inputs import read_bytes
from smsl_studio.legible import one_line
from smsl_studio.picture.aligned import as_drawn
from smsl_studio.smsl.document.limits import LARGEST_FILE
from smsl_studio.smsl.inputs import read_ordinary

_MOST_LINES = 3000
"""The largest number of lines of unreadable texts that are compared line by line."""


def by_git(arguments: Sequence[str], environment: Mapping[str, str]) -> bool:
    """Whether these are the arguments of an external diff driver."""
    if len(arguments) == 1:
        return "GIT_DIFF_PATH_COUNTER" in environment
    return len(arguments) in (7, 9)


def show_for_git(
    arguments: Sequence[str], out: Output, show: Callable[[Difference, Output], None]
) -> None:
    """Print the differences of one file in a git diff."""
    path, renamed = arguments[0], arguments[7] if len(arguments) == 9 else arguments[0]
    if len(arguments) == 1:
        out.line(one_line(f"{path}: not merged yet"))
        return
    title = path if renamed == path else f"{path} -> {renamed}"
    out.line(one_line(f"smsl {title}"))
    raws = [_bytes_of(arguments[at]) for at in (1, 4)]
    sides: list[Blueprint] = []
    for word, raw, name in zip(("earlier", "later"), raws, (path, renamed), strict=True):
        try:
            sides.append(_read(raw, name))
        except ReadError as error:
            out.line(out.yellow(one_line(f"the {word} version cannot be read: {error}")))
    if len(sides) == 2:
        show(as_drawn(compare(*sides)), out)
    else:
        _show_lines(raws, (path, renamed), out)


def _bytes_of(file: str) -> bytes | OSError | None:
    if file in ("/dev/null", os.devnull, "nul"):
        return None
    try:
        return read_ordinary(file, LARGEST_FILE).raw
    except OSError as error:
        return error


def _read(raw: bytes | OSError | None, name: str) -> Blueprint:
    """Read one side as a blueprint. Its imports are searched beside ``name`` in the work tree."""
    if isinstance(raw, OSError):
        raise ReadError(raw.strerror or str(raw), Place(name, 1, 1))
    blueprint = read_bytes(b"{}", "nothing.json") if raw is None else read_bytes(raw, name)
    note_stand_ins(blueprint)
    return blueprint


def _show_lines(raws: Sequence[bytes | OSError | None], names: Sequence[str], out: Output) -> None:
    """Print the different lines of sides whose meaning cannot be compared."""
    texts = [raw.decode("utf-8", "replace") if isinstance(raw, bytes) else "" for raw in raws]
    before, after = (text.splitlines() for text in texts)
    if max(len(before), len(after)) > _MOST_LINES:
        out.line("the texts differ")
        return
    paint = {"+": out.green, "-": out.red}
    for line in unified_diff(before, after, names[0], names[1], lineterm="", n=2):
        out.line(paint.get(line[:1], out.plain)(one_line(line)))
