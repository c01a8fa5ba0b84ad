"""What rules give as one picture, with what the last change took away and what no rule gives."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison.signs import ADDED, REMOVED
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import HEADER, read_blueprint
from smsl_studio.front.rule_differences import RuleDifference
from smsl_studio.smsl.json_form import parse_json, write_json

Json = Any
Edge = tuple[str, str, str]
MOST_GHOSTS = 2_000
"""With more operations than these, what the last change took away is only counted."""


@dataclass(frozen=True)
class RulePreview:
    """``blueprint`` has the SB of the rules, the ghosts, and the odd operations of the drawing.
    ``changes`` has the sign of what the last change brought (+) and took away (-). ``drawn`` has
    the address in the picture of each difference that can be shown there."""

    blueprint: Blueprint
    changes: Mapping[Address, str] = field(default_factory=dict)
    drawn: Mapping[RuleDifference, Address] = field(default_factory=dict)


def rule_preview(
    made: Blueprint,
    branch: StateBranch,
    before: StateBranch | None,
    drawing: StateBranch | None,
    differences: Iterable[RuleDifference],
) -> RulePreview:
    """Return the picture of ``branch``, which rules made in ``made``.

    ``before`` is what the text gave before its last change, ``drawing`` the SB that the
    ``differences`` are about.
    """
    table = {state: dict(own) for state, own in branch.table.items()}
    changes: dict[Address, str] = {}
    if before is not None and before.name == branch.name:
        changes = _changes(branch, before)
        for address, sign in changes.items():
            if sign == REMOVED:
                own = table.setdefault(address.state, {})
                if address.operation:
                    own.setdefault(
                        address.operation, before.table[address.state][address.operation]
                    )
    drawn: dict[RuleDifference, Address] = {}
    if drawing is not None:
        facts = {branch.facts(state): state for state in branch.table}
        names = {state: facts.get(drawing.facts(state), "") for state in drawing.table}
        for one in differences:
            source, target = names.get(one.state, one.state), names.get(one.target, one.target)
            if source not in table or target not in table:
                continue
            if one.kind == "odd" and table[source].setdefault(one.operation, target) != target:
                continue
            drawn[one] = Address(branch.name, source, one.operation)
    if table == {state: dict(own) for state, own in branch.table.items()}:
        return RulePreview(made, changes, drawn)
    return RulePreview(_with_table(made, branch, table), changes, drawn)


def _changes(after: StateBranch, before: StateBranch) -> dict[Address, str]:
    """Return the signs of the states and operations that only one of two versions has."""
    now, then = set(_edges(after)), set(_edges(before))
    if len(now ^ then) > MOST_GHOSTS:
        return {}
    signs: dict[Address, str] = {}
    for sign, version, other in ((ADDED, after, before), (REMOVED, before, after)):
        edges = (now - then) if sign == ADDED else (then - now)
        for state in version.table:
            if state not in other.table:
                signs[Address(after.name, state)] = sign
        for state, operation, _ in _edges(version):
            here = Address(after.name, state, operation)
            if (state, operation, version.table[state][operation]) in edges and here not in signs:
                signs[here] = sign
    return signs


def _edges(branch: StateBranch) -> Iterable[Edge]:
    for state, own in branch.table.items():
        for operation, target in own.items():
            yield state, operation, target


def _with_table(made: Blueprint, branch: StateBranch, table: Mapping[str, Json]) -> Blueprint:
    """Return a blueprint with this SB alone and another table. A ghost may lead to a ghost."""
    inner = made.document.values[branch.name]
    ends = {target for own in table.values() for target in own.values()}
    states = {**table, **{end: {} for end in ends if end not in table}}
    kept = {key: value for key, value in inner.items() if key.startswith("_")}
    header = {key: value for key, value in inner[HEADER].items() if key != "NUM_STATES"}
    values = {branch.name: {HEADER: header, **kept, **states}}
    return read_blueprint(parse_json(write_json(values), made.file))
