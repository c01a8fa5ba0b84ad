"""Engines: their names stand in one room, and each can be built on."""

from __future__ import annotations

from pathlib import Path

import pytest

import smsl_studio
from smsl_studio.errors import WorldError
from smsl_studio.world.bodies import Body, Box, Floor
from smsl_studio.world.bullet import BulletWorld
from smsl_studio.world.engines import ENGINES, TABLE, make_engine
from smsl_studio.world.mujoco_world import MujocoWorld

PACKAGE = Path(smsl_studio.__file__).parent


ROOMS = ("host", "library", "front", "dispatch", "monitor", "inspection", "runlog")


def test_names_of_engines_stand_in_the_room_of_worlds_alone() -> None:
    files = [path for room in ROOMS for path in (PACKAGE / room).rglob("*.py")]
    assert len(files) > len(ROOMS)
    quoted = [f"{mark}{name}{mark}" for name in ENGINES for mark in "\"'"]
    found = [path.name for path in files if any(name in path.read_text("utf-8") for name in quoted)]
    assert found == []


@pytest.mark.parametrize("engine", ENGINES)
def test_every_engine_gives_an_empty_world(engine: str) -> None:
    world = make_engine(engine, "here")
    try:
        assert (world.time, world.shapes()) == (0.0, ())
    finally:
        world.close()


@pytest.mark.parametrize("engine", [name for name in ENGINES if name != TABLE])
@pytest.mark.parametrize(("height", "depth"), [(0.02, 40), (0.05, 10)])
def test_two_things_in_one_place_are_refused_and_not_thrown_apart(
    engine: str, height: float, depth: int
) -> None:
    world = make_engine(engine, "here")
    assert isinstance(world, BulletWorld | MujocoWorld)
    world.add(Body("table", Floor(), (0.0, 0.0, 0.0)))
    world.add(Body("low", Box((0.02, 0.02, 0.02)), (0.0, 0.0, 0.02), mass=0.1))
    world.add(Body("high", Box((0.02, 0.02, 0.02)), (0.0, 0.0, height), mass=0.1))
    words = f"'high' and 'low' are in one place in the world 'here': they overlap by {depth} mm"
    with pytest.raises(WorldError, match=words):
        world.settle()
    assert world.time == 0.0
    world.place("high", (0.0, 0.0, 0.0601))
    world.settle()
    assert world.pose("high")[0][2] == pytest.approx(0.06, abs=1e-3)
    world.close()
