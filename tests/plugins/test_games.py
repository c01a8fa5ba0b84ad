"""The worlds river and chess: what a person asks for happens, and nothing false is said."""

from __future__ import annotations

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.front.request import HOSTS
from smsl_studio.front.single_edge import try_edge
from smsl_studio.runlog.events import Commanded, FactChanged, Held, RunFinished
from tests.plugin_folder import blueprint_of
from tests.plugins.piece_games import CHESS, GOALS, RIVER, GameFault, file_of, run_game

BOTH = pytest.mark.parametrize("game", [RIVER, CHESS])


@BOTH
def test_the_goal_is_reached_and_the_pieces_are_there(game: str) -> None:
    story = run_game(game)
    assert (story.end.reason, story.reached) == ("goal_reached", True)
    assert story.committed[-1] == GOALS[game]


@BOTH
def test_both_hosts_tell_the_same_story(game: str) -> None:
    blueprint = smsl.read(file_of(game))
    near = {RIVER: "State_0B00", CHESS: "State_aB1B"}[game]
    runs = [smsl.run(blueprint, world=game, goal=f"SB1/{near}", host=host) for host in HOSTS]
    told = [[event.as_json() for event in one.events] for one in runs]
    assert told[0][1:] == told[1][1:]


EDGES = {
    RIVER: ("State_0BB0", "State_1BB1"),
    CHESS: ("State_1T1B", "State_aBdB", "State_dTdB"),
}
"""States whose edges are tried alone: two in the boat, a piece on the other, near neighbours."""


@pytest.mark.parametrize(("game", "state"), [(g, s) for g, some in EDGES.items() for s in some])
def test_edges_of_tight_places_pass_alone(game: str, state: str) -> None:
    blueprint = smsl.read(file_of(game))
    edges = [Address("SB1", state, name) for name in blueprint["SB1"].table[state]]
    tried = [try_edge(blueprint, edge, game, host="local") for edge in edges]
    assert tried
    assert [str(one.address) for one in tried if not one.passed] == []


@pytest.mark.parametrize(
    ("game", "fault"),
    [
        (RIVER, GameFault("gripper_opens", 0.5)),
        (RIVER, GameFault("third_aboard", 0.5, {"item": 1})),
        (CHESS, GameFault("beside", 6.0, {"piece": 2})),
        (CHESS, GameFault("toppled", 0.5, {"piece": 1})),
    ],
)
def test_a_fault_gives_no_false_goal(game: str, fault: GameFault) -> None:
    story = run_game(game, fault, most=60.0)
    assert not story.false_goal
    assert any(isinstance(event, Held) for event in story.events)


@pytest.mark.parametrize("item", [9, -3, 0])
def test_an_item_that_is_none_cannot_stand_aboard(item: int) -> None:
    story = run_game(RIVER, GameFault("third_aboard", 0.0, {"item": item}), most=0.1)
    refused = [e.refused for e in story.events if isinstance(e, Commanded) and e.value]
    assert len(refused) == 1
    assert f"there is no piece {item}" in refused[0]


def test_a_piece_beside_the_other_one_is_not_on_it() -> None:
    """Seen from above both are on one block."""
    story = run_game(CHESS, GameFault("beside", 0.1, {"piece": 2}), most=2.0)
    values = [e.value for e in story.events if isinstance(e, FactChanged) and e.digit == 1]
    assert "0B" in values
    assert "0T" not in values
    assert any(isinstance(event, Held) for event in story.events)


@pytest.mark.parametrize(
    ("game", "facts", "start", "words"),
    [
        (RIVER, 4, "State_BBB0", "at most two can be in the boat"),
        (CHESS, 2, "State_0T1B", "a piece on top needs the other one below it"),
    ],
)
def test_a_start_that_cannot_be_built_is_refused(
    game: str, facts: int, start: str, words: str
) -> None:
    branch = {"HEADER": {"NUM_FACTS": facts}, start: {}}
    blueprint = blueprint_of({"SB1": branch})
    *_, last = smsl.run(blueprint, world=game, start=f"SB1/{start}", host="local").events
    assert isinstance(last, RunFinished)
    assert (last.reason, words in last.sentence) == ("refused", True)
