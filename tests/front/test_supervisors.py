"""At the level automatic an agent supervises the run, from every way to start it."""

from __future__ import annotations

import json

from smsl_studio import front
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.inputs import read_bytes
from smsl_studio.runlog.events import Committed, Event

AUTOMATIC = {"supervision": "automatic"}


def _rated(near: str, far: str) -> Blueprint:
    """Two ways from a to c: ``near`` is the risk of the cheap one, ``far`` of the other."""
    priced: dict[str, dict[str, object]] = {
        "Near": {"risk": near},
        "Far": {"risk": far, "cost": 5},
        "On": {"risk": far},
    }
    notes = {name: {k: v for k, v in note.items() if v} for name, note in priced.items()}
    values = {
        "SB": {
            "_operations": notes,
            "State_a": {"Near": "State_c", "Far": "State_b"},
            "State_b": {"On": "State_c"},
            "State_c": {},
        }
    }
    return read_bytes(json.dumps(values).encode(), "rated.json")


def _committed(events: tuple[Event, ...]) -> list[str]:
    return [name for e in events if isinstance(e, Committed) for name in e.operations]


def test_what_is_too_risky_is_refused_and_another_way_is_taken() -> None:
    run = front.run(_rated("high", "medium"), levels=AUTOMATIC)
    assert run.reason == "goal_reached"
    assert _committed(run.events) == ["SB/State_a/Far", "SB/State_b/On"]


def test_what_is_not_rated_is_nobodys_to_allow() -> None:
    run = front.run(_rated("", "low"), levels=AUTOMATIC)
    assert run.reason == "held"
    assert "No risk is declared for SB/State_a/Near" in run.sentence
    assert not _committed(run.events)


def test_where_people_supervise_no_agent_decides() -> None:
    assert _committed(front.run(_rated("high", "low")).events) == ["SB/State_a/Near"]
