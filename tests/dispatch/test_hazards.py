"""Hazards while a run goes on: refusals before motion, holds at any tick, and the ways out."""

from __future__ import annotations

from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.host.protocol import Host, Outcome
from smsl_studio.runlog.grammar.automaton import Grammar
from tests.dispatch.fake_host import TICK, FakeHost, Fault
from tests.dispatch.runs import Story, blueprint, branch

HAZARD = {"name": "Blind cut", "facts": {"A/0": "1", "B/0": "1"}}
FACTS = {"A/0": "1", "B/0": "1"}


def made(hazards: Any = (HAZARD,), **more: Any) -> Blueprint:
    """A goes from 0 over 1 to 2; B may be set and cleared. Both 1 is the hazard."""
    return blueprint(
        {
            "_hazards": list(hazards),
            "A": branch({"0": "go>1", "1": "on>2, back>0", "2": "down>1"}, activating="2"),
            "B": branch({"0": "set>1", "1": "clear>0"}, activating="0"),
            **more,
        }
    )


def told(story: Run, kind: str = "hazard") -> Any:
    """The last hold, which has this kind; and the story is a possible one."""
    possible(story)
    held = story.of("held")[-1]
    assert held.kind == kind
    return held


class Run(Story):
    """A run that knows whether it was begun by hand."""

    def __init__(self, blueprint: Blueprint, host: Host | None = None, **choices: Any) -> None:
        self.by_hand = not choices.get("automatic", True)
        super().__init__(blueprint, host, **choices)


def possible(story: Run) -> None:
    grammar = Grammar({"by_hand": story.by_hand}, COMMANDS)
    for event in story.events:
        assert grammar.follow(event) == "", event


def put(story: Run, **facts: str | None) -> None:
    """Change facts of the table behind the run's back."""
    assert isinstance(story.host, FakeHost)
    for name, value in facts.items():
        story.host.facts[name, 0] = value


def by_hand(on: Blueprint | None = None, **choices: Any) -> Run:
    on = on or made()
    return Run(on, FakeHost(on, lasts=choices.pop("lasts", 1)), automatic=False, **choices).tick()


# before motion ---------------------------------------------------------------------------------


def test_a_person_by_hand_is_refused_with_code_and_name() -> None:
    story = by_hand().ask("B/set", "A/go")
    (refused,) = story.of("operation_refused")
    assert (refused.address, refused.code, refused.hazard) == ("A/State0/go", "hazard", "Blind cut")
    assert "would meet the hazard Blind cut" in refused.reasons[0]
    assert (story.started, story.phase, story.of("held")) == (["B/State0/set"], "ready", [])
    assert story.of("commanded")[-1].refused == refused.reasons[0]
    possible(story)


def test_other_refusals_tell_no_code() -> None:
    story = by_hand().ask("A/go", "A/go")
    line = next(one.line() for one in story.events if one.event == "operation_refused")
    assert "code" not in line
    assert "hazard" not in line


def test_what_the_run_believes_and_what_is_sensed_both_refuse() -> None:
    """B is sensed as 1 and believed as 0: the scene counts."""
    story = by_hand(made(), attended=True)
    put(story, B="1")
    story.dispatcher.ask(Address("A", "State0", "go"))
    story.tick()
    (refused,) = story.of("operation_refused")
    assert (refused.code, refused.hazard, story.started) == ("hazard", "Blind cut", [])


def test_an_unknown_fact_that_could_complete_it_refuses_and_holds_nothing() -> None:
    more = {"C": branch({"0": "move>1", "1": ""}, activating="1")}
    story = by_hand(made(**more))
    put(story, B=None)
    story.tick(20)
    assert (story.phase, story.of("held", "hazard_met")) == ("ready", [])
    story.ask("A/go", "C/move")
    (refused,) = story.of("operation_refused")
    assert (refused.address, refused.code, refused.hazard) == ("A/State0/go", "hazard", "Blind cut")
    assert "B/0 is unknown" in refused.reasons[0]
    assert story.started == ["C/State0/move"]
    possible(story)


