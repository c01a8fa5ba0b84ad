"""Costs and risks that a campaign has measured, as a proposal for the blueprint."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.editing.notes import change_notes
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.campaign_tally import CampaignShare, CampaignTally, share_of

MEDIUM, HIGH = 0.25, 0.6
"""From these shares of runs that did not reach the goal on, a risk is medium or high. They lie
half way between the numbers that the words stand for: 0.1, 0.4 and 0.8."""


@dataclass(frozen=True, slots=True)
class RateProposal:
    """The cost and the risk of an operation, as declared and as measured.

    ``share`` has the runs in which a fault disturbed it. ``smooth`` are those of them that reached
    the goal as if nothing had happened.
    """

    address: Address
    share: CampaignShare
    smooth: int
    cost_before: float
    cost: float
    risk_before: str
    risk: str

    @property
    def changes(self) -> bool:
        """Whether something would be written."""
        return (self.cost, self.risk) != (self.cost_before, self.risk_before)


def proposals(blueprint: Blueprint, tally: CampaignTally) -> tuple[RateProposal, ...]:
    """Return what the runs say of each operation that a fault disturbed.

    The risk follows from the share of runs that did not reach the goal. The cost is the declared
    one times one and the share of runs that did not go smoothly: such an operation is done again.
    """
    found = []
    for edge in tally.edges:
        cells = [one for one in tally.cells if one.edge == edge]
        share = share_of(cells)
        injection = cells[0].injection
        if injection is None or not share.runs:
            continue
        address = injection.edge
        branch = blueprint.branches.get(address.branch)
        if branch is None or address.operation not in branch.table.get(address.state, {}):
            continue
        note = branch.operation_note(address.state, address.operation)
        smooth = share.reached - sum(one.recovered for one in cells)
        lost = 1.0 - share.reached / share.runs
        before = branch.cost(address.state, address.operation)
        cost = round(before * (2.0 - smooth / share.runs), 2)
        risk = risk_word(lost)
        found.append(RateProposal(address, share, smooth, before, cost, note.risk or "", risk))
    return tuple(found)


def risk_word(lost: float) -> str:
    """Return the risk of an operation that fails in this share of its attempts."""
    return "high" if lost >= HIGH else "medium" if lost >= MEDIUM else "low"


def with_rates(blueprint: Blueprint, chosen: Sequence[RateProposal]) -> Blueprint:
    """Return the blueprint with the proposed costs and risks.

    EditRefused if an entry of ``_operations`` is no map.
    """
    changes = {
        (one.address.branch, note_key(one.address.operation, one.address.state)): {
            "cost": int(one.cost) if one.cost == int(one.cost) else one.cost,
            "risk": one.risk,
        }
        for one in chosen
        if one.changes
    }
    return change_notes(blueprint, "_operations", changes)
