"""The estimate: the states in which an SB can be according to the scene (the paper's state
estimation).

**located**: the check of one state is true. **ambiguous**: the checks of several are true.
**unknown**: some facts are unknown, and some states do not contradict the others. **off the map**:
every state contradicts the scene, so the SB is in no drawn state.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import islice
from typing import Literal

from smsl_studio.blueprint.check import Scene, Term, state_check, sub_below
from smsl_studio.blueprint.model import Blueprint, StateBranch

MOST = 8
"""The largest number of states that are named."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """The place of an SB according to the scene.

    ``states`` have a true check, ``possible`` an unknown check, in file order and at most ``MOST``
    of each. ``unknown`` are the terms whose facts are unknown. They are from the check of one
    state, so their ``wanted`` values do not matter.
    """

    branch: str
    kind: Literal["located", "ambiguous", "off the map", "unknown"]
    states: tuple[str, ...] = ()
    possible: tuple[str, ...] = ()
    unknown: tuple[Term, ...] = ()

    @property
    def state(self) -> str | None:
        """The only state with a true check. None if there is not exactly one."""
        return self.states[0] if self.kind == "located" else None


def estimate(
    blueprint: Blueprint, branch: str, scene: Scene, believed: Mapping[str, str]
) -> Estimate:
    """Return the states of ``branch`` that fit the scene. ``believed`` is as in ``state_check``."""
    own = blueprint.branches[branch]
    if not own.table:
        return Estimate(branch, "off the map")
    terms = _terms(blueprint, own, scene, believed)
    unknown = tuple(term for term in terms if term.truth is None)
    fitting = _fitting(blueprint, own, terms)
    if unknown:
        possible = tuple(islice(fitting, MOST))
        return Estimate(branch, "unknown" if possible else "off the map", (), possible, unknown)
    states = tuple(islice(fitting, MOST))
    if len(states) > 1:
        return Estimate(branch, "ambiguous", states)
    return Estimate(branch, "located" if states else "off the map", states)


def fitting(
    blueprint: Blueprint, branch: str, scene: Scene, believed: Mapping[str, str]
) -> tuple[str, ...]:
    """Return every state of ``branch`` with a true check, in file order. They all have the same
    facts. Empty if a fact is unknown.
    """
    own = blueprint.branches[branch]
    terms = _terms(blueprint, own, scene, believed) if own.table else ()
    if any(term.truth is None for term in terms):
        return ()
    return tuple(_fitting(blueprint, own, terms))


def _terms(
    blueprint: Blueprint, branch: StateBranch, scene: Scene, believed: Mapping[str, str]
) -> tuple[Term, ...]:
    first = next(iter(branch.table))
    return state_check(blueprint, branch.name, first, scene, believed).terms


def _fitting(blueprint: Blueprint, branch: StateBranch, terms: tuple[Term, ...]) -> Iterator[str]:
    """Yield the states that no known fact contradicts.

    A reading does not depend on the state that is checked. So the terms of one state serve all
    states, and even 59,049 states take little time.
    """
    known = [
        (digit, *_read(blueprint, branch, term))
        for digit, term in enumerate(terms)
        if term.truth is not None
    ]
    for state in branch.table:
        facts = branch.facts(state)
        if all((facts[digit] == value) == same for digit, value, same in known):
            yield state


def _read(blueprint: Blueprint, branch: StateBranch, term: Term) -> tuple[str, bool]:
    """Return a value, and whether a state must have it (or must not, for a sub-SB that is off)."""
    digit = term.fact[1]
    if sub_below(blueprint, branch, digit) is None:
        return term.reading or "", True
    on = branch.on_value(digit)
    return on, term.truth == (term.wanted == on)
