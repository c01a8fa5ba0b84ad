"""An equal blueprint and seed give an equal run, bit for bit; another seed gives another table."""

from __future__ import annotations

import subprocess
import sys

import pytest

from smsl_studio.errors import WorldError
from tests.plugins.hanoi_game import Game

TRACE = """
import hashlib, struct
from tests.plugins.hanoi_game import Game
game = Game(seed=5)
game.put({state!r})
digest = hashlib.sha256()
generator = game.start({operation!r})
while game.advance(generator, 1)[0] == "running":
    digest.update(struct.pack(f"<{{len(game.world.poses())}}d", *game.world.poses()))
print(digest.hexdigest())
"""


def _trace(state: str, operation: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", TRACE.format(state=state, operation=operation)],
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout


def test_two_processes_agree_to_the_last_bit() -> None:
    first, second = _trace("aaa", "1c"), _trace("aaa", "1c")
    assert first == second
    assert len(first) == 65


def test_a_table_does_not_remember() -> None:
    """What an edge does in a sweep hangs on its source and the seed, not on the edges before."""
    game = Game(seed=5)
    game.put("caa")
    fresh = game.world.poses()
    game.run("2b")
    after = game.world.poses()
    game.put("cba")
    game.run("1a")
    game.put("caa")
    assert game.world.poses() == fresh
    assert game.world.time == 0.0
    game.run("2b")
    assert game.world.poses() == after
    game.world.close()


def test_the_seed_draws_the_jitter(game: Game) -> None:
    places = []
    for seed in (0, 1):
        game.table.seed = seed
        game.put("abc")
        assert game.read() == "abc"
        places.append([game.world.pose(disk.name)[0] for disk in game.table.disks])
    for disk, (first, second) in enumerate(zip(*places, strict=True)):
        assert first[:2] != second[:2]
        for x, y, _ in (first, second):
            assert abs(x - 0.5) < 0.0035
            assert abs(y - (disk - 1) * 0.14) < 0.0035


def test_a_snapshot_brings_everything_back(game: Game) -> None:
    game.put("aaa")
    generator = game.start("1c")
    game.advance_until(generator, "haa")
    game.advance(generator, 90)
    held = game.world.snapshot()
    game.world.apply(held)
    time, poses, status = game.world.time, game.world.poses(), game.world.status()
    game.wait(60)
    later = game.world.poses()
    game.run("1b")
    game.world.apply(held)
    assert (game.world.time, game.world.poses(), game.world.status()) == (time, poses, status)
    game.wait(60)
    assert game.world.poses() == later
    assert game.read() == "haa"


def test_a_fork_goes_its_own_way_from_the_same_instant(game: Game) -> None:
    game.put("aaa")
    generator = game.start("1c")
    game.advance(generator, 300)
    game.world.apply(game.world.snapshot())
    other = game.world.fork()
    poses = game.world.poses()
    assert other.poses() == poses
    for _ in range(40):
        other.step()
    assert game.world.poses() == poses
    game.wait(40)
    assert game.world.poses() == other.poses()
    other.close()
    game.wait(1)
    with pytest.raises(WorldError, match="not of a world built like"):
        game.world.apply(b"12345678")


def test_shapes_and_poses_belong_together(game: Game) -> None:
    game.put("aaa")
    shapes, poses = game.world.shapes(), game.world.poses()
    assert len(poses) == 7 * len(shapes)
    assert [shape.label for shape in shapes if shape.label] == ["a", "b", "c"]
    assert {f"disk_{n}" for n in (1, 2, 3)} < {shape.name for shape in shapes}
    assert all(len(shape.mesh) % 9 == 0 and shape.mesh for shape in shapes)
    assert 5_000 < sum(len(shape.mesh) for shape in shapes) / 9 < 60_000
