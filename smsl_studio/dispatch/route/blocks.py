"""Blocked edges: they get a penalty, so that a search finds a route with the fewest of them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edges import Edge

PENALTY = 1e12
"""The penalty is more than any edge may cost, so one blocked edge fewer is always better."""


class Blocks:
    """The reasons why edges are blocked: closed, without a function, or into a failure state."""

    def __init__(self, closed: Mapping[Address, str], bound: Collection[Address]) -> None:
        self.closed, self._bound = closed, bound

    def __call__(self, edge: Edge) -> float:
        """Return the extra cost of an edge: the penalty if it is blocked."""
        return PENALTY if self.reason(edge) else 0.0

    def reason(self, edge: Edge) -> str:
        """Return why no route uses an edge, or the empty text."""
        closed = self.closed.get(edge.address)
        if closed is not None:
            return closed
        if edge.function and edge.address not in self._bound:
            return "no function is bound to it in this world"
        return f"it leads into a failure: {edge.fails}" if edge.fails else ""

    def among(self, edges: Iterable[Edge]) -> Mapping[Address, str]:
        """Return the blocked edges among some, in their order, with the reasons."""
        return {edge.address: reason for edge in edges if (reason := self.reason(edge))}
