"""The effect of an edge on the facts that sub-SBs expand: rise, fall, mixed, or none."""

from __future__ import annotations

from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.model import StateBranch


def sub_mark(branch: StateBranch, edge: Operation) -> str:
    """Return ``rise``, ``fall`` or ``mixed`` (other facts change too), or the empty text if there
    is no effect.
    """
    if not branch.subs or edge.source not in branch.table or edge.target not in branch.table:
        return ""
    before, after = branch.facts(edge.source), branch.facts(edge.target)
    if len(before) != len(after):
        return ""
    changed = [digit for digit, value in enumerate(before) if value != after[digit]]
    turned = [
        digit
        for digit in changed
        if digit in branch.subs
        and branch.is_on(edge.source, digit) != branch.is_on(edge.target, digit)
    ]
    if not turned:
        return ""
    if len(changed) > 1:
        return "mixed"
    return "rise" if branch.is_on(edge.target, turned[0]) else "fall"
