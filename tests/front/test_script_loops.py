"""A script that asks for an operation every time comes to an end, and the log says why."""

from __future__ import annotations

import json
from itertools import count
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.front.script.lines import script_of
from smsl_studio.runlog.events import Commanded, Committed, OperationRefused
from tests.plugin_folder import blueprint_of

DRAWN = {
    "S": {
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_2"},
        "State_0": {"stay": "State_0", "there": "State_1", "go": "State_2"},
        "State_1": {"back": "State_0"},
        "State_2": {},
    }
}
ENOUGH = 5_000
"""Ticks after which a run is stopped that does not end by itself."""


def _asks(state: str, operation: str, **more: Any) -> dict[str, Any]:
    address = f"S/{state}/{operation}"
    return {"when": f"S/{state}", "do": "ask", "address": address, "times": "every", **more}


def _run(*lines: dict[str, Any]) -> smsl.Run:
    blueprint = blueprint_of(DRAWN)
    raw = "\n".join(map(json.dumps, lines)).encode()
    ticks = count()
    script = script_of(raw, "script", blueprint)
    return smsl.run(blueprint, script=script, stop_when=lambda: next(ticks) > ENOUGH)


@pytest.mark.parametrize(
    ("lines", "operation"),
    [
        ([_asks("State_0", "stay")], "S/State_0/stay"),
        ([_asks("State_0", "stay", by="Ada"), {"at": 0.0, "do": "by_hand"}], "S/State_0/stay"),
        ([{"at": 0.0, "do": "by_hand"}, _asks("State_0", "stay", after=0.1)], "S/State_0/stay"),
        ([_asks("State_0", "there"), _asks("State_1", "back")], "S/State_0/there"),
    ],
    ids=["a self loop", "by hand", "later each time", "there and back"],
)
def test_what_a_script_asks_every_time_is_refused_at_last(
    lines: list[dict[str, Any]], operation: str
) -> None:
    run = _run(*lines)
    assert run.reason != "stopped", run.sentence
    words = f"{operation} was begun 100 times from S/State_0 without getting further."
    asked = [e for e in run.events if isinstance(e, Commanded) and e.command == "ask"]
    assert [one.refused for one in asked if one.refused] == [words]
    refused = [event for event in run.events if isinstance(event, OperationRefused)]
    assert [one.reasons for one in refused] == [(words,)]
    done = [event for event in run.events if isinstance(event, Committed)]
    assert sum(event.operations == (operation,) for event in done) == 100
    assert run.sentence


def test_what_is_asked_a_number_of_times_is_the_choice_of_whoever_wrote_it() -> None:
    """The guard is for what has no end: single lines are carried out, however many there are."""
    address = "S/State_0/stay"
    run = _run(
        {"at": 0.0, "do": "by_hand"},
        *({"at": 0.05 * n, "do": "ask", "address": address} for n in range(120)),
    )
    done = [event for event in run.events if isinstance(event, Committed)]
    assert [event.operations for event in done] == [(address,)] * 120
