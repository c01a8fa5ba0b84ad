"""Identifiers for programs that allow fewer characters in names than SMSL does."""

from __future__ import annotations

import re

from smsl_studio.blueprint.names import FreeNames

_FOREIGN = re.compile(r"[^A-Za-z0-9_]+")
LONGEST = 60


class Identifiers:
    """Identifiers of ASCII letters, digits and ``_``, each used once. They begin with a letter."""

    def __init__(self, reserved: tuple[str, ...] = ()) -> None:
        self._free = FreeNames(reserved)

    def of(self, name: str, letter: str = "s") -> str:
        """Return a new identifier that is similar to a name. ``letter`` stands before one that
        would begin with another character."""
        plain = _FOREIGN.sub("_", name)[:LONGEST].strip("_")
        if not plain or not plain[0].isalpha():
            plain = f"{letter}{plain}"
        return self._free.take(plain)
