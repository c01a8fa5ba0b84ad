"""The table world: named things with values, and nothing that moves.

Any blueprint runs in it, because an operation is carried out by writing down what its target says.
It is instant, exact and cheap, which is what most tests and most first looks want.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from types import MappingProxyType

from smsl_studio.blueprint.check import FactKey
from smsl_studio.world.protocol import Shape

NOTHING: Mapping[FactKey, str] = MappingProxyType({})


class TableWorld:
    """Facts on a table: ``set_facts`` writes them, ``fact`` reads them; a tick is 0.05 s."""

    tick = 0.05
    hardware = False

    def __init__(self, name: str = "table") -> None:
        self.name = name
        self._facts: dict[FactKey, str] = {}
        self._ticks = 0
        self._befalls: tuple[str, dict[FactKey, str]] = ("", {})

    @property
    def time(self) -> float:
        """Simulated seconds since the world was built."""
        return self._ticks * self.tick

    def set_facts(self, facts: Mapping[FactKey, str]) -> None:
        """Set some facts; the others stay as they are."""
        self._facts.update(facts)

    def fact(self, branch: str, digit: int) -> str | None:
        """The value of a fact, None where the table has none."""
        return self._facts.get((branch, digit))

    def spoil(self, how: str, facts: Mapping[FactKey, str] = NOTHING) -> None:
        """Set the fault of the next operation, in the place of an earlier one; ``""``: none."""
        self._befalls = (how, dict(facts))

    def befalling(self) -> tuple[str, Mapping[FactKey, str]]:
        """The fault of the operation that begins now, with its facts; it is given only once."""
        found, self._befalls = self._befalls, ("", {})
        return found

    def step(self) -> None:
        """Let one tick pass; nothing moves by itself."""
        self._ticks += 1

    def brake(self) -> None:
        """Nothing moves, so nothing has to be held."""

    def shapes(self) -> tuple[Shape, ...]:
        """Empty: facts have no shape."""
        return ()

    def poses(self) -> tuple[float, ...]:
        """Empty: facts have no pose."""
        return ()

    def status(self) -> Mapping[str, str]:
        """Empty: the facts of the run say everything."""
        return {}

    def snapshot(self) -> bytes:
        """The time, every fact, and what befalls the next operation."""
        how, facts = self._befalls
        return json.dumps([self._ticks, _rows(self._facts), how, _rows(facts)]).encode()

    def apply(self, snapshot: bytes) -> None:
        """Come back to the instant of a snapshot."""
        self._ticks, facts, how, befalling = json.loads(snapshot)
        self._facts, self._befalls = _facts(facts), (how, _facts(befalling))

    def fork(self) -> TableWorld:
        """An independent copy that starts at this instant."""
        copy = TableWorld(self.name)
        copy.apply(self.snapshot())
        return copy

    def close(self) -> None:
        """Nothing has to be freed."""


def _rows(facts: Mapping[FactKey, str]) -> list[list[str | int]]:
    return [[branch, digit, value] for (branch, digit), value in facts.items()]


def _facts(rows: Iterable[tuple[str, int, str]]) -> dict[FactKey, str]:
    return {(branch, digit): value for branch, digit, value in rows}
