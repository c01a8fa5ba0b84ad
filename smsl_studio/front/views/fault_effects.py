"""Whether a chosen fault changes anything, as far as this is known before its moment."""

from __future__ import annotations

from collections.abc import Collection

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.front.views.fault_choices import (
    AFTER,
    DISTURB,
    ELSEWHERE,
    NOW,
    SET,
    STUCK,
    FaultChoice,
)
from smsl_studio.front.views.states import short_name

RIGHT = "none"
"""The disturbance that ends all disturbances of a fact."""


def value_then(
    key: FactKey, choice: FaultChoice, status: DispatchStatus, blueprint: Blueprint
) -> str | None:
    """Return the value that a fact will have at the moment of a choice; None if it is not known."""
    edge, then = choice.operation, None
    if choice.moment == NOW:
        reading = status.scene.get(*key)
        return reading.value if reading is not None else None
    if edge is not None and edge.branch == key[0]:
        after = choice.moment == AFTER
        then = blueprint[edge.branch].table[edge.state][edge.operation] if after else edge.state
    return blueprint[key[0]].facts(then)[key[1]] if then is not None else None


def idle_words(
    choice: FaultChoice,
    status: DispatchStatus,
    blueprint: Blueprint,
    disturbed: Collection[FactKey],
) -> str:
    """Return why a choice would change nothing, or the empty text.

    ``disturbed`` are the facts that are read wrongly now, or will be at a moment that is waited
    for.
    """
    kind = choice.given.get("kind") or choice.given.get("fault")
    key = split_fact(str(choice.given.get("target") or choice.given.get("fact") or ""))
    if key is not None and choice.do == DISTURB and kind == RIGHT:
        return "" if key in disturbed else f"{_named(key, blueprint)} is read rightly already"
    if key is not None and kind == SET and key not in disturbed:
        value = value_then(key, choice, status, blueprint)
        if value is not None and value == choice.given.get("value"):
            when = "already" if choice.moment == NOW else "then already"
            return f"{_named(key, blueprint)} is {value} {when}: choose another value"
    edge = _befallen(choice, status)
    if kind == ELSEWHERE and edge is not None:
        branch = blueprint[edge.branch]
        target = branch.table[edge.state][edge.operation]
        if choice.given.get("state") == str(Address(edge.branch, target)):
            ends = short_name(branch, target)
            return f"{edge.operation} ends in {ends} anyway: choose another state"
    return ""


def later_words(choice: FaultChoice, status: DispatchStatus, blueprint: Blueprint) -> str:
    """Return that a wrong value shows only when the fact changes, or the empty text."""
    key = split_fact(str(choice.given.get("target") or ""))
    if key is None or choice.given.get("kind") != STUCK:
        return ""
    value = value_then(key, choice, status, blueprint)
    if value is None or value != choice.given.get("value"):
        return ""
    return f"{_named(key, blueprint)} is {value} then, so this shows only when it changes"


def _befallen(choice: FaultChoice, status: DispatchStatus) -> Address | None:
    """Return the operation that a fault of an operation befalls, None if it is not known."""
    if choice.moment == NOW:
        return status.running or next(iter(status.route), None)
    return choice.operation if choice.moment != AFTER else None


def _named(key: FactKey, blueprint: Blueprint) -> str:
    branch = blueprint[key[0]]
    name = branch.fact_name(key[1])
    return f"{branch.name} {name}" if len(blueprint) > 1 else name
