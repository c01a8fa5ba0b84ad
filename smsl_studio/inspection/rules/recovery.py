"""Rules about the way back after something went wrong (R20, R21; paper, Failure Mode Handling).

They look at each SB by itself. A failure is entered from outside, so a failure state counts whether
operations lead to it or not.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property, partial

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.facts import changed_digits
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.names import FreeNames
from smsl_studio.graph.build import graph_of
from smsl_studio.graph.shape import bottom_groups, can_reach, connected, flood, reachable
from smsl_studio.inspection.rules.finding import Fix, Remark, Severity
from smsl_studio.inspection.rules.words import fact_words
from smsl_studio.stop import heed

ERROR, WARNING = Severity.ERROR, Severity.WARNING


def r20_no_way_back(blueprint: Blueprint) -> Iterator[Remark]:
    """R20: reachable states from which nothing leads to a declared safe or failure-free state.

    SBs in which no state is declared safe and no value a failure are passed over.
    """
    for branch in blueprint:
        good = _good_states(branch)
        if good is None or branch.initial not in branch.table:
            continue
        graph = graph_of(branch)
        back = flood(graph.predecessors, map(graph.number, good))
        inside = reachable(branch, branch.initial)
        lost = [name for name in branch.table if name in inside and graph.index[name] not in back]
        nearest = _Nearest(branch, good)
        for part in connected(branch, lost):
            first, *others = (Address(branch.name, state) for state in part)
            yield Remark(
                "R20",
                WARNING,
                first,
                f"nothing leads from here to a state that is {_kinds(branch)}",
                "add an operation that leads back",
                others=others,
                remedy=partial(_way_back, branch, part, nearest),
            )


def _good_states(branch: StateBranch) -> list[str] | None:
    """Return the states that are declared safe or have no failure. None if nothing is declared."""
    said = {name: note.safe for name, note in branch.notes.states.items()}
    failing = failing_states(branch)
    if not failing and True not in said.values():
        return None
    return [
        name
        for name in branch.table
        if said.get(name) is True or (failing and name not in failing and said.get(name) is None)
    ]


def _kinds(branch: StateBranch) -> str:
    """Return the words for the states of ``_good_states``."""
    safe = any(note.safe for note in branch.notes.states.values())
    kinds = ["declared safe"] * safe + ["without failure"] * bool(failing_states(branch))
    return " or ".join(kinds)


def _way_back(
    branch: StateBranch, part: Sequence[str], nearest: _Nearest
) -> tuple[str, Fix | None]:
    """Return the advice and the fix: an operation from each group that nothing leaves."""
    return _recovery(branch, [group[0] for group in bottom_groups(branch, part)], nearest)


def r21_no_recovery(blueprint: Blueprint) -> Iterator[Remark]:
    """R21: a declared failure value in a state from which no operations lead to ACTIVATING, or a
    failure value that no state has. One finding for each value."""
    for branch in blueprint:
        failing = failing_states(branch)
        yield from _without_state(blueprint, branch)
        if not failing or branch.activating not in branch.table:
            continue
        saved = can_reach(branch, branch.activating)
        good = [name for name in branch.table if name in saved and name not in failing]
        nearest = _Nearest(branch, good)
        stuck: dict[tuple[int, str], list[str]] = {}
        for state in failing:
            if state not in saved:
                stuck.setdefault(_failure(branch, state), []).append(state)
        for (digit, value), states in stuck.items():
            first, *others = (Address(branch.name, state) for state in states)
            yield Remark(
                "R21",
                ERROR,
                first,
                f"{fact_words(branch, digit)} has the failure value {value} here, and no "
                f"operations lead from here to the goal, {branch.activating}",
                others=others,
                remedy=partial(_recovery, branch, states, nearest),
            )


def _without_state(blueprint: Blueprint, branch: StateBranch) -> Iterator[Remark]:
    if "_facts" not in branch.fields:
        return
    for digit, note in sorted(branch.notes.facts.items()):
        known = branch.alphabet[digit] if digit < len(branch.alphabet) else note.failure
        for value in note.failure:
            if value not in known:
                path = (branch.name, "_facts", str(digit), "failure")
                yield Remark(
                    "R21",
                    ERROR,
                    branch.address,
                    f"no state has {value}, a failure value of {fact_words(branch, digit)}, so no "
                    "operation clears it",
                    "add such a state with an operation that leads back, or do not declare it",
                    spot=(blueprint.home(branch.name), path),
                )


def _failure(branch: StateBranch, state: str) -> tuple[int, str]:
    """Return the first digit of a failure state that has a failure value, and this value."""
    return next((digit, value) for digit, value in failures_of(branch, state))


def failures_of(branch: StateBranch, state: str) -> Iterator[tuple[int, str]]:
    """Yield the digits of a state that have a failure value, each with this value."""
    for digit, value in enumerate(branch.facts(state)):
        note = branch.fact_note(digit)
        if note is not None and value in note.failure:
            yield digit, value


class _Nearest:
    """Finds for a state the good state in which the fewest facts differ.

    A good state that differs in one fact is looked up. Otherwise the state is compared with the
    first good ones.
    """

    def __init__(self, branch: StateBranch, good: Sequence[str]) -> None:
        self.branch, self.good = branch, good

    @cached_property
    def _known(self) -> dict[tuple[str, ...], str]:
        facts = self.branch.facts
        return {facts(state): state for state in reversed(self.good)}

    def of(self, state: str) -> str:
        """Return the nearest good state, the first of several that were compared."""
        facts = self.branch.facts(state)
        if len(facts) > 1:
            for digit, values in enumerate(self.branch.alphabet):
                for value in values[:_VALUES]:
                    found = self._known.get((*facts[:digit], value, *facts[digit + 1 :]))
                    if found is not None:
                        return found
        return min(self.good[:_COMPARED], key=partial(self._distance, facts))

    def _distance(self, facts: Sequence[str], other: str) -> int:
        return len(changed_digits(facts, self.branch.facts(other)))


_VALUES, _COMPARED = 50, 500
"""So many values of a fact are looked up, and so many good states are compared."""


def _recovery(
    branch: StateBranch, states: Sequence[str], nearest: _Nearest
) -> tuple[str, Fix | None]:
    """Return the advice and the fix: an operation from each state to the nearest good one."""
    if not nearest.good:
        return "add operations that lead to the goal, or to a state without failure", None
    words = f"Recover from {states[0]}"
    if len(states) > 1:
        words = f"{words} and {len(states) - 1:,} more"
    add = partial(_add_recoveries, name=branch.name, states=states, nearest=nearest)
    advice = f"add an operation that leads back, such as to {nearest.of(states[0])}"
    return advice, Fix(words, add)


def _add_recoveries(
    blueprint: Blueprint, name: str, states: Sequence[str], nearest: _Nearest
) -> Blueprint:
    names = blueprint[name].operation_names
    prefix = "Op_" if names and all(one.startswith("Op_") for one in names) else ""
    operation = FreeNames(names).take(f"{prefix}Recover")
    for state in states:
        heed()
        blueprint = editing.add_operation(blueprint, name, state, operation, nearest.of(state))
    return blueprint
