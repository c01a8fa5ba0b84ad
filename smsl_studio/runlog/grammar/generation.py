"""The rule for edges that were generated during a run."""

from __future__ import annotations

import re
from collections.abc import Iterator

from smsl_studio.blueprint.address import split_fact
from smsl_studio.runlog import events as run
from smsl_studio.runlog.grammar.memory import Memory, parts

_DIGEST = re.compile("[0-9a-f]{64}")


def edge_generated(memory: Memory, event: run.EdgeGenerated) -> Iterator[str]:
    """Check that the edge leaves where its SB stands, that nothing is carried out, and that the
    named person has just allowed it.
    """
    address, named = event.address, parts(event.address)
    if len(named) != 3 or not memory.knows(named[0]) or not event.target:
        yield f"{address!r} is no operation of this run"
        return
    branch, source, _ = named
    if memory.stands(branch) != source or memory.begun:
        yield f"{address} is generated, and the run does not stand in {source}"
    if memory.known.made(named):
        yield f"{address} is generated for the second time"
    if not memory.evidence.is_drawn(branch, event.target):
        yield f"{address} is generated; {branch} has no {event.target}"
    if not event.facts or any(split_fact(key) is None for key in event.facts):
        yield f"{address} is generated and changes no fact"
    if not (event.function and event.provider and _DIGEST.fullmatch(event.proposal)):
        yield f"{address} is generated, and nothing says of what"
    closed = memory.last
    by = [*closed.answers] if isinstance(closed, run.TaskClosed) and closed.answer == ALLOW else []
    if memory.allowed != (address, event.t) or by != [event.by]:
        yield f"{address} is generated, and {event.by or 'nobody'} has not allowed it"


ALLOW = "allow"
"""The answer that lets a generated edge count."""