def test_an_unknown_fact_that_cannot_complete_it_refuses_nothing() -> None:
    facts = {**FACTS, "C/0": "1"}
    more = {"C": branch({"0": "move>1", "1": ""})}
    story = by_hand(made([{"name": "h", "facts": facts}], **more))
    put(story, B=None)
    story.tick(5).ask("A/go")
    assert story.started == ["A/State0/go"]


def test_an_unknown_fact_and_the_goal_of_that_tick() -> None:
    """The goal is confirmed although a hazard could be met: unknown is no hold."""
    on = made([{"name": "h", "facts": {"A/0": "2", "B/0": "1"}}])
    story = Run(on, goals=["A/State1"])
    while not story.commits:
        story.tick()
    put(story, B=None)
    story.run()
    assert story.end.reason == "goal_reached"
    possible(story)


def test_an_automatic_run_holds_at_a_refusal_and_says_hazard() -> None:
    story = Run(made(), goals=["A/State2"], attended=True)
    put(story, B=None)
    story.tick(8)
    held = told(story)
    assert held.reason.startswith("A/State1/on cannot begin: ")
    assert (story.started, story.phase) == (["A/State0/go"], "fault_hold")


def test_a_start_that_meets_a_hazard_is_refused_and_opens_nothing() -> None:
    start = {"A": "State1", "B": "State1"}
    story = Run(made(), start=start)
    assert (story.words, story.end.reason) == (["run_finished"], "refused")
    assert "the start meets a hazard: the hazard Blind cut is met" in story.end.sentence
    assert story.host.calls == []  # type: ignore[attr-defined]


def test_before_each_function_the_scene_is_asked_again() -> None:
    """A rise of two functions: the guard agreed, and then another fact changed meanwhile."""
    values = {
        "_hazards": [{"name": "h", "facts": {"S/1": "1", "B/0": "1"}}],
        "A": branch({"0": "rise>1", "1": ""}, activating="1", subs={"S": 0}),
        "S": branch({"00": "near>10", "10": "end>11", "11": ""}, activating="11"),
        "B": branch({"0": "set>1", "1": ""}, activating="0", initial="0"),
    }
    on = blueprint(values)
    turn = Fault(writes={("S", 0): "1", ("B", 0): None})
    story = Run(on, FakeHost(on, faults={"S/State00/near": turn}), attended=True).run()
    assert story.started == ["A/State0/rise", "S/State00/near"]
    held = told(story)
    assert held.reason == "S/State10/end changes a fact of the hazard h, and B/0 is unknown"
    plain = Run(on, FakeHost(on), attended=True).run()
    assert plain.end.reason == "goal_reached"


# at any tick -----------------------------------------------------------------------------------


@pytest.mark.parametrize("stop", ["hold", "abort"])
@pytest.mark.parametrize("attended", [True, False])
@pytest.mark.parametrize("settle", [0.0, 0.5])
def test_in_mid_operation_it_stops_and_holds_within_one_tick(
    stop: str, attended: bool, settle: float
) -> None:
    on = made()
    host = FakeHost(on, lasts=10, stop=stop, settle=settle)
    story = Run(on, host, goals=["A/State2"], start={"A": "State1"}, attended=attended).tick(4)
    before = story.dispatcher.time
    put(story, B="1")
    story.tick()
    (met,) = story.of("hazard_met")
    assert (met.name, met.facts, met.t) == ("Blind cut", FACTS, pytest.approx(before + TICK))
    (ended,) = story.of("operation_ended")
    assert (ended.outcome, f"cancel {stop}" in host.calls) == ("cancelled", True)
    assert "the hazard Blind cut is met" in told(story).reason
    assert told(story).t == pytest.approx(before + TICK)
    assert (story.commits, story.phase) == ([], "fault_hold")
    assert story.dispatcher.finished is not attended


