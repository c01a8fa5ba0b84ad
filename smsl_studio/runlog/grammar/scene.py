"""The rules for facts, mismatches, the location of a run, goals and holds. Each yields a sentence
for each fault.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from smsl_studio.blueprint.address import split_fact
from smsl_studio.blueprint.predicates.measure import GOOD, QUALITIES, measure_of
from smsl_studio.runlog import events as run
from smsl_studio.runlog.grammar.memory import Memory, parts

HOLDS = ("held", "no_route", "guard_lost", "goal_unconfirmed", "hazard")


def fact_changed(memory: Memory, event: run.FactChanged) -> Iterator[str]:
    """Check that a fact of this run has another value than before."""
    key = (event.branch, event.digit)
    if event.digit < 0 or not event.branch or not memory.knows(event.branch):
        yield f"{event.branch}/{event.digit} is no fact of this run"
    known = memory.fold.facts.get(key)
    if known is not None and known.value == event.value:
        yield f"{event.branch}/{event.digit} changes to the value that it had"
    if not memory.evidence.can_tell(event.branch, event.digit, event.value):
        yield f"{event.branch}/{event.digit} is no fact that is sensed"
    if event.value is not None and event.reason:
        yield f"{event.branch}/{event.digit} has a value, and also a reason why it has none"


def measured(memory: Memory, event: run.Measured) -> Iterator[str]:
    """Check that something of this run was measured, as a number or with a reason."""
    word = f"{event.source} of {event.branch}/{event.digit}"
    if event.digit < 0 or not event.branch or not memory.knows(event.branch):
        yield f"{event.branch}/{event.digit} is no fact of this run"
    if not memory.evidence.can_tell(event.branch, event.digit, None):
        yield f"{event.branch}/{event.digit} is no fact that is sensed"
    if not event.source or event.quality not in QUALITIES:
        yield f"{word} is measured by nothing, or in quality {event.quality!r}"
    if event.value is not None and isinstance(measure_of(event.value, None), str):
        yield f"{word} has measured {event.value[:40]!r}, which is no number"
    if event.value is None and event.quality == GOOD:
        yield f"{word} has measured nothing, in good quality"


def mismatch(memory: Memory, event: run.Mismatch) -> Iterator[str]:
    """Check that the right number of facts differ, and that no operation runs."""
    if memory.blames:
        yield "an operation has failed, and none is tagged risky"
    if memory.acting:
        yield "the scene is judged while an operation runs"
    if not event.facts:
        yield "a mismatch names no fact"
    differ = memory.evidence.differ
    if memory.fold.begun and not memory.evidence.open and len(event.facts) != differ:
        yield f"a mismatch names {len(event.facts)} facts; {differ} differ"
    if not all(map(memory.is_configuration, event.candidates)):
        yield "the scene agrees with a configuration that this run cannot have"


def relocalised(memory: Memory, event: run.Relocalised) -> Iterator[str]:
    """Check that the run is located where it was, or where the scene or a person says."""
    if isinstance(memory.last, run.Relocalised):
        yield "the run is located twice"
    if memory.blames:
        yield "an operation has failed, and none is tagged risky"
    here, there = memory.fold.configuration, dict(event.configuration)
    if memory.acting:
        yield "the run is located anew while an operation runs"
    if not there or not memory.is_configuration(there):
        yield "the run is located in a configuration that it cannot have"
    elif here and there != here and not _may_move(memory, there):
        yield "the run is located elsewhere, but neither the scene nor a person says so"
    for one in memory.expansion.broken(there, there):
        yield f"the run is located in {one.base}/{there[one.base]} and {one.sub}/{there[one.sub]}"
    yield from _unlike(memory, there)


def _unlike(memory: Memory, there: Mapping[str, str]) -> Iterator[str]:
    """Yield the states of the location that the logged facts contradict."""
    for branch, state in there.items():
        if not memory.evidence.holds(branch, state):
            yield f"the run is located in {branch}/{state}, and its facts say otherwise"


def _may_move(memory: Memory, there: Mapping[str, str]) -> bool:
    if isinstance(memory.last, run.GivenBack):
        return dict(memory.last.configuration) == there
    if [dict(one) for one in memory.fold.candidates] == [there]:
        return isinstance(memory.last, run.Mismatch) or memory.caused("adopt")
    moved = [name for name, state in there.items() if memory.fold.configuration[name] != state]
    return (memory.failing or memory.stepped) and len(moved) == 1


def held(memory: Memory, event: run.Held) -> Iterator[str]:
    """Check that the kind of the hold is known and that its reason agrees."""
    if event.kind not in HOLDS or not event.reason:
        yield f"a run cannot hold as {event.kind!r}, or for no reason"
    for kind, words in _BEGINS.items():
        if (event.kind == kind) != event.reason.startswith(words):
            yield f"a run holds as {event.kind}, and says otherwise: {event.reason}"
    risk = memory.risk if isinstance(memory.last, run.Mismatch) and event.kind == "held" else None
    if risk is not None and risk.t == event.t and event.reason != risk.reason:
        yield f"a run holds after {risk.address} has failed, for another reason: {event.reason}"


_BEGINS = {
    "no_route": "Nothing permitted leads from ",
    "goal_unconfirmed": "The goal is not confirmed: ",
}
"""The first words of the reason for these kinds. No other kind may use them."""


def hazard_met(memory: Memory, event: run.HazardMet) -> Iterator[str]:
    """Check that a hazard has a name and facts, and that the logged facts are those."""
    if not event.name:
        yield "a hazard without a name is met"
    for text, value in event.facts.items():
        fact = split_fact(text)
        if fact is None or not memory.knows(fact[0]):
            yield f"the hazard {event.name} is met, and {text} is no fact of this run"
            continue
        sensed = memory.fold.facts.get(fact)
        if sensed is not None and sensed.value != value:
            yield f"the hazard {event.name} is met, and {text} is not {value}"


def goal_reached(memory: Memory, event: run.GoalReached) -> Iterator[str]:
    """Check that the goals come in order, each once, and that no SB has left its goal."""
    goals, told = memory.fold.goals, memory.reached
    if event.goal in told:
        yield f"{event.goal} is reached for the second time"
        return
    if len(told) == len(goals) or goals[len(told)] != event.goal:
        yield f"{event.goal} is reached, which is not the next goal of this run"
        return
    if memory.begun:
        yield f"{event.goal} is reached in the middle of {next(iter(memory.begun))}"
    branch, state = parts(event.goal)
    here = memory.fold.configuration.get(branch)
    if here != state:
        yield f"{event.goal} is reached; {branch} is in {here}"
    if memory.away:
        yield f"{event.goal} is reached; {min(memory.away)} has left its goal"
    if not memory.former:
        yield from _unconfirmed(memory, event.goal)


def _unconfirmed(memory: Memory, goal: str) -> Iterator[str]:
    """Check that the whole scene was sensed in the tick before, without any other event."""
    branch, state = parts(goal)
    if memory.fold.phase not in ("running", "ready", "paused"):
        yield f"{goal} is reached; the run is {memory.fold.phase.replace('_', ' ')}"
    if memory.busy >= memory.now:
        yield f"{goal} is reached at the time of the last event; nothing was sensed after it"
    if not memory.evidence.holds(branch, state):
        yield f"{goal} is reached; the logged facts are not those of {state}"
    if memory.evidence.off:
        yield f"{goal} is reached; the facts of {min(memory.evidence.off)} are not as it believes"
