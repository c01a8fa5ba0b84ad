"""The guard of a run against its hazards, on sensed facts in three-valued logic.

A fact that nobody senses is believed, and a pending state counts as it is. A digit in transit has
the value of its base's state. While a function runs, what it changes can have either value: a fact
that nobody senses and a digit in transit of its SB are unknown then. ``docs/running.md`` says what
a hazard refuses and when it holds.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import NamedTuple

from smsl_studio.blueprint.address import fact_text
from smsl_studio.blueprint.check import FactKey, Term, off_value, sub_below
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.hazards import GuardHazard, named
from smsl_studio.blueprint.joint import JointAction, JointStep
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.runlog.events import HazardMet

HAZARD = "hazard"
"""The code of a refusal because of a hazard, and the kind of a hold because of one."""
NOTHING: Mapping[FactKey, str] = {}


class Objection(NamedTuple):
    """Why an operation must not begin: the name of the hazard, and a sentence."""

    hazard: str
    sentence: str


def met(run: LiveRun) -> tuple[GuardHazard, ...]:
    """Return the hazards whose facts all hold now. Those that do not are no longer told ones."""
    if not run.hazards:
        return ()
    seen = _Seen(run, run.transit)
    found = tuple([one for one in run.hazards if seen.truth(one) is True])
    if run.told_hazards:
        run.told_hazards &= {one.name for one in found}
    return found


def newly_met(run: LiveRun) -> tuple[GuardHazard, ...]:
    """Return the hazards that are met now and were not told since they are."""
    return tuple(one for one in met(run) if one.name not in run.told_hazards)


def tell(run: LiveRun, hazards: Collection[GuardHazard]) -> None:
    """Tell that these hazards are met."""
    for one in hazards:
        run.told_hazards.add(one.name)
        run.emit(HazardMet(t=run.time, name=one.name, facts=one.words))


def met_words(hazards: Collection[GuardHazard]) -> tuple[str, ...]:
    """Return a sentence for each hazard that is met."""
    return tuple(f"{named([one])} is met: {_facts(one)}" for one in hazards)


def objection(run: LiveRun, step: JointStep) -> Objection | None:
    """Return why a step must not begin because of a hazard, if so. Nothing of it has moved."""
    return next(_objections(run, step.asked, step.actions), None) if run.hazards else None


def objection_to(run: LiveRun, action: JointAction) -> Objection | None:
    """Return why a function of a step that has begun must not run because of a hazard, if so."""
    return next(_objections(run, action.edge, (action,)), None) if run.hazards else None


def doubts(run: LiveRun, step: JointStep) -> Iterator[Term]:
    """Yield the unknown facts because of which a hazard would refuse a step."""
    changed = _changed(run, step.actions)
    for hazard in run.hazards:
        seen = _open(run, hazard, step.actions, changed)
        if seen is not None:
            yield from (Term(k, v, None, None, "") for k, v in seen.unknown(hazard))


def _objections(run: LiveRun, edge: Edge, actions: Collection[JointAction]) -> Iterator[Objection]:
    """Yield the objection of each hazard, first of those that would be met."""
    overlay: dict[FactKey, str] = {}
    for action in actions:
        overlay.update(_declared(run, action))
        seen = _Seen(run, action.after, overlay)
        for hazard in run.hazards:
            if seen.truth(hazard) is True:
                words = f"{edge} would meet {named([hazard])}: {_facts(hazard)}"
                yield Objection(hazard.name, words)
    changed = _changed(run, actions)
    for hazard in run.hazards:
        doubtful = _open(run, hazard, actions, changed)
        if doubtful is not None:
            facts = ", ".join(fact_text(*key) for key, _ in doubtful.unknown(hazard))
            words = f"{edge} changes a fact of {named([hazard])}, and {facts} is unknown"
            yield Objection(hazard.name, words)


def _open(
    run: LiveRun,
    hazard: GuardHazard,
    actions: Collection[JointAction],
    changed: Collection[FactKey],
) -> _Seen | None:
    """Return the facts with which an unknown one could complete a hazard, if the actions change one
    of its facts: those of now, or those after one of the actions.
    """
    if not any(key in changed for key, _ in hazard.facts):
        return None
    now = _Seen(run, run.transit)
    if now.truth(hazard) is None:
        return now
    overlay: dict[FactKey, str] = {}
    for action in actions:
        overlay.update(_declared(run, action))
        seen = _Seen(run, action.after, overlay)
        if seen.truth(hazard) is None:
            return seen
    return None


def _declared(run: LiveRun, action: JointAction) -> Iterator[tuple[FactKey, str]]:
    """Yield the facts that an action declares: those of the states that it leads to."""
    for name, state in action.moved.items():
        for digit, value in enumerate(run.blueprint[name].facts(state)):
            yield (name, digit), value


def _changed(run: LiveRun, actions: Collection[JointAction]) -> set[FactKey]:
    """Return the facts in which the states of the actions differ from those before."""
    here, found = run.believed, set()
    for action in actions:
        for name, state in action.moved.items():
            facts = run.blueprint[name].facts
            pairs = zip(facts(here[name]), facts(state), strict=False)
            found |= {(name, digit) for digit, (old, new) in enumerate(pairs) if old != new}
            here[name] = state
    return found


def _facts(hazard: GuardHazard) -> str:
    return ", ".join(f"{key} is {value}" for key, value in hazard.words.items())


class _Seen:
    """The values of facts as they are sensed, with some facts replaced by ``declared`` ones.

    ``transit`` are the digits in transit.
    """

    def __init__(
        self,
        run: LiveRun,
        transit: Collection[FactKey],
        declared: Mapping[FactKey, str] = NOTHING,
    ) -> None:
        self._run, self._transit, self._declared = run, transit, declared

    def truth(self, hazard: GuardHazard) -> bool | None:
        """Return whether all facts of a hazard hold, None if an unknown one could complete it."""
        return self._all(hazard.facts)

    def unknown(self, hazard: GuardHazard) -> list[tuple[FactKey, str]]:
        """Return the unknown facts of a hazard, with the values that it names."""
        return [(key, value) for key, value in hazard.facts if self._value(key) is None]

    def _all(self, facts: Collection[tuple[FactKey, str]]) -> bool | None:
        known = True
        for key, wanted in facts:
            value = self._value(key)
            if value is None:
                known = False
            elif value != wanted:
                return False
        return True if known else None

    def _value(self, key: FactKey) -> str | None:
        """Return the value of a fact, None if it is unknown."""
        declared = self._declared.get(key)
        if declared is not None:
            return declared
        run, (name, digit) = self._run, key
        branch = run.blueprint.branches[name]
        sub = sub_below(run.blueprint, branch, digit)
        state = run.pending.get(name) or run.configuration[name]
        if key in self._transit and name in run.moving:
            return None
        if sub is not None and key not in self._transit:
            values = enumerate(sub.facts(sub.activating))
            there = self._all([((sub.name, at), value) for at, value in values])
            if there is None:
                return None
            return branch.on_value(digit) if there else off_value(branch, digit)
        reading = run.senses.scene.readings.get(key) if sub is None else None
        if reading is not None and reading.sensed:
            return reading.value
        believed = branch.facts(state)[digit]
        moved_to = run.moving.get(name)
        if moved_to is not None and branch.facts(moved_to)[digit] != believed:
            return None
        return believed
