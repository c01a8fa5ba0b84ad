"""The rules for a step: operations begin, end, are checked and commit, or fail. Each yields a
sentence for each fault.
"""

from __future__ import annotations

from collections import ChainMap, Counter
from collections.abc import Iterator, Mapping
from math import isclose

from smsl_studio.runlog import events as run
from smsl_studio.runlog.grammar.memory import Begun, Memory, parts

OUTCOMES = ("returned", "failed", "raised", "timed_out", "cancelled", "lost")
AT_WORK = ("returned", "failed", "raised", "timed_out")
"""The outcomes of a function that ran for at least one tick."""
WITHOUT_FAILURE = "a state without failure"
"""The goal of a route that leads out of a failure state."""
MOST = 1e12
"""The highest cost of an operation (see ``docs/running.md``)."""


def route_planned(memory: Memory, event: run.RoutePlanned) -> Iterator[str]:
    """Check that nothing is carried out, and that the route begins where the run stands."""
    if isinstance(memory.last, run.RoutePlanned):
        yield "a route is planned twice"
    if event.goal not in (*memory.fold.goals, WITHOUT_FAILURE):
        yield f"a route is planned to {event.goal}, which is no goal of this run"
    if memory.begun:
        yield f"a route is planned in the middle of {next(iter(memory.begun))}"
    named = [parts(address) for address in event.operations]
    if not named or any(len(one) != 3 or not memory.knows(one[0]) for one in named):
        yield "the route is empty, or names something that is no operation of this run"
    elif memory.stands(named[0][0]) != named[0][1]:
        yield f"the route begins at {'/'.join(named[0][:2])}, where the run does not stand"
    if event.cost < 0:
        yield "the cost of the route is negative"
    cost = memory.known.cost(zip(event.operations, named, strict=True))
    if cost is not None and not isclose(cost, event.cost, rel_tol=1e-9, abs_tol=1e-6):
        yield f"the route costs {event.cost:g}, and its operations {cost:g}"


def subs_bypassed(memory: Memory, event: run.SubsBypassed) -> Iterator[str]:
    """Check that the operation and the bypassed SBs belong to the run."""
    named = parts(event.address)
    if len(named) != 3 or not memory.knows(named[0]) or not event.sentence:
        yield f"{event.address!r} is no operation of this run"
    elif not event.subs or not all(memory.knows(sub) and sub != named[0] for sub in event.subs):
        yield f"{event.address} bypasses no SB of this run"


def operation_started(memory: Memory, event: run.OperationStarted) -> Iterator[str]:
    """Check that the operation leaves the state of its SB, is not excluded, is the next one of the
    route or was asked for, and that nothing else runs.
    """
    address, fold = event.address, memory.fold
    named = parts(address)
    if len(named) != 3 or not memory.knows(named[0]) or not event.target:
        yield f"{address!r} is no operation of this run"
        return
    branch, source, _ = named
    if memory.stands(branch) != source:
        yield f"{address} begins; {branch} is in {memory.stands(branch)}"
    newest = memory.newest.get(branch)
    if newest is not None and not newest.done:
        yield f"{address} begins; {branch} is still on its way"
    if address in memory.shut:
        yield f"{address} begins; it was shut out"
    if address in memory.guarded:
        yield f"{address} begins; it is not available"
    if memory.failing:
        yield f"{address} begins in a step that has failed"
    elif memory.acting and not isinstance(memory.last, run.OperationStarted):
        yield f"{address} begins; the operation before it has not ended"
    if fold.tasks:
        yield f"{address} begins; people are still being asked"
    # A step that has begun goes on if a fact is unknown, unless the fact is critical.
    later = bool(memory.begun) or memory.committed == event.t or memory.rests
    evidence = memory.evidence
    if evidence.misses(branch, source) or (evidence.unknown(branch) and not later):
        yield f"{address} begins; the logged facts are not those of {source}"
    if not memory.evidence.is_drawn(branch, event.target):
        yield f"{address} begins; {branch} has no {event.target}"
    known = memory.known.function(*named)
    if known is not None and event.function not in (known, ""):
        yield f"{address} begins with {event.function}, and its function is {known or 'none'}"
    yield from _unproved(memory)
    chosen = not memory.begun and memory.asked == address
    if not (memory.chosen or chosen) and (planned := _next(memory)) != address:
        yield f"{address} begins without a command; the route goes on with {planned}"
    # A chosen step that has committed a part goes on at the same time.
    if fold.phase != "running" and not chosen and not memory.may_go_on:
        yield f"{address} begins; the run is {fold.phase.replace('_', ' ')}"


def _next(memory: Memory) -> str:
    """Return the next operation of the route."""
    planned, passed = memory.fold.planned, memory.fold.passed
    return planned[passed] if passed < len(planned) else "nothing"


