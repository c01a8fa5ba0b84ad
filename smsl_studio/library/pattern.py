"""Name patterns such as ``Op_{disk}{peg}``, and the rule for reading names with them.

The rule gives one result for each name. From the left, an ``int``, ``float`` or ``bool`` takes as
many characters as possible, and a ``str`` as few as possible (at least one), so that the whole name
matches. So ``Op_{disk}{peg}`` with ``disk: int, peg: str`` reads ``Op_12b`` as disk 12 and peg
``b``. ``{{`` and ``}}`` stand for braces.
"""

from __future__ import annotations

import re
import string
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from smsl_studio.errors import PluginError

MOST = 16
"""The largest number of parameters in one pattern."""

LONGEST = 500
"""The largest length of one pattern, in characters."""

_DIGITS = re.compile("[0-9]*")


class _Piece(NamedTuple):
    """Fixed characters, and the parameter behind them. An empty name means no parameter."""

    fixed: str
    name: str
    kind: object


@dataclass(frozen=True, slots=True)
class Pattern:
    """A pattern: its text, its parameters, and the number ``literal`` of its fixed characters."""

    text: str
    parameters: tuple[str, ...]
    literal: int
    _pieces: tuple[_Piece, ...] = field(repr=False)

    def match(self, name: str) -> dict[str, str] | None:
        """Return the text of each parameter in ``name``, or None if the name does not match.

        The time is at most in proportion to the length of the pattern times that of the name.
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
        """Return the name that the pattern gives with these values."""
        return "".join(
            piece.fixed + (str(values[piece.name]) if piece.name else "") for piece in self._pieces
        )


class _PatternMatch:
    """Reads one name with one pattern, from the left. It never tries a failed position again."""

    def __init__(self, pieces: tuple[_Piece, ...], name: str) -> None:
        self._pieces = pieces
        self._name = name
        self._dead: dict[tuple[int, int], int] = {}

    def ends(self, at: int, start: int) -> list[tuple[int, int]] | None:
        """Return begin and end of each parameter from piece ``at`` on, the last parameter first.

        ``start`` is the position in the name. The result is None if the rest does not match.
        """
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
        # A parameter that began at ``dead`` has failed, so every end behind ``dead`` was tried.
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
    """Return the last position where a parameter could end: behind the digits, or at the end of
    the name.

    For a truth value it is ``start``, because its ends depend on nothing but ``start``.
    """
    if kind is bool:
        return start
    if kind is int or kind is float:
        found = _DIGITS.match(name, start)
        return found.end() if found else start
    return len(name)


def _possible(name: str, start: int, furthest: int, kind: object) -> Iterator[int]:
    """Yield the possible ends of a parameter up to ``furthest``, in the order of the attempts."""
    if kind is bool:
        yield from (start + len(word) for word in ("true", "false") if name.startswith(word, start))
    elif kind is int or kind is float:
        if kind is float and furthest > start and name.startswith(".", furthest):
            yield from range(_furthest(name, furthest + 1, kind), furthest + 1, -1)
        yield from range(furthest, start, -1)
    else:
        yield from range(start + 1, furthest + 1)


def read_pattern(text: str, types: Mapping[str, object]) -> Pattern:
    """Read a pattern. ``types`` has the types of its parameters; the default is ``str``.

    PluginError if the value is no text, if it is too long, if a brace is not closed, or if braces
    contain no plain name or the same name twice.
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
