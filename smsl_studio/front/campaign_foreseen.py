"""What a campaign foresees of its rows, and a row that ended otherwise in words."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.front.campaign_faults import CampaignRequest, arguments_of
from smsl_studio.front.campaign_runs import Injection
from smsl_studio.front.campaign_tally import CampaignCell
from smsl_studio.front.fault_foresight import FaultEnd, FaultForesight
from smsl_studio.front.hosts import known_world


class CampaignForesight:
    """Foresees the rows of one campaign. The plugins of its world are loaded in this process."""

    def __init__(self, request: CampaignRequest) -> None:
        loaded = known_world(request.world)
        self._foresight = FaultForesight(
            request.blueprint,
            loaded.faults_of(request.world) if loaded else {},
            arguments_of(request.blueprint, request.world, loaded),
            request.goals,
        )

    def look(self, injection: Injection | None) -> FaultEnd | None:
        """Return how the runs of a row are expected to end. None if there is no fault, or if
        nothing can be foreseen."""
        if injection is None:
            return None
        return self._foresight.look(injection.fault, injection.edge)


def finding_of(cell: CampaignCell, world: str) -> str:
    """Return a cell that ended otherwise than foreseen in words, for a note on the drawing."""
    seen = ", ".join(f"{number:,} {kind}" for kind, number in cell.counts.items() if number)
    operation, told = Address.split(cell.edge)[-1], cell.foreseen
    foreseen = f" Foreseen: {told.end}, because {told.why}." if told is not None else ""
    return (
        f"Campaign in the world {world}: {cell.fault} in {operation}.{foreseen} "
        f"Seen: {seen} of {cell.runs:,} runs."
    )