def operation_ended(memory: Memory, event: run.OperationEnded) -> Iterator[str]:
    """Check that a function or a person ends an operation that has begun, and only once."""
    one = memory.begun.get(event.address)
    if one is None:
        yield f"{event.address} ends; it has not begun"
    elif one.outcome:
        yield f"{event.address} ends for the second time"
    elif not (one.function or one.person or event.outcome == "cancelled"):
        yield f"{event.address} ends; it has no function, and no person was asked to carry it out"
    elif not one.person and event.outcome in AT_WORK and event.t <= one.since:
        yield f"{event.address} ends at the time at which it began"
    if event.outcome not in OUTCOMES:
        yield f"an operation cannot end {event.outcome!r}"
    if memory.failing:
        yield f"{event.address} ends in a step that has failed already"
    yield from _unproved(memory)


def _unproved(memory: Memory) -> Iterator[str]:
    """Yield a fault if the step continues before the target states of its last operation are
    checked.
    """
    for branch, state in memory.unproved.items():
        yield f"{branch}/{state} was not checked, and the step goes on"
    for branch in memory.proved:
        for one in memory.expansion.apart(branch, memory.stands(branch), memory.stands):
            yield f"{one.sub} was not checked with {branch}/{memory.stands(branch)}"


def state_checked(memory: Memory, event: run.StateChecked) -> Iterator[str]:
    """Check that it is a check of a start state, or of the target of an operation that has
    begun.
    """
    named = parts(event.address)
    if len(named) != 2 or not memory.knows(named[0]):
        yield f"{event.address!r} is no state of this run"
        return
    yield from _contradictory(event)
    yield from _ungrounded(memory, event, *named)
    branch, state = named
    if memory.unchecked:
        if next(iter(memory.unchecked.items())) != (branch, state) or event.result != "true":
            yield f"the run begins in {branch}/{state}, which is not where it starts"
    elif branch in memory.checked:
        yield f"{branch} is checked twice"
    elif not memory.begun:
        yield f"{event.address} is checked, and no operation leads there"
    elif memory.acting or memory.failing:
        yield f"{event.address} is checked before the operation that leads there has succeeded"
    elif not _leads_to(memory, branch, state):
        yield f"{event.address} is checked; no operation that has begun leads there"


def _contradictory(event: run.StateChecked) -> Iterator[str]:
    wrong = {
        "true": bool(event.misses or event.unknown),
        "false": not event.misses,
        "unknown": bool(event.misses) or not event.unknown,
    }
    if wrong.get(event.result, True):
        yield f"the check of {event.address} is {event.result}, and its facts say otherwise"


def _ungrounded(memory: Memory, event: run.StateChecked, branch: str, state: str) -> Iterator[str]:
    """Yield a fault if the result differs from what the logged facts say."""
    evidence = memory.evidence
    misses, unknown = evidence.misses(branch, state), evidence.unknown(branch)
    if not evidence.is_drawn(branch, state):
        yield f"{event.address} is checked; {branch} has no such state"
    elif event.result == "true" and (misses or unknown):
        yield f"the check of {event.address} is true; the logged facts are not those of the state"
    elif event.result == "unknown" and misses:
        yield f"the check of {event.address} is unknown; a logged fact contradicts the state"
    elif evidence.decides(branch) and (len(event.misses), len(event.unknown)) != (misses, unknown):
        yield f"the check of {event.address} is {event.result}; the logged facts say otherwise"


def _leads_to(memory: Memory, branch: str, state: str) -> bool:
    """Return whether the newest operation of an SB leads to a state. A later operation of another
    SB may also have loaded the state.
    """
    newest = memory.newest.get(branch)
    last = next(reversed(memory.begun.values()))
    return (newest is not None and newest.target == state) or last.branch != branch


def committed(memory: Memory, event: run.Committed) -> Iterator[str]:
    """Check that the operations have begun, ended well and were checked directly before."""
    if not event.operations:
        yield "a commit has no operations"
        return
    for address, times in Counter(event.operations).items():
        one = memory.begun.get(address)
        if one is None:
            yield f"{address} commits; it has not begun"
        elif one.times != times:
            yield f"{address} has begun {one.times} times, and commits {times} times"
        elif one.outcome != ("returned" if one.is_carried else ""):
            yield f"{address} commits; its function has {one.outcome or 'not ended'}"
    if memory.failing or memory.acting:
        yield "a step commits that has failed or not ended"
    if memory.last is not None and memory.last.t != event.t:
        yield "a step commits at another time than its state checks"
    for branch, state in event.configuration.items():
        if memory.checked.get(branch) != state:
            yield f"{branch}/{state} commits without a true state check before it"
    yield from _elsewhere(memory, event)
    # This does not copy the configuration: a run may have many SBs, and a commit moves few of them.
    there = ChainMap(dict(event.configuration), memory.fold.configuration)
    for apart in memory.expansion.broken(there, event.configuration):
        base, sub = apart.base, apart.sub
        yield f"{base}/{there[base]} commits where {sub} is in {there[sub]}"
    yield from _unproved(memory)


