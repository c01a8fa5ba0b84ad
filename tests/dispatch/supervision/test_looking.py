"""The other parts of a status: since when, from where, offers, detour, needs."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from tests.dispatch.fake_host import FakeHost
from tests.dispatch.runs import Story, blueprint, branch, sample, short
from tests.dispatch.supervision.runs import FIRST, between, fault_hold, hanoi, said, taken_over


def test_since_when_and_from_where() -> None:
    story = between()
    status = story.dispatcher.status
    assert status.since == {"SB1": story.of("committed")[0].t}
    assert status.previous == {"SB1": FIRST}


def test_where_no_edge_of_the_run_led_there_is_no_previous() -> None:
    story = fault_hold()
    said(story, "adopt")
    status = story.dispatcher.status
    assert status.configuration == {"SB1": "State_baa"}
    assert status.previous == {}
    assert status.since["SB1"] > 0


def test_the_detour_is_the_way_if_the_next_operation_were_vetoed() -> None:
    story = between()
    detour = story.dispatcher.status.detour
    assert detour is not None
    assert len(detour) >= 6
    assert short(map(str, detour))[0] != "Op_2b"
    said(story, "veto")
    assert story.tick().of("route_planned")[-1].operations == tuple(map(str, detour))


def test_unattended_nobody_looks_for_a_detour() -> None:
    assert between(attended=False).dispatcher.status.detour is None


def test_what_a_possible_edge_needs_risks_and_who_acts() -> None:
    story = Story(sample("three-roots"), automatic=False).ask("ROBOT/SwitchOn")
    edge = Address("ROBOT", "State10", "MoveToTarget")
    (one,) = [p for p in story.dispatcher.status.possible if p.address == edge]
    assert next((term.fact, term.wanted, term.truth) for term in one.needs) == (
        ("REGISTRATION", 2), "1", False)  # fmt: skip
    notes = {"go": {"risk": "high", "actor": "human"}}
    made = blueprint({"ONE": branch({"0": "go>1", "1": ""}, operations=notes)})
    story = Story(made, FakeHost(made), automatic=False, attended=True).tick()
    (one,) = story.dispatcher.status.possible
    assert (one.risk, one.level) == ("high", "human")
    said(story, "veto", one.address)
    assert story.dispatcher.status.possible[0].vetoed


def test_who_has_taken_over_or_stopped_and_whether_the_whole_map_is_shown() -> None:
    story = taken_over()
    assert story.dispatcher.status.by == "Brandt"
    assert story.dispatcher.status.sentence == "Brandt has taken over."
    said(story, "full_map", True, by="Weiss")
    assert story.dispatcher.status.full_map
    assert story.of("commanded")[-1].value == "on"
    said(story, "stop", by="Weiss")
    assert (story.phase, story.dispatcher.status.by) == ("stopped", "Weiss")


def test_while_it_is_latched_nothing_is_permitted_and_the_reason_is_said() -> None:
    story = taken_over()
    for one in story.dispatcher.status.possible:
        assert not one.permitted
        assert one.reasons[-1].startswith("Brandt has taken over")
    said(story, "stop")
    reasons = {one.reasons[-1] for one in story.dispatcher.status.possible}
    assert reasons == {"the run is stopped, reset it first"}


def test_a_status_is_kept_until_something_happens_and_sources_are_in_it() -> None:
    story = hanoi().tick(2)
    status = story.dispatcher.status
    assert status is story.dispatcher.status
    assert {one.fact for one in status.sources} == {("SB1", 0), ("SB1", 1), ("SB1", 2)}


def test_one_tick_takes_commands_by_rank_and_what_holds_counts_more_than_what_goes() -> None:
    story = between()
    for word in ("resume", "step", "pause", "stop"):
        getattr(story.dispatcher, word)()
    story.tick()
    answers = [(one.command, one.refused == "") for one in story.of("commanded")]
    assert answers == [("stop", True), ("pause", False), ("step", False), ("resume", False)]
    story = between()
    for word in ("step", "pause"):
        getattr(story.dispatcher, word)()
    assert story.tick().phase == "paused"
    assert story.of("commanded")[-1].refused == "pause came at the same tick and counts more"
    assert story.of("commanded")[-1].t <= story.of("paused")[-1].t


def test_an_answer_stands_before_its_effects() -> None:
    story = between()
    said(story, "stop")
    words = story.words
    assert words.index("commanded") == words.index("stopped") - 1


def test_disturbances_and_faults_are_told_and_unknown_ones_refused() -> None:
    story = hanoi().tick()
    assert said(story, "disturb", "SB1/0", "noise", rate=0.5).refused == ""
    (event,) = story.of("disturbed")
    assert (event.target, event.kind, event.parameters) == ("SB1/0", "noise", {"rate": "0.5"})
    assert (
        said(story, "disturb", "SB1/0", "nonsense").refused == "there is no disturbance 'nonsense'"
    )
    assert said(story, "inject", "slip").refused == ""
    assert story.of("fault_injected")[0].fault == "slip"
    assert said(story, "inject", "meteor").refused == "there is no fault 'meteor'"


def test_a_cost_changes_the_route_and_no_cost_is_refused() -> None:
    story = between()
    second = Address("SB1", "State_caa", "Op_2b")
    assert said(story, "set_cost", second, 100.0).refused == ""
    assert story.of("costs_changed")[0].costs == {str(second): 100.0}
    assert story.run().end.reason == "goal_reached"
    assert (str(second),) not in story.commits
    assert said(between(), "set_cost", second, -1.0).refused
    assert "there is no" in said(between(), "set_cost", Address("SB1", "State_caa", "X"), 1).refused
