"""Both sides of a comparison, and the names that elements of one have on the other."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from smsl_studio.blueprint.address import Address, fact_text, split_fact
from smsl_studio.blueprint.comparison.difference import Change
from smsl_studio.blueprint.model import Blueprint, StateBranch


@dataclass
class Sides:
    """The two blueprints, the renamings found between them, and the changes written so far."""

    before: Blueprint
    after: Blueprint
    branches: Mapping[str, str]
    changes: list[Change] = field(default_factory=list)

    def fact(self, text: str) -> str:
        """The name on the later side of a fact of the earlier one."""
        found = split_fact(text)
        if found is None or found[0] not in self.branches:
            return text
        return fact_text(self.branches[found[0]], found[1])

    def branch(self, name: str) -> str:
        """The name on the later side of an SB of the earlier one."""
        return _renamed(name, self.branches, self._given)

    @cached_property
    def _given(self) -> frozenset[str]:
        return frozenset(self.branches.values()) - self.before.branches.keys()


def _renamed(name: str, names: Mapping[str, str], given: Collection[str]) -> str:
    """The name that an element of the earlier side has on the later one.

    A name that only a renamed element has on the later side names nothing on the earlier one. It
    gets a null character, so that it is equal to no name of the later side.
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
    """For (state, operation) of the earlier side, the new name of an operation renamed there."""

    def state(self, name: str) -> str:
        """The name on the later side of a state of the earlier one; also for a name that is no
        state."""
        return _renamed(name, self.states, self._given)

    @cached_property
    def _given(self) -> frozenset[str]:
        return frozenset(self.states.values()) - self.before.table.keys()

    def address_before(self, state: str = "", operation: str = "") -> Address:
        """An address in the SB of the earlier side; without names that of the SB itself."""
        return Address(self.before.name, state, operation)

    def address_after(self, state: str = "", operation: str = "") -> Address:
        """An address in the SB of the later side; without names that of the SB itself."""
        return Address(self.after.name, state, operation)

    def add(self, change: Change) -> None:
        """Append a change to those found so far."""
        self.sides.changes.append(change)
