"""Reads the functions and costs of operations from the header of a log.

If the header leaves something out, nothing is known about it, and it is not checked.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from smsl_studio.blueprint.address import note_key

Json = Any
USUAL = 1.0
"""The cost of an operation for which no cost is written."""


class KnownOperations:
    """The functions and costs in a header, and later changes of costs.

    ``priced`` says whether cost functions may change costs. None means that this is not known.
    """

    def __init__(self, grounds: Json) -> None:
        said = grounds if isinstance(grounds, dict) else {}
        self._functions, self._costs = _tables(said.get("functions")), _tables(said.get("costs"))
        self.priced = said["priced"] if isinstance(said.get("priced"), bool) else None
        self._changed: dict[str, float] = {}
        self._made: dict[tuple[str, str, str], str] = {}

    def function(self, branch: str, state: str, operation: str) -> str | None:
        """Return the name of the function that an operation runs, empty if it runs none.

        None if the header does not say.
        """
        made = self._made.get((branch, state, operation))
        table = self._functions.get(branch)
        if made is not None or table is None:
            return made
        found = _entry(table, state, operation, "")
        return found if isinstance(found, str) else None

    def make(self, edge: tuple[str, str, str], function: str) -> None:
        """Remember an edge that was generated, and its function."""
        self._made[edge] = function

    def made(self, edge: tuple[str, ...]) -> bool:
        """Return whether an edge was generated."""
        return edge in self._made

    def reprice(self, costs: Mapping[str, float]) -> None:
        """Remember new costs of operations."""
        self._changed.update(costs)

    def cost(self, operations: Iterable[tuple[str, tuple[str, ...]]]) -> float | None:
        """Return the total cost of some operations. None if the header does not say.

        Each operation is an address and its three names.
        """
        total = 0.0
        for address, (branch, state, operation) in operations:
            table = self._costs.get(branch)
            if table is None:
                return None
            found: float | None = _entry(table, state, operation, USUAL)
            if found is not None:
                changed = self._changed.get(address)
                total += found if changed is None else changed
        return total


def _tables(said: Json) -> dict[str, Mapping[str, Json]]:
    """Return the tables of SBs.

    Values of a wrong type are left out here; another check reports them.
    """
    pairs = said.items() if isinstance(said, dict) else ()
    return {branch: table for branch, table in pairs if isinstance(table, dict)}


def _entry(table: Mapping[str, Json], state: str, operation: str, usual: Json) -> Json:
    by_name = note_key(operation)
    return table[by_name] if by_name in table else table.get(note_key(operation, state), usual)
