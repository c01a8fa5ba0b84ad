"""The hazards that guard a run: combinations of facts that must never hold together.

An entry of ``_hazards`` that cannot be read guards nothing (rule R29 reports it). Of equal names
the first entry counts.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from smsl_studio.blueprint.address import fact_text, split_fact
from smsl_studio.blueprint.known_values import values_of
from smsl_studio.stop import heed

if TYPE_CHECKING:
    from smsl_studio.blueprint.check import FactKey
    from smsl_studio.blueprint.joint import JointStep
    from smsl_studio.blueprint.model import Blueprint

_KEY = "_hazards"


@dataclass(frozen=True)
class GuardHazard:
    """A hazard whose facts exist: ``facts`` with their values, and for each SB that it names the
    states that have these facts.
    """

    name: str
    facts: tuple[tuple[FactKey, str], ...]
    states: Mapping[str, frozenset[str]]

    def meets(self, configuration: Mapping[str, str]) -> bool:
        """Return whether all its facts hold together in a configuration."""
        return all(configuration[name] in states for name, states in self.states.items())

    def bars(self, branch: str, others: Mapping[str, str]) -> frozenset[str]:
        """Return the states of one SB that meet it while all ``others`` stay where they are."""
        states = self.states.get(branch)
        if states is None:
            return frozenset()
        rest = ((name, some) for name, some in self.states.items() if name != branch)
        return states if all(others[name] in some for name, some in rest) else frozenset()

    @property
    def words(self) -> Mapping[str, str]:
        """Its facts as texts with their values."""
        return {fact_text(*key): value for key, value in self.facts}


def guard_hazards(blueprint: Blueprint) -> tuple[GuardHazard, ...]:
    """Return the hazards of all files that can be read, file by file, as they are written."""
    if not any(_KEY in one.values for one in blueprint.documents):
        return ()
    found: dict[str, GuardHazard] = {}
    taken: set[str] = set()
    for document in blueprint.documents:
        raw = document.values.get(_KEY)
        for entry in raw if isinstance(raw, list) else ():
            heed()
            name = entry.get("name") if isinstance(entry, dict) else None
            if not isinstance(name, str) or not name or name in taken:
                continue
            taken.add(name)
            hazard = _read(blueprint, entry)
            if hazard is not None:
                found[name] = hazard
    return tuple(found.values())


def _states_with(blueprint: Blueprint, fact: FactKey, value: str) -> frozenset[str] | None:
    """Return the states in which a fact has a value, or None if no state can have it."""
    name, digit = fact
    branch = blueprint.branches.get(name)
    if branch is None or digit >= len(branch.alphabet):
        return None
    found = branch.states_with(digit, value)
    return found if found or value in values_of(branch, digit) else None


def _read(blueprint: Blueprint, entry: Any) -> GuardHazard | None:
    from smsl_studio.blueprint.annotations import read_hazards

    notes, faults = read_hazards([entry])
    if not notes or faults:
        return None
    facts: list[tuple[FactKey, str]] = []
    states: dict[str, frozenset[str]] = {}
    for text, value in notes[0].facts.items():
        fact = split_fact(text)
        some = _states_with(blueprint, fact, value) if fact else None
        if fact is None or some is None:
            return None
        facts.append((fact, value))
        states[fact[0]] = states.get(fact[0], some) & some
    return GuardHazard(notes[0].name, tuple(facts), states)


def first_met(
    hazards: Sequence[GuardHazard], configuration: Mapping[str, str]
) -> GuardHazard | None:
    """Return the first hazard that a configuration meets."""
    return next((one for one in hazards if one.meets(configuration)), None)


def met_on_the_way(
    hazards: Sequence[GuardHazard], before: Mapping[str, str], step: JointStep
) -> Iterator[GuardHazard]:
    """Yield each hazard that a joint step passes or ends in, at its first action that meets one.

    After each action pending states count as they are, and digits of bases in transit as they are
    committed.
    """
    here = dict(before)
    for action in step.actions:
        here.update(action.moved)
        yield from (one for one in hazards if one.meets(here))


def named(hazards: Sequence[GuardHazard]) -> str:
    """Return the names of hazards in words."""
    names = list(dict.fromkeys(one.name for one in hazards))
    word = "hazard" if len(names) == 1 else "hazards"
    return f"the {word} {' and '.join(names)}"
