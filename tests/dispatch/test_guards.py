"""Clauses 4 and 10: all guards are asked before anything moves, and refusals give reasons."""

from __future__ import annotations

from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.drive.supervisor import Proposal, Verdict
from smsl_studio.host.protocol import Outcome
from tests.dispatch.fake_host import FakeHost, Fault
from tests.dispatch.runs import Story, blueprint, branch, sample


def by_hand(made: Any, host: FakeHost | None = None, **choices: Any) -> Story:
    return Story(made, host, automatic=False, **choices).tick()


def nothing_moved(story: Story) -> bool:
    return not [call for call in story.host.calls if "/" in call]  # type: ignore[attr-defined]


def test_clause_4_an_operation_that_does_not_leave_the_active_state() -> None:
    story = by_hand(sample("hanoi"))
    story.dispatcher.ask(Address("SB1", "State_bba", "Op_3c"))
    story.tick()
    assert story.reasons == ["SB1 is in State_aaa, not in State_bba"]
    story.ask("Op_3c")
    assert "there is no operation 'Op_3c'" in story.reasons[-1]
    assert nothing_moved(story)


def test_clause_4_avoided_and_pruned_edges_are_refused_with_the_reason() -> None:
    story = by_hand(sample("hanoi"), avoid=["SB1/State_aaa/Op_1b"])
    story.dispatcher.prune(Address("SB1", "State_aaa", "Op_1c"), "the peg is bent")
    story.ask("Op_1b", "Op_1c")
    assert story.reasons == [
        "SB1/State_aaa/Op_1b is avoided",
        "SB1/State_aaa/Op_1c is pruned: the peg is bent",
    ]
    assert nothing_moved(story)
    story.dispatcher.restore(Address("SB1", "State_aaa", "Op_1c"))
    assert story.ask("Op_1c").configuration == {"SB1": "State_caa"}


def test_clause_4_the_source_must_check_true_on_sensed_facts() -> None:
    made = sample("hanoi")
    host = FakeHost(made, settle=60.0)
    story = by_hand(made, host)
    host.facts["SB1", 2] = None
    story.ask("Op_1c")
    assert "Fact 3 of SB1 is unknown, no valid reading" in story.reasons[0]
    host.facts["SB1", 2] = "b"
    story.ask("Op_1c")
    assert "Fact 3 of SB1 reads b, not a" in story.reasons[1]
    assert nothing_moved(story)


def test_clause_4_no_function_no_motion_also_deep_in_a_sub_route() -> None:
    made = sample("three-levels")
    host = FakeHost(made, unbound=["DIGITIZATION/State10/TouchLandmarks"])
    story = by_hand(made, host).ask("SURGERY/PositionPatient")
    host.calls.clear()
    story.ask("SURGERY/RegisterPatient")
    assert "no function is bound to DIGITIZATION/State10/TouchLandmarks in this world" in (
        story.reasons
    )
    assert nothing_moved(story)


def test_clause_4_required_facts_of_any_branch() -> None:
    story = by_hand(sample("three-roots")).ask("ROBOT/SwitchOn", "ROBOT/MoveToTarget")
    assert story.reasons == [
        "ROBOT/State10/MoveToTarget requires REGISTRATION/2 to be 1, and it is 0",
        "ROBOT/State10/MoveToTarget requires TOOLPLAN/0 to be 1, and it is 0",
        "ROBOT/State10/MoveToTarget requires TOOLPLAN/1 to be 1, and it is 0",
    ]
    story.ask("TOOLPLAN/ChooseEntry", "TOOLPLAN/ChooseTarget", "REGISTRATION/UsePrevRegister")
    assert story.ask("ROBOT/MoveToTarget").configuration["ROBOT"] == "State11"


def test_clause_4_a_required_fact_must_be_sensed_not_only_believed() -> None:
    made = sample("three-roots")
    host = FakeHost(made, settle=60.0)
    story = by_hand(made, host).ask(
        "ROBOT/SwitchOn", "TOOLPLAN/ChooseEntry", "TOOLPLAN/ChooseTarget"
    )
    story.ask("REGISTRATION/UsePrevRegister")
    host.facts["TOOLPLAN", 1] = None
    host.calls.clear()
    story.ask("ROBOT/MoveToTarget")
    assert "Target chosen of TOOLPLAN is unknown" in story.reasons[0]
    assert nothing_moved(story)


def test_clause_4_the_supervisor_is_asked_last_and_may_object() -> None:
    asked: list[str] = []

    class Nurse:
        name = "Nurse"

        def review(self, proposal: Proposal) -> Verdict:
            asked.append(str(proposal.operation))
            no = proposal.operation.operation == "Op_1b"
            return Verdict("veto", "not with this patient") if no else Verdict("allow")

    story = by_hand(sample("hanoi"), supervisor=Nurse()).ask("Op_1b", "Op_1c")
    assert story.reasons == ["Nurse says no: not with this patient"]
    assert asked == ["SB1/State_aaa/Op_1b", "SB1/State_aaa/Op_1c"]
    assert story.configuration == {"SB1": "State_caa"}


