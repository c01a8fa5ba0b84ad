"""The second line of a card in any width: nothing lies over the sign of who acts."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.front.views.partial import OperationCard
from smsl_studio.studio.features.supervise.card import risk_and_cost

CARD = OperationCard(Address("SB", "A", "op"), 1, "B", "", "medium", "4.0", "robot", "", "possible")


def wide(words: str) -> float:
    """Six pixels a letter."""
    return 6.0 * len(words)


def test_risk_and_cost_share_the_room_and_the_cost_stays_longest() -> None:
    for room in range(300):
        told = risk_and_cost(CARD, wide, room)
        assert sum(wide(one) + 8 for one in told if one) <= room
    assert risk_and_cost(CARD, wide, 120) == ("medium", "cost 4.0")
    assert risk_and_cost(CARD, wide, 60) == ("", "cost 4.0")
    assert risk_and_cost(CARD, wide, 50) == ("medium", "")
    assert risk_and_cost(CARD, wide, 20) == ("", "")
