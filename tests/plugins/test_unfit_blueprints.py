"""A blueprint that a world cannot have is refused with one sentence before anything is built, and a
start that cannot be with one before anything moves."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.runlog.events import OperationStarted, RunFinished
from tests.plugin_folder import blueprint_of

STEVE = "move_steve_from_red_land_to_boat"
STAR = "move-star-chess-to-block-uppercase-A"
PLAN = "Op_PlanLandmarks"
UNFIT = [
    ("hanoi", ["aaaaa", "baaaa"], "Op_1b", "has 2, 3 or 4 disks, and this blueprint has 5 facts"),
    ("hanoi", ["a", "b"], "Op_1b", "has 2, 3 or 4 disks, and this blueprint has 1 facts"),
    ("hanoi", ["aaa", "daa"], "Op_1d", "SB1/State_daa has disk 1 at 'd', and this world knows a b"),
    ("hanoi", ["aaa", "baa"], "Op_4b", "Op_4b moves disk 4, and this table has 3 disks"),
    ("hanoi", ["aaa", "baa"], "Op_0b", "Op_0b moves disk 0, and this table has 3 disks"),
    ("hanoi", ["aaa", "baa"], "Op_1q", "Op_1q moves a disk to 'q', and there are the pegs"),
    ("river", ["000", "00B"], STEVE, "needs one State Branch with 4 facts"),
    ("river", ["0000", "0020"], STEVE, "SB1/State_0020 has steve at '2', and this world knows 0 B"),
    ("chess", ["AB0BaB", "aB0BaB"], STAR, "needs one State Branch with 2 facts"),
    ("chess", ["AB0B", "EB0B"], STAR, "SB1/State_EB0B has star at 'EB', and this world knows AB"),
    ("river", ["00B0", "BBB0"], STEVE, "SB1/State_BBB0 cannot be in this world: at most two"),
    ("chess", ["0B1B", "0B0B", "AB1B"], STAR, "State_0B0B cannot be in this world: both pieces"),
    ("chess", ["0B1B", "0TAB"], STAR, "State_0TAB cannot be in this world: a piece on top needs"),
    ("registration", ["00000", "10000"], PLAN, "needs one root with 3 or 4 facts"),
    ("registration", ["0000", "2000"], PLAN, "SB1/State_2000 has planned at '2'"),
]
WORLDS = ("hanoi", "river", "chess", "registration")
IMPOSSIBLE = [
    ("river", ["BBB0", "B0B0"], STEVE, "at most two can be in the boat"),
    ("chess", ["0B0B", "AB0B"], STAR, "both pieces would be in one place, on block 0"),
    ("chess", ["0T0T", "AB0B"], STAR, "a piece on top needs the other one below it"),
    ("chess", ["0TaB", "AB0B"], STAR, "a piece on top needs the other one below it"),
    ("hanoi", ["haa", "baa"], "Op_1b", "disk 1 cannot start on 'h'"),
    ("river", ["hhhh", "00B0"], STEVE, "grass cannot start at 'h'"),
    ("registration", ["0001", "1001"], PLAN, "a registration needs planned and digitized"),
]


def chain(values: Sequence[str], operation: str) -> Blueprint:
    """States one after another, with the same operation between them."""
    count = len(values[0]) // (2 if operation == STAR else 1)
    names = [f"State_{value}" for value in values]
    header = {"INITIAL": names[0], "ACTIVATING": names[-1], "NUM_FACTS": count}
    edges = {one: {operation: other} for one, other in pairwise(names)}
    return blueprint_of({"SB1": {"HEADER": header, **edges, names[-1]: {}}})


@pytest.mark.parametrize(("world", "values", "operation", "words"), [*UNFIT, *IMPOSSIBLE])
def test_it_is_refused_with_a_sentence_and_nothing_moves(
    world: str, values: Sequence[str], operation: str, words: str
) -> None:
    done = smsl.run(chain(values, operation), world, host="local")
    (last,) = (event for event in done.events if isinstance(event, RunFinished))
    assert (last.reason, last.operations, last.t) == ("refused", 0, 0.0)
    assert words in last.sentence
    assert not [event for event in done.events if isinstance(event, OperationStarted)]


@pytest.mark.parametrize(("world", "values", "operation", "words"), UNFIT)
def test_a_sweep_and_a_preview_say_the_same(
    world: str, values: Sequence[str], operation: str, words: str
) -> None:
    file = chain(values, operation)
    with pytest.raises(StudioError, match=words):
        list(smsl.sweep(file, world, host="local"))
    edge = f"SB1/State_{values[0]}/{operation}"
    with pytest.raises(StudioError, match=words):
        smsl.preview(file, edge, world)


@pytest.mark.parametrize("world", WORLDS)
def test_a_blueprint_of_two_roots_is_refused(world: str) -> None:
    branch = {"HEADER": {"NUM_FACTS": 4}, "State_0000": {}}
    done = smsl.run(blueprint_of({"SB1": branch, "SB2": branch}), world, host="local")
    assert done.reason == "refused"
    assert "needs" in done.sentence


@pytest.mark.parametrize("name", ["hanoy", "", "river\n", "\x1b[31mred", "x" * 500])
def test_an_unknown_world_is_told_before_anything_is_built(name: str) -> None:
    words = "there is no world" if name else "no world is chosen"
    with pytest.raises(StudioError, match=words) as told:
        smsl.run(chain(["aaa", "baa"], "Op_1b"), name, host="local")
    assert str(told.value).isprintable()


def test_a_failure_that_a_blueprint_declares_is_no_odd_value() -> None:
    branch = {
        "HEADER": {"INITIAL": "State_aaa", "ACTIVATING": "State_baa", "NUM_FACTS": 3},
        "_facts": {"0": {"failure": ["z"]}},
        "State_aaa": {"Op_1b": "State_baa"},
        "State_baa": {},
        "State_zaa": {},
    }
    assert smsl.run(blueprint_of({"SB1": branch}), "hanoi", host="local").reason == "goal_reached"