def test_an_operation_that_finishes_commits_nothing() -> None:
    on = made()
    host = FakeHost(on, lasts=6, stop="finish")
    story = Run(on, host, goals=["A/State2"], start={"A": "State1"}, attended=True).tick(4)
    put(story, B="1")
    story.tick()
    assert (len(story.of("hazard_met")), story.of("held")) == (1, [])
    story.run()
    assert (story.commits, len(story.of("hazard_met"))) == ([], 1)
    told(story)


def test_the_last_tick_of_an_operation_does_not_commit() -> None:
    on = made()
    turn = Fault(writes={("A", 0): "1", ("B", 0): "1"})
    story = Run(on, FakeHost(on, faults={"A/State0/go": turn}), attended=True).run()
    assert story.commits == []
    assert told(story).t == story.of("hazard_met")[0].t


@pytest.mark.parametrize("phase", ["ready", "fault_hold", "taken_over"])
def test_while_idle_while_it_holds_and_while_taken_over(phase: str) -> None:
    story = by_hand(attended=True).ask("A/go")
    if phase == "fault_hold":
        put(story, A="2")
        story.tick()
        assert story.of("held")[-1].kind == "held"
        put(story, A="1")
    if phase == "taken_over":
        story.dispatcher.take_over(by="Brandt")
    story.tick()
    assert story.phase == phase
    put(story, B="1")
    story.tick()
    assert [one.name for one in story.of("hazard_met")] == ["Blind cut"]
    told(story)
    assert story.phase == ("taken_over" if phase == "taken_over" else "fault_hold")
    story.tick(5)
    assert len(story.of("hazard_met")) == 1, "it is told once while it lasts"
    put(story, B="0")
    story.tick()
    put(story, B="1")
    story.tick()
    assert len(story.of("hazard_met")) == 2
    possible(story)


def test_the_goal_of_that_tick_is_not_told() -> None:
    on = made([{"name": "h", "facts": {"A/0": "2", "B/0": "1"}}])
    story = Run(on, goals=["A/State2"], attended=True)
    while len(story.commits) < 2:
        story.tick()
    put(story, B="1")
    story.tick()
    assert (story.of("goal_reached"), told(story).kind) == ([], "hazard")


def test_a_stop_counts_more_and_the_hold_comes_when_it_would_go_on() -> None:
    story = by_hand(attended=True).ask("A/go")
    story.dispatcher.stop(by="Brandt")
    story.tick()
    put(story, B="1")
    story.tick(2)
    assert (story.phase, len(story.of("hazard_met")), story.of("held")) == ("stopped", 1, [])
    story.dispatcher.reset(by="Brandt")
    story.tick()
    assert story.phase == "paused"
    story.dispatcher.resume(by="Brandt")
    story.tick(2)
    told(story)
    assert story.phase == "fault_hold"


# out of it -------------------------------------------------------------------------------------


def endangered() -> Run:
    """By hand, A is in 1, and somebody has set B."""
    story = by_hand(attended=True).ask("A/go")
    put(story, B="1")
    return story.tick()


def test_leaving_is_offered_and_never_automatic() -> None:
    story = endangered()
    offers = {one.address: one.sentence for one in story.dispatcher.status.offers if one.address}
    assert list(offers) == ["A/State1/on", "A/State1/back"]
    assert "It leaves the hazard Blind cut" in offers["A/State1/back"]
    started = list(story.started)
    story.tick(10)
    assert (story.started, story.phase) == (started, "fault_hold")
    story.dispatcher.resume(by="Brandt")
    story.tick(3)
    assert (story.started, story.phase, len(story.of("held"))) == (started, "fault_hold", 2)
    told(story)


def test_an_operation_that_leaves_it_is_carried_out() -> None:
    story = endangered()
    story.dispatcher.ask(Address("A", "State1", "back"))
    story.tick(4)
    assert story.commits[-1] == ("A/State1/back",)
    held = story.of("held")
    assert [one.kind for one in held] == ["hazard", "held"], "B still differs from what is believed"
    possible(story)


