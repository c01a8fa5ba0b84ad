"""The loop guard: it stops a run that begins the same edge from the same configuration
repeatedly.
"""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.edges import Edge

VISITS = 3
"""How often the automatic route may begin one edge from one configuration."""
REPEATS = 100
"""How often a script may ask for the same edge from one configuration."""


class LoopGuard:
    """Counts the beginnings of edges. The counts are dropped if a person decides or a goal is
    reached.
    """

    def __init__(self, most: int = VISITS) -> None:
        self.most = most
        self._visits: dict[tuple[str, ...], int] = {}
        """How often each edge (last, as text) was begun from each configuration."""

    def why_not(self, configuration: Mapping[str, str], edge: Edge) -> str:
        """Return why an edge must not begin: it was begun too often from here. Empty if it may
        begin.
        """
        if self._visits.get((*configuration.values(), edge.text), 0) < self.most:
            return ""
        here = ", ".join(f"{name}/{state}" for name, state in configuration.items())
        return f"{edge} was begun {self.most} times from {here} without getting further."

    def count(self, configuration: Mapping[str, str], edge: Edge) -> None:
        """Count one beginning of an edge."""
        key = (*configuration.values(), edge.text)
        self._visits[key] = self._visits.get(key, 0) + 1

    def forget(self) -> None:
        """Set all counts to zero."""
        self._visits.clear()
