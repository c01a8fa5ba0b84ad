"""What the blueprint alone foresees of a fault in an operation: whether a run gets to its goal all
the same.

It foresees that the operation fails and nothing else changes. Then the run tags it as risky, and
reaches its goal if another way leads there. A fault that changes facts, or stops other operations
too, may end otherwise: then prediction and outcome differ.
"""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.errors import StudioError
from smsl_studio.front.campaign_tally import HELD, REACHED, CampaignCell
from smsl_studio.front.starts import start_for_edge

WHY = {
    REACHED: "if it fails, another way leads to the goal",
    HELD: "if it fails, no other way leads to the goal",
}
"""Why an end is foreseen."""


class CampaignForesight:
    """Foresees the runs of one campaign. Each operation is looked at once."""

    def __init__(self, blueprint: Blueprint, goals: tuple[str, ...] = ()) -> None:
        self._blueprint, self._goals = blueprint, goals
        self.known: dict[str, str] = {"": ""}
        """The foreseen end by the address of the operation; empty where none can be foreseen."""

    def look(self, edge: str) -> str:
        """Return the foreseen end of runs with a fault in an operation: ``reached`` or ``held``.
        Empty if nothing can be foreseen."""
        if edge not in self.known:
            try:
                self.known[edge] = self._foreseen(Address(*Address.split(edge)))
            except StudioError:
                self.known[edge] = ""
        return self.known[edge]

    def _foreseen(self, edge: Address) -> str:
        branch = self._blueprint.branches.get(edge.branch)
        if branch is None or edge.operation not in branch.table.get(edge.state, {}):
            return ""
        hierarchy = Hierarchy(self._blueprint)
        start = start_for_edge(hierarchy, edge)
        if start is None:
            return ""
        named = [Address(*Address.split(goal)) for goal in self._goals]
        roots = [Address(name, self._blueprint[name].activating) for name in hierarchy.roots]
        planner = Planner(hierarchy, Terms(shut={edge: "risky"}))
        return HELD if planner.legs(start, named or roots) is None else REACHED

    def differs(self, cell: CampaignCell) -> bool:
        """Whether most runs of a cell whose runs are all done ended otherwise than foreseen."""
        told = self.known.get(cell.edge, "")
        if not told or cell.runs < cell.seeds:
            return False
        if not cell.begun:
            return False  # nothing was seen
        return (told == REACHED) is not (2 * cell.counts[REACHED] >= cell.begun)


def finding_of(cell: CampaignCell, told: str, world: str) -> str:
    """Return a cell that ended otherwise than foreseen in words, for a note on the drawing."""
    seen = ", ".join(f"{number:,} {kind}" for kind, number in cell.counts.items() if number)
    operation = Address.split(cell.edge)[-1]
    return (
        f"Campaign in the world {world}: {cell.fault} in {operation}. Foreseen: {told}, because "
        f"{WHY[told]}. Seen: {seen} of {cell.runs:,} runs."
    )
