"""Events are read from a log exactly as they were written, and nothing else is read."""

from __future__ import annotations

import json
from dataclasses import fields
from typing import Any

import pytest
from hypothesis import given, settings

from smsl_studio.runlog.decoder import EVENTS, event_of
from smsl_studio.runlog.events import Committed, Event, FactChanged, RunFinished, RunStarted
from tests.counts import share_of
from tests.runlog.any_event import events


@given(events())
@settings(max_examples=share_of(150))
def test_an_event_comes_back_from_its_line(event: Event) -> None:
    text = event.line().encode("utf-8", "backslashreplace").decode("utf-8")
    found = event_of(json.loads(text))
    assert type(found) is type(event)
    assert found.line() == event.line()


def test_no_event_has_a_field_of_the_chain() -> None:
    assert not any(
        item.name in ("chain", "head", "log") for kind in EVENTS.values() for item in fields(kind)
    )


def test_what_has_a_default_may_be_missing() -> None:
    found = event_of({"event": "fact_changed", "t": 1, "branch": "SB", "digit": 0, "value": None})
    assert found == FactChanged(t=1, branch="SB", digit=0, value=None)


PAUSED = {"event": "paused", "t": 0.0}
COMMITTED = Committed(t=0.0, operations=("a",), configuration={"SB": "S"}).as_json()
STARTED = RunStarted(t=0.0, world="w", seed=0, start={}, goals=()).as_json()
FINISHED = RunFinished(t=0.0, reason="", sentence="", operations=0, configuration={}).as_json()


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({}, "no event"),
        ({"event": 1}, "no event"),
        ({"event": "pausd", "t": 0}, "Did you mean paused?"),
        ({"event": "x" * 10**6, "t": 0}, "there is no event"),
        ({"event": "paused"}, "lacks 't'"),
        ({**PAUSED, "wall_time": 1}, "has no 'wall_time'"),
        *(
            ({**PAUSED, "t": t}, "t of the event paused is no number")
            for t in ("0", None, True, 10**400, 1e300, float("nan"), float("-inf"), [0])
        ),
        ({**COMMITTED, "operations": "a"}, "operations of the event committed is no list"),
        ({**COMMITTED, "operations": [1]}, "is no text"),
        ({**COMMITTED, "configuration": []}, "is no map of names"),
        ({**COMMITTED, "configuration": {"SB": 1}}, "is no text"),
        ({**STARTED, "seed": 1.0}, "is no whole number"),
        ({**STARTED, "seed": True}, "is no whole number"),
        ({**FINISHED, "operations": None}, "is no whole number"),
        ({"event": "mismatch", "t": 0, "facts": [], "candidates": [[]]}, "is no map of names"),
        ({"event": "edge_swept", "t": 0, "address": "", "passed": 1}, "is no yes or no"),
    ],
)
def test_anything_else_is_refused_in_a_sentence(values: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match="event") as caught:
        event_of(values)
    assert words in str(caught.value)
    assert len(str(caught.value)) < 300
