"""The loop guard: it stops a run that begins the same edge from the same place again and again."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

from .elements import Edge

VISITS = 3
"""How often the route may begin one edge from one configuration."""
REPEATS = 100
"""How often a script may ask for the same."""


class LoopGuard:
    """Counts how often edges were begun. The counts are dropped when a person decides or a goal is
    reached.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._begun: Counter[tuple[str, tuple[str, ...]]] = Counter()

    def why_not(self, configuration: Mapping[str, str], edge: Edge) -> str:
        """Return why an edge must not begin, or the empty text."""
        if self._begun[edge.address, tuple(configuration.values())] < self._most:
            return ""
        here = ", ".join(f"{name}/{state}" for name, state in configuration.items())
        return f"{edge} was begun {self._most} times from {here} without getting further."

    def count(self, configuration: Mapping[str, str], edge: Edge) -> None:
        """Count one begin."""
        self._begun[edge.address, tuple(configuration.values())] += 1

    def forget(self) -> None:
        """Set all counts to zero."""
        self._begun.clear()
