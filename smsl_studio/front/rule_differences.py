"""What an SB that rules make has, and the drawing has not, and the other way round."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch

Kind = Literal["missing", "odd", "target"]
"""``missing``: the rules give the operation and the drawing lacks it. ``odd``: no rule gives it.
``target``: it leads to another state."""


@dataclass(frozen=True)
class RuleDifference:
    """One operation that differs. States have their names in the drawing, or, if it lacks them,
    their names by the rules. ``target`` is that of the rules, for an odd operation its own."""

    kind: Kind
    state: str
    operation: str
    target: str


@dataclass(frozen=True)
class RuleComparison:
    """All differences in the order of the rules, and the number of operations that are the same."""

    differences: tuple[RuleDifference, ...]
    same: int


def rule_comparison(ruled: StateBranch, drawn: StateBranch) -> RuleComparison:
    """Compare the SB of the rules with that of the drawing. States are the same if their facts
    are."""
    by_facts = {drawn.facts(name): name for name in drawn.table}
    names = {name: by_facts.get(ruled.facts(name), name) for name in ruled.table}
    found: list[RuleDifference] = []
    same = 0
    for state, operations in ruled.table.items():
        there = drawn.table.get(names[state], {})
        for operation, target in operations.items():
            wanted = names[target]
            if there.get(operation) == wanted:
                same += 1
                continue
            kind: Kind = "target" if operation in there else "missing"
            found.append(RuleDifference(kind, names[state], operation, wanted))
    found.extend(_odd(drawn, {names[state]: set(ops) for state, ops in ruled.table.items()}))
    return RuleComparison(tuple(found), same)


def _odd(drawn: StateBranch, given: dict[str, set[str]]) -> Iterator[RuleDifference]:
    for state, operations in drawn.table.items():
        for operation, target in operations.items():
            if operation not in given.get(state, ()):
                yield RuleDifference("odd", state, operation, target)


def taken(blueprint: Blueprint, branch: str, differences: Iterable[RuleDifference]) -> Blueprint:
    """Return a blueprint whose SB follows the rules in these differences.

    States that it lacks are added. EditRefused as the single edits have it.
    """
    for one in differences:
        at = Address(branch, one.state, one.operation)
        if one.kind == "odd":
            blueprint = editing.delete(blueprint, [at])
            continue
        for end in (one.state, one.target):
            if end not in blueprint[branch].table:
                blueprint = editing.add_state(blueprint, branch, end)
        if one.kind == "target":
            blueprint = editing.retarget(blueprint, at, one.target)
        else:
            blueprint = editing.add_operation(
                blueprint, branch, one.state, one.operation, one.target
            )
    return blueprint
