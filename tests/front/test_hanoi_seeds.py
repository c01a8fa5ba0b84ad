"""The game in physics from a start each: three millimetres of jitter, sensed at 50 Hz.

``benches/physics.py`` solves it from twenty and from a hundred.
"""

from __future__ import annotations

import pytest

from smsl_studio import front
from smsl_studio.shipped import samples_dir


@pytest.mark.parametrize(
    ("sample", "moves", "seed"),
    [("hanoi-corrected.json", 7, 0), ("hanoi-4.json", 15, 0)],
)
def test_every_start_reaches_the_goal(sample: str, moves: int, seed: int) -> None:
    run = front.run(front.read(samples_dir() / sample), "hanoi", seed=seed)
    assert run.reason == "goal_reached", run.sentence
    told = [event.as_json() for event in run.events]
    assert sum(event["event"] == "committed" for event in told) == moves
    checks = [event["result"] for event in told if event["event"] == "state_checked"]
    assert checks == ["true"] * (moves + 1)
