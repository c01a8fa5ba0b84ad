"""The last events of a node: how its facts have changed, the newest first."""

from __future__ import annotations

from smsl_studio.front.views.room_events import RoomEvent, room_events
from smsl_studio.front.views.room_view import RoomFact
from smsl_studio.runlog.history import RunHistory

SAID = (("0", "force < 1 N"), ("1", "force > 2 N"))


def fact(key: str, name: str) -> RoomFact:
    return RoomFact(key, name, "1", "", "", SAID, ("clamp",), "Clamp", 0.0, ())


def test_the_newest_changes_come_first() -> None:
    history = RunHistory()
    history.sense(0.0, ("SB", 0), "0")
    history.sense(2.0, ("SB", 1), "1")
    history.sense(3.0, ("SB", 0), None)
    facts = (fact("SB/0", "Clamp fixed"), fact("SB/1", "Lamp on"))
    assert room_events(facts, history) == (
        RoomEvent(3.0, "Clamp fixed is unknown", False),
        RoomEvent(2.0, "Lamp on is 1", True, "force > 2 N"),
        RoomEvent(0.0, "Clamp fixed is 0", True, "force < 1 N"),
    )
    assert len(room_events(facts, history, most=1)) == 1
    assert room_events((fact("elsewhere", "x"),), history) == ()
