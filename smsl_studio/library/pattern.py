"""Name patterns such as ``Op_{disk}{peg}``, and the one way they are read.

Reading is unambiguous: from the left, an ``int``, ``float`` or ``bool`` takes as many characters as
it can, a ``str`` as few as it can (at least one), under the condition that the whole name matches.
So ``Op_{disk}{peg}`` with ``disk: int, peg: str`` reads ``Op_12b`` as disk 12 and peg ``b``.
``{{`` and ``}}`` stand for braces.
"""

from __future__ import annotations

import re
import string
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from smsl_studio.errors import PluginError

MOST = 16
"""Parameters in one pattern."""

LONGEST = 500
"""Characters of one pattern."""

_DIGITS = re.compile("[0-9]*")


class _Piece(NamedTuple):
    """Fixed characters, and the parameter behind them (none where it is empty)."""

    fixed: str
    name: str
    kind: object


@dataclass(frozen=True, slots=True)
class Pattern:
    """A pattern: its text, the parameters in it, and how many of its characters are fixed."""

    text: str
    parameters: tuple[str, ...]
    literal: int
    _pieces: tuple[_Piece, ...] = field(repr=False)

    def match(self, name: str) -> dict[str, str] | None:
        """The text each parameter has in ``name``, or None where the name does not fit.

        It takes time in proportion to the pattern times the name, whatever they are.
        """
        pieces = self._pieces
        if not pieces:
            return None if name else {}
        if not name.startswith(pieces[0].fixed):
            return None
        ends = _PatternMatch(pieces, name).ends(0, 0)
        if ends is None:
            return None
        values = (name[start:end] for start, end in reversed(ends))
        return dict(zip(self.parameters, values, strict=True))

    def fill(self, values: Mapping[str, object]) -> str:
        """The name that has these values."""
        return "".join(
            piece.fixed + (str(values[piece.name]) if piece.name else "") for piece in self._pieces
        )


class _PatternMatch:
    """One name read by one pattern, from the left; what has failed once is not tried again."""

    def __init__(self, pieces: tuple[_Piece, ...], name: str) -> None:
        self._pieces = pieces
        self._name = name
        self._dead: dict[tuple[int, int], int] = {}

    def ends(self, at: int, start: int) -> list[tuple[int, int]] | None:
        """Where the parameters from piece ``at`` on begin and end, the last one first."""
        name = self._name
        if at == len(self._pieces):
            return [] if start == len(name) else None
        fixed, parameter, kind = self._pieces[at]
        if not name.startswith(fixed, start):
            return None
        start += len(fixed)
        if not parameter:
            return self.ends(at + 1, start)
        furthest = _furthest(name, start, kind)
        # Where one that began at ``dead`` has failed, every end behind that has been tried.
        dead = self._dead.get((at, furthest))
        if dead is not None and start >= dead:
            return None
        for end in _possible(name, start, furthest if dead is None else dead, kind):
            found = self.ends(at + 1, end)
            if found is not None:
                found.append((start, end))
                return found
        self._dead[at, furthest] = start
        return None


def _furthest(name: str, start: int, kind: object) -> int:
    """The last place where a parameter could end: behind the digits, or at the end of the name.

    A truth value has only its own places, so that this says nothing of any other.
    """
    if kind is bool:
        return start
    if kind is int or kind is float:
        found = _DIGITS.match(name, start)
        return found.end() if found else start
    return len(name)


def _possible(name: str, start: int, furthest: int, kind: object) -> Iterator[int]:
    """The ends up to ``furthest`` that a parameter may have, the one that is tried first first."""
    if kind is bool:
        yield from (start + len(word) for word in ("true", "false") if name.startswith(word, start))
    elif kind is int or kind is float:
        if kind is float and furthest > start and name.startswith(".", furthest):
            yield from range(_furthest(name, furthest + 1, kind), furthest + 1, -1)
        yield from range(furthest, start, -1)
    else:
        yield from range(start + 1, furthest + 1)


def read_pattern(text: str, types: Mapping[str, object]) -> Pattern:
    """The pattern a text means; ``types`` gives the types of its parameters, ``str`` by default.

    Raises PluginError where the braces do not close, hold no plain name, or name one twice, and
    where it is no text or too long.
    """
    if type(text) is not str:
        raise PluginError(f"a pattern is of type {type(text).__name__}, not a text")
    if len(text) > LONGEST:
        raise PluginError(f"a pattern has {len(text)} characters, more than {LONGEST}")
    try:
        parsed = list(string.Formatter().parse(text))
    except ValueError as error:
        raise PluginError(f"the pattern {text!r} cannot be read: {error}") from None
    pieces: list[_Piece] = []
    for fixed, name, spec, conversion in parsed:
        pieces.append(_Piece(fixed, name or "", types.get(name, str) if name else str))
        if name is None:
            continue
        if not name.isidentifier() or spec or conversion:
            raise PluginError(f"the pattern {text!r} has {{{name}}}, which is no parameter name")
        if any(name == piece.name for piece in pieces[:-1]):
            raise PluginError(f"the pattern {text!r} names {name!r} twice")
    parameters = tuple(piece.name for piece in pieces if piece.name)
    if len(parameters) > MOST:
        raise PluginError(f"the pattern {text!r} has more than {MOST} parameters")
    return Pattern(text, parameters, sum(len(piece.fixed) for piece in pieces), tuple(pieces))
