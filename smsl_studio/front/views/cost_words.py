"""The cost of an operation in words."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.inspection.rules.idle_fields import moved_sub


def cost_words(branch: StateBranch, address: Address, cost: float) -> str:
    """Return the cost with one decimal. It is empty if the operation only moves a sub-SB: then the
    operations of the sub-SB have a cost, and this one has none."""
    moves = moved_sub(branch, branch.operation(address.state, address.operation))
    return "" if moves else f"{cost:.1f}"
