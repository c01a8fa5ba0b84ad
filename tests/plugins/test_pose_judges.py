"""No fault makes a run commit or tell what is not so, by judges that look at what is drawn.

``benches/faults.py`` has 500 runs.
"""

from __future__ import annotations

import pytest

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.front.inputs import read
from smsl_studio.front.runs import open_run
from tests.plugins.piece_games import CHESS, RIVER
from tests.plugins.pose_judges import judge_of, judged_run
from tests.plugins.world_runs import HANOI, REGISTRATION, WORLDS, blueprint_file


@pytest.mark.parametrize("world", WORLDS)
def test_a_run_with_a_fault_commits_and_tells_only_what_is_so(world: str) -> None:
    story = judged_run(world, 2)
    assert story.reason in {"goal_reached", "held", "no_route"}
    assert story.wrong == ()


@pytest.mark.parametrize(
    ("world", "state", "values"),
    [
        (HANOI, "SB1/State_cab", "cab"),
        (RIVER, "SB1/State_0BB1", "0BB1"),
        (CHESS, "SB1/State_aTaB", ("aT", "aB")),
        (REGISTRATION, "REGISTRATION/State_1000", "1000"),
    ],
)
def test_a_judge_sees_what_stands_and_doubts_the_rest(
    world: str, state: str, values: tuple[str, ...]
) -> None:
    file = read(blueprint_file(world))
    dispatcher = open_run(file, world, start=state, host="local")
    list(dispatcher.open())
    try:
        judge = judge_of(world, dispatcher)
        assert judge.doubts(tuple(values)) == []
        for other in _facts(file[state.partition("/")[0]]) - {tuple(values)}:
            claims = world != REGISTRATION or "1" in (other[1], other[3])
            assert bool(judge.doubts(other)) == claims
    finally:
        dispatcher.close()


def _facts(branch: StateBranch) -> set[tuple[str, ...]]:
    return {branch.facts(state) for state in branch.table}
