"""What the navigation and the tracker measure, and how that becomes the facts (paper, Eq. 5).

A blueprint may decide otherwise from the same measures (``sources`` in ``_facts``). What the
tracker has to see is not measured while something is in its way.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from .phantom import COUNT
from .site import DIGITIZED, PLANNED, POSED, REGISTERED, Site
from .tracker import Stand, apart

if TYPE_CHECKING:
    from smsl_studio.library.operation_library import OperationLibrary


def register_sensors(library: OperationLibrary) -> None:
    """Register the sensors that measure, and the predicates of the facts."""
    _measures(library, "navigation_{n}", lambda site, n: site.meaning(site.root, n - 1))
    _measures(library, "digitization_{n}", lambda site, n: DIGITIZED)
    library.fact("navigation_{n}", "{n}", _conditions("navigation_{n}"))
    library.fact("digitization_{n}", "DIGITIZATION/{n}", _conditions("digitization_{n}"))


def _measures(library: OperationLibrary, name: str, meaning: Callable[[Site, int], str]) -> None:
    """Register what is measured of one result: of the planned landmarks, the measured landmarks,
    the planned pose of the tool, or the registration.
    """

    @library.sensor(f"{name}_missing", unit="1")
    def missing(site: Site, n: int) -> int | None:
        """How much of it is still missing: landmarks to measure, or else the whole as one."""
        what, now = meaning(site, n), site.navigation
        if what == PLANNED:
            return 0 if len(now.planned) else 1
        if what == POSED:
            return 0 if now.pose is not None else 1
        if site.tracker.occluded:
            return None
        if what == DIGITIZED:
            return COUNT - len(now.measured)
        return 0 if now.fit else 1

    @library.sensor(f"{name}_shift", unit="m")
    def shift(site: Site, n: int) -> float | None:
        """How far the phantom has moved against the reference since; 0 where that is no matter."""
        what, now = meaning(site, n), site.navigation
        if what in (PLANNED, POSED):
            return 0.0
        stand = now.stand if what == DIGITIZED else now.fit.stand if now.fit else None
        return _moved(site, stand)

    @library.sensor(f"{name}_error", unit="m")
    def error(site: Site, n: int) -> float | None:
        """The root-mean-square distance of the landmarks (FRE) of a registration, else 0."""
        if meaning(site, n) != REGISTERED:
            return 0.0
        fit = site.navigation.fit
        return None if site.tracker.occluded or fit is None else fit.error


def _moved(site: Site, stand: Stand | None) -> float | None:
    if stand is None or site.tracker.occluded:
        return None
    return apart(stand, site.tracker.stand)


def _conditions(name: str) -> dict[str, str]:
    """Return the conditions under which a result counts, and under which it does not."""
    return {
        "1": f"{name}_missing < 1 and {name}_shift < 0.5 mm and {name}_error <= 0.5 mm",
        "0": f"{name}_missing >= 1 or {name}_shift >= 0.5 mm or {name}_error > 0.5 mm",
    }
