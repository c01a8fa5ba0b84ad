"""Which class drives a world: the engines a plugin may ask for, loaded only when one does."""

from __future__ import annotations

from smsl_studio.errors import WorldError
from smsl_studio.world.protocol import World


def make_engine(engine: str, name: str) -> World:
    """A fresh, empty engine world called ``name``; WorldError where it is not installed."""
    if engine == "table":
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
