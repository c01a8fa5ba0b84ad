"""The last events of a node of the room: how the facts that it feeds have changed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.address import split_fact
from smsl_studio.front.views.room_view import RoomFact
from smsl_studio.runlog.history import RunHistory

MOST = 7
UNKNOWN = "?"


@dataclass(frozen=True)
class RoomEvent:
    """A change of a fact: at which time of the run (simulated s), in words, and whether it is
    known since then. ``why`` is when it has this value, empty if nothing is written."""

    time: float
    words: str
    known: bool
    why: str = ""


def room_events(
    facts: Sequence[RoomFact], history: RunHistory, most: int = MOST
) -> tuple[RoomEvent, ...]:
    """Return the newest changes of facts, the newest first."""
    found: list[RoomEvent] = []
    for fact in facts:
        key = split_fact(fact.key)
        spans = history.facts.get(key, []) if key is not None else []
        said = dict(fact.predicates)
        for span in spans[-most:]:
            known = span.words != UNKNOWN
            words = f"{fact.name} is {span.words if known else 'unknown'}"
            found.append(RoomEvent(span.start, words, known, said.get(span.words, "")))
    found.sort(key=lambda one: one.time, reverse=True)
    return tuple(found[:most])
