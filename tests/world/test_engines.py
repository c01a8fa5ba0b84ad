"""Engines: their names stand in one room, and each can be built on."""

from __future__ import annotations

from pathlib import Path

import pytest

import smsl_studio
from smsl_studio.world.engines import ENGINES, make_engine

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
