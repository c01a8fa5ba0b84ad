"""Name patterns such as ``Op_{disk}{peg}``, and the one way they are read.

Reading is unambiguous: from the left, an ``int``, ``float`` or ``bool`` takes as many characters as
it can, a ``str`` as few as it can (at least one), under the condition that the whole name matches.
So ``Op_{disk}{peg}`` with ``disk: int, peg: str`` reads ``Op_12b`` as disk 12 and peg ``b``.
``{{`` and ``}}`` stand for braces.
"""

from __future__ import annotations

import re
import string
from collections.abc import Mapping
from dataclasses import dataclass, field

from smsl_studio.errors import PluginError

_TEXT_OF = {
    int: r"[0-9]+",
    float: r"[0-9]+(?:\.[0-9]+)?",
    bool: r"true|false",
}


@dataclass(frozen=True, slots=True)
class Pattern:
    """A pattern: its text, the parameters in it, and how many of its characters are fixed."""

    text: str
    parameters: tuple[str, ...]
    literal: int
    _pieces: tuple[tuple[str, str], ...] = field(repr=False)
    _regex: re.Pattern[str] = field(repr=False, compare=False)

    def match(self, name: str) -> dict[str, str] | None:
        """The text each parameter has in ``name``, or None where the name does not fit."""
        found = self._regex.fullmatch(name)
        return None if found is None else found.groupdict()

    def fill(self, values: Mapping[str, object]) -> str:
        """The name that has these values."""
        return "".join(fixed + (str(values[name]) if name else "") for fixed, name in self._pieces)


def read_pattern(text: str, types: Mapping[str, object]) -> Pattern:
    """The pattern a text means; ``types`` gives the types of its parameters, ``str`` by default.

    Raises PluginError where the braces do not close, hold no plain name, or name one twice.
    """
    try:
        parsed = list(string.Formatter().parse(text))
    except ValueError as error:
        raise PluginError(f"the pattern {text!r} cannot be read: {error}") from None
    pieces: list[tuple[str, str]] = []
    regex, literal = "", 0
    for fixed, name, spec, conversion in parsed:
        regex += re.escape(fixed)
        literal += len(fixed)
        pieces.append((fixed, name or ""))
        if name is None:
            continue
        if not name.isidentifier() or spec or conversion:
            raise PluginError(f"the pattern {text!r} has {{{name}}}, which is no parameter name")
        if any(name == known for _, known in pieces[:-1]):
            raise PluginError(f"the pattern {text!r} names {name!r} twice")
        kind = types.get(name, str)
        regex += f"(?P<{name}>{_TEXT_OF.get(kind, '.+?')})"  # type: ignore[call-overload]
    parameters = tuple(name for _, name in pieces if name)
    return Pattern(text, parameters, literal, tuple(pieces), re.compile(regex, re.DOTALL))
