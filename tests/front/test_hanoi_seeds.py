"""The game of four disks in physics: three millimetres of jitter, sensed at 50 Hz.

``test_hanoi.py`` has that of three. ``benches/physics.py`` solves both from many starts.
"""

from __future__ import annotations

from smsl_studio import front
from smsl_studio.shipped import samples_dir


def test_fifteen_moves_reach_the_goal() -> None:
    run = front.run(front.read(samples_dir() / "hanoi-4.json"), "hanoi", seed=0)
    assert run.reason == "goal_reached", run.sentence
    told = [event.as_json() for event in run.events]
    assert sum(event["event"] == "committed" for event in told) == 15
    checks = [event["result"] for event in told if event["event"] == "state_checked"]
    assert checks == ["true"] * 16
