"""What a run's state checks rest on: in its log's header, so that a log can be held against it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from smsl_studio.blueprint.address import fact_text
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint, StateBranch

Json = Any
MOST = 1000
"""So many states, and so many sensed facts, stand in a header: it is one line of a log."""


def grounds_of(blueprint: Blueprint, sensed: Iterable[FactKey]) -> Mapping[str, Json]:
    """What each state wants of its facts, which ``subs`` expand which, and which are ``sensed``.

    ``states`` has for each SB and state the value of every fact, digit 0 first, null where a
    sub-SB expands the digit. An SB with which there would be more than 1,000 states is left out
    whole; of more than 1,000 sensed facts none is named. ``subs`` has for each of these SBs and
    each digit that is expanded the sub-SB, its ACTIVATING and INITIAL, and the states of the SB
    where the digit is on.
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
    """By digit, as text: a JSON object has no other keys. A sub-SB that is not drawn is left out:
    no run begins with it."""
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
