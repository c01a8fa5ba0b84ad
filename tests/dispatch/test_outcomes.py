"""Clauses 6 to 9 and 13: what decides the outcome, what happens on a failure, what is watched."""

from __future__ import annotations

from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.host.protocol import Outcome
from tests.dispatch.fake_host import TICK, FakeHost, Fault
from tests.dispatch.runs import Story, blueprint, branch, sample, short

FIRST = "SB1/State_aaa/Op_1c"


def hanoi(fault: Fault | None = None, host: dict[str, Any] | None = None, **choices: Any) -> Story:
    made = sample("hanoi-corrected")
    faults = {FIRST: fault} if fault else {}
    choices.setdefault("goals", ["SB1/State_ccc"])
    return Story(made, FakeHost(made, faults=faults, **(host or {})), **choices)


def hierarchy(faults: dict[str, Fault], **choices: Any) -> Story:
    made = sample("registration-digitization")
    return Story(made, FakeHost(made, faults=faults, **choices.pop("host", {})), **choices)


def test_clause_7_a_returned_success_is_no_evidence() -> None:
    story = hanoi(Fault(Outcome.RETURNED, writes={})).run()
    assert story.of("operation_ended")[0].outcome == "returned"
    assert story.of("state_checked")[1].result == "false"
    assert story.commits[0] != (FIRST,)
    assert story.of("operation_risky")[0].address == FIRST


@pytest.mark.parametrize(
    ("fault", "outcome"),
    [
        (Fault(Outcome.FAILED), "failed"),
        (Fault(Outcome.RAISED), "raised"),
        (Fault(hangs=True), "timed_out"),
    ],
)
def test_clause_7_a_failure_is_a_failure_whatever_the_check_says(
    fault: Fault, outcome: str
) -> None:
    story = hanoi(fault).run()
    assert story.of("operation_ended")[0].outcome == outcome
    assert story.of("operation_risky")[0].address == FIRST
    assert (FIRST,) not in story.commits


def test_clause_7_the_check_decides_after_the_declared_time() -> None:
    story = hanoi(host={"settle": 0.3}).tick(2)
    assert story.of("operation_ended")[0].t == pytest.approx(TICK)
    assert not story.of("committed")
    story.tick(3)
    assert story.of("committed")[0].t == pytest.approx(TICK + 0.3)


def test_clause_7_a_time_out_brakes() -> None:
    story = hanoi(Fault(hangs=True), host={"timeout": 0.5}).run()
    assert story.of("operation_ended")[0].t == pytest.approx(0.5)
    assert "cancel abort" in story.host.calls  # type: ignore[attr-defined]


def test_clause_8_an_unchanged_scene_goes_on_and_bypasses_the_risky_edge() -> None:
    story = hanoi(Fault(Outcome.FAILED, writes={})).run()
    assert story.end.reason == "goal_reached"
    assert FIRST not in story.started[1:]
    assert story.of("relocalised")[0].configuration == {"SB1": "State_aaa"}
    assert not story.of("held")


def test_clause_8_a_scene_that_differs_holds_and_names_what_it_agrees_with() -> None:
    story = hanoi(Fault(Outcome.FAILED)).run()
    (mismatch,) = story.of("mismatch")
    assert mismatch.facts == ("Fact 1 of SB1 reads c, not a",)
    assert mismatch.candidates == ({"SB1": "State_caa"},)
    assert story.end.reason == "held"
    assert "says that it failed" in story.end.sentence


def test_clause_8_exactly_one_agreeing_configuration_may_be_adopted() -> None:
    story = hanoi(Fault(Outcome.FAILED), on_mismatch="adopt").run()
    assert story.of("relocalised")[0].configuration == {"SB1": "State_caa"}
    assert story.end.reason == "goal_reached"
    assert len(story.commits) == 6


def test_clause_8_no_agreeing_configuration_is_never_adopted() -> None:
    fault = Fault(Outcome.FAILED, writes={("SB1", 0): "nowhere"})
    story = hanoi(fault, on_mismatch="adopt").run()
    assert story.of("mismatch")[0].candidates == ()
    assert story.end.reason == "held"


def test_clause_8_an_unknown_fact_holds() -> None:
    class Loses(FakeHost):
        def _resume(self) -> Outcome:
            result = super()._resume()
            self.facts["SB1", 0] = None
            return result

    made = sample("hanoi-corrected")
    story = Story(made, Loses(made)).run()
    assert story.end.reason == "held"
    assert story.commits == []
    assert "Fact 1 of SB1 is unknown, no valid reading" in story.end.sentence


