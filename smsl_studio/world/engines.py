"""The engines that a world may be built on; each is loaded only when a world asks for it."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from smsl_studio.errors import WorldError

if TYPE_CHECKING:
    from smsl_studio.world.protocol import World

BULLET, TABLE = "bullet", "table"
ENGINES = (BULLET, TABLE)
USUAL = BULLET
"""What a plugin's world is built on that names no engine."""


def make_engine(engine: str, name: str) -> World:
    """A fresh, empty engine world called ``name``; WorldError where it is not installed."""
    if engine == TABLE:
        from smsl_studio.world.table import TableWorld

        return TableWorld(name)
    try:
        from smsl_studio.world.bullet import BulletWorld
    except ImportError as error:
        raise WorldError(
            f"the world {name!r} needs PyBullet, which cannot be loaded: {error}",
            advice="Install pybullet, or run in the world table.",
        ) from None
    return BulletWorld(name)


def preload() -> None:
    """Load the usual engine, so that a world that is built later stands sooner."""
    import_module("smsl_studio.world.bullet")
