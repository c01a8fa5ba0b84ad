"""The guard against hazards, on sensed facts in three-valued logic.

A fact that nobody senses is believed. A digit in transit has the value of its base's state. While a
function runs, what it changes can have either value.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import NamedTuple

from .elements import FactKey, Hazard, fact_text
from .joint import Action, JointStep
from .live import LiveRun, differing

DECLARED_NOTHING: Mapping[FactKey, str] = {}


class Objection(NamedTuple):
    """Why an operation must not begin: the name of the hazard, and a sentence."""

    hazard: str
    sentence: str


def met(run: LiveRun) -> list[Hazard]:
    """Return the hazards that are met now. Others are no longer told ones."""
    seen = _Seen(run, run.transit)
    found = [one for one in run.hazards if seen.truth(one) is True]
    run.told_hazards &= {one.name for one in found}
    return found


def tell(run: LiveRun, hazards: Sequence[Hazard]) -> None:
    """Tell that hazards are met."""
    for one in hazards:
        run.told_hazards.add(one.name)
        run.tell("hazard_met", name=one.name, facts=one.words)


def met_words(hazards: Sequence[Hazard]) -> list[str]:
    """Return a sentence for each hazard that is met."""
    return [f"{named([one])} is met: {_facts(one)}" for one in hazards]


def named(hazards: Sequence[Hazard]) -> str:
    """Return the names of hazards in words."""
    names = list(dict.fromkeys(one.name for one in hazards))
    return f"the {'hazard' if len(names) == 1 else 'hazards'} {' and '.join(names)}"


def objection(run: LiveRun, asked: object, actions: Sequence[Action]) -> Objection | None:
    """Return why some actions of the edge ``asked`` must not begin because of a hazard."""
    return next(_objections(run, asked, actions), None) if run.hazards else None


def doubtful(run: LiveRun, step: JointStep) -> Iterator[FactKey]:
    """Yield the unknown facts because of which a hazard would refuse a step."""
    changed = _changed(run, step.actions)
    for hazard in run.hazards:
        seen = _open(run, hazard, step.actions, changed)
        if seen is not None:
            yield from seen.unknown(hazard)


def _objections(run: LiveRun, asked: object, actions: Sequence[Action]) -> Iterator[Objection]:
    declared: dict[FactKey, str] = {}
    for action in actions:
        declared.update(_declared(run, action))
        seen = _Seen(run, action.after, declared)
        for hazard in run.hazards:
            if seen.truth(hazard) is True:
                words = f"{asked} would meet {named([hazard])}: {_facts(hazard)}"
                yield Objection(hazard.name, words)
    changed = _changed(run, actions)
    for hazard in run.hazards:
        open_one = _open(run, hazard, actions, changed)
        if open_one is not None:
            facts = ", ".join(map(fact_text, open_one.unknown(hazard)))
            words = f"{asked} changes a fact of {named([hazard])}, and {facts} is unknown"
            yield Objection(hazard.name, words)


def _open(
    run: LiveRun, hazard: Hazard, actions: Sequence[Action], changed: Collection[FactKey]
) -> _Seen | None:
    """Return the facts with which an unknown one could complete a hazard, now or after an action,
    if the actions change one of its facts.
    """
    if not any(key in changed for key, _ in hazard.facts):
        return None
    now = _Seen(run, run.transit)
    if now.truth(hazard) is None:
        return now
    declared: dict[FactKey, str] = {}
    for action in actions:
        declared.update(_declared(run, action))
        seen = _Seen(run, action.after, declared)
        if seen.truth(hazard) is None:
            return seen
    return None


def _declared(run: LiveRun, action: Action) -> Iterator[tuple[FactKey, str]]:
    for name, state in action.moved.items():
        for digit, value in enumerate(run.blueprint[name].facts(state)):
            yield (name, digit), value


def _changed(run: LiveRun, actions: Sequence[Action]) -> set[FactKey]:
    here, found = run.believed, set[FactKey]()
    for action in actions:
        for name, state in action.moved.items():
            found |= differing(run.blueprint, name, here[name], state)
            here[name] = state
    return found


def _facts(hazard: Hazard) -> str:
    return ", ".join(f"{key} is {value}" for key, value in hazard.words.items())


class _Seen:
    """The values of facts as they are sensed, some replaced by ``declared`` ones."""

    def __init__(
        self,
        run: LiveRun,
        transit: Collection[FactKey],
        declared: Mapping[FactKey, str] = DECLARED_NOTHING,
    ) -> None:
        self._run, self._transit, self._declared = run, transit, declared

    def truth(self, hazard: Hazard) -> bool | None:
        """Return whether all facts of a hazard hold, None if an unknown one could complete it."""
        return self._all(hazard.facts)

    def unknown(self, hazard: Hazard) -> list[FactKey]:
        """Return the unknown facts of a hazard."""
        return [key for key, _ in hazard.facts if self._value(key) is None]

    def _all(self, facts: Collection[tuple[FactKey, str]]) -> bool | None:
        values = [(self._value(key), wanted) for key, wanted in facts]
        if any(value is not None and value != wanted for value, wanted in values):
            return False
        return None if any(value is None for value, _ in values) else True

    def _value(self, key: FactKey) -> str | None:
        """Return the value of a fact, None if it is unknown."""
        if key in self._declared:
            return self._declared[key]
        run, (name, digit) = self._run, key
        branch, flag = run.blueprint[name], run.blueprint.flag(key)
        if key in self._transit and name in run.moving:
            return None
        if flag.sub and key not in self._transit:
            return self._of_sub(key)
        reading = None if flag.sub else run.senses.scene.get(key)
        if reading is not None:
            return reading.value
        believed = branch.facts(run.believed[name])[digit]
        leads = run.moving.get(name)
        changes = leads is not None and branch.facts(leads)[digit] != believed
        return None if changes else believed

    def _of_sub(self, key: FactKey) -> str | None:
        flag = self._run.blueprint.flag(key)
        sub = self._run.blueprint[flag.sub]
        values = enumerate(sub.facts(sub.activating))
        there = self._all([((sub.name, digit), value) for digit, value in values])
        if there is None:
            return None
        return flag.on if there else flag.off
