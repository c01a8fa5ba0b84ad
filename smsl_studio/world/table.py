"""The table world: it keeps the values of facts, and has no bodies and no physics.

Every blueprint runs in it, because an operation only sets the facts of its target. It is fast and
exact, so most tests use it, and it is good for a first look at a procedure.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from types import MappingProxyType

from smsl_studio.blueprint.check import FactKey
from smsl_studio.world.protocol import Shape

NOTHING: Mapping[FactKey, str] = MappingProxyType({})


class TableWorld:
    """A table of facts: ``set_facts`` writes them, ``fact`` reads them. A tick is 0.05 s."""

    tick = 0.05
    hardware = False

    def __init__(self, name: str = "table") -> None:
        self.name = name
        self._facts: dict[FactKey, str] = {}
        self._ticks = 0
        self._befalls: tuple[str, dict[FactKey, str]] = ("", {})
        self._befalls_at = ""

    @property
    def time(self) -> float:
        """Simulated seconds since the world was built."""
        return self._ticks * self.tick

    def set_facts(self, facts: Mapping[FactKey, str]) -> None:
        """Set the values of some facts. The others do not change."""
        self._facts.update(facts)

    def fact(self, branch: str, digit: int) -> str | None:
        """Return the value of a fact. None if the table has no value."""
        return self._facts.get((branch, digit))

    def spoil(self, how: str, facts: Mapping[FactKey, str] = NOTHING, at: str = "") -> None:
        """Set the fault of the next operation, or of the one with the address ``at``. It replaces
        an earlier one. ``""`` means no fault."""
        self._befalls, self._befalls_at = (how, dict(facts)), at

    def befalling(self, edge: str = "") -> tuple[str, Mapping[FactKey, str]]:
        """Return the fault of the operation that begins now, with its facts, and remove it."""
        if self._befalls_at not in ("", edge):
            return "", {}
        found, self._befalls, self._befalls_at = self._befalls, ("", {}), ""
        return found

    def step(self) -> None:
        """Advance the time by one tick. Nothing moves."""
        self._ticks += 1

    def brake(self) -> None:
        """Do nothing: there are no drives to hold."""

    def shapes(self) -> tuple[Shape, ...]:
        """Return no shapes: facts cannot be drawn."""
        return ()

    def poses(self) -> tuple[float, ...]:
        """Return no poses: there are no shapes."""
        return ()

    def status(self) -> Mapping[str, str]:
        """Return no texts: the facts of the run show everything."""
        return {}

    def snapshot(self) -> bytes:
        """Return the time, all facts, and the fault of the next operation."""
        how, facts = self._befalls
        at = [self._befalls_at] if self._befalls_at else []
        return json.dumps([self._ticks, _rows(self._facts), how, _rows(facts), *at]).encode()

    def apply(self, snapshot: bytes) -> None:
        """Go back to the instant of a snapshot."""
        self._ticks, facts, how, befalling, *at = json.loads(snapshot)
        self._befalls_at = at[0] if at else ""
        self._facts, self._befalls = _facts(facts), (how, _facts(befalling))

    def fork(self) -> TableWorld:
        """Return an independent copy that starts at this instant."""
        copy = TableWorld(self.name)
        copy.apply(self.snapshot())
        return copy

    def close(self) -> None:
        """Do nothing: there are no resources to free."""


def _rows(facts: Mapping[FactKey, str]) -> list[list[str | int]]:
    return [[branch, digit, value] for (branch, digit), value in facts.items()]


def _facts(rows: Iterable[tuple[str, int, str]]) -> dict[FactKey, str]:
    return {(branch, digit): value for branch, digit, value in rows}
