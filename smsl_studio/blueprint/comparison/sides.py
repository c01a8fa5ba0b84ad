"""Both sides of a comparison, and the names of elements on the other side."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from smsl_studio.blueprint.address import Address, fact_text, split_fact
from smsl_studio.blueprint.comparison.difference import Change
from smsl_studio.blueprint.model import Blueprint, StateBranch


@dataclass
class Sides:
    """The two blueprints, the renamed SBs, and the changes so far."""

    before: Blueprint
    after: Blueprint
    branches: Mapping[str, str]
    changes: list[Change] = field(default_factory=list)

    def fact(self, text: str) -> str:
        """Return the later name of a fact of the earlier side."""
        found = split_fact(text)
        if found is None or found[0] not in self.branches:
            return text
        return fact_text(self.branches[found[0]], found[1])

    def branch(self, name: str) -> str:
        """Return the later name of an SB of the earlier side."""
        return _renamed(name, self.branches, self._given)

    @cached_property
    def _given(self) -> frozenset[str]:
        return frozenset(self.branches.values()) - self.before.branches.keys()


def _renamed(name: str, names: Mapping[str, str], given: Collection[str]) -> str:
    """Return the later name of an element of the earlier side.

    A name that only a renamed element has on the later side names nothing on the earlier one. It
    gets a null character, so that it equals no name of the later side.
    """
    return f"{name}\0" if name in given else names.get(name, name)


@dataclass
class BranchSides:
    """One SB on both sides. ``states`` has the new name of every state that was renamed."""

    sides: Sides
    before: StateBranch
    after: StateBranch
    states: Mapping[str, str]
    operations: dict[tuple[str, str], str] = field(default_factory=dict)
    """For (state, operation) of the earlier side, the new name of a renamed operation."""

    def state(self, name: str) -> str:
        """Return the later name of a state of the earlier side. The name need not be a state."""
        return _renamed(name, self.states, self._given)

    @cached_property
    def _given(self) -> frozenset[str]:
        return frozenset(self.states.values()) - self.before.table.keys()

    def address_before(self, state: str = "", operation: str = "") -> Address:
        """Return an address in the SB of the earlier side, that of the SB itself without names."""
        return Address(self.before.name, state, operation)

    def address_after(self, state: str = "", operation: str = "") -> Address:
        """Return an address in the SB of the later side, that of the SB itself without names."""
        return Address(self.after.name, state, operation)

    def add(self, change: Change) -> None:
        """Add a change."""
        self.sides.changes.append(change)
