"""Which runs are armed after a step, and which were before it (see ``armed``)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from smsl_studio.graph.joint.diagram import Diagram


class MarkedSet(NamedTuple):
    """Two sets: configurations at the end of runs that are not armed, and of armed ones."""

    plain: int
    armed: int


@dataclass(frozen=True)
class ArmedSets:
    """A configuration of ``arming`` arms a run, and one of ``disarming`` disarms it."""

    diagram: Diagram
    arming: int
    disarming: int

    def after(self, plain: int, armed: int) -> MarkedSet:
        """Return the marks of configurations that were reached from plain and from armed ones."""
        return MarkedSet(
            self._either(plain, self.arming, armed, self.disarming),
            self._either(armed, self.disarming, plain, self.arming),
        )

    def before(self, plain: int, armed: int) -> MarkedSet:
        """Return what must be reached from plain and from armed ones to be in these sets."""
        return MarkedSet(
            self._either(plain, self.arming, armed, self.arming),
            self._either(armed, self.disarming, plain, self.disarming),
        )

    def _either(self, stays: int, outside: int, comes: int, inside: int) -> int:
        """Return what stays because it is outside a set, and what comes because it is in one."""
        diagram, top = self.diagram, self.diagram.height - 1
        return diagram.union(
            diagram.without(stays, outside, top), diagram.both(comes, inside, top), top
        )
