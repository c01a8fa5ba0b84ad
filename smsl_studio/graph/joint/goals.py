"""What a search for a shortest run looks for, and what it finds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.graph.joint.products import JointBox


class SearchGoals(NamedTuple):
    """Boxes of configurations.

    ``hits`` are wanted. Out of one of ``passing`` a step passes what is wanted. Steps begin in
    ``may`` alone, if it is given.
    """

    hits: Sequence[JointBox]
    passing: Sequence[JointBox] = ()
    may: Sequence[JointBox] | None = None

    @property
    def boxes(self) -> list[JointBox]:
        """All boxes, in this order."""
        return [*self.hits, *self.passing, *(self.may or ())]


class FoundRun(NamedTuple):
    """A shortest run: the operations that are asked, and the configuration at its end.

    With ``during`` the end is none that is wanted, but a step out of it passes one. Without a
    ``start`` it begins where a run does.
    """

    path: list[Address]
    end: Mapping[str, str]
    during: bool
    start: Mapping[str, str] | None = None
