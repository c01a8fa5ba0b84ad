"""The rules for the beginning and the end of a log. Each yields a sentence for each fault."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from smsl_studio.runlog import events as run
from smsl_studio.runlog.ends import BROKEN_OFF, LET_GO, UNBEGUN
from smsl_studio.runlog.grammar.memory import Memory, parts, texts

Json = Any
REASONS = ("goal_reached", "no_route", "held", "refused", "stopped", "failed")
_CUT = (LET_GO, BROKEN_OFF, UNBEGUN)
"""The sentences of ends from outside the run, which may come at any time."""


def run_started(memory: Memory, event: run.RunStarted) -> Iterator[str]:
    """Check that the run begins once, with goals in its SBs, and as its header says."""
    fold, start = memory.fold, event.start
    if fold.begun:
        yield "a second run begins; a log has one"
    if not start or not all(start.values()) or not all(start):
        yield "the run begins in no state"
    if fold.facts and not memory.names:
        yield "facts are logged before the run began, but no person was asked for one"
    if fold.configuration and dict(start) != fold.configuration:
        yield f"the run does not begin where it was located, in {_where(fold.configuration)}"
    goals = [parts(goal) for goal in event.goals]
    if not goals or any(len(goal) != 2 or goal[0] not in start for goal in goals):
        yield "a goal is no state of an SB of this run"
    elif len({goal[0] for goal in goals}) < len(goals):
        yield "an SB has two goals"
    for one in memory.expansion.broken(start, start):
        yield f"the run begins in {one.base}/{start[one.base]} and {one.sub}/{start[one.sub]}"
    yield from _unlike_header(memory, event)


def left_out(memory: Memory, event: run.LeftOut) -> Iterator[str]:
    """Check that what cannot be read is told at the beginning, with an address and a sentence."""
    if not isinstance(memory.last, run.RunStarted | run.LeftOut):
        yield f"{event.address} is left out after the beginning of the run"
    if not event.address or not event.sentence:
        yield "something is left out, without a place or a reason"


def _unlike_header(memory: Memory, event: run.RunStarted) -> Iterator[str]:
    """Yield the differences from the header, which was written before the run."""
    header, located = memory.header, bool(memory.fold.configuration)
    world, seed = header.get("world"), header.get("seed")
    if isinstance(world, str) and world != event.world:
        yield f"the run is in the world {event.world}; the header has {world}"
    if isinstance(seed, int) and seed != event.seed:
        yield f"the seed is {event.seed}; the header has {seed}"
    digests = header.get("digests")
    behaviour = digests.get("behaviour") if isinstance(digests, dict) else None
    if isinstance(behaviour, str) and behaviour != event.behaviour:
        yield "the run is of another blueprint than the header"
    for branch, state in _states(header.get("start")).items():
        if event.start.get(branch) != state and not located:
            yield f"the run does not begin in {branch}/{state}, which the header asks for"
    goals = _states(header.get("goals"))
    if goals and goals != _states(list(event.goals)):
        yield "the goals are not those that the header asks for"


def _states(value: Json) -> Mapping[str, str]:
    """Return the states that a header names with their SBs. Only the blueprint could complete
    others.
    """
    named = [parts(text) for text in texts(value)]
    return {one[0]: one[1] for one in named} if all(len(one) == 2 for one in named) else {}


def run_finished(memory: Memory, event: run.RunFinished) -> Iterator[str]:
    """Check that the end agrees with the events: the number of operations, the configuration, the
    reason.
    """
    fold = memory.fold
    if event.reason not in REASONS:
        yield f"a run cannot end with the reason {event.reason}"
        return
    if event.operations != fold.operations:
        yield f"the run ends with {event.operations} operations; {fold.operations} have committed"
    if (fold.begun or fold.configuration) and dict(event.configuration) != fold.configuration:
        yield f"the run ends in another place than {_where(fold.configuration)}"
    if not event.sentence:
        yield "the run ends, and does not say why"
    if memory.tasks and event.reason != "failed" and event.sentence not in _CUT:
        yield f"the run ends, and {next(iter(memory.tasks))} is open"
    for branch, state in event.configuration.items():
        if not memory.evidence.is_drawn(branch, state):
            yield f"the run ends in {branch}/{state}, which is not drawn"
    yield from _ENDS[event.reason](memory, event)
    yield from _late(memory, event)


def _late(memory: Memory, event: run.RunFinished) -> Iterator[str]:
    """Check that a run ends as soon as it is over.

    A run that waits for a person may end at any later time. So may a run that the window has let go
    of.
    """
    last = memory.last
    at = last.t if last is not None else 0.0
    arrived = isinstance(last, run.GoalReached) and memory.fold.phase == "running"
    over = arrived and event.reason == "goal_reached"
    if event.reason == "refused" or event.sentence == UNBEGUN or last is None:
        over = True
    elif memory.unattended and event.sentence not in (LET_GO, BROKEN_OFF):
        over |= event.reason in ("held", "no_route", "stopped")
    if over and event.t > at:
        yield f"the run ends at {event.t:g} s; it was over at {at:g} s"


def _reached(memory: Memory, event: run.RunFinished) -> Iterator[str]:
    fold = memory.fold
    missing = [
        goal for goal in fold.goals if not _holds(memory, goal) or goal not in memory.reached
    ]
    if not fold.begun:
        yield "the goal is reached by a run that has not begun"
    elif missing:
        yield f"the run ends at its goal; {missing[0]} was not reached"
    elif fold.started:
        yield f"the run ends at its goal in the middle of {next(iter(fold.started))}"
    elif fold.held or fold.stopped or fold.taken_over or fold.tasks:
        yield f"the run ends at its goal and is {_state(memory)}"
    elif not memory.former and memory.busy >= memory.now:
        yield "the run ends at its goal at the time of the last event; nothing was sensed after it"
    elif not memory.former and memory.evidence.off:
        yield f"the run ends at its goal; {min(memory.evidence.off)} has other facts"
    elif event.sentence != f"{', '.join(fold.goals)} {'hold' if fold.goals[1:] else 'holds'}.":
        yield "the run ends at its goal, and its sentence says something else"


def _held(memory: Memory, event: run.RunFinished) -> Iterator[str]:
    held, phase = memory.fold.held, memory.fold.phase
    if _was_asked(memory, event) and event.sentence.startswith(WAITING):
        return
    if memory.fold.taken_over and event.sentence in _LEFT["taken_over"]:
        return  # a hazard may hold it besides
    if held is not None and (held.kind == "no_route" or held.reason != event.sentence):
        yield f"the run held for another reason: {held.reason}"
    elif held is None and phase not in _LEFT:
        yield f"the run ends because it held; it is {_state(memory)}"
    elif held is None and event.sentence not in _LEFT[phase]:
        yield f"the run ends because nobody goes on with it, but its sentence is: {event.sentence}"


WAITING = "The run is waiting, and "
GONE = "The goals do not hold any more, and nobody is there to decide."
_LEFT: dict[str, tuple[str, ...]] = {
    phase: (f"The run is {words}, and nobody is there to go on with it.", GONE)
    for phase, words in (
        ("ready", "waiting to be asked"),
        ("paused", "paused"),
        ("taken_over", "taken over"),
    )
}
_LEFT["idle"] = sum(_LEFT.values(), ())
"""The run states in which a run ends if nobody attends it, and the possible sentences of its
end.
"""


def _was_asked(memory: Memory, event: run.RunFinished) -> bool:
    """Return whether people were asked until this moment."""
    last = memory.last
    return isinstance(last, run.TaskClosed) and last.outcome == "withdrawn" and last.t == event.t


def _no_route(memory: Memory, event: run.RunFinished) -> Iterator[str]:
    held = memory.fold.held
    if held is None or held.kind != "no_route" or held.reason != event.sentence:
        yield "the run ends without a route, but no event before says so"


def _refused(memory: Memory, event: run.RunFinished) -> Iterator[str]:
    if memory.fold.begun and not memory.declined:
        yield "a run that has begun is refused, but nobody has refused its start"
    elif memory.fold.operations or memory.begun:
        yield "a run is refused that has carried out operations"


def _is_by(by: str, sentence: str) -> bool:
    """Return whether the sentence names who stopped the run. Words about the world may follow."""
    said, _, rest = sentence.partition(f"Stopped by {by}.")
    return not said and (not rest or rest.startswith(" "))


def _stopped(memory: Memory, event: run.RunFinished) -> Iterator[str]:
    by = memory.fold.stopped
    if event.sentence in (LET_GO, BROKEN_OFF) or (by and _is_by(by, event.sentence)):
        return
    if event.sentence == UNBEGUN and not memory.fold.begun:
        return
    yield (
        f"the run was stopped by {by}; its end says otherwise"
        if by
        else "the run ends as stopped, and nobody has stopped it"
    )


def _failed(memory: Memory, event: run.RunFinished) -> Iterator[str]:
    last = memory.last
    told = isinstance(last, run.Held) and last.kind == "held" and last.t == event.t
    if not told or getattr(last, "reason", "") != event.sentence:
        yield "the run fails without a hold that gives the reason"


_ENDS = {
    "goal_reached": _reached,
    "no_route": _no_route,
    "held": _held,
    "refused": _refused,
    "stopped": _stopped,
    "failed": _failed,
}


def _holds(memory: Memory, goal: str) -> bool:
    branch, state = parts(goal)
    return memory.fold.configuration.get(branch) == state


def _state(memory: Memory) -> str:
    return memory.fold.phase.replace("_", " ")


def _where(configuration: Mapping[str, str]) -> str:
    return ", ".join(f"{name}/{state}" for name, state in configuration.items())
