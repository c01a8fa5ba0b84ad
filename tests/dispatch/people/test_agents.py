"""The sample agent allows operations up to a declared risk, and asks if none is declared."""

from __future__ import annotations

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Scene
from smsl_studio.dispatch.agents import RiskLimit
from smsl_studio.dispatch.drive.supervisor import Proposal
from smsl_studio.errors import UsageError

EDGE = Address("A", "State_0", "go")


def proposal(risk: str) -> Proposal:
    return Proposal(0.0, {"A": "State_0"}, EDGE, (EDGE,), "State_1", risk, 1.0, Scene())


@pytest.mark.parametrize(
    ("limit", "decisions"),
    [
        ("low", ("allow", "veto", "veto", "ask")),
        ("medium", ("allow", "allow", "veto", "ask")),
        ("high", ("allow", "allow", "allow", "ask")),
    ],
)
def test_it_allows_up_to_its_limit_and_asks_where_none_is_declared(
    limit: str, decisions: tuple[str, ...]
) -> None:
    agent = RiskLimit(limit)
    said = [agent.review(proposal(risk)) for risk in ("low", "medium", "high", "")]
    assert tuple(one.decision for one in said) == decisions
    assert all(one.reason for one in said)
    assert agent.name == f"risk limit {limit}"


def test_a_limit_that_is_no_risk_is_refused() -> None:
    with pytest.raises(UsageError, match="'hgih' is no risk") as refused:
        RiskLimit("hgih")
    assert refused.value.advice == "Did you mean high?"