def test_clause_8_where_only_risky_edges_remain_the_run_holds_and_names_them() -> None:
    made = blueprint({"ONE": branch({"0": "go>1", "1": ""})})
    story = Story(made, FakeHost(made, faults={"ONE/State0/go": Fault(Outcome.FAILED, {})})).run()
    assert story.end.reason == "held"
    assert story.end.sentence == "Only risky operations lead to ONE/State1: ONE/State0/go."


def test_avoided_edges_alone_leave_no_route_and_every_edge_says_why() -> None:
    made = blueprint({"ONE": branch({"0": "go>1, loop>0", "1": ""})})
    story = Story(made, avoid=["ONE/State0/go"]).run()
    assert story.end.reason == "no_route"
    assert story.of("held")[0].details == (
        "ONE/State0/go: ONE/State0/go is avoided",
        "ONE/State0/loop: possible, but no way leads on from State0",
    )


def test_of_very_many_edges_the_first_say_why() -> None:
    loops = ", ".join(f"loop{number}>0" for number in range(210))
    made = blueprint({"ONE": branch({"0": f"go>1, {loops}", "1": ""})})
    details = Story(made, avoid=["ONE/State0/go"]).run().of("held")[0].details
    assert len(details) == 201
    assert details[199].startswith("ONE/State0/loop198: ")
    assert details[200] == "and 11 more operations"


LINE = branch({"00": "a>10", "10": "b>11, other>00", "11": "c>00"}, activating="11")
ROUTE = {"BASE": branch({"00": "up>10, mix>11", "10": "on>11", "11": "down>00"}, subs={"SUB": 0})}


def based(faults: dict[str, Fault], **choices: Any) -> Story:
    made = blueprint({**ROUTE, "SUB": LINE})
    return Story(made, FakeHost(made, faults=faults), goals=["BASE/State10"], **choices)


def test_clause_8_before_a_crossing_the_base_stays_and_the_sub_is_relocalised() -> None:
    """The sub's first step fails, but did move: no base fact hangs on it, so the run goes on from
    there; the root's edge is risky with it, and the direct way takes it along, so only risky
    edges are left."""
    story = based({"SUB/State00/a": Fault(Outcome.FAILED)}).run()
    assert story.of("relocalised")[0].configuration == {"BASE": "State00", "SUB": "State10"}
    risky = [event.address for event in story.of("operation_risky")]
    assert risky == ["SUB/State00/a", "BASE/State00/up"]
    assert story.end.reason == "held"
    assert "BASE/State00/up" in story.end.sentence


def test_clause_8_while_pending_nothing_is_committed_and_default_is_hold() -> None:
    story = based({"SUB/State10/b": Fault(Outcome.FAILED)}).run()
    assert story.commits == [("SUB/State00/a",)]
    assert story.end.reason == "held"
    assert story.end.configuration == {"BASE": "State00", "SUB": "State10"}
    (mismatch,) = story.of("mismatch")
    assert mismatch.candidates == ({"BASE": "State10", "SUB": "State11"},)


def test_clause_8_a_crossing_that_ends_elsewhere_is_pending_and_not_relocalised_alone() -> None:
    back = Fault(Outcome.FAILED, writes={("SUB", 0): "0", ("SUB", 1): "0"})
    story = based({"SUB/State10/b": back}).run()
    assert story.end.reason == "held"
    assert story.of("mismatch")[0].candidates == ({"BASE": "State00", "SUB": "State00"},)


def test_clause_8_two_agreeing_configurations_are_a_hold_also_where_one_may_be_adopted() -> None:
    values = {"ONE": branch({"0": "go>1, far>2", "1": "", "2": ""}, activating="2")}
    values["ONE"]["Twin_1"] = {}
    made = blueprint(values)
    faults = {"ONE/State0/far": Fault(Outcome.FAILED, writes={("ONE", 0): "1"})}
    story = Story(made, FakeHost(made, faults=faults), on_mismatch="adopt").run()
    assert len(story.of("mismatch")[0].candidates) == 2
    assert story.end.reason == "held"


def test_clause_8_a_candidate_must_agree_with_itself() -> None:
    """Two states of the sub read alike; only the one in ACTIVATING goes with a base that is on."""
    values = {**ROUTE, "SUB": {**LINE, "Twin_11": {}}}
    made = blueprint(values)
    host = FakeHost(made, faults={"SUB/State10/b": Fault(Outcome.FAILED)})
    story = Story(made, host, goals=["BASE/State10"], on_mismatch="adopt").run()
    assert story.of("mismatch")[0].candidates == ({"BASE": "State10", "SUB": "State11"},)
    assert story.end.reason == "goal_reached"


def test_clause_8_while_pending_the_one_agreeing_configuration_may_be_adopted() -> None:
    story = based({"SUB/State10/b": Fault(Outcome.RAISED)}, on_mismatch="adopt").run()
    assert story.end.reason == "goal_reached"
    assert story.end.configuration == {"BASE": "State10", "SUB": "State11"}


