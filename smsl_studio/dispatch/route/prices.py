"""The costs of edges in a run: declared, from cost functions, or set by a person."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError

MOST = 1e12
"""The highest cost of an edge, so that the cost of any route is a finite number."""


class Prices:
    """The costs that are not the declared ones. A person's cost counts before that of a cost
    function.
    """

    def __init__(self, blueprint: Blueprint) -> None:
        self._blueprint = blueprint
        self._said: dict[Address, float] = {}
        self._adaptive: dict[Address, float] = {}
        self.now: Mapping[Address, float] = MappingProxyType({})
        """Every edge with another cost than the declared one, for ``Terms.costs``."""

    def follow(self, blueprint: Blueprint) -> None:
        """Take declared costs from another blueprint, which has one more edge."""
        self._blueprint = blueprint

    def of(self, address: Address) -> float:
        """Return the present cost of an edge."""
        found = self.now.get(address)
        return self._declared(address) if found is None else found

    def say(self, address: Address, cost: float) -> Mapping[Address, float]:
        """Set the cost of an edge for a person. Return the changed costs. UsageError if it is no
        valid cost.
        """
        if not is_cost(cost):
            raise UsageError(
                f"{cost!r} is no cost of {address}", advice="Give a number from 0 to 1e12."
            )
        self._said[address] = float(cost)
        return self._merge()

    def adapt(self, costs: Mapping[Address, float | None]) -> Mapping[Address, float]:
        """Set valid costs from cost functions; None means the declared cost. Return the changed
        costs.
        """
        for address, cost in costs.items():
            if cost is None:
                self._adaptive.pop(address, None)
            else:
                self._adaptive[address] = float(cost)
        return self._merge()

    def _merge(self) -> Mapping[Address, float]:
        before = self.now
        merged = {**self._adaptive, **self._said}
        self.now = {a: c for a, c in merged.items() if c != self._declared(a)}
        found = {
            address: self.of(address)
            for address in dict.fromkeys((*before, *self.now))
            if before.get(address) != self.now.get(address)
        }
        return dict(sorted(found.items(), key=lambda one: str(one[0])))

    def _declared(self, address: Address) -> float:
        return self._blueprint[address.branch].cost(address.state, address.operation)


def is_cost(value: object) -> bool:
    """Return whether a value is a cost: a number from 0 to 1e12, and not a truth value."""
    return type(value) in (int, float) and 0 <= value <= MOST  # type: ignore[operator]
