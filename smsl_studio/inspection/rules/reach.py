"""Rules about what leads where: unreachable states, traps, dead ends."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import partial

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import delete
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.graph.shape import dead_ends, reachable, traps
from smsl_studio.inspection.finding import LISTED, Finding, Fix, Severity

ERROR, WARNING = Severity.ERROR, Severity.WARNING


def r10_unreachable(blueprint: Blueprint) -> Iterator[Finding]:
    """A state INITIAL cannot reach; a warning where it holds a declared failure value, because
    such a state is entered from outside."""
    for branch in blueprint:
        if branch.initial not in branch.table:
            continue
        inside = reachable(branch, branch.initial)
        outside = [state for state in branch.table if state not in inside]
        sources = _sources(branch, outside)
        for number, state in enumerate(outside):
            failed = _is_failure(branch, state)
            yield Finding.at(
                blueprint,
                "R10",
                WARNING if failed else ERROR,
                Address(branch.name, state),
                f"no operations lead here from INITIAL, {branch.initial}"
                + ("; it holds a failure value, so it is entered from outside" if failed else ""),
                advice="add an operation that leads here, or delete the state",
                fix=None if failed or number >= LISTED else _deletion(branch, state, sources),
            )


def _is_failure(branch: StateBranch, state: str) -> bool:
    return any(
        value in note.failure
        for digit, value in enumerate(branch.facts(state))
        if (note := branch.fact_note(digit)) is not None
    )


def _sources(branch: StateBranch, states: Iterable[str]) -> Mapping[str, list[str]]:
    """For each state, which of some states lead to it: one as often as it has operations there."""
    sources: dict[str, list[str]] = {}
    for state in states:
        for target in branch.table[state].values():
            sources.setdefault(target, []).append(state)
    return sources


def _deletion(branch: StateBranch, state: str, sources: Mapping[str, list[str]]) -> Fix | None:
    """Delete the state, and with it unreachable ones that would become dead ends."""
    doomed, waiting = {state}, [state]
    left: dict[str, int] = {}
    while waiting:
        for other in sources.get(waiting.pop(), ()):
            left[other] = left.get(other, len(branch.table[other])) - 1
            if not left[other] and other not in doomed:
                doomed.add(other)
                waiting.append(other)
    if branch.activating in doomed or any(_is_failure(branch, other) for other in doomed):
        return None
    addresses = tuple(Address(branch.name, name) for name in branch.table if name in doomed)
    words = f"Delete {state}" if len(doomed) == 1 else f"Delete {len(doomed)} states"
    return Fix(words, partial(delete, addresses=addresses))


def r11_traps(blueprint: Blueprint) -> Iterator[Finding]:
    """A trap: reachable, and no path to ACTIVATING. A state that nothing leaves is R12's."""
    for branch in blueprint:
        if not {branch.initial, branch.activating} <= set(branch.table):
            continue
        for state in traps(branch, branch.initial, branch.activating):
            if branch.table[state]:
                yield Finding.at(
                    blueprint,
                    "R11",
                    ERROR,
                    Address(branch.name, state),
                    f"nothing leads from here to ACTIVATING, {branch.activating}",
                    advice="add an operation that leads out of the trap",
                )


def r12_dead_ends(blueprint: Blueprint) -> Iterator[Finding]:
    """A dead end that is not ACTIVATING."""
    for branch in blueprint:
        for state in dead_ends(branch):
            if state != branch.activating:
                yield Finding.at(
                    blueprint,
                    "R12",
                    ERROR,
                    Address(branch.name, state),
                    "no operation leads out of here, and it is not ACTIVATING",
                    advice="add an operation, or make it the ACTIVATING state",
                )
