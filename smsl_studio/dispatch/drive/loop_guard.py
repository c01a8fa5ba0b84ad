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
        self._visits: dict[str, dict[tuple[str, ...], int]] = {}
        """How often each edge (as text) was begun from each configuration."""

    def why_not(self, configuration: Mapping[str, str], edge: Edge) -> str:
        """Return why an edge must not begin: it was begun too often from here. Empty if it may
        begin.
        """
        begun = self._visits.get(edge.text)
        if begun is None or begun.get(tuple(configuration.values()), 0) < self.most:
            return ""
        here = ", ".join(f"{name}/{state}" for name, state in configuration.items())
        return f"{edge} was begun {self.most} times from {here} without getting further."

    def count(self, configuration: Mapping[str, str], edge: Edge) -> None:
        """Count one beginning of an edge."""
        begun, here = self._visits.setdefault(edge.text, {}), tuple(configuration.values())
        begun[here] = begun.get(here, 0) + 1

    def forget(self) -> None:
        """Set all counts to zero."""
        self._visits.clear()