def test_an_operation_that_stays_in_it_is_refused() -> None:
    more = {"C": branch({"0": "move>1", "1": ""})}
    story = by_hand(made(**more), attended=True).ask("A/go")
    put(story, B="1")
    story.tick()
    story.dispatcher.ask(Address("C", "State0", "move"))
    story.tick()
    assert story.of("operation_refused")[-1].hazard == "Blind cut"


def test_another_hazard_while_one_is_left_stops_it() -> None:
    other = {"name": "Other", "facts": {"C/0": "1"}}
    on = made([HAZARD, other], C=branch({"0": "move>1", "1": ""}))
    story = by_hand(on, attended=True, lasts=5).ask("A/go")
    put(story, B="1")
    story.tick()
    story.dispatcher.ask(Address("A", "State1", "back"))
    story.tick(2)
    assert story.dispatcher.status.running == Address("A", "State1", "back")
    put(story, C="1")
    story.tick()
    assert [one.name for one in story.of("hazard_met")] == ["Blind cut", "Other"]
    assert (told(story).kind, story.phase) == ("hazard", "fault_hold")


def test_nothing_is_adopted_by_itself_and_an_adopted_hazard_still_holds() -> None:
    story = by_hand(on_mismatch="adopt", attended=True).ask("A/go")
    put(story, B="1")
    story.tick()
    assert (story.configuration["B"], story.phase) == ("State0", "fault_hold")
    story.dispatcher.adopt(by="Brandt")
    story.tick()
    assert (story.configuration["B"], told(story).kind) == ("State1", "hazard")
    story.ask("B/clear")
    assert story.configuration == {"A": "State1", "B": "State0"}
    assert story.phase == "ready"
    possible(story)


def test_what_is_given_back_in_a_hazard_holds_at_once() -> None:
    story = by_hand(attended=True).ask("A/go")
    story.dispatcher.take_over(by="Brandt")
    story.tick()
    put(story, B="1")
    story.tick(2)
    story.dispatcher.give_back(by="Brandt")
    story.tick()
    story.dispatcher.accept(by="Brandt")
    story.tick()
    assert (story.configuration["B"], story.phase) == ("State1", "fault_hold")
    assert [one.kind for one in story.of("held")] == ["hazard", "hazard"]
    told(story)


# with other clauses -------------------------------------------------------------------------------


def test_what_an_operation_requires_and_a_hazard_are_both_watched() -> None:
    note = {"requires": {"C/0": "0"}}
    more = {
        "A": branch({"0": "go>1", "1": ""}, activating="1", operations={"go": note}),
        "C": branch({"0": "move>1", "1": ""}, activating="0"),
    }
    on = made([{"name": "h", "facts": {"B/0": "1", "C/0": "1"}}], **more)
    story = Run(on, FakeHost(on, lasts=10), goals=["A/State1"], attended=True).tick(4)
    put(story, B="1", C="1")
    story.tick()
    held = told(story)
    assert "the hazard h is met" in held.reason
    story = Run(on, FakeHost(on, lasts=10), goals=["A/State1"], attended=True).tick(4)
    put(story, C="1")
    story.tick()
    told(story, "guard_lost")


def test_a_shared_sub_that_is_pending_counts_and_its_bases_as_committed() -> None:
    """P and Q share S. P's rise has a function of its own, so S and Q are pending meanwhile."""
    base = branch({"00": "up>11", "11": ""}, activating="11", subs={"S": 0})
    other = branch({"0": "too>1", "1": ""}, activating="1", subs={"S": 0})
    sub = branch({"0": "on>1", "1": ""}, activating="1")
    for facts, reason in (
        ({"S/0": "1", "P/1": "0"}, "no_route"),
        ({"P/0": "1", "P/1": "0"}, "goal_reached"),
        ({"Q/0": "1", "P/1": "0"}, "no_route"),
    ):
        values = {"_hazards": [{"name": "h", "facts": facts}], "P": base, "Q": other, "S": sub}
        story = Run(blueprint(values), goals=["P/State11"]).run()
        assert (facts, story.end.reason) == (facts, reason)
        assert not story.of("hazard_met")


