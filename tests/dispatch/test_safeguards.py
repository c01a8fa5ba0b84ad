"""What is checked at every tick of a run: critical facts, and facts that running edges require."""

from __future__ import annotations

from typing import Any

import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.host.local import LocalHost
from smsl_studio.host.protocol import Outcome
from tests.dispatch.fake_host import TICK, FakeHost, Fault
from tests.dispatch.people.tasks import Attended
from tests.dispatch.runs import Story, blueprint, branch

CLAMP = {"facts": {"0": {"name": "Clamp", "critical": True}}}
GO = {"requires": {"B/0": "0"}}


def made(go: dict[str, Any] | None = None, clamp: dict[str, Any] | None = None) -> Blueprint:
    """A goes from 0 over 1 to 2; its operations may require B/0, which may be critical."""
    operations = {"go": go or {}, "on": {}}
    return blueprint(
        {
            "A": branch({"0": "go>1", "1": "on>2", "2": ""}, activating="2", operations=operations),
            "B": branch({"0": "z>1", "1": ""}, activating="1", **(clamp or {})),
        }
    )


REQUIRED, CRITICAL = made(GO), made(clamp=CLAMP)


def started(on: Blueprint, host: FakeHost | None = None, **choices: Any) -> Story:
    """The first operation runs, and takes ten ticks."""
    choices.setdefault("goals", ["A/State2"])
    story = Story(on, host or FakeHost(on, lasts=10), **choices).tick(4)
    assert story.words[-1] == "operation_started"
    return story


def facts(story: Story) -> dict[Any, Any]:
    assert isinstance(story.host, FakeHost)
    return story.host.facts


def lost(story: Story) -> Any:
    """The one hold of its own kind; nothing was committed, begun or told of a goal."""
    (held,) = story.of("held")
    assert (held.kind, story.commits, story.of("goal_reached")) == ("guard_lost", [], [])
    return held


@pytest.mark.parametrize("on", [REQUIRED, CRITICAL], ids=["required", "critical"])
@pytest.mark.parametrize("value", ["1", None], ids=["false", "unknown"])
@pytest.mark.parametrize("stop", ["hold", "abort"])
def test_a_loss_in_the_middle_stops_the_operation_as_it_declares(
    on: Blueprint, value: str | None, stop: str
) -> None:
    story = started(on, FakeHost(on, lasts=10, stop=stop))
    before = story.dispatcher.time
    facts(story)["B", 0] = value
    story.tick()
    (ended,) = story.of("operation_ended")
    assert (ended.outcome, ended.t) == ("cancelled", pytest.approx(before + TICK))
    assert f"cancel {stop}" in story.host.calls  # type: ignore[attr-defined]
    held = lost(story)
    assert story.end.reason == "held"
    assert "A/State0/go cannot go on: " in held.reason
    assert ("requires B/0 to be 0" in held.reason) is (on is REQUIRED)
    assert ("a critical fact" in held.reason) is (on is CRITICAL)
    assert not story.of("operation_risky")


def test_what_declares_finish_runs_to_its_end_and_commits_nothing() -> None:
    story = started(REQUIRED, FakeHost(REQUIRED, lasts=10, stop="finish"))
    facts(story)["B", 0] = "1"
    story.tick(2)
    facts(story)["B", 0] = "0"
    story.run()
    (ended,) = story.of("operation_ended")
    assert (ended.outcome, ended.t) == ("returned", pytest.approx(10 * TICK))
    assert lost(story).reason.startswith("A/State0/go cannot go on: ")


def test_a_failure_of_what_finishes_is_still_one() -> None:
    faults = {"A/State0/go": Fault(Outcome.FAILED, writes={})}
    story = started(REQUIRED, FakeHost(REQUIRED, faults=faults, lasts=10, stop="finish"))
    facts(story)["B", 0] = "1"
    story.run()
    assert lost(story).reason == "A/State0/go says that it failed"
    assert story.of("operation_risky")


