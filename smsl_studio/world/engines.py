"""The engines of worlds. An engine is loaded only when a world needs it."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from smsl_studio.errors import WorldError

if TYPE_CHECKING:
    from smsl_studio.world.protocol import World

BULLET, MUJOCO, TABLE = "bullet", "mujoco", "table"
REMOTE = "remote"
"""The world that is a program somewhere else. It has no engine here."""
ENGINES = (BULLET, MUJOCO, TABLE)
USUAL = BULLET
"""The engine of a plugin's world that names none."""


def make_engine(engine: str, name: str) -> World:
    """Return a new, empty world with the name ``name`` on an engine. WorldError if the engine is
    not installed."""
    if engine == TABLE:
        from smsl_studio.world.table import TableWorld

        return TableWorld(name)
    if engine == MUJOCO:
        try:
            from smsl_studio.world.mujoco_world import MujocoWorld
        except ImportError as error:
            raise WorldError(
                f"the world {name!r} needs MuJoCo, which cannot be loaded: {error}",
                advice="Install smsl-studio[mujoco], or run in another world.",
            ) from None
        return MujocoWorld(name)
    try:
        from smsl_studio.world.bullet import BulletWorld
    except ImportError as error:
        raise WorldError(
            f"the world {name!r} needs PyBullet, which cannot be loaded: {error}",
            advice="Install pybullet, or run in the world table.",
        ) from None
    return BulletWorld(name)


def preload() -> None:
    """Import the usual engine, so that a later world is built faster."""
    import_module("smsl_studio.world.bullet")
