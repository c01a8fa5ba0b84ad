"""Rules about what leads where: unreachable states, traps, dead ends."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import delete
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.graph.shape import dead_ends, reachable, traps
from smsl_studio.inspection.finding import Finding, Fix, Severity

ERROR, WARNING = Severity.ERROR, Severity.WARNING


def r10_unreachable(blueprint: Blueprint) -> Iterator[Finding]:
    """A state INITIAL cannot reach; a warning where it holds a declared failure value, because
    such a state is entered from outside."""
    for branch in blueprint:
        if branch.initial not in branch.table:
            continue
        inside = reachable(branch, branch.initial)
        for state in branch.table:
            if state in inside:
                continue
            failed = _is_failure(branch, state)
            yield Finding.at(
                blueprint,
                "R10",
                WARNING if failed else ERROR,
                Address(branch.name, state),
                f"no operations lead here from INITIAL, {branch.initial}"
                + ("; it holds a failure value, so it is entered from outside" if failed else ""),
                advice="add an operation that leads here, or delete the state",
                fix=None if failed else _deletion(branch, state, inside),
            )


def _is_failure(branch: StateBranch, state: str) -> bool:
    return any(
        value in note.failure
        for digit, value in enumerate(branch.facts(state))
        if (note := branch.fact_note(digit)) is not None
    )


def _deletion(branch: StateBranch, state: str, inside: frozenset[str]) -> Fix | None:
    """Delete the state, and with it unreachable ones that would become dead ends."""
    doomed = {state}
    grown = True
    while grown:
        more = {
            other
            for other, operations in branch.table.items()
            if other not in inside
            and other not in doomed
            and operations
            and all(target in doomed for target in operations.values())
        }
        grown = bool(more)
        doomed |= more
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
