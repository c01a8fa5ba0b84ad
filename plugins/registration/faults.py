"""The faults of the site, for tests and exercises."""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import TYPE_CHECKING, Any

import numpy as np

from smsl_studio.errors import WorldError
from smsl_studio.world.pose import check_amounts

from .phantom import NAME
from .tracker import REFERENCE

if TYPE_CHECKING:
    from smsl_studio.library.operation_library import OperationLibrary

    from .site import Site

Fault = Generator[None, None, None]


def occluded(site: Site, seconds: float = 2.0) -> Fault:
    """Somebody stands between the tracker and what it looks at, for a while."""
    site.tracker.occluded = True
    for _ in range(max(1, round(seconds / site.world.tick))):
        yield
    site.tracker.occluded = False


def reference_bumped(site: Site, millimetres: float = 5.0) -> None:
    """The reference frame is pushed aside by this way (mm), and stays there."""
    _push(site, REFERENCE, (0.6, 0.8, 0.0), millimetres)


def phantom_shifted(site: Site, millimetres: float = 5.0) -> None:
    """The phantom is pushed aside by this way (mm), and the reference is not."""
    _push(site, NAME, (0.8, 0.6, 0.0), millimetres)


def bent_pointer(site: Site, millimetres: float = 3.0) -> None:
    """The tip of the pointer is bent to the side by this way (mm), and nobody has calibrated it."""
    check_amounts("the pointer", "the way", [millimetres])
    site.bend = np.array([millimetres / 1000, 0.0, 0.0])


def noisy_tracker(site: Site, millimetres: float = 2.0) -> None:
    """The tracker measures with this standard deviation (mm) along each axis from now on."""
    check_amounts("the tracker", "the noise", [millimetres], least=0.0)
    site.tracker.noise = millimetres / 1000


def seized_joint(site: Site, joint: int = 2) -> None:
    """A joint of the arm (1 to 7, counted from the base) does not move any more."""
    if not 1 <= joint <= 7:
        raise WorldError(f"the arm has no joint {joint}", advice="Its joints are 1 to 7.")
    site.world.robot.seize(joint - 1)


FAULTS: tuple[Callable[..., Any], ...] = (
    occluded,
    reference_bumped,
    phantom_shifted,
    bent_pointer,
    noisy_tracker,
    seized_joint,
)


def register_faults(library: OperationLibrary) -> None:
    """Register the faults of the world ``registration``."""
    for function in FAULTS:
        library.fault("registration", function.__name__)(function)


def _push(site: Site, name: str, way: tuple[float, float, float], millimetres: float) -> None:
    check_amounts(name, "the way", [millimetres])
    (x, y, z), turned = site.world.pose(name)
    dx, dy, dz = (part * millimetres / 1000 for part in way)
    site.world.place(name, (x + dx, y + dy, z + dz), turned)
