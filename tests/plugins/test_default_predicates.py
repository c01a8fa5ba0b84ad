"""The default predicates of the shipped plugins say the same as the code that operations ask."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest

from plugins.chess.board import BLOCKS, PIECES, Board
from plugins.chess.plugin import register as chess
from plugins.hanoi.disks import PEGS
from plugins.hanoi.plugin import register as hanoi
from plugins.hanoi.table import Table
from plugins.registration.navigation import Fit
from plugins.registration.phantom import COUNT, NAME
from plugins.registration.plugin import register as registration
from plugins.registration.site import DIGITIZED, Site
from plugins.registration.tracker import REFERENCE
from plugins.river.crossing import BANKS, HEIGHT, ITEMS, SEATS, Crossing
from plugins.river.plugin import register as river
from smsl_studio import front
from smsl_studio.host.default_decision import decided
from smsl_studio.library.arm_table import arm_named
from smsl_studio.library.fact_default import default_of
from smsl_studio.library.operation_library import OperationLibrary

ROOT = Path(__file__).parents[2]
SCENES = 1500
ON_PEGS = 1007
"""How often a ring of the scenes is on a peg, whatever its size."""
FLAT = (0.0, 0.0, 0.0, 1.0)
Pose = tuple[tuple[float, float, float], tuple[float, float, float, float]]


class Poses:
    """A world that has only poses, and how many fingers touch a body."""

    def __init__(self) -> None:
        self.found: dict[str, Pose] = {}
        self.fingers: dict[str, int] = {}
        self.revision = 0

    def pose(self, name: str) -> Pose:
        return self.found[name]

    def place(self, name: str, position: tuple[float, float, float]) -> None:
        """What is only shown is sensed by nothing."""

    def fingers_on(self, name: str) -> int:
        return self.fingers.get(name, 0)


def turned(chance: Random, most: float) -> tuple[float, float, float, float]:
    """A turn around x by up to so many degrees, often none."""
    angle = np.radians(chance.choice((0.0, 0.0, 0.0, chance.uniform(-most, most), 180.0)) / 2)
    return float(np.sin(angle)), 0.0, 0.0, float(np.cos(angle))


def near(chance: Random, value: float, most: float) -> float:
    return value + chance.choice((0.0, 0.0, chance.uniform(-most, most)))


def reader(register: Callable[[OperationLibrary], None], name: str) -> Callable[..., str | None]:
    """The default predicates of the sensor with this pattern, by its number."""
    library = OperationLibrary("x")
    register(library)
    (entry,) = (one for one in library.sensors if one.pattern.text == name)
    made: dict[int, Callable[[Any], str | None]] = {}

    def read(subject: Any, number: int) -> str | None:
        if number not in made:
            texts = {"n": str(number)}
            made[number] = decided(
                default_of(entry.predicate, entry.otherwise, texts, library.sensors)
            )
        return made[number](subject)

    return read


@pytest.mark.parametrize("robot", ["panda", "dvrk"])
def test_hanoi(robot: str) -> None:
    chance, seen, on_pegs = Random(1), set[str | None](), 0
    read = reader(hanoi, "disk_{n}_peg")
    for _ in range(SCENES):
        world = Poses()
        table = Table(world, 3, 0, arm_named(robot))  # type: ignore[arg-type]
        size = table.size
        for disk in table.disks:
            x, y = chance.choice([*table.pegs.values()])
            height = size * chance.choice((0.009, 0.027, 0.045, 0.009, 0.9 / size))
            aside, above = 0.01 * size, 0.006 * size
            place = near(chance, x, aside), near(chance, y, aside), near(chance, height, above)
            world.found[disk.name] = place, turned(chance, 12.0)
            world.fingers[disk.name] = chance.choice((0, 0, 0, 1, 2))
        if chance.random() < 0.05:
            world.found["disk_2"] = (2.0, 0.0, 0.0), FLAT
        for disk in table.disks:
            value = read(table, disk.number)
            assert value == table.reading(disk)
            seen.add(value)
            on_pegs += value in PEGS
    assert seen == {"a", "b", "c", "h", "x", None}
    # The smaller rings are read as exactly, for their size, as the larger ones.
    assert on_pegs == ON_PEGS


def test_river() -> None:
    chance, seen = Random(2), set[str | None]()
    world, read = Poses(), reader(river, "item_{n}_place")
    crossing = Crossing(world, front.read(ROOT / "plugins/river/river.json"), 0)  # type: ignore[arg-type]
    for _ in range(SCENES):
        for number, item in enumerate(ITEMS, 1):
            value = chance.choice([*BANKS])
            y, ground = BANKS[value]
            x = chance.choice(SEATS[value])
            place = (
                near(chance, x, 0.1),
                near(chance, y, 0.1),
                near(chance, ground + HEIGHT / 2, 0.006),
            )
            world.found[item] = place, turned(chance, 15.0)
            world.fingers[item] = chance.choice((0, 0, 1, 2))
            said = read(crossing, number)
            assert said == crossing.reading(item)
            seen.add(said)
    assert seen == {"0", "B", "1", "h", "x"}


def test_chess() -> None:
    chance, seen = Random(3), set[str | None]()
    world, read = Poses(), reader(chess, "piece_{n}_block")
    board = Board(world, front.read(ROOT / "plugins/chess/chess.json"), 0)  # type: ignore[arg-type]
    for _ in range(SCENES):
        for piece in PIECES:
            x, y = chance.choice([*BLOCKS.values()])
            place = near(chance, x, 0.03), near(chance, y, 0.03), near(chance, 0.019, 0.006)
            world.found[piece] = place, turned(chance, 15.0)
            world.fingers[piece] = chance.choice((0, 0, 1, 2))
        if chance.random() < 0.5:
            upper, lower = chance.sample(PIECES, 2)
            x, y, z = world.found[lower][0]
            place = near(chance, x, 0.012), near(chance, y, 0.012), near(chance, z + 0.026, 0.006)
            world.found[upper] = place, world.found[upper][1]
        for number, piece in enumerate(PIECES, 1):
            said = read(board, number)
            assert said == board.reading(piece)
            seen.add(said)
    assert {*(block + layer for block in BLOCKS for layer in "BT"), "hh", "xx"} == seen


@pytest.mark.parametrize("file", ["registration", "registration-digitization"])
def test_registration(file: str) -> None:
    chance, seen = Random(4), set[tuple[str, str | None]]()
    world = Poses()
    blueprint = front.read(ROOT / "samples" / f"{file}.json")
    navigation, digitization = (
        reader(registration, "navigation_{n}"),
        reader(registration, "digitization_{n}"),
    )
    world.found = {NAME: ((0.5, 0.0, 0.1), FLAT), REFERENCE: ((0.6, 0.2, 0.1), FLAT)}
    site = Site(world, blueprint, 0)  # type: ignore[arg-type]
    for _ in range(300):
        here = near(chance, 0.5, 0.0007)
        world.found[NAME] = (here, 0.0, 0.1), FLAT
        now = site.navigation.without_plan().without_pose()
        stand = site.tracker.stand
        if chance.random() < 0.6:
            now = now.with_plan(site.plan())
        for number in range(chance.choice((0, COUNT - 1, COUNT, COUNT))):
            now = now.with_measure(number, np.zeros(3), stand)
        if chance.random() < 0.5:
            error = chance.choice((0.0002, 0.0005, 0.0007))
            now = now.registered(Fit(np.eye(3), np.zeros(3), error, stand))
        site.navigation = now
        if chance.random() < 0.5:
            site.plan_pose()
        world.found[NAME] = (near(chance, here, 0.0009), 0.0, 0.1), FLAT
        site.tracker.occluded = chance.random() < 0.2
        for number in range(1, blueprint[site.root].num_facts + 1):
            meaning = site.meaning(site.root, number - 1)
            said = navigation(site, number)
            assert said == site.reading(meaning)
            seen.add((meaning, said))
        assert digitization(site, 1) == site.reading(DIGITIZED)
    assert {said for meaning, said in seen if meaning == DIGITIZED} == {"0", "1", None}
    assert {said for meaning, said in seen if meaning == "registered"} == {"0", "1", None}
