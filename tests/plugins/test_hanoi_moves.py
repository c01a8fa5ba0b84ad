"""The Panda carries rings in the simulation: its motions and its failures."""

from __future__ import annotations

import pytest

from smsl_studio.errors import WorldError
from tests.plugins.hanoi_game import Game


def test_seven_moves_bring_the_tower_to_c(game: Game) -> None:
    game.put("aaa")
    assert game.read() == "aaa"
    for operation, state in zip(
        ("1c", "2b", "1b", "3c", "1a", "2c", "1c"),
        ("caa", "cba", "bba", "bbc", "abc", "acc", "ccc"),
        strict=True,
    ):
        returned, seconds = game.run(operation)
        assert returned is True
        assert game.read() == state
        assert 1.5 < seconds < 5.0


@pytest.mark.parametrize(("count", "moves", "end"), [(2, "1b2c1c", "cc"), (4, "1b2c1c3b", "ccba")])
def test_two_and_four_disks(count: int, moves: str, end: str) -> None:
    game = Game(count, seed=3)
    game.put("a" * count)
    for i in range(0, len(moves), 2):
        assert game.run(moves[i : i + 2])[0] is True
    assert game.read() == end
    game.world.close()


def test_a_disk_that_is_there_already_is_left_alone(game: Game) -> None:
    """So a misprint fails: Op_1c from cbb claims bbb, and disk 1 is on c before and after."""
    game.put("cbb")
    assert game.run("1c") == (True, 0.0)
    assert game.read() == "cbb"


def test_a_covered_disk_is_not_gripped(game: Game) -> None:
    game.put("aaa")
    assert game.run("3c") == (False, 0.0)
    assert game.read() == "aaa"


def test_a_grasp_that_closes_on_air_fails(game: Game) -> None:
    game.put("baa")
    generator = game.start("1c")
    assert game.advance(generator, 130)[0] == "running"
    game.world.place("disk_1", (0.62, 0.3, 0.009))
    assert game.advance(generator)[0] is False
    assert game.read() == "xaa"


def test_a_disk_that_is_lost_on_the_way_fails(game: Game) -> None:
    game.put("baa")
    generator = game.start("1c")
    game.advance_until(generator, "haa")
    game.advance(generator, 60)
    game.world.robot.open()
    assert game.advance(generator)[0] is False
    assert game.read() in {"baa", "xaa"}


def test_a_disk_in_the_hand_is_carried_on(game: Game) -> None:
    """A hold in mid-air ends the call; the next one begins with what is in the hand."""
    game.put("baa")
    generator = game.start("1c")
    game.advance_until(generator, "haa")
    game.advance(generator, 100)
    generator.close()
    game.world.brake()
    game.wait(120)
    assert game.read() == "haa"
    assert game.run("2c") == (False, 0.0)
    assert game.run("1c")[0] is True
    assert game.read() == "caa"


def test_a_disk_that_is_not_there_raises(game: Game) -> None:
    game.put("aaa")
    with pytest.raises(WorldError, match="there is no disk 9"):
        next(game.start("9a"))
    with pytest.raises(WorldError, match="there is no peg 'z'"):
        next(game.start("1z"))
