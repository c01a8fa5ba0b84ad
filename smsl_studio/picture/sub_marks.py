"""The effect of an edge on the facts that sub-SBs expand: rise, fall, mixed, or none."""

from __future__ import annotations

from collections.abc import Container

from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.model import StateBranch


def mark_words(branch: StateBranch, kinds: Container[str]) -> dict[str, str]:
    """Return what the marks of these kinds mean, in the order of a legend.

    With one sub-SB its fact is named, by the first of them.
    """
    subs = list(branch.subs)
    name = f"“{branch.fact_name(subs[0])}”" if len(subs) == 1 else "a sub-SB's fact"
    said = {
        "rise": "turns {} on",
        "fall": "turns {} off",
        "mixed": "changes {} together with others",
    }
    shown = {kind: words for kind, words in said.items() if kind in kinds}
    later = "it" if len(subs) == 1 else name
    names = [name, *[later] * (len(shown) - 1)]
    return {
        kind: words.format(one) for (kind, words), one in zip(shown.items(), names, strict=False)
    }


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
