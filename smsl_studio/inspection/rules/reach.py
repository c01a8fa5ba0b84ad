"""Rules about reachability: unreachable states, traps, dead ends (R10 to R12).

One missing operation may cut off many states. States that are connected to each other share one
finding.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.graph.shape import connected, dead_ends, reachable, traps
from smsl_studio.inspection.rules.finding import Fix, Remark, Severity, edit

ERROR, WARNING = Severity.ERROR, Severity.WARNING


def r10_unreachable(blueprint: Blueprint) -> Iterator[Remark]:
    """R10: states that cannot be reached from INITIAL.

    A state with a declared failure value gets only a warning, because no operation leads there on
    purpose (paper, Failure Mode Handling).
    """
    for branch in blueprint:
        if branch.initial not in branch.table:
            continue
        inside, failing = reachable(branch, branch.initial), failing_states(branch)
        outside = [state for state in branch.table if state not in inside]
        words = f"no operations lead here from INITIAL, {branch.initial}"
        for part in connected(branch, outside):
            failed = [state for state in part if state in failing]
            if failed:
                why = f"{words}; it holds a failure value, so it is entered from outside"
                first, more = _addresses(branch, failed)
                yield Remark("R10", WARNING, first, why, _LEAD_HERE, others=more)
            others = [state for state in part if state not in set(failed)] if failed else part
            if others:
                fix = None if failed or branch.activating in part else _deletion(branch, part)
                first, more = _addresses(branch, others)
                yield Remark("R10", ERROR, first, words, _LEAD_HERE, fix, others=more)


_LEAD_HERE = "add an operation that leads here, or delete the state"


def _addresses(branch: StateBranch, states: Sequence[str]) -> tuple[Address, list[Address]]:
    """Return the address of the first state, and the addresses of the others."""
    first, *others = (Address(branch.name, state) for state in states)
    return first, others


def _deletion(branch: StateBranch, states: Sequence[str]) -> Fix:
    """Return a fix that deletes connected states together, so that none becomes a dead end."""
    addresses = tuple(Address(branch.name, state) for state in states)
    words = f"Delete {states[0]}" if len(states) == 1 else f"Delete {len(states):,} states"
    return Fix(words, edit("delete", addresses=addresses))


def r11_traps(blueprint: Blueprint) -> Iterator[Remark]:
    """R11: reachable states without a path to ACTIVATING. R12 reports states without operations."""
    for branch in blueprint:
        if not {branch.initial, branch.activating} <= branch.table.keys():
            continue
        found = traps(branch, branch.initial, branch.activating)
        for part in connected(branch, [state for state in found if branch.table[state]]):
            first, more = _addresses(branch, part)
            yield Remark(
                "R11",
                ERROR,
                first,
                f"nothing leads from here to ACTIVATING, {branch.activating}",
                "add an operation that leads out of the trap",
                others=more,
            )


def r12_dead_ends(blueprint: Blueprint) -> Iterator[Remark]:
    """R12: a state without operations that is not ACTIVATING. R21 reports failure states."""
    for branch in blueprint:
        told = failing_states(branch) if branch.activating in branch.table else ()
        for state in dead_ends(branch):
            if state != branch.activating and state not in told:
                yield Remark(
                    "R12",
                    ERROR,
                    Address(branch.name, state),
                    "no operation leads out of here, and it is not ACTIVATING",
                    "add an operation, or make it the ACTIVATING state",
                )
