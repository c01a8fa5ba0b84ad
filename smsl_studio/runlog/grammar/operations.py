"""How a step is carried out: operations begin, end, are checked and commit, or fail."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Iterator, Mapping

from smsl_studio.runlog import events as run
from smsl_studio.runlog.grammar.memory import Begun, Memory, parts

OUTCOMES = ("returned", "failed", "raised", "timed_out", "cancelled", "lost")
AT_WORK = ("returned", "failed", "raised", "timed_out")
"""The outcomes of a function that ran for one tick at least."""
WITHOUT_FAILURE = "a state without failure"
"""What a route leads to that leads out of a failure state."""
MOST = 1e12
"""The highest cost of an operation, as ``docs/running.md`` has it."""


def route_planned(said: Memory, event: run.RoutePlanned) -> Iterator[str]:
    """A route is planned where nothing is carried out, and it begins where the run stands."""
    if isinstance(said.last, run.RoutePlanned):
        yield "a route is planned twice"
    if event.goal not in (*said.fold.goals, WITHOUT_FAILURE):
        yield f"a route is planned to {event.goal}, which is no goal of this run"
    if said.begun:
        yield f"a route is planned in the middle of {next(iter(said.begun))}"
    named = [parts(address) for address in event.operations]
    if not named or any(len(one) != 3 or not said.knows(one[0]) for one in named):
        yield "the route names what is no operation of this run"
    elif said.stands(named[0][0]) != named[0][1]:
        yield f"the route begins at {'/'.join(named[0][:2])}, where the run does not stand"
    if event.cost < 0:
        yield "the route costs less than nothing"


def subs_bypassed(said: Memory, event: run.SubsBypassed) -> Iterator[str]:
    """An edge of one SB does without the operations of others."""
    named = parts(event.address)
    if len(named) != 3 or not said.knows(named[0]) or not event.sentence:
        yield f"{event.address!r} is no operation of this run"
    elif not event.subs or not all(said.knows(sub) and sub != named[0] for sub in event.subs):
        yield f"{event.address} bypasses no SB of this run"


def operation_started(said: Memory, event: run.OperationStarted) -> Iterator[str]:
    """It leaves the state in which its SB stands, was not shut out, and nothing else runs."""
    address, fold = event.address, said.fold
    named = parts(address)
    if len(named) != 3 or not said.knows(named[0]) or not event.target:
        yield f"{address!r} is no operation of this run"
        return
    branch, source, _ = named
    if said.stands(branch) != source:
        yield f"{address} begins; {branch} is in {said.stands(branch)}"
    newest = said.newest.get(branch)
    if newest is not None and not newest.done:
        yield f"{address} begins; {branch} is still on its way"
    if address in said.shut:
        yield f"{address} begins; it was shut out"
    if said.failing:
        yield f"{address} begins in a step that has failed"
    elif said.acting and not isinstance(said.last, run.OperationStarted):
        yield f"{address} begins; the operation before it has not ended"
    if fold.tasks:
        yield f"{address} begins; people are still being asked"
    # A step that is carried out already goes on where a fact is unknown, unless that is critical.
    later = bool(said.begun) or said.committed == event.t or said.rests
    evidence = said.evidence
    if evidence.misses(branch, source) or (evidence.unknown(branch) and not later):
        yield f"{address} begins; the facts that were told are not those of {source}"
    if not said.evidence.is_drawn(branch, event.target):
        yield f"{address} begins; {branch} has no {event.target}"
    chosen = not said.begun and said.asked == address
    if not (said.chosen or chosen) and _next(said) != address:
        yield f"{address} begins; nobody has asked for it, and the route goes on with {_next(said)}"
    # A step that somebody chose, and that has committed in part, goes on at that moment.
    if fold.phase != "running" and not chosen and not said.may_go_on:
        yield f"{address} begins; the run is {fold.phase.replace('_', ' ')}"


def _next(said: Memory) -> str:
    """The operation with which the route goes on."""
    planned, passed = said.fold.planned, said.fold.passed
    return planned[passed] if passed < len(planned) else "nothing"


def operation_ended(said: Memory, event: run.OperationEnded) -> Iterator[str]:
    """A function or a person ends what has begun, once."""
    one = said.begun.get(event.address)
    if one is None:
        yield f"{event.address} ends; it has not begun"
    elif one.outcome:
        yield f"{event.address} ends for the second time"
    elif not (one.function or one.person or event.outcome == "cancelled"):
        yield f"{event.address} ends; it runs no function, and nobody was asked to carry it out"
    elif not one.person and event.outcome in AT_WORK and event.t <= one.since:
        yield f"{event.address} ends in the moment in which it began"
    if event.outcome not in OUTCOMES:
        yield f"an operation cannot end {event.outcome!r}"
    if said.failing:
        yield f"{event.address} ends in a step that has failed already"


def state_checked(said: Memory, event: run.StateChecked) -> Iterator[str]:
    """At the start every SB is checked where it stands; later, where an operation leads."""
    named = parts(event.address)
    if len(named) != 2 or not said.knows(named[0]):
        yield f"{event.address!r} is no state of this run"
        return
    yield from _contradictory(event)
    yield from _ungrounded(said, event, *named)
    branch, state = named
    if said.unchecked:
        if next(iter(said.unchecked.items())) != (branch, state) or event.result != "true":
            yield f"the run begins in {branch}/{state}, which is not where it starts"
    elif branch in said.checked:
        yield f"{branch} is checked twice"
    elif not said.begun:
        yield f"{event.address} is checked, and no operation leads there"
    elif said.acting or said.failing:
        yield f"{event.address} is checked before what leads there has ended well"
    elif not _leads_to(said, branch, state):
        yield f"{event.address} is checked; nothing that has begun leads there"


def _contradictory(event: run.StateChecked) -> Iterator[str]:
    wrong = {
        "true": bool(event.misses or event.unknown),
        "false": not event.misses,
        "unknown": bool(event.misses) or not event.unknown,
    }
    if wrong.get(event.result, True):
        yield f"the check of {event.address} is {event.result}, and its facts say otherwise"


def _ungrounded(said: Memory, event: run.StateChecked, branch: str, state: str) -> Iterator[str]:
    """What a check comes to is what the facts say that were told until then."""
    evidence = said.evidence
    misses, unknown = evidence.misses(branch, state), evidence.unknown(branch)
    if not evidence.is_drawn(branch, state):
        yield f"{event.address} is checked; {branch} has no such state"
    elif event.result == "true" and (misses or unknown):
        yield f"the check of {event.address} is true; the facts that were told are not its own"
    elif event.result == "unknown" and misses:
        yield f"the check of {event.address} is unknown; a fact was told that is not its own"
    elif evidence.decides(branch) and (len(event.misses), len(event.unknown)) != (misses, unknown):
        yield f"the check of {event.address} is {event.result}; the facts that were told are not so"


def _leads_to(said: Memory, branch: str, state: str) -> bool:
    """Whether the newest operation of an SB leads to a state, or a later one of another SB may
    load it."""
    newest = said.newest.get(branch)
    last = next(reversed(said.begun.values()))
    return (newest is not None and newest.target == state) or last.branch != branch


def committed(said: Memory, event: run.Committed) -> Iterator[str]:
    """What has begun, ended well and checked true commits, directly after its checks."""
    if not event.operations or len(set(event.operations)) < len(event.operations):
        yield "what commits is not a list of different operations"
        return
    for address in event.operations:
        one = said.begun.get(address)
        if one is None:
            yield f"{address} commits; it has not begun"
        elif one.outcome != ("returned" if one.function or one.person else ""):
            yield f"{address} commits; its function has {one.outcome or 'not ended'}"
    if said.failing or said.acting:
        yield "a step commits that has failed or not ended"
    if said.last is not None and said.last.t != event.t:
        yield "a step commits at another time than its state checks"
    for branch, state in event.configuration.items():
        if said.checked.get(branch) != state:
            yield f"{branch}/{state} commits without a true state check before it"
    yield from _elsewhere(said, event)
    # It is no copy: a run may have many SBs, and a commit moves few of them.
    there = ChainMap(dict(event.configuration), said.fold.configuration)
    for apart in said.expansion.broken(there, event.configuration):
        base, sub = apart.base, apart.sub
        yield f"{base}/{there[base]} commits where {sub} is in {there[sub]}"


def _elsewhere(said: Memory, event: run.Committed) -> Iterator[str]:
    """Each SB must stand where its last operation leads. One may be loaded by that of another."""
    ends: dict[str, Begun] = {}
    for address in event.operations:
        if address in said.begun:
            ends[said.begun[address].branch] = said.begun[address]
    for branch, one in ends.items():
        state = event.configuration.get(branch)
        if state is None or (state != one.target and not _is_loaded(said, ends, branch, state)):
            yield f"{branch} commits elsewhere than in {one.target}, where its operation leads"


def _is_loaded(said: Memory, ends: Mapping[str, Begun], branch: str, state: str) -> bool:
    """Whether an operation of another SB that commits as well may have loaded an SB into a state:
    one with a function. A log that does not say which SBs are subs is believed in that."""
    if not said.expansion.told:
        return len(ends) > 1
    return any(
        (one.function or one.person) and said.expansion.may_load(name, branch, state)
        for name, one in ends.items()
    )


def operation_refused(said: Memory, event: run.OperationRefused) -> Iterator[str]:
    """What is refused is an operation, for a reason."""
    last = said.last
    asked = isinstance(last, run.Commanded) and bool(last.refused) and last.address == event.address
    if not event.reasons or (len(parts(event.address)) != 3 and not asked):
        yield "what is refused is no operation, or for no reason"
    if isinstance(last, run.OperationRefused) and last.address == event.address:
        yield f"{event.address} is refused twice"


def operation_risky(said: Memory, event: run.OperationRisky) -> Iterator[str]:
    """A step has failed; the operation that is to blame is told first, then that of the root."""
    if len(parts(event.address)) != 3 or not event.reason:
        yield "what is risky is no operation, or for no reason"
    last = said.last
    again = isinstance(last, run.OperationRisky) and last.t == event.t
    if again and isinstance(last, run.OperationRisky) and last.address == event.address:
        yield f"{event.address} is tagged risky twice"
    if not again and not (said.failing and event.address in said.begun):
        yield f"{event.address} is tagged risky, and it has not failed"


def operation_shut_out(said: Memory, event: run.OperationPruned) -> Iterator[str]:
    """Somebody shut it out."""
    if len(parts(event.address)) != 3 or not said.caused("prune", None, event.address):
        yield f"{event.address} is shut out, and nobody said so"


def operation_restored(said: Memory, event: run.OperationRestored) -> Iterator[str]:
    """Somebody allowed it again."""
    if len(parts(event.address)) != 3 or not said.caused("restore", None, event.address):
        yield f"{event.address} may be used again, and nobody said so"


def costs_changed(said: Memory, event: run.CostsChanged) -> Iterator[str]:
    """Something costs otherwise, or a cost function failed."""
    if not event.costs and not event.faults:
        yield "no cost has changed"
    if event == said.last:
        yield "costs change to what they were"
    for address, cost in event.costs.items():
        if len(parts(address)) != 3 or not 0 <= cost <= MOST:
            yield f"{address!r} cannot cost {cost:g}"
