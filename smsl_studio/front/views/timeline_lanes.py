"""Lanes: the rows of the timeline, from the history of a run."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import takewhile

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.front.views.run_marks import expected_duration
from smsl_studio.front.views.states import short_name
from smsl_studio.host.protocol import SensorInfo
from smsl_studio.runlog.history import RunHistory, Span, Story
from smsl_studio.runlog.moment import RunMoment


@dataclass(frozen=True)
class Block:
    """One span of a lane, in simulated seconds. ``end`` is None if it still lasts.

    ``look`` is ``past``, ``now``, ``bad`` or ``predicted``, and for a fact ``unknown`` or
    ``beyond`` (a value that no state has).
    """

    start: float
    end: float | None
    words: str
    look: str


@dataclass(frozen=True)
class Lane:
    """One row: its label, its kind (``state``, ``operation`` or ``fact``) and its blocks in order
    of time.
    """

    label: str
    kind: str
    blocks: tuple[Block, ...]


def lanes(
    blueprint: Blueprint, status: DispatchStatus, story: Story, sensors: Sequence[SensorInfo] = ()
) -> tuple[Lane, ...]:
    """Return the rows of the timeline: the states of each SB, the operations, then the facts."""
    words = {(sensor.branch, sensor.digit): sensor.words for sensor in sensors}
    several, ended = len(blueprint) > 1, story.moment.finished is not None
    soon = _soon(blueprint, status, story)
    history, found = story.history, []
    for branch in blueprint:
        if branch.name in history.states:
            coming = soon[1:] if status.running and status.running.branch == branch.name else ()
            blocks = (*_states(branch, history.states[branch.name], ended), *coming)
            begun = blocks[0].start
            if begun > 0:
                # The run held at its start. What was believed then is not recorded.
                blocks = (Block(0.0, begun, "?", "unknown"), *blocks)
        elif branch.name in status.configuration:
            # Before the run has begun, the start is believed and nobody has confirmed it.
            name = short_name(branch, status.configuration[branch.name])
            blocks = (Block(0.0, None, name, "unknown"),)
        else:
            continue
        found.append(Lane(branch.name if several else "State", "state", blocks))
    if found:
        found += _operations(history, status.running, soon[:1])
    for branch in blueprint:
        for digit in range(branch.num_facts if branch.table else 0):
            spans = history.facts.get((branch.name, digit))
            if spans:
                name = branch.fact_name(digit)
                label = f"{branch.name} {name}" if several else name
                found.append(Lane(label, "fact", tuple(_facts(branch, digit, spans, words))))
    return tuple(found)


def present_blocks(
    blueprint: Blueprint, rows: Sequence[Lane], moment: RunMoment
) -> frozenset[tuple[int, int]]:
    """Return the blocks of a whole run that last at a moment of it: (number of the row, of the
    block).

    They follow the events, as all else that shows the moment. Several states may have the same
    time, so a time alone does not say which of them the run is in.
    """
    running = Address.read(moment.running) if moment.running else None
    found = []
    for number, row in enumerate(rows):
        at: tuple[float, str] | None = None
        if row.kind == "state":
            branch = blueprint[row.label if len(blueprint) > 1 else next(iter(blueprint)).name]
            if branch.name in moment.configuration and branch.name in moment.entered:
                state = short_name(branch, moment.configuration[branch.name])
                at = moment.entered[branch.name].since, state
        elif row.kind == "operation" and running is not None and moment.running_since is not None:
            at = moment.running_since, running.operation
        if at is not None:
            first = bisect_left(row.blocks, at[0], key=lambda block: block.start)
            same = takewhile(lambda one, at=at: one[1].start == at[0],  # type: ignore[misc]
                             enumerate(row.blocks[first:], first))  # fmt: skip
            found += [(number, one) for one, block in same if block.words == at[1]][-1:]
    return frozenset(found)


def _soon(blueprint: Blueprint, status: DispatchStatus, story: Story) -> tuple[Block, ...]:
    """Return the rest of the running operation and the state after it. Empty if its duration is not
    known.
    """
    whole, running = expected_duration(blueprint, status, story), status.running
    if whole is None or running is None or status.running_since is None:
        return ()
    end = status.running_since + whole
    if end <= status.time:
        return ()
    branch = blueprint[running.branch]
    target = short_name(branch, branch.table[running.state][running.operation])
    return (
        Block(status.time, end, f"to {end:.1f} s", "predicted"),
        Block(end, end + whole, target, "predicted"),
    )


def _states(branch: StateBranch, spans: Sequence[Span], ended: bool) -> Iterator[Block]:
    for span in spans:
        look = "now" if span.end is None and not ended else "past"
        yield Block(span.start, span.end, short_name(branch, span.words), look)


def _operations(
    history: RunHistory, running: Address | None, soon: tuple[Block, ...]
) -> Iterator[Lane]:
    """Yield the rows of operations, as many as there are operations at the same time.

    ``soon`` is the rest of the running operation, which comes at the end of its row.
    """
    rows: list[list[Span]] = [[]]
    for span in history.operations:
        free = (row for row in rows if not row or _is_over(row[-1], span.start))
        row = next(free, None)
        if row is None:
            row = []
            rows.append(row)
        row.append(span)
    name = str(running) if running is not None else ""
    going = next((row for row in rows if row and row[-1].words == name), rows[0])
    for number, row in enumerate(rows, 1):
        label = "Operation" if number == 1 else f"Operation {number}"
        rest = soon if row is going else ()
        yield Lane(label, "operation", (*map(_operation, row), *rest))


def _is_over(span: Span, time: float) -> bool:
    return span.end is not None and span.end <= time


def _operation(span: Span) -> Block:
    look = "now" if span.end is None else "past" if span.good else "bad"
    return Block(span.start, span.end, span.words.rpartition("/")[2], look)


def _facts(
    branch: StateBranch,
    digit: int,
    spans: Sequence[Span],
    words: Mapping[tuple[str, int], Mapping[str, str]],
) -> Iterator[Block]:
    known, said = branch.alphabet[digit], words.get((branch.name, digit), {})
    for span in spans:
        look = "past" if span.words in known else "beyond"
        shown = span.words if span.words in known else said.get(span.words, span.words)
        yield Block(span.start, span.end, shown, look if span.good else "unknown")