def test_a_loss_in_the_very_tick_of_the_end() -> None:
    story = started(CRITICAL).tick(6)
    facts(story)["B", 0] = None
    story.tick()
    assert story.of("operation_ended")[0].outcome == "returned"
    lost(story)


def test_a_loss_while_the_world_settles() -> None:
    host = FakeHost(REQUIRED, lasts=1, settle=5 * TICK)
    story = Story(REQUIRED, host, goals=["A/State2"]).tick(3)
    assert story.of("operation_ended")
    facts(story)["B", 0] = "1"
    story.tick()
    facts(story)["B", 0] = "0"
    story.run()
    lost(story)


def test_a_loss_while_a_person_acts() -> None:
    on = made({**GO, "actor": "human"})
    story = Attended(on, goals=["A/State2"], attended=True).tick(2)
    assert story.asked == [("operation", "A/State0/go")]
    story.dispatcher.inject("set", fact="B/0", value="1")
    story.tick()
    assert (story.tasks, story.phase) == ((), "fault_hold")
    assert story.of("operation_ended")[0].outcome == "cancelled"
    lost(story)


def test_a_person_who_shall_finish_does_and_nothing_commits() -> None:
    on = made({**GO, "actor": "human", "stop": "finish"})
    story = Attended(on, goals=["A/State2"], attended=True).tick(2)
    story.dispatcher.inject("set", fact="B/0", value="1")
    story.tick(3)
    assert len(story.tasks) == 1
    story.say("done")
    assert story.of("operation_ended")[0].outcome == "returned"
    lost(story)


def test_a_loss_while_people_are_asked_what_was_reached() -> None:
    on = blueprint(
        {
            "A": branch(
                {"0": "go>1", "1": ""},
                activating="1",
                facts={"0": {"aggregation": "human"}},
                operations={"go": GO},
            ),
            "B": branch({"0": "z>1", "1": ""}, activating="1"),
        }
    )
    levels = {"A/0": "human"}
    story = Attended(on, goals=["A/State1"], levels=levels, attended=True)
    story.say("0").tick(3)
    assert story.asked[-1] == ("fact", "A/0")
    assert len(story.asked) == 2
    story.dispatcher.inject("set", fact="B/0", value="1")
    story.tick()
    assert story.tasks == ()
    lost(story)


def test_a_loss_while_people_are_asked_whether_it_may_begin() -> None:
    on = made({"confirm": ["surgeon"]}, CLAMP)
    story = Attended(on, goals=["A/State2"], attended=True).tick(2)
    assert [kind for kind, _ in story.asked] == ["confirm"]
    story.dispatcher.disturb("B/0", "dropout")
    story.tick(10)
    assert (story.tasks, story.started) == ((), [])
    assert lost(story).reason == "Clamp of B, a critical fact, is unknown, no reading for 0.4 s"


@pytest.mark.parametrize("automatic", [True, False])
def test_no_operation_begins_while_a_critical_fact_is_unknown(automatic: bool) -> None:
    story = Story(CRITICAL, automatic=False, attended=True)
    facts(story)["B", 0] = None
    story.tick()
    story.dispatcher.set_automatic(automatic)
    story.dispatcher.ask(next(CRITICAL["A"].edges()).address)
    story.tick(3)
    assert story.started == []
    lost(story)


def test_it_holds_on_until_the_fact_is_known_again() -> None:
    story = started(CRITICAL, attended=True)
    facts(story)["B", 0] = None
    story.tick()
    story.dispatcher.resume()
    story.tick(2)
    assert (story.phase, story.dispatcher.status.reason) == ("fault_hold", "held")
    facts(story)["B", 0] = "0"
    story.tick()
    story.dispatcher.resume()
    story.run()
    assert story.end.reason == "goal_reached"