def test_clause_10_a_crossing_without_a_base_edge_is_refused_before_motion() -> None:
    story = by_hand(sample("registration-digitization")).ask("DIGITIZATION/DigitizeAllLandmarks")
    assert story.reasons == [
        "REGISTRATION/State000 has no rise of Landmarks digitized (digit 1) for DIGITIZATION "
        "to take along"
    ]
    assert nothing_moved(story)


def test_clause_10_all_guards_apply_to_the_edges_taken_along() -> None:
    made = sample("registration-digitization")
    avoid = ["REGISTRATION/State100/LandmarksDigitized"]
    story = by_hand(made, avoid=avoid).ask("LandmarksPlanned", "DIGITIZATION/DigitizeAllLandmarks")
    assert "REGISTRATION/State100/LandmarksDigitized is avoided" in story.reasons
    assert story.configuration == {"REGISTRATION": "State100", "DIGITIZATION": "State0"}


def test_one_operation_at_a_time_and_none_behind_the_plan() -> None:
    made = sample("hanoi")
    story = Story(made, FakeHost(made, lasts=5)).tick(2)
    story.dispatcher.ask(Address("SB1", "State_aaa", "Op_1b"))
    story.tick()
    assert story.reasons == ["SB1/State_aaa/Op_1c is being carried out"]


def test_status_tells_what_is_possible_and_why_the_rest_is_not() -> None:
    story = by_hand(sample("registration-digitization"))
    possible = {str(one.address): one for one in story.dispatcher.status.possible}
    planned = possible["REGISTRATION/State000/LandmarksPlanned"]
    assert (planned.permitted, planned.target, planned.cost) == (True, "State100", 1.0)
    digitize = possible["DIGITIZATION/State0/DigitizeAllLandmarks"]
    assert not digitize.permitted
    assert "no rise of Landmarks digitized (digit 1)" in digitize.reasons[0]
    assert story.dispatcher.status is story.dispatcher.status


def test_a_risky_edge_may_still_be_asked_for_by_hand() -> None:
    made = sample("hanoi")
    fault = Fault(Outcome.FAILED, writes={})
    host = FakeHost(made, faults={"SB1/State_aaa/Op_1c": fault})
    story = by_hand(made, host).ask("Op_1c")
    (one,) = [p for p in story.dispatcher.status.possible if p.address.operation == "Op_1c"]
    assert (one.risky, one.permitted, one.pruned) == (True, True, False)
    host.faults.clear()
    assert story.ask("Op_1c").configuration == {"SB1": "State_caa"}


NESTED = blueprint(
    {
        "A": branch(
            {"00": "go>11", "11": ""},
            initial="00",
            activating="11",
            subs={"B": 1},
            operations={"go": {"requires": {"C/0": "0"}}},
        ),
        "B": branch({"0": "u>2", "2": "v>1", "1": "d>0"}, initial="0", activating="1"),
        "C": branch({"0": "z>1", "1": ""}, activating="1"),
    }
)


class Covered(FakeHost):
    """Sensors can be covered while it runs."""

    covered: tuple[tuple[str, int], ...] = ()

    def _samples(self) -> tuple[Any, ...]:
        samples = super()._samples()
        return tuple(one for one in samples if (one.branch, one.digit) not in self.covered)


def test_clause_4_an_own_function_does_not_begin_on_facts_that_became_unknown() -> None:
    host = Covered(NESTED, lasts=5)
    story = Story(NESTED, host, attended=True).tick(3)
    host.covered = (("A", 0),)
    story.run()
    assert story.phase == "fault_hold"
    assert "Fact 1 of A is unknown" in story.dispatcher.status.sentence
    assert host.calls == ["B/State0/u", "B/State2/v"]
    assert story.commits == [("B/State0/u",)]


def loading() -> Any:
    """A turns B on; on its way B loads C off, which its last operation requires."""
    return blueprint(
        {
            "A": branch({"0": "go>1", "1": ""}, subs={"B": 0}),
            "B": branch(
                {"10": "load>00", "00": "in>01", "01": ""},
                subs={"C": 0},
                operations={"load": {"subs": "load"}, "in": {"requires": {"C/0": "0"}}},
            ),
            "C": branch({"0": "up>1", "1": "down>0"}),
        }
    )


def test_clause_4_what_a_load_brings_about_is_not_required_before() -> None:
    story = Story(loading()).run()
    assert (story.end.reason, story.reasons) == ("goal_reached", [])
    assert story.started == ["A/State0/go", "B/State10/load", "B/State00/in"]


def test_a_load_that_was_held_goes_on_where_only_what_it_sets_has_changed() -> None:
    made = loading()
    host = FakeHost(made, lasts=10, stop="hold")
    story = Story(made, host, goals=["B/State00"], attended=True)
    while not story.started:
        story.tick()
    host.facts["C", 0] = "0"  # the first half of what the function sets
    story.tick(2).dispatcher.pause()
    story.tick()
    assert story.phase == "paused"
    story.dispatcher.resume()
    story.run()
    assert story.end.reason == "goal_reached"
    assert [one.outcome for one in story.of("operation_ended")] == ["returned"]
