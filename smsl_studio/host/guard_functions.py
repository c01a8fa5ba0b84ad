"""Guards of plugins: whether an operation can be used now, asked before anything moves."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.host.brief import words_of
from smsl_studio.library.bound import BoundOperation

LONGEST = 300
"""The greatest length of a reason (characters); more is cut."""


class GuardFunctions:
    """The guards bound to edges, and their last answers."""

    def __init__(self, bound: Mapping[Address, BoundOperation]) -> None:
        self._bound = {edge: one for edge, one in bound.items() if one.available is not None}
        self._said: dict[Address, str] = {}

    def __bool__(self) -> bool:
        """Return whether any edge has a guard."""
        return bool(self._bound)

    def add(self, edge: Address, bound: BoundOperation) -> None:
        """Ask about one more edge, which has a guard."""
        self._bound[edge] = bound

    def ask(self, subject: Any) -> dict[Address, str]:
        """Ask every guard about the world ``subject``. Return the reasons that have changed since
        the last call; an empty one opens the edge."""
        changed: dict[Address, str] = {}
        for edge, bound in self._bound.items():
            reason = refusal(bound, subject)
            if self._said.get(edge, "") != reason:
                self._said[edge] = changed[edge] = reason
        return changed


def refusal(bound: BoundOperation, subject: Any) -> str:
    """Return why an operation cannot be used now, or the empty text. A guard that raises an error,
    or returns no text, is a reason, too."""
    if bound.available is None:
        return ""
    try:
        found = bound.available.why_not(subject, **bound.arguments)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # SystemExit, and what compiled libraries raise
        found = f"its guard raised an error: {words_of(error, bound.location)}"
    if type(found) is not str:
        found = f"its guard says {type(found).__name__!r}, which is no text"
    return " ".join("".join(c if c.isprintable() else " " for c in found).split())[:LONGEST]
