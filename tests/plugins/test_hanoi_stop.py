"""A stop brakes the drives: the arm stays at its place and keeps the held ring."""

from __future__ import annotations

import numpy as np
import pytest

from smsl_studio.front.inputs import read
from smsl_studio.front.runs import open_run
from tests.plugins.hanoi_game import SAMPLES, Game

STILL = 0.005
"""The greatest speed (rad/s) of a joint 100 ms after a stop; a limp one falls at 1.27."""


def _speed(game: Game, ticks: int) -> float:
    """How fast the fastest joint turns (rad/s), over the last tick of so many."""
    game.wait(ticks - 1)
    before = game.world.robot.joints()
    game.wait(1)
    return float(np.abs(game.world.robot.joints() - before).max() / game.world.tick)


@pytest.mark.parametrize("ticks", [30, 160, 330, 420])
def test_a_braked_arm_stays_where_it_is(game: Game, ticks: int) -> None:
    """In the air, on the way down, and with a ring in the hand."""
    game.put("aaa")
    operation = game.start("1c")
    assert game.advance(operation, ticks)[0] == "running"
    held = game.read()
    operation.close()
    game.world.brake()
    assert _speed(game, 24) < STILL
    there = game.world.robot.joints()
    game.wait(480)
    assert np.abs(game.world.robot.joints() - there).max() < 0.002
    assert game.read() == held


def test_a_stopped_run_leaves_the_arm_standing() -> None:
    """Through the dispatcher: the command is taken before the next tick, and nothing moves on."""
    dispatcher = open_run(read(SAMPLES / "hanoi-2.json"), "hanoi", host="local", attended=True)
    dispatcher.open()
    while dispatcher.time < 1.4:
        dispatcher.tick()
    dispatcher.stop()
    dispatcher.tick()
    stopped = dispatcher.time
    for _ in range(24):
        dispatcher.tick()
    assert dispatcher.time == pytest.approx(stopped + 0.1)
    before = np.array(dispatcher.host.poses())
    for _ in range(240):
        dispatcher.tick()
    assert np.abs(np.array(dispatcher.host.poses()) - before).max() < 0.002
    assert dispatcher.time == pytest.approx(stopped + 1.1)
    dispatcher.close()
