"""The human-automation continuum: who acts, senses, inspects and supervises (paper, section on it).

Levels are ``human``, ``shared`` and ``automatic``. By default an operation has the level of its
actor, and a fact that of its aggregation. ``_levels`` of the file, or a setting before a run, may
replace each level.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from smsl_studio.blueprint.address import Address, fact_text, note_key, split_fact
from smsl_studio.blueprint.continuum import (
    AUTOMATIC,
    DEFAULTS,
    FORECAST,
    FORECAST_LEVELS,
    GENERATES,
    GENERATION,
    HUMAN,
    INSPECTION,
    LEVELS,
    NOTHING,
    OF_ACTOR,
    SUPERVISION,
    levels_of,
)
from smsl_studio.errors import UsageError, did_you_mean

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import Blueprint, StateBranch


class Levels:
    """The level of each element of a blueprint, computed when it is asked for.

    Keys are ``inspection``, ``supervision``, ``generation``, ``forecast``, ``SB/digit`` (a fact),
    ``SB/State/Operation``, or ``SB/Operation`` for every edge of that name; the level of a single
    edge counts first.
    ``before`` has the levels that are set before a run. They count before ``_levels`` of the files,
    and these before the annotations. UsageError if ``before`` has an unknown key or level.
    """

    def __init__(self, blueprint: Blueprint, before: Mapping[str, str] = NOTHING) -> None:
        for key, level in before.items():
            fault = fault_of(blueprint, key, level)
            if fault is not None:
                raise UsageError(fault.sentence, advice=fault.advice())
        self._blueprint = blueprint
        self._said = tuple(one for one in (dict(before), dict(blueprint.levels)) if one)

    @property
    def inspection(self) -> str:
        """Who inspects the blueprint before a run: ``human``, ``shared`` or ``automatic``."""
        return self._of(INSPECTION) or DEFAULTS[INSPECTION]

    @cached_property
    def supervision(self) -> str:
        """Who supervises a run: ``human``, ``shared`` or ``automatic``."""
        return self._of(SUPERVISION) or DEFAULTS[SUPERVISION]

    @property
    def generation(self) -> str:
        """Who makes edges during a run (see ``continuum.GENERATES``): ``human``, ``shared`` or
        ``automatic``.
        """
        return self._of(GENERATION) or GENERATES

    def of(self, blueprint: Blueprint) -> Levels:
        """Return the same levels of a blueprint with more edges."""
        found = Levels(blueprint)
        found._said = self._said
        return found

    def forecast(self, edge: Address) -> str:
        """Return the level of the forecast of an edge (see ``continuum.FORECAST_LEVELS``), empty
        if it has none. The most careful one of all levels counts: a level that is set before a run
        cannot take away what the blueprint demands.
        """
        branch = self._blueprint[edge.branch]
        own = None
        if "_operations" in branch.fields:
            own = branch.operation_note(edge.state, edge.operation).forecast
        return careful(own or "", *(said.get(FORECAST, "") for said in self._said))

    @property
    def forecasts(self) -> bool:
        """Whether the blueprint or the run asks for a forecast of any operation."""
        notes = (
            note
            for branch in self._blueprint
            if "_operations" in branch.fields
            for note in branch.notes.operations.values()
        )
        return any(FORECAST in said for said in self._said) or any(note.forecast for note in notes)

    def operation(self, edge: Address) -> str:
        """Return the level of an edge. ``human``: a person carries it out. ``shared``: a person
        confirms it and its function carries it out. ``automatic``: its function carries it out.
        """
        branch = self._blueprint[edge.branch]
        if self._said:
            named = f"{Address(edge.branch)}/{note_key(edge.operation)}"
            also = () if digit_of(branch, edge.operation) is not None else (named,)
            said = self._of(str(edge), *also)
            if said:
                return said
        if "_operations" not in branch.fields:
            return AUTOMATIC
        actor = branch.operation_note(edge.state, edge.operation).actor
        return OF_ACTOR.get(actor or "", AUTOMATIC)

    def fact(self, branch: str, digit: int) -> str:
        """Return the level of a fact. ``human``: a person tells it. ``shared``: sensors tell it, or
        else a person. ``automatic``: only sensors tell it.
        """
        said = self._of(fact_text(branch, digit)) if self._said else ""
        if said:
            return said
        note = self._blueprint[branch].fact_note(digit)
        return HUMAN if note is not None and note.aggregation == "human" else AUTOMATIC

    def people_do(self, branch: str) -> bool:
        """Return whether people may carry out or confirm any operation of an SB."""
        if branch in self._spoken_of:
            return True
        notes = self._blueprint[branch].notes.operations.values()
        return any(note.actor in OF_ACTOR or note.confirm for note in notes)

    @cached_property
    def _spoken_of(self) -> frozenset[str]:
        """The SBs with an operation or a fact whose level was declared or set."""
        keys = (key for said in self._said for key in said if "/" in key)
        return frozenset(Address.split(key)[0] for key in keys)

    def _of(self, *keys: str) -> str:
        """Return the level that was set before the run for the first of these keys, else the
        declared one.
        """
        return next((said[key] for said in self._said for key in keys if key in said), "")


def careful(*levels: str) -> str:
    """Return the most careful of some levels of forecasts. Empty is none."""
    return max(levels, key=("", *FORECAST_LEVELS).index, default="")


@dataclass(frozen=True, slots=True)
class Share:
    """The number of elements of one kind at each level."""

    kind: str
    human: int = 0
    shared: int = 0
    automatic: int = 0

    @property
    def count(self) -> int:
        """The number of elements of this kind."""
        return self.human + self.shared + self.automatic

    @property
    def position(self) -> float:
        """The position from 0 (all human) to 1 (all automatic), 0.5 if there are no elements."""
        return (self.automatic + self.shared / 2) / self.count if self.count else 0.5


@dataclass(frozen=True, slots=True)
class Spectrum:
    """The position of a whole procedure between human (0) and automatic (1)."""

    operations: Share
    facts: Share
    inspection: Share
    supervision: Share

    @property
    def shares(self) -> tuple[Share, ...]:
        """The shares of inspection, operations, facts and supervision, in this order."""
        return (self.inspection, self.operations, self.facts, self.supervision)

    @property
    def position(self) -> float:
        """The mean position of the kinds that the procedure has, all with equal weight."""
        some = [share for share in self.shares if share.count]
        return sum(share.position for share in some) / len(some)


def spectrum(blueprint: Blueprint, levels: Levels | None = None) -> Spectrum:
    """Return the numbers of operations and sensed facts at each level, and the two other levels."""
    chosen = levels or Levels(blueprint)
    operations = dict.fromkeys(LEVELS, 0)
    for branch in blueprint:
        if not chosen.people_do(branch.name):
            operations[AUTOMATIC] += branch.edge_count
            continue
        for edge in branch.edges():
            operations[chosen.operation(edge.address)] += 1
    facts = dict.fromkeys(LEVELS, 0)
    for name, digit in sensed_facts(blueprint):
        facts[chosen.fact(name, digit)] += 1
    return Spectrum(
        Share("operations", **operations),
        Share("facts", **facts),
        Share(INSPECTION, **{chosen.inspection: 1}),
        Share(SUPERVISION, **{chosen.supervision: 1}),
    )


def sensed_facts(blueprint: Blueprint) -> Iterator[tuple[str, int]]:
    """Yield every fact with a level. A fact that a sub-SB expands has none."""
    for branch in blueprint:
        yield from ((branch.name, digit) for digit in _sensed(branch))


def _sensed(branch: StateBranch) -> Iterator[int]:
    digits = range(branch.num_facts if branch.table else 0)
    return (digit for digit in digits if digit not in branch.subs)


class LevelFault(NamedTuple):
    """Why something cannot have a level. The advice is computed when it is asked for."""

    sentence: str
    advice: Callable[[], str]


def fault_of(blueprint: Blueprint, key: str, level: object) -> LevelFault | None:
    """Return why a key cannot have this level, or None if it can."""
    known = levels_of(key)
    if level not in known:
        choice = f"Choose one of {', '.join(known)}."
        said = str(level) if isinstance(level, str) else ""
        return LevelFault(
            f"{level!r} is no level of {key}", lambda: did_you_mean(said, known) or choice
        )
    if key in (*DEFAULTS, FORECAST, GENERATION):
        return None
    parts = Address.split(key)
    branch = blueprint.branches.get(parts[0])
    if len(parts) == 1 or branch is None:
        return LevelFault(
            f"{key!r} has no level: it is no operation and no fact",
            lambda: did_you_mean(parts[0], (*DEFAULTS, FORECAST, GENERATION, *blueprint.branches)),
        )
    digit = digit_of(branch, parts[1]) if len(parts) == 2 else None
    if digit is not None:
        sub = branch.subs.get(digit)
        if sub is None:
            return None
        return LevelFault(
            f"{key} has no level of its own: {sub} expands it",
            lambda: f"Set the levels of what {sub} does and senses.",
        )
    if len(parts) == 2 and parts[1] in branch.operation_names:
        return None
    if len(parts) == 3 and parts[2] in branch.table.get(parts[1], {}):
        return None
    return LevelFault(
        f"{key!r} has no level: it is no operation and no fact",
        lambda: did_you_mean(key, _keys(branch)),
    )


def digit_of(branch: StateBranch, name: str) -> int | None:
    """Return the digit that ``SB/name`` names in an SB, or None.

    If an operation has the name of a digit, such a key names the fact.
    """
    fact = split_fact(f"{Address(branch.name)}/{name}")
    if fact is None or fact[1] >= branch.num_facts or str(fact[1]) != name:
        return None
    return fact[1]


def _keys(branch: StateBranch) -> Iterator[str]:
    yield from (fact_text(branch.name, digit) for digit in _sensed(branch))
    yield from (f"{Address(branch.name)}/{note_key(name)}" for name in branch.operation_names)
    yield from (str(edge.address) for edge in branch.edges())
