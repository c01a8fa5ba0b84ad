"""The loop guard: the same edge from the same configuration, again and again, gets nowhere."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.edges import Edge

VISITS = 3
"""So often the automatic route may begin one edge from one configuration."""
REPEATS = 100
"""So often a script may ask for one that it asks for every time."""


class LoopGuard:
    """Counts what the automatic route begins; forgets it where a person decides, or a goal is
    reached."""

    def __init__(self, most: int = VISITS) -> None:
        self.most = most
        self._visits: dict[tuple[tuple[str, ...], str], int] = {}

    def why_not(self, configuration: Mapping[str, str], edge: Edge) -> str:
        """Why an edge must not begin: it was begun too often from here. Empty where it may."""
        if self._visits.get(_key(configuration, edge), 0) < self.most:
            return ""
        here = ", ".join(f"{name}/{state}" for name, state in configuration.items())
        return f"{edge} was begun {self.most} times from {here} without getting further."

    def count(self, configuration: Mapping[str, str], edge: Edge) -> None:
        """An edge begins."""
        key = _key(configuration, edge)
        self._visits[key] = self._visits.get(key, 0) + 1

    def forget(self) -> None:
        """Count from zero again."""
        self._visits.clear()


def _key(configuration: Mapping[str, str], edge: Edge) -> tuple[tuple[str, ...], str]:
    return tuple(configuration.values()), str(edge)
