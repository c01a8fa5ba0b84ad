"""What stands in the way: a price on every edge that no route may use, so that a way of the fewest
of them can be asked for."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edges import Edge

PENALTY = 1e12
"""More than any edge may cost, so that one blocked edge less is always better."""


class Blocks:
    """Why edges may not be used: closed with a reason, without a function, into a failure."""

    def __init__(self, closed: Mapping[Address, str], bound: Collection[Address]) -> None:
        self.closed, self._bound = closed, bound

    def __call__(self, edge: Edge) -> float:
        """What an edge costs on top: the penalty where it is blocked."""
        return PENALTY if self.reason(edge) else 0.0

    def reason(self, edge: Edge) -> str:
        """Why no route uses an edge; empty where routes may."""
        closed = self.closed.get(edge.address)
        if closed is not None:
            return closed
        if edge.function and edge.address not in self._bound:
            return "no function is bound to it in this world"
        return f"it leads into a failure: {edge.fails}" if edge.fails else ""

    def among(self, edges: Iterable[Edge]) -> Mapping[Address, str]:
        """The blocked ones among edges, in their order."""
        return {edge.address: reason for edge in edges if (reason := self.reason(edge))}