def _elsewhere(memory: Memory, event: run.Committed) -> Iterator[str]:
    """Check that each SB is where its last operation leads, or where another SB's operation put
    it.
    """
    ends: dict[str, Begun] = {}
    for address in event.operations:
        if address in memory.begun:
            ends[memory.begun[address].branch] = memory.begun[address]
    for branch, one in ends.items():
        state = event.configuration.get(branch)
        if state is None or (state != one.target and not _is_loaded(memory, ends, branch, state)):
            yield f"{branch} commits elsewhere than in {one.target}, where its operation leads"


def _is_loaded(memory: Memory, ends: Mapping[str, Begun], branch: str, state: str) -> bool:
    """Return whether another operation of the same commit may have put an SB into a state.

    It must have a function or a person. If the header does not name the sub-SBs, any other
    operation may have done so.
    """
    if not memory.expansion.told:
        return len(ends) > 1
    return any(
        (one.function or one.person) and memory.expansion.may_load(name, branch, state)
        for name, one in ends.items()
    )


def operation_refused(memory: Memory, event: run.OperationRefused) -> Iterator[str]:
    """Check that an operation was refused, with a reason."""
    last = memory.last
    asked = isinstance(last, run.Commanded) and bool(last.refused) and last.address == event.address
    if not event.reasons or (len(parts(event.address)) != 3 and not asked):
        yield "a refusal names no operation or no reason"
    if isinstance(last, run.OperationRefused) and last.address == event.address:
        yield f"{event.address} is refused twice"


def operation_risky(memory: Memory, event: run.OperationRisky) -> Iterator[str]:
    """Check that the operation belongs to a step that has failed. The operation that failed comes
    first, then that of the root.
    """
    if len(parts(event.address)) != 3 or not event.reason:
        yield "a risk names no operation or no reason"
    last = memory.last
    again = isinstance(last, run.OperationRisky) and last.t == event.t
    if again and isinstance(last, run.OperationRisky) and last.address == event.address:
        yield f"{event.address} is tagged risky twice"
    if not again and not (memory.failing and event.address in memory.begun):
        yield f"{event.address} is tagged risky, and it has not failed"
    if again and isinstance(last, run.OperationRisky) and last.reason != event.reason:
        yield f"{event.address} is tagged risky for another reason than {last.address}"
    ended = memory.ended
    failed = memory.blames and ended is not None and ended.outcome != "returned"
    if not again and failed and ended is not None and ended.message not in event.reason:
        yield f"{event.address} is tagged risky, and it has failed for another reason"


def operation_shut_out(memory: Memory, event: run.OperationPruned) -> Iterator[str]:
    """Check that somebody has excluded the operation."""
    if len(parts(event.address)) != 3 or not memory.caused("prune", None, event.address):
        yield f"{event.address} is excluded without a command"


def operation_restored(memory: Memory, event: run.OperationRestored) -> Iterator[str]:
    """Check that somebody has allowed the operation again."""
    if len(parts(event.address)) != 3 or not memory.caused("restore", None, event.address):
        yield f"{event.address} is allowed again without a command"


def costs_changed(memory: Memory, event: run.CostsChanged) -> Iterator[str]:
    """Check that costs have changed or a cost function has failed, and that costs are in range."""
    if not event.costs and not event.faults and not event.closed:
        yield "no cost has changed"
    if event == memory.last:
        yield "the new costs are the same as before"
    for address, cost in event.costs.items():
        if len(parts(address)) != 3 or not 0 <= cost <= MOST:
            yield f"{address!r} cannot cost {cost:g}"
    for address, reason in event.closed.items():
        if len(parts(address)) != 3 or bool(reason) == (address in memory.guarded):
            yield f"a guard tells nothing new of {address!r}"
    if event.costs or event.faults:
        yield from _unset(memory, event)


def _unset(memory: Memory, event: run.CostsChanged) -> Iterator[str]:
    """Check that a person has set the costs, if no cost function can have set them."""
    said = memory.last
    is_set = isinstance(said, run.Commanded) and said.command == "set_cost" and not said.refused
    if isinstance(said, run.Commanded) and is_set:
        if memory.known.priced is False or said.address in event.costs:
            cost = event.costs.get(said.address)
            if len(event.costs) != 1 or cost is None or str(float(cost)) != said.value:
                yield f"{said.address} was priced at {said.value}, and something else has changed"
    elif memory.known.priced is False:
        yield "the costs have changed, and nobody has set them"
