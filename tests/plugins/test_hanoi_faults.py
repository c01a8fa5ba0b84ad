"""A fault on the table never gives the readings of a success. benches/faults.py has all 27
cases."""

from __future__ import annotations

import pytest

from smsl_studio.runlog.events import OperationStarted
from tests.plugins.faulted import PLAIN, WITH_FAILURES, Case, Hand, Story, cases, run_with


def _operations(story: Story) -> list[str]:
    return [
        event.address.rpartition("/")[2]
        for event in story.events
        if isinstance(event, OperationStarted)
    ]


def _honest(story: Story) -> None:
    """No commit and no goal but where the rings truly stood; and an end that says so."""
    assert story.wrong == ()
    assert story.decision in {"held", "refused", "recovered"}
    if story.decision == "recovered":
        assert story.stood == story.sensed == "ccc"


def test_there_are_nine_faults_at_three_edges_each() -> None:
    found = cases()
    assert len(found) == 27
    assert len({(case.fault, case.during) for case in found}) == 27
    assert len({case.fault for case in found}) == 9


@pytest.mark.parametrize("case", [one for one in cases() if one.during == 1], ids=str)
def test_a_run_with_a_fault_is_held_or_finds_another_way(case: Case) -> None:
    _honest(run_with(case, PLAIN))


def test_what_the_operation_says_is_no_evidence() -> None:
    """The tower comes along, and the operation says that all is well."""
    story = run_with(Case("tower_carried", 1))
    assert (story.at_first, story.sensed, story.decision) == ("returned", "cca", "held")
    assert "reads c, not a" in story.end.sentence


def test_a_carried_tower_is_adopted_where_that_is_allowed() -> None:
    story = run_with(Case("tower_carried", 1), PLAIN, adopt=True)
    _honest(story)
    assert _operations(story)[:3] == ["Op_1c", "Op_1a", "Op_2b"]


def test_a_dropped_disk_is_recovered_by_its_own_operation() -> None:
    story = run_with(Case("gripper_opens", 1), WITH_FAILURES, adopt=True)
    _honest(story)
    assert _operations(story)[:2] == ["Op_1c", "Op_recover1a"]
    assert story.decision == "recovered"


def test_a_disk_that_a_cap_keeps_off_its_peg_is_put_elsewhere() -> None:
    """The cap is taken away again, and then the way goes on."""
    story = run_with(
        Case("blocked_peg", 1, {"peg": "c", "seconds": 6.0}), WITH_FAILURES, adopt=True
    )
    _honest(story)
    assert _operations(story)[:2] == ["Op_1c", "Op_recover1a"]
    assert story.decision == "recovered"


def test_a_failure_state_is_not_adopted_unless_that_is_asked_for() -> None:
    story = run_with(Case("gripper_opens", 1), WITH_FAILURES)
    _honest(story)
    assert (story.sensed, story.decision) == ("xaa", "held")


def test_the_same_fault_and_seed_give_the_same_events() -> None:
    one, other = (run_with(Case("disk_pushed", 1, {"disk": 3}), seed=4) for _ in range(2))
    assert one.events == other.events


HANDS = (Hand(robot="iiwa"), Hand(robot="dvrk"), Hand("hanoi-mujoco"))
DROP = Case("gripper_opens", 1)
SLIP = Case("slippery", 1)
BLOCK = Case("blocked_peg", 1, {"peg": "c"})


@pytest.mark.parametrize("hand", HANDS, ids=str)
@pytest.mark.parametrize("case", [DROP, SLIP, BLOCK], ids=lambda case: case.fault)
def test_other_hands_do_not_take_a_fault_for_a_success(hand: Hand, case: Case) -> None:
    """benches/faults.py has the runs in which they recover."""
    story = run_with(case, PLAIN, hand=hand)
    assert story.wrong == ()
    assert story.decision == "held"
    assert story.sensed != "caa"
