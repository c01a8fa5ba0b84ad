"""What edges cost in a run: as declared, as cost functions say, as a person says."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError

MOST = 1e12
"""No edge may cost more, so that the cost of any route is a number too."""


class Prices:
    """The costs that are not the declared ones; what a person says wins over cost functions."""

    def __init__(self, blueprint: Blueprint) -> None:
        self._blueprint = blueprint
        self._said: dict[Address, float] = {}
        self._adaptive: dict[Address, float] = {}
        self.now: Mapping[Address, float] = MappingProxyType({})
        """Every edge that costs something else than declared, for ``Terms.costs``."""

    def of(self, address: Address) -> float:
        """What an edge costs now."""
        found = self.now.get(address)
        return self._declared(address) if found is None else found

    def say(self, address: Address, cost: float) -> Mapping[Address, float]:
        """A person says what an edge costs; what changed. UsageError where that is no cost."""
        if not is_cost(cost):
            raise UsageError(
                f"{cost!r} is no cost of {address}", advice="Give a number from 0 to 1e12."
            )
        self._said[address] = float(cost)
        return self._merge()

    def adapt(self, costs: Mapping[Address, float | None]) -> Mapping[Address, float]:
        """What cost functions say, valid costs all; None leaves the declared one; what changed."""
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
    """Whether a value is a cost: a number from 0 to 1e12, and no truth value."""
    return type(value) in (int, float) and 0 <= value <= MOST  # type: ignore[operator]