def test_clause_8_while_pending_an_unchanged_scene_goes_on_from_what_is_committed() -> None:
    story = based({"SUB/State10/b": Fault(Outcome.FAILED, writes={})}).run()
    assert story.of("relocalised")[0].configuration == {"BASE": "State00", "SUB": "State10"}
    assert not story.of("mismatch")


def test_clause_6_and_8_an_own_function_that_fails_leaves_every_crossing_uncommitted() -> None:
    made = sample("registration-digitization")
    faults = {"REGISTRATION/State110/ReinitState": Fault(Outcome.RAISED, writes={})}
    start = {"REGISTRATION": "State110"}
    host = FakeHost(made, faults=faults)
    story = Story(made, host, start=start, automatic=False).ask("ReinitState")
    assert short(story.started) == ["ReinitState", "ReinitState"]
    assert story.commits == []
    assert story.configuration == {"REGISTRATION": "State110", "DIGITIZATION": "State1"}
    assert story.phase == "fault_hold"
    agreed = {"REGISTRATION": "State100", "DIGITIZATION": "State0"}
    assert story.dispatcher.status.candidates == (agreed,)
    story.dispatcher.adopt()
    assert story.tick().configuration == agreed
    assert story.phase == "ready"


def test_clause_9_a_fact_that_moves_by_itself_while_idle_holds() -> None:
    story = hanoi(automatic=False).tick(3)
    story.host.facts["SB1", 2] = "b"  # type: ignore[attr-defined]
    story.tick()
    assert story.phase == "fault_hold"
    assert story.dispatcher.status.sentence == (
        "SB1/State_aaa does not check true: Fact 3 of SB1 reads b, not a"
    )
    story.host.facts["SB1", 2] = "a"  # type: ignore[attr-defined]
    story.dispatcher.resume()
    story.tick()
    assert story.phase in ("ready", "running")


def test_clause_9_after_a_step_the_other_roots_are_checked_too() -> None:
    made = sample("three-roots")
    writes = {("ROBOT", 0): "1", ("REGISTRATION", 0): "1"}
    fault = Fault(Outcome.RETURNED, writes={**writes, ("TOOLPLAN", 1): "1"})
    host = FakeHost(made, faults={"ROBOT/State00/SwitchOn": fault})
    story = Story(made, host, goals=["ROBOT/State10"]).run()
    assert story.commits == [("ROBOT/State00/SwitchOn",)]
    assert story.end.reason == "held"
    assert "TOOLPLAN/State00" in story.end.sentence or "REGISTRATION" in story.end.sentence


def test_clause_9_a_flicker_shorter_than_the_settling_time_is_no_mismatch() -> None:
    story = hanoi(host={"settle": 0.3}, automatic=False).tick(2)
    story.host.facts["SB1", 2] = "b"  # type: ignore[attr-defined]
    story.tick(2)
    story.host.facts["SB1", 2] = "a"  # type: ignore[attr-defined]
    story.tick(5)
    assert story.phase == "ready"
    assert not story.of("mismatch")


def test_clause_13_facts_nobody_senses_are_believed() -> None:
    made = sample("registration-digitization")
    facts = [("REGISTRATION", 0), ("REGISTRATION", 2), ("DIGITIZATION", 0)]
    story = Story(made, FakeHost(made, blind=facts), avoid=_previous(made)).run()
    assert story.end.reason == "goal_reached"
    assert not story.of("fact_changed")


def _previous(made: Any) -> list[str]:
    edges = (edge.address for edge in made["REGISTRATION"].edges())
    return [str(address) for address in edges if address.operation == "UsePrevRegister"]


def test_a_host_that_dies_holds_with_the_reason_and_ends_as_failed() -> None:
    story = hanoi(host={"broken_at": 3, "lasts": 2}).run()
    assert story.words[-2:] == ["held", "run_finished"]
    assert (story.end.reason, story.end.sentence) == ("failed", "the world's process was killed")
    assert story.end.configuration == {"SB1": "State_caa"}
    assert story.dispatcher.status.phase == "fault_hold"
    assert story.dispatcher.status.running is None


def test_restoring_a_risky_edge_lets_the_held_run_go_on() -> None:
    made = blueprint({"ONE": branch({"0": "go>1", "1": ""})})
    host = FakeHost(made, faults={"ONE/State0/go": Fault(Outcome.FAILED, {})})
    story = Story(made, host, attended=True).run()
    assert story.phase == "fault_hold"
    host.faults.clear()
    story.dispatcher.restore(Address("ONE", "State0", "go"))
    story.dispatcher.resume()
    assert story.run().end.reason == "goal_reached"