@pytest.mark.parametrize("note", [{}, {"subs": "load"}])
def test_a_function_that_moves_a_base_meets_nothing_halfway(note: dict[str, str]) -> None:
    """The other digit of P is new already, and the digit in transit is still the old one."""
    edges = {"00": "go>11", "11": ""}
    base = branch(edges, activating="11", subs={"S": 1}, operations={"go": note})
    sub = branch({"0": "on>1", "1": ""}, activating="1")
    hazards = [{"name": "h", "facts": {"P/0": "1", "P/1": "0"}}]
    story = Run(blueprint({"_hazards": hazards, "P": base, "S": sub})).run()
    assert (story.end.reason, story.of("hazard_met")) == ("goal_reached", [])


def test_a_fact_without_a_sensor_is_unknown_while_the_running_function_changes_it() -> None:
    """A/1 is 0 before the operation and 1 after it; A/0 is sensed and changes first."""
    values = {
        "_hazards": [{"name": "h", "facts": {"A/0": "1", "A/1": "0"}}],
        "A": branch({"00": "go>11", "11": ""}, activating="11"),
    }
    on = blueprint(values)
    story = Run(on, FakeHost(on, lasts=3, blind=[("A", 1)])).run()
    assert (story.end.reason, story.of("hazard_met")) == ("goal_reached", [])


def test_a_fact_without_a_sensor_that_the_running_function_lets_be_is_believed() -> None:
    more = {"C": branch({"0": "move>1", "1": ""}, activating="0")}
    on = made([{"name": "h", "facts": {"B/0": "0", "C/0": "1"}}], **more)
    host = FakeHost(on, lasts=10, blind=[("B", 0)])
    story = Run(on, host, goals=["A/State1"], attended=True).tick(4)
    assert (story.phase, story.of("hazard_met")) == ("running", [])
    put(story, C="1")
    story.tick()
    told(story)


def test_a_base_digit_is_sensed_by_the_check_of_its_sub() -> None:
    values = {
        "_hazards": [{"name": "h", "facts": {"P/0": "1", "A/0": "1"}}],
        "P": branch({"0": "up>1", "1": ""}, activating="1", subs={"S": 0}),
        "S": branch({"0": "on>1", "1": ""}, activating="1"),
        "A": branch({"0": "go>1", "1": "back>0"}, activating="1"),
    }
    story = by_hand(blueprint(values), attended=True).ask("A/go")
    put(story, S="1")
    story.tick()
    (met,) = story.of("hazard_met")
    assert met.facts == {"P/0": "1", "A/0": "1"}
    told(story)


def test_a_failed_operation_in_a_hazard_holds_for_the_hazard() -> None:
    on = made()
    slip = Fault(Outcome.FAILED, writes={("A", 0): "1", ("B", 0): "1"})
    story = Run(on, FakeHost(on, faults={"A/State0/go": slip}), on_mismatch="adopt").run()
    assert (told(story).kind, story.end.reason) == ("hazard", "held")
    assert not story.of("goal_reached")


def test_what_cannot_be_read_stands_in_the_first_lines() -> None:
    from smsl_studio.front.runs import run

    odd = {"name": "Odd", "facts": {"X/0": "1"}}
    done = run(made([odd, HAZARD, {"name": "Blind cut", "facts": {"B/0": "0"}}]), goal="A/State2")
    assert done.reason == "goal_reached"
    first, *left = done.events[:3]
    assert first.event == "run_started"
    assert [(one.event, one.address) for one in left] == [  # type: ignore[attr-defined]
        ("left_out", "_hazards/Odd"), ("left_out", "_hazards/Blind cut"),
    ]  # fmt: skip
    assert "X/0" in left[0].sentence  # type: ignore[attr-defined]
    many = run(made(range(150)), goal="A/State2")
    assert sum(one.event == "left_out" for one in many.events) == 101


def test_without_hazards_nothing_is_written_differently() -> None:
    story = Run(made([]), goals=["A/State2"]).run()
    assert not {"hazard_met", "left_out"} & set(story.words)
