"""What the state checks of a run compare, for the header of its log. With it a log can be
checked.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from smsl_studio.blueprint.address import fact_text
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint, StateBranch

Json = Any
MOST = 1000
"""The largest number of states and of sensed facts in a header, because it is one line of a log."""


def grounds_of(blueprint: Blueprint, sensed: Iterable[FactKey]) -> Mapping[str, Json]:
    """Return the values that each state needs, the facts that sub-SBs expand, and the ``sensed``
    facts.

    ``states`` has for each SB and state the value of every fact, digit 0 first, and null if a
    sub-SB expands the digit. An SB that would exceed 1,000 states in total is left out. If more
    than 1,000 facts are sensed, none is named. ``subs`` has for each of these SBs and each expanded
    digit the sub-SB, its ACTIVATING and INITIAL, and the states of the SB in which the digit is on.
    """
    states: dict[str, Json] = {}
    subs: dict[str, Json] = {}
    left = MOST
    for branch in blueprint:
        if len(branch.table) <= left:
            left -= len(branch.table)
            states[branch.name] = {state: _values(branch, state) for state in branch.table}
            if branch.subs:
                subs[branch.name] = _expanded(blueprint, branch)
    keys = dict.fromkeys(sensed)
    named = [fact_text(*key) for key in keys] if len(keys) <= MOST else []
    return {"states": states, "subs": subs, "sensed": named}


def _values(branch: StateBranch, state: str) -> list[str | None]:
    subs = branch.subs
    return [None if n in subs else value for n, value in enumerate(branch.facts(state))]


def _expanded(blueprint: Blueprint, branch: StateBranch) -> Mapping[str, Json]:
    """Return the expanded digits of an SB. The keys are texts, because JSON has no others.

    A sub-SB that is not drawn is left out, because no run begins with it.
    """
    drawn = {one.name: one for one in blueprint}
    return {
        str(digit): {
            "sub": sub,
            "activating": drawn[sub].activating,
            "initial": drawn[sub].initial,
            "on": [state for state in branch.table if branch.is_on(state, digit)],
        }
        for digit, sub in branch.subs.items()
        if sub in drawn
    }
