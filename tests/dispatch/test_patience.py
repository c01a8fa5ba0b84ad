"""A plan over too many joint configurations is given up, with a sentence."""

from __future__ import annotations

import pytest

from smsl_studio import front
from smsl_studio.blueprint import search
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import PlanningError
from smsl_studio.smsl.json_form import parse_json

CHAIN = """{"SB1": {
    "HEADER": {"SUB_SBS": {"SB2": 1}}, "_operations": {"Op_e": {"subs": "load"}},
    "State_a0": {"Op_b": "State_b0"}, "State_b0": {"Op_c": "State_c0"},
    "State_c0": {"Op_d": "State_d0"}, "State_d0": {"Op_e": "State_d1"}, "State_d1": {}
}, "SB2": {"State_0": {"Op_1": "State_1"}, "State_1": {}}}"""


def test_a_search_is_given_up_after_as_many_configurations_as_it_may_look_at() -> None:
    moves = {n: [search.Move(n + 1, 1.0, 1, lambda: (), (), None)] for n in range(10)}

    found = search.cheapest(0, lambda n: n == 9, lambda n: moves[n], most=9)
    assert found is not None
    assert len(found) == 9
    with pytest.raises(PlanningError, match="first 8 joint configurations"):
        search.cheapest(0, lambda n: n == 9, lambda n: moves[n], most=8)


def test_a_run_without_a_plan_holds_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("smsl_studio.dispatch.route.planner.patience", lambda states: 2)

    run = front.run(read_blueprint(parse_json(CHAIN, "chain.json")), "table")

    assert run.reason == "held"
    assert run.sentence == "No plan was found among the first 2 joint configurations."


def test_every_state_of_a_flat_branch_is_looked_at_if_need_be() -> None:
    assert search.patience(59_049) > 59_049
