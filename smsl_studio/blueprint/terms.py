"""The terms of a plan: which edges may be used at all, and what they cost."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edges import NO_COSTS, Edge, Extra
from smsl_studio.blueprint.hazards import GuardHazard


@dataclass(frozen=True)
class Terms:
    """The edges that may be used: exclusions with reasons, and the edges with a function.

    ``bound`` None means a plan without a world, in which every edge counts as bound. ``failing``
    are the edges that may be used although they lead into a failure state (None: all of them). Only
    a request of a person allows one. ``costs`` replace declared costs. ``extra`` gives the
    additional cost of an edge. No joint step may meet one of ``hazards``, on its way or at its end.
    """

    shut: Mapping[Address, str] = field(default_factory=dict)
    bound: Collection[Address] | None = None
    exact: Collection[Address] = ()
    failing: Collection[Address] | None = ()
    costs: Mapping[Address, float] = field(default_factory=lambda: NO_COSTS)
    extra: Extra | None = None
    hazards: tuple[GuardHazard, ...] = ()

    def closures(self, edge: Edge) -> Iterator[str]:
        """Yield the reasons why an edge can be used from no configuration at all."""
        shut = self.shut.get(edge.address) if self.shut else None
        if shut is not None:
            yield f"{edge} is {shut}"
        if edge.function and self.bound is not None and edge.address not in self.bound:
            yield f"no function is bound to {edge} in this world"
        if edge.fails and self.failing is not None and edge.address not in self.failing:
            yield f"{edge} leads into a failure: {edge.fails}"
