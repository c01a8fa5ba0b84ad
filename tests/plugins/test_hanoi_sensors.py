"""The readings of the sensors: pegs only for legal stacks, other values in all other cases."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plugins.hanoi.disks import PEGS, disks_for
from plugins.hanoi.table import Table
from smsl_studio.errors import WorldError
from smsl_studio.world.bullet import BulletWorld
from tests.counts import share_of
from tests.plugins.hanoi_game import Game, library, sample

LOW, HIGH = 0.009, 0.027


@pytest.mark.parametrize("state", ["aaa", "abc", "cab", "bbc", "ccc"])
def test_what_was_put_up_is_read(game: Game, state: str) -> None:
    game.put(state)
    assert game.read() == state


def test_a_larger_disk_on_a_smaller_one_is_on_no_peg(game: Game) -> None:
    """By position alone this would be the legal state ccb."""
    game.put("cab")
    assert game.run("2c")[0] is True
    assert game.read() == "cxb"


def test_everything_above_a_wrong_pair_is_on_no_peg(game: Game) -> None:
    x, y = PEGS["c"]
    for disk, height in (("disk_2", 0.009), ("disk_3", 0.027), ("disk_1", 0.045)):
        game.world.place(disk, (x, y, height))
    assert game.read() == "xcx"


def test_held_in_the_hand(game: Game) -> None:
    game.put("aaa")
    seen: list[str] = []
    generator = game.start("1c")
    while game.advance(generator, 5)[0] == "running":
        if game.read() not in seen[-1:]:
            seen.append(game.read())
    assert [state for state in seen if state != "xaa"] == ["aaa", "haa", "caa"]


@pytest.mark.parametrize(
    ("place", "value"),
    [
        ((0.5, 0.07, LOW), "x"),  # between two pegs
        ((0.5, 0.0095, LOW), "x"),  # leaning at a peg from outside
        ((0.5, 0.0, HIGH), "x"),  # over a peg, but in the air
        ((0.5, 0.003, LOW), "b"),  # not in the middle, and still on the peg
        ((0.5, 0.9, LOW), "?"),  # out of sight
        ((0.5, 0.0, -0.3), "?"),
    ],
)
def test_off_the_pegs(game: Game, place: tuple[float, float, float], value: str) -> None:
    game.put("aaa")
    game.world.place("disk_1", place)
    assert game.read() == f"{value}aa"


def test_a_tilted_disk_rests_nowhere(game: Game) -> None:
    game.put("aaa")
    game.world.place("disk_1", (0.5, 0.0, LOW), (0.0871557, 0.0, 0.0, 0.9961947))
    assert game.read() == "xaa"


class Poses:
    """Only the poses of rings, and how many fingers press on them."""

    revision = 0

    def __init__(self, found: dict[str, tuple[float, float, float]], held: str) -> None:
        self._found, self._held = found, held

    def pose(self, name: str) -> tuple[tuple[float, float, float], tuple[float, ...]]:
        return self._found[name], (0.0, 0.0, 0.0, 1.0)

    def fingers_on(self, name: str) -> int:
        return 2 if name == self._held else 0


heights = st.sampled_from([0.009, 0.027, 0.045, 0.063, 0.018])
spots = st.sampled_from([*PEGS.values(), (0.5, 0.07), (0.52, -0.14)])


@settings(max_examples=share_of(300))
@given(st.lists(st.tuples(spots, heights), min_size=3, max_size=3), st.integers(0, 3))
def test_pegs_are_said_only_of_legal_stacks(
    places: list[tuple[tuple[float, float], float]], held: int
) -> None:
    """Whatever is read as a, b, c must be a tower without gaps that shrinks upwards."""
    disks = disks_for(3)
    found = {d.name: (*spot, z) for d, (spot, z) in zip(disks, places, strict=True)}
    table = Table(Poses(found, f"disk_{held}"), 3, 0)  # type: ignore[arg-type]
    read = {disk: table.reading(disk) for disk in disks}
    for peg in PEGS:
        tower = sorted((found[d.name][2], -d.number) for d in disks if read[d] == peg)
        assert [z for z, _ in tower] == [0.009, 0.027, 0.045][: len(tower)]
        assert [n for _, n in tower] == sorted(n for _, n in tower)
    assert all((read[d] == "h") == (d.number == held) for d in disks)


@pytest.mark.parametrize("count", [1, 5])
def test_only_the_numbers_of_disks_that_were_built(count: int) -> None:
    with pytest.raises(WorldError, match=f"has {count} fact"):
        disks_for(count)


def test_a_blueprint_of_two_branches_has_no_table() -> None:
    world = BulletWorld("hanoi")
    with pytest.raises(WorldError, match="one State Branch"):
        library().worlds["hanoi"].build(world, sample("hfsm.json"), 0)
    world.close()


def test_facts_that_are_no_pegs_cannot_be_put_up(game: Game) -> None:
    with pytest.raises(WorldError, match="there are the pegs a, b and c"):
        game.put("a0a")
