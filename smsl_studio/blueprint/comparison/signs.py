"""The signs of a difference: the marks of changed elements on each side."""

from __future__ import annotations

from dataclasses import dataclass, field

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison.difference import ChangeKind, Difference
from smsl_studio.blueprint.model import Blueprint

ADDED, REMOVED, CHANGED = "+", "-", "~"


def sign_of(kind: ChangeKind) -> str:
    """Return the sign of one kind of change."""
    return {ChangeKind.ADDED: ADDED, ChangeKind.REMOVED: REMOVED}.get(kind, CHANGED)


@dataclass
class Signs:
    """The signs ``+``, ``-`` and ``~`` of one side's SBs, states and operations, by address."""

    by_address: dict[Address, str] = field(default_factory=dict)

    def of(self, address: Address) -> str:
        """Return the sign of an element, or the empty text if it did not change."""
        return self.by_address.get(address, "")

    def add(self, address: Address, sign: str, blueprint: Blueprint) -> None:
        """Mark an element. If it was added or removed, mark everything in it too."""
        # An element that was added or removed keeps this sign, even if another change names it.
        if self.by_address.get(address) in (ADDED, REMOVED):
            return
        self.by_address[address] = sign
        if sign == CHANGED or address.operation:
            return
        branch = blueprint[address.branch]
        states = [address.state] if address.state else list(branch.table)
        for state in states:
            self.by_address[Address(branch.name, state)] = sign
            for operation in branch.table[state]:
                self.by_address[Address(branch.name, state, operation)] = sign


def signs_of(difference: Difference) -> tuple[Signs, Signs]:
    """Return the signs of the earlier and of the later side."""
    before, after = Signs(), Signs()
    for change in difference.changes:
        whole = change.what in ("branch", "state", "operation")
        sign = sign_of(change.kind) if whole else CHANGED
        if change.before is not None:
            before.add(change.before, sign, difference.before)
        if change.after is not None:
            after.add(change.after, sign, difference.after)
    return before, after
