"""The route of one sub-SB to ACTIVATING or back to INITIAL. It is kept, so it is searched only
once.
"""

from __future__ import annotations

from collections.abc import Collection

from smsl_studio.blueprint.allowance import Part
from smsl_studio.blueprint.configuration import Configuration
from smsl_studio.blueprint.edges import Edge, Edges
from smsl_studio.blueprint.joint import StepDraft
from smsl_studio.blueprint.search import PlanSearch

Key = tuple[str, ...]


class Region:
    """The SBs that the route of a sub-SB depends on, while the edges of the SBs in ``held`` have
    begun.

    These are the sub-SB and all SBs below it, the bases that go along with them, and every SB with
    a fact that one of their operations ``requires``. ``names`` are in the order of the hierarchy.
    ``border`` are the bases in ``held``, of which only the edge matters.
    """

    def __init__(self, edges: Edges, branch: str, held: Collection[str]) -> None:
        hierarchy = edges.hierarchy
        moving = set(hierarchy.tree(branch))
        border: set[str] = set()
        waiting = list(moving)
        while waiting:
            for base, _ in hierarchy.bases[waiting.pop()]:
                if base in held:
                    border.add(base)
                elif base not in moving:
                    moving.add(base)
                    waiting.append(base)
        seen = {name for mover in moving for name in edges.required_by(mover)}
        self.names = tuple(name for name in hierarchy.order if name in moving or name in seen)
        self.border = tuple(border)

    def key(self, configuration: Configuration) -> Key:
        """Return the part of a configuration that the route depends on."""
        return tuple(configuration[name] for name in self.names)


class SubRoute(Part):
    """The edges of a sub-SB's route, or the ``search`` for them.

    ``reasons`` say why edges could not be used, and ``closed`` why there is no route. ``whole`` has
    the changes and the cost of the whole route, after these were asked for.
    """

    def __init__(self, region: Region) -> None:
        super().__init__()
        self.region = region
        self.search: PlanSearch[Key] | None = None
        self.reasons: dict[str, None] = {}
        self.edges: tuple[Edge, ...] = ()
        self.closed: tuple[str, ...] = ()
        self.whole: StepDraft | None = None
