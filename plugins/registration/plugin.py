"""Image registration in physics: landmarks are planned in an image, touched on a phantom while a
tracker watches, and fitted (paper, the registration example; its operations are those of the
appendix).

Facts have the values 0 and 1. Facts that the tracker has to see are unknown while something is in
its way.
"""

from __future__ import annotations

from collections.abc import Generator, Mapping
from typing import TYPE_CHECKING

from smsl_studio.library.operation_library import Availability
from smsl_studio.world.motions import wait

from .faults import register_faults
from .moves import digitize, stations_of
from .navigation import GOOD
from .phantom import COUNT
from .sensors import register_sensors
from .site import ARM, DIGITIZED, Site

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import Blueprint
    from smsl_studio.library.operation_library import OperationLibrary
    from smsl_studio.world.bullet import BulletWorld

Work = Generator[None, None, bool]

SHORT = 48
"""How many ticks an entry at the screen takes."""


def plan_landmarks(site: Site) -> Work:
    """Plan landmarks in the image. What was measured for other ones is void."""
    yield from wait(SHORT)
    site.navigation = site.navigation.with_plan(site.plan())
    return True


def clear_landmarks(site: Site) -> Work:
    """Forget the plan, and all that was made of it; what was saved stays."""
    yield from wait(SHORT)
    site.navigation = site.navigation.without_plan()
    return True


def plan_tool(site: Site) -> Work:
    """Plan the pose of the tool in the image."""
    yield from wait(SHORT)
    site.plan_pose()
    return True


def clear_tool(site: Site) -> Work:
    """Forget the planned pose of the tool."""
    yield from wait(SHORT)
    site.navigation = site.navigation.without_pose()
    return True


def digitize_all(site: Site) -> Work:
    """Touch and measure every landmark."""
    return (yield from digitize(site, range(COUNT)))


def digitize_missing(site: Site) -> Work:
    """Touch and measure the landmarks that were not measured yet."""
    missing = [number for number in range(COUNT) if number not in site.navigation.measured]
    return (yield from digitize(site, missing))


def digitize_one(site: Site) -> Work:
    """Touch and measure the first landmark again."""
    return (yield from digitize(site, [0]))


def confirm(site: Site) -> Work:
    """Confirm that every landmark is measured. Return False if it is not."""
    yield from wait(SHORT)
    return site.reading(DIGITIZED) == "1"


def clear_digitization(site: Site) -> Work:
    """Forget what was measured, and the registration made of it."""
    yield from wait(SHORT)
    site.navigation = site.navigation.without_measures()
    return True


def forget_touches(site: Site) -> Work:
    """Forget what was measured. A registration made of it counts until it is cleared itself."""
    yield from wait(SHORT)
    site.navigation = site.navigation.without_touches()
    return True


def register_patient(site: Site) -> Generator[None, None, bool | str]:
    """Fit the planned landmarks to the measured ones. Return how good the fit is, or False if the
    landmarks do not fit, or if the reference has moved since they were measured."""
    yield from wait(SHORT)
    now = site.navigation
    if not (now.complete and len(now.planned) and site.is_where(now.stand)):
        return False
    found = site.register()
    if found.error > GOOD:
        site.navigation = now
        return False
    return site.told(found)


def clear_registration(site: Site) -> Work:
    """Forget the registration; what was saved stays."""
    yield from wait(SHORT)
    site.navigation = site.navigation.without_fit()
    return True


def use_previous(site: Site) -> Generator[None, None, str]:
    """Load the registration that was saved, with its landmarks."""
    yield from wait(SHORT)
    site.navigation = site.navigation.restored()
    found = site.navigation.fit
    assert found is not None
    return site.told(found)


OPERATIONS = {
    plan_landmarks: ("Op_PlanLandmarks", "Op_ReplanLandmarks", "LandmarksPlanned"),
    clear_landmarks: ("Op_ClearLandmarks", "ClearLandmarks", "ReinitState"),
    plan_tool: ("Op_PlanToolPose", "Op_ReplanToolPose"),
    clear_tool: ("Op_ClearToolPose",),
    digitize_all: ("Op_DigitizeLandmarks", "DigitizeAllLandmarks"),
    digitize_one: ("Op_Redigitize", "RedigitizeOneLandmark"),
    digitize_missing: ("ConfirmAllDigitized",),
    confirm: ("LandmarksDigitized",),
    clear_digitization: (
        "Op_ClearDigitization",
        "ClearDigitization",
    ),
    forget_touches: ("DIGITIZATION/ReinitState",),
    register_patient: ("Op_Register", "Registered"),
    clear_registration: ("Op_ClearReg", "ClearRegistration"),
}
"""The functions by the names of the operations that they carry out."""


def register(library: OperationLibrary) -> None:
    """Register the world ``registration`` with its operations, sensors and faults."""

    @library.world("registration", settle=0.2, values=("0", "1"))
    def build(world: BulletWorld, blueprint: Blueprint, seed: int) -> Site:
        site = Site(world, blueprint, seed)
        site.furnish()
        return site

    @library.arrange("registration")
    def arrange(site: Site, facts: Mapping[tuple[str, int], str]) -> None:
        site.arrange(facts)

    library.stations("registration", robot=ARM)(stations_of)
    register_sensors(library)
    for function, names in OPERATIONS.items():
        for name in names:
            library.operation(name, stop="hold", timeout=120.0)(function)
    previous = Availability(Site.no_previous, Site.save_one)
    for name in ("Op_UsePrevReg", "UsePrevRegister"):
        library.operation(name, stop="hold", timeout=20.0, available=previous)(use_previous)
    register_faults(library)