def test_a_held_operation_is_not_resumed_after_a_loss() -> None:
    story = started(REQUIRED, attended=True)
    story.dispatcher.pause()
    story.tick()
    assert story.phase == "paused"
    facts(story)["B", 0] = None
    story.tick(3)
    assert story.phase == "paused"
    story.dispatcher.resume()
    story.tick()
    lost(story)


def test_idle_by_hand_a_critical_fact_is_watched() -> None:
    for value in ("1", None):
        story = Story(CRITICAL, automatic=False).tick(3)
        facts(story)["B", 0] = value
        story.tick()
        assert story.phase == "fault_hold"
        lost(story)


def test_nothing_is_adopted_by_itself_after_a_loss() -> None:
    story = started(CRITICAL, on_mismatch="adopt", attended=True)
    facts(story)["B", 0] = "1"
    story.tick(5)
    lost(story)
    assert story.configuration == {"A": "State0", "B": "State0"}
    assert story.dispatcher.status.candidates == ({"A": "State0", "B": "State1"},)


def test_what_the_step_itself_moves_is_not_missed() -> None:
    on = blueprint(
        {
            "A": branch(
                {"0": "go>1", "1": ""},
                activating="1",
                subs={"B": 0},
                facts={"0": {"critical": True}},
                operations={"go": {"requires": {"B/0": "0", "A/0": "0"}}},
            ),
            "B": branch(
                {"00": "u>10", "10": "v>11", "11": ""},
                activating="11",
                facts={"0": {"critical": True}, "1": {"critical": True}},
                operations={"v": {"requires": {"B/0": "1", "B/1": "0"}}},
            ),
        }
    )

    class Slow(FakeHost):
        """What an operation changes cannot be read while it runs."""

        def _samples(self) -> tuple[Any, ...]:
            samples = super()._samples()
            moving = {"B/State00/u": 0, "B/State10/v": 1}.get(str(self._edge))
            return tuple(one for one in samples if one.digit != moving)

    story = Story(on, Slow(on, lasts=10)).run()
    assert story.end.reason == "goal_reached"
    assert story.commits == [("B/State00/u",), ("B/State10/v", "A/State0/go")]


@pytest.mark.parametrize(
    ("fact", "tick", "commits"),
    [
        (("C", 0), 5, []),  # the base's edge requires it, and runs from the start
        (("C", 0), 15, [("B/State00/u",)]),
        (("C", 1), 15, [("B/State00/u",)]),  # only the second operation of the sub requires it
        (("A", 1), 15, [("B/State00/u",)]),  # a critical fact of the base that stays
        (("B", 0), 15, [("B/State00/u",)]),  # the sub's own, that its second operation leaves
    ],
)
@pytest.mark.parametrize("value", ["9", None])
def test_a_loss_below_a_base(
    fact: tuple[str, int], tick: int, commits: list[Any], value: str | None
) -> None:
    on = blueprint(
        {
            "A": branch(
                {"00": "go>10", "10": ""},
                activating="10",
                subs={"B": 0},
                facts={"1": {"critical": True}},
                operations={"go": {"requires": {"C/0": "0"}}},
            ),
            "B": branch(
                {"00": "u>10", "10": "v>11", "11": ""},
                activating="11",
                facts={"0": {"critical": True}},
                operations={"v": {"requires": {"C/1": "0"}}},
            ),
            "C": branch({"00": "z>11", "11": ""}, activating="11"),
        }
    )
    story = Story(on, FakeHost(on, lasts=10), goals=["A/State10"]).tick(tick)
    facts(story)[fact] = value
    story.run()
    (held,) = story.of("held")
    assert (held.kind, story.commits) == ("guard_lost", commits)
    assert len(story.started) == len(commits) + 2


