"""An operation that a command begins or resumes can be reached by the next command, too."""

from __future__ import annotations

import json

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.front.runs import open_run
from smsl_studio.front.script.lines import script_of
from smsl_studio.runlog.events import Event
from smsl_studio.shipped import samples_dir

HANOI = smsl.read(samples_dir() / "hanoi-corrected.json")
FIRST = Address("SB1", "State_aaa", "Op_1c")


def _words(events: tuple[Event, ...]) -> list[str]:
    return [event.event for event in events]


def test_an_operation_that_was_asked_for_can_be_paused_before_it_ends() -> None:
    dispatcher = open_run(HANOI, host="local", automatic=False, attended=True)
    dispatcher.open()
    dispatcher.ask(FIRST)
    assert _words(dispatcher.tick())[-1] == "operation_started"
    assert dispatcher.under_way == FIRST
    dispatcher.pause()
    assert _words(dispatcher.tick()) == ["commanded", "paused"]
    assert dispatcher.under_way is None
    dispatcher.take(COMMANDS["resume"].command())
    assert _words(dispatcher.tick()) == ["commanded", "resumed"]
    assert dispatcher.under_way == FIRST
    events = dispatcher.tick()
    assert _words(events)[0:1] == ["fact_changed"]
    assert "committed" in _words(events)
    assert events[0].t == dispatcher.opened.tick if dispatcher.opened else 0
    dispatcher.close()


def test_a_script_meets_an_operation_that_was_asked_for() -> None:
    lines = (
        {"do": "by_hand"},
        {"at": 0.1, "do": "ask", "address": str(FIRST)},
        {"during": str(FIRST), "do": "inject", "fault": "fail"},
    )
    raw = "\n".join(map(json.dumps, lines)).encode()
    run = smsl.run(HANOI, script=script_of(raw, "script", HANOI))
    (ended,) = (event.as_json() for event in run.events if event.event == "operation_ended")
    assert (ended["outcome"], run.left) == ("failed", ())
