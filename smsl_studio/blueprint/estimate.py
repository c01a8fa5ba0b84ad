"""The estimate: in which states an SB can be, going by the scene (the paper's state estimation).

One state whose check is true: **located**. Several: **ambiguous**. None, and none that could be:
**off the map**, what is there was never drawn. None, but some that could be, were it not for facts
that are unknown: **unknown**; unknown is neither a place nor a proof that there is none.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import islice
from typing import Literal

from smsl_studio.blueprint.check import Scene, Term, state_check, sub_below
from smsl_studio.blueprint.model import Blueprint, StateBranch

MOST = 8
"""States that are worth naming."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """Where an SB is, going by the scene.

    ``states`` check true, ``possible`` check unknown, in the order of the file; at most ``MOST``
    of each are named. ``unknown`` are the terms (of any state: what they want counts for nothing)
    whose fact is not known.
    """

    branch: str
    kind: Literal["located", "ambiguous", "off the map", "unknown"]
    states: tuple[str, ...] = ()
    possible: tuple[str, ...] = ()
    unknown: tuple[Term, ...] = ()

    @property
    def state(self) -> str | None:
        """The one state it is in, None where that is not sure."""
        return self.states[0] if self.kind == "located" else None


def estimate(
    blueprint: Blueprint, branch: str, scene: Scene, believed: Mapping[str, str]
) -> Estimate:
    """In which states of ``branch`` the scene can be; ``believed`` as in ``state_check``."""
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
    """Every state of ``branch`` whose check is true, in the order of the file. They all have the
    same facts; empty where a fact is unknown."""
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
    """The states that no known fact contradicts.

    What was read does not depend on the state that is checked, only what is wanted does: so the
    terms of one state tell those of all, and 59,049 states are gone through in a wink.
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
    """A value, and whether a state must want it, or must not (for a sub-SB that is off)."""
    digit = term.fact[1]
    if sub_below(blueprint, branch, digit) is None:
        return term.reading or "", True
    on = branch.on_value(digit)
    return on, term.truth == (term.wanted == on)