def test_a_later_edge_does_not_begin_where_what_it_requires_was_lost_before() -> None:
    on = blueprint(
        {
            "A": branch({"0": "go>1", "1": ""}, activating="1", subs={"B": 0}),
            "B": branch(
                {"00": "u>10", "10": "v>11", "11": ""},
                activating="11",
                operations={"v": {"requires": {"C/0": "0"}}},
            ),
            "C": branch({"0": "z>1", "1": ""}, activating="1"),
        }
    )
    story = Story(on, FakeHost(on, lasts=10), goals=["A/State1"], attended=True).tick(5)
    facts(story)["C", 0] = None
    story.run()
    assert story.started == ["A/State0/go", "B/State00/u"]
    (held,) = story.of("held")
    assert held.kind == "guard_lost"
    assert held.reason.startswith("B/State10/v cannot go on: B/State10/v requires C/0 to be 0")


def test_the_critical_facts_of_people_are_asked_for_before_it_holds() -> None:
    on = blueprint(
        {
            "A": branch({"0": "go>1", "1": "on>2", "2": ""}, activating="2"),
            "B": branch(
                {"0": "z>1", "1": ""},
                activating="1",
                facts={"0": {"aggregation": "human", "critical": True, "max_age": 0.3}},
            ),
        }
    )
    levels = {"B/0": "human"}
    story = Attended(on, goals=["A/State0"], levels=levels, automatic=False).tick()
    story.say("0").wait(0.5)
    assert (len(story.asked), story.phase) == (2, "waiting")
    story.say("0")
    assert story.phase == "ready"
    story.wait(0.5).say("cannot say")
    assert lost(story).reason.startswith("Fact 1 of B, a critical fact, is unknown")


def clamped() -> Attended:
    """A waits to be asked; a person says B's fact, for 0.3 s; C's is critical and has a sensor."""
    human = {"0": {"aggregation": "human", "max_age": 0.3}}
    on = blueprint(
        {
            "A": branch({"0": "go>1", "1": "on>2", "2": ""}, activating="2"),
            "B": branch({"0": "z>1", "1": ""}, activating="1", facts=human),
            "C": branch({"0": "z>1", "1": ""}, activating="1", facts=CLAMP["facts"]),
        }
    )
    return Attended(on, FakeHost(on), goals=["A/State0"], automatic=False).tick().say("0")


@pytest.mark.parametrize("value", ["1", None], ids=["false", "unknown"])
def test_nobody_is_asked_before_it_holds_where_people_cannot_say_what_is_lost(
    value: str | None,
) -> None:
    story = clamped().wait(0.5)
    assert (story.phase, len(story.asked)) == ("ready", 1)
    facts(story)["C", 0] = value
    story.tick(4)
    assert lost(story).reason.startswith("Clamp of C, a critical fact, ")
    assert (story.phase, len(story.asked)) == ("fault_hold", 1)


@pytest.mark.parametrize("value", ["1", None], ids=["false", "unknown"])
def test_a_loss_while_people_are_asked_where_the_procedure_stands(value: str | None) -> None:
    story = clamped().wait(0.5)
    story.dispatcher.pause()
    story.tick().dispatcher.resume()
    story.tick()
    assert (story.phase, story.asked[1:]) == ("waiting", [("fact", "B/0")])
    facts(story)["C", 0] = value
    story.tick(4)
    assert lost(story).reason.startswith("Clamp of C, a critical fact, ")
    assert story.outcomes[1:] == [("withdrawn", "")]
    facts(story)["C", 0] = "0"
    story.dispatcher.resume()
    story.tick(4).say("0")
    assert (story.phase, story.configuration["A"]) == ("ready", "State0")


def test_a_critical_fact_lost_after_its_state_was_reached() -> None:
    edges = {f"1{n:02}": f"go>1{n + 1:02}" for n in range(20)} | {"000": "go>100", "120": ""}
    on = blueprint(
        {"A": branch(edges, initial="000", activating="120", facts={"0": {"critical": True}})}
    )
    story = Story(on, LocalHost(on, "table")).tick(4)
    story.dispatcher.disturb("A/0", "dropout")
    story.run()
    (held,) = story.of("held")
    assert (held.kind, story.of("goal_reached")) == ("guard_lost", [])
    assert len(story.commits) < 10
