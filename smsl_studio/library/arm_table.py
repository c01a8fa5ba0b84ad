"""The table of arms: finds an arm by its name."""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules

from smsl_studio.errors import WorldError, did_you_mean
from smsl_studio.world import arms
from smsl_studio.world.bodies import Robot


def arm_names() -> tuple[str, ...]:
    """Return the names of all shared arms, in alphabetical order.

    >>> arm_names()
    ('dvrk', 'iiwa', 'panda')
    """
    return tuple(sorted(module.name for module in iter_modules(arms.__path__)))


def arm_named(name: str) -> Robot:
    """Return a shared arm. WorldError if there is none with this name."""
    known = arm_names()
    if name not in known:
        near = did_you_mean(name, known) or f"There are {', '.join(known)}."
        raise WorldError(f"there is no arm {name!r}", advice=near)
    found = import_module(f"{arms.__name__}.{name}").ARM
    assert isinstance(found, Robot)
    return found
