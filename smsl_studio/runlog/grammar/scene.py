"""What is sensed and believed: facts, mismatches, where the run is located, goals, holds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from smsl_studio.runlog import events as run
from smsl_studio.runlog.grammar.memory import Memory, parts

HOLDS = ("held", "no_route", "guard_lost", "goal_unconfirmed")


def fact_changed(said: Memory, event: run.FactChanged) -> Iterator[str]:
    """A fact of this run reads otherwise than before."""
    key = (event.branch, event.digit)
    if event.digit < 0 or not event.branch or not said.knows(event.branch):
        yield f"{event.branch}/{event.digit} is no fact of this run"
    known = said.fold.facts.get(key)
    if known is not None and known.value == event.value:
        yield f"{event.branch}/{event.digit} changes to what it was"
    if not said.evidence.can_tell(event.branch, event.digit, event.value):
        yield f"{event.branch}/{event.digit} is no fact that is sensed"
    if event.value is not None and event.reason:
        yield f"{event.branch}/{event.digit} is known, and a reason says why it is not"


def mismatch(said: Memory, event: run.Mismatch) -> Iterator[str]:
    """The scene and what is believed differ in a fact at least."""
    if said.blames:
        yield "an operation has failed, and none is tagged risky"
    if said.acting:
        yield "the scene is judged while an operation runs"
    if not event.facts:
        yield "a mismatch names no fact"
    differ = said.evidence.differ
    if said.fold.begun and not said.evidence.open and len(event.facts) != differ:
        yield f"a mismatch names {len(event.facts)} facts; {differ} differ"
    if not all(map(said.is_configuration, event.candidates)):
        yield "the scene agrees with what is no configuration of this run"


def relocalised(said: Memory, event: run.Relocalised) -> Iterator[str]:
    """The run is where it was, or where the scene alone, or a person, has it."""
    if isinstance(said.last, run.Relocalised):
        yield "the run is located twice"
    if said.blames:
        yield "an operation has failed, and none is tagged risky"
    here, there = said.fold.configuration, dict(event.configuration)
    if said.acting:
        yield "the run is located anew while an operation runs"
    if not there or not said.is_configuration(there):
        yield "the run is located in what is no configuration of it"
    elif here and there != here and not _may_move(said, there):
        yield "the run is located elsewhere, and neither the scene nor a person has said so"
    for one in said.expansion.broken(there, there):
        yield f"the run is located in {one.base}/{there[one.base]} and {one.sub}/{there[one.sub]}"
    yield from _unlike(said, there)


def _unlike(said: Memory, there: Mapping[str, str]) -> Iterator[str]:
    """A run is located where every state check is true."""
    for branch, state in there.items():
        if not said.evidence.holds(branch, state):
            yield f"the run is located in {branch}/{state}, and its facts say otherwise"


def _may_move(said: Memory, there: Mapping[str, str]) -> bool:
    if isinstance(said.last, run.GivenBack):
        return dict(said.last.configuration) == there
    if [dict(one) for one in said.fold.candidates] == [there]:
        return isinstance(said.last, run.Mismatch) or said.caused("adopt")
    moved = [name for name, state in there.items() if said.fold.configuration[name] != state]
    return (said.failing or said.stepped) and len(moved) == 1


def held(said: Memory, event: run.Held) -> Iterator[str]:
    """It says why, in one of the known ways."""
    if event.kind not in HOLDS or not event.reason:
        yield f"a run cannot hold as {event.kind!r}, or for no reason"
    for kind, words in _BEGINS.items():
        if (event.kind == kind) != event.reason.startswith(words):
            yield f"a run holds as {event.kind}, and says otherwise: {event.reason}"


_BEGINS = {
    "no_route": "Nothing permitted leads from ",
    "goal_unconfirmed": "The goal is not confirmed: ",
}
"""What a hold of this kind says, and no other."""


def goal_reached(said: Memory, event: run.GoalReached) -> Iterator[str]:
    """The goals are told in their order, each once, where the run stands there and at all that
    were told before."""
    goals, told = said.fold.goals, said.reached
    if event.goal in told:
        yield f"{event.goal} is reached for the second time"
        return
    if len(told) == len(goals) or goals[len(told)] != event.goal:
        yield f"{event.goal} is reached, which is not the next goal of this run"
        return
    if said.begun:
        yield f"{event.goal} is reached in the middle of {next(iter(said.begun))}"
    branch, state = parts(event.goal)
    here = said.fold.configuration.get(branch)
    if here != state:
        yield f"{event.goal} is reached; {branch} is in {here}"
    if said.away:
        yield f"{event.goal} is reached; {min(said.away)} has left its goal"
    if not said.former:
        yield from _unconfirmed(said, event.goal)


def _unconfirmed(said: Memory, goal: str) -> Iterator[str]:
    """A goal is told after a look at the whole scene, a tick after anything else was told."""
    branch, state = parts(goal)
    if said.fold.phase not in ("running", "ready", "paused"):
        yield f"{goal} is reached; the run is {said.fold.phase.replace('_', ' ')}"
    if said.busy >= said.now:
        yield f"{goal} is reached in the moment of what came before; nothing was sensed since"
    if not said.evidence.holds(branch, state):
        yield f"{goal} is reached; the facts that were told are not those of {state}"
    if said.evidence.off:
        yield f"{goal} is reached; the facts of {min(said.evidence.off)} are not as it believes"
