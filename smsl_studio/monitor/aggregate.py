"""Aggregation: makes one value, or unknown with a reason, from the sources of a fact (paper, Eq.
5).

Values have no numeric meaning, so two sources can only agree or disagree. Every mode is a pure
function; ``docs/running.md`` has their truth tables. Aggregation never invents a value for an
unknown fact.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.predicates import FactSense

NOBODY = "nobody has answered yet"
"""The reason why a fact that only a person may answer is unknown."""
NO_SENSOR = "no sensor reads it"


@dataclass(frozen=True, slots=True)
class SourceValue:
    """The present value of one source for a fact, or None with the reason. ``age`` is in seconds.

    ``human`` says that a person answered. ``contested`` says that several programs send samples for
    this source.
    """

    source: str
    value: str | None
    reason: str = ""
    age: float = 0.0
    human: bool = False
    contested: bool = False


@dataclass(frozen=True, slots=True)
class Aggregate:
    """The value of a fact, or None with the reason. ``conflict`` says that sources disagree."""

    value: str | None
    reason: str = ""
    age: float = 0.0
    conflict: bool = False


@dataclass(frozen=True, slots=True)
class FactRule:
    """The rule that makes a fact from its sources, as ``_facts`` declares it.

    ``k`` is the number of sources that must agree; None means all. ``conflict_after`` is the time
    (s) that sources may disagree before the fact is unknown. ``sensors`` are the named sensors, in
    order; a named sensor that does not exist counts as a source without a value. ``max_age`` (s)
    is the largest age of a person's answer; None means that it holds until the next answer.
    ``shared`` says that a person's answer counts if the sensors leave the fact unknown. With a
    ``sense`` the sensors measure, and predicates decide.
    """

    aggregation: str = "single"
    k: int | None = None
    critical: bool = False
    conflict_after: float = 0.0
    sensors: tuple[str, ...] = ()
    max_age: float | None = None
    shared: bool = False
    sense: FactSense | None = None

    @property
    def people(self) -> bool:
        """Whether a person may answer the fact."""
        return self.shared or self.aggregation == "human"

    @property
    def awaits_all(self) -> bool:
        """Whether a named sensor that does not exist counts as a source without a value."""
        return self.aggregation in ("all", "k_of_n")


def aggregate(rule: FactRule, said: Sequence[SourceValue]) -> Aggregate:
    """Return the value of a fact by its rule. ``said`` has the values of its sources, in the order
    of the sensors."""
    if rule.aggregation == "human":
        said = [one for one in said if one.human]
        return _first(rule, said) if said else Aggregate(None, NOBODY)
    people = _valid([one for one in said if one.human])
    said = [one for one in said if not one.human]
    contested = next((one for one in said if one.contested), None)
    if contested is not None:
        # One of the programs sends false values. No rule may outvote or replace this source.
        verdict = Aggregate(None, contested.reason, contested.age)
    else:
        verdict = MODES[rule.aggregation](rule, said) if said else Aggregate(None, NO_SENSOR)
    if rule.shared and verdict.value is None and people:
        return Aggregate(people[0].value, "", people[0].age)
    return verdict


def _agreeing(rule: FactRule, said: Sequence[SourceValue]) -> Aggregate:
    """All sources with a reading must agree. One source is enough."""
    valid = _valid(said)
    if not valid:
        return _silent(said)
    if len({one.value for one in valid}) > 1:
        return _conflict(valid)
    return Aggregate(valid[0].value, "", min(one.age for one in valid))


def _all(rule: FactRule, said: Sequence[SourceValue]) -> Aggregate:
    """All sources must have a reading, and all must agree."""
    verdict = _agreeing(rule, said)
    missing = [one for one in said if one.value is None]
    if verdict.value is None or not missing:
        oldest = max(one.age for one in said)
        return verdict if verdict.value is None else Aggregate(verdict.value, "", oldest)
    words = "; ".join(f"{one.source}: {one.reason}" for one in missing)
    return Aggregate(None, f"not all sensors have a reading ({words})", max(o.age for o in missing))


def _k_of_n(rule: FactRule, said: Sequence[SourceValue]) -> Aggregate:
    """At least k sources must agree. For a critical fact no other source may disagree. For any
    other fact, no k sources may agree on another value."""
    k = len(said) if rule.k is None else rule.k
    valid = _valid(said)
    votes = Counter(one.value for one in valid)
    enough = [value for value, count in votes.items() if count >= k]
    if len(enough) == 1 and (len(votes) == 1 or not rule.critical):
        ages = sorted(one.age for one in valid if one.value == enough[0])
        return Aggregate(enough[0], "", ages[k - 1])
    if len(votes) > 1:
        return _conflict(valid)
    age = max((one.age for one in said if one.value is None), default=0.0)
    reason = f"{len(valid)} of {len(said)} sensors have a reading, {k} must agree"
    return Aggregate(None, reason, age)


def _first(rule: FactRule, said: Sequence[SourceValue]) -> Aggregate:
    """The first source with a reading decides. For a critical fact no other source may
    disagree."""
    valid = _valid(said)
    if not valid:
        return _silent(said)
    if rule.critical and len({one.value for one in valid}) > 1:
        return _conflict(valid)
    return Aggregate(valid[0].value, "", valid[0].age)


MODES: dict[str, Callable[[FactRule, Sequence[SourceValue]], Aggregate]] = {
    "single": _agreeing,
    "any": _agreeing,
    "all": _all,
    "k_of_n": _k_of_n,
    "priority": _first,
}


def _valid(said: Sequence[SourceValue]) -> list[SourceValue]:
    return [one for one in said if one.value is not None]


def _silent(said: Sequence[SourceValue]) -> Aggregate:
    return Aggregate(None, said[0].reason, said[0].age)


def _conflict(valid: Sequence[SourceValue]) -> Aggregate:
    words = ", ".join(f"{one.source} says {one.value}" for one in valid)
    return Aggregate(None, f"conflict: {words}", max(one.age for one in valid), conflict=True)
