"""The goals of a search for a shortest run, and the run that it finds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.graph.joint.products import JointBox


class SearchGoals(NamedTuple):
    """The goals of a search, as boxes of configurations.

    ``hits`` are wanted. From a configuration of ``passing`` one step passes through a wanted one.
    If ``may`` is given, only configurations of ``may`` are left by a step.
    """

    hits: Sequence[JointBox]
    passing: Sequence[JointBox] = ()
    may: Sequence[JointBox] | None = None

    @property
    def boxes(self) -> list[JointBox]:
        """All boxes: ``hits``, then ``passing``, then ``may``."""
        return [*self.hits, *self.passing, *(self.may or ())]


class FoundRun(NamedTuple):
    """A shortest run: the operations that are asked for, and the configuration at its end.

    ``during`` is True if the end is not wanted itself, but one step from there passes through a
    wanted configuration. ``start`` is None if the run begins at the usual start.
    """

    path: list[Address]
    end: Mapping[str, str]
    during: bool
    start: Mapping[str, str] | None = None
