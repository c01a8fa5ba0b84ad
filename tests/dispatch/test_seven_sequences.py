"""Seven sequences that broke the first D-SFO system: here none deadlocks or refuses late."""

from __future__ import annotations

import pytest

from smsl_studio.blueprint.configuration import Hierarchy, disagreements
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.host.local import LocalHost
from smsl_studio.host.protocol import Outcome
from tests.dispatch.fake_host import FakeHost, Fault
from tests.dispatch.runs import Story, blueprint, sample

WORDS = {
    "plan": "LandmarksPlanned",
    "auto-digitize": "DIGITIZATION/DigitizeAllLandmarks",
    "digitize-one": "DIGITIZATION/RedigitizeOneLandmark",
    "register": "Registered",
    "session-reinit": "ReinitState",
    "use-previous": "UsePrevRegister",
}
GOAL = "REGISTRATION/State111"


def driving() -> Blueprint:
    """The same blueprint with ``UsePrevRegister`` not marked: its sub is driven."""
    made = sample("registration-digitization")
    values = {name: dict(made.document.values[name]) for name in made.branches}
    del values["REGISTRATION"]["_operations"]
    return blueprint(values)


@pytest.mark.parametrize(
    "made", [sample("registration-digitization"), driving()], ids=["load", "drive"]
)
@pytest.mark.parametrize(
    ("sequence", "ends", "refused"),
    [
        ("plan auto-digitize session-reinit", ("000", "0"), 0),
        ("plan auto-digitize plan", ("100", "0"), 0),
        ("auto-digitize", ("000", "0"), 1),
        ("use-previous digitize-one", ("111", "1"), 0),
        ("plan auto-digitize register plan", ("111", "1"), 1),
        ("use-previous", ("111", "1"), 0),
    ],
)
def test_sequence(made: Blueprint, sequence: str, ends: tuple[str, str], refused: int) -> None:
    host = LocalHost(made, "table")
    story = Story(made, host, automatic=False).ask(*(WORDS[word] for word in sequence.split()))
    assert story.configuration == {
        "REGISTRATION": f"State{ends[0]}",
        "DIGITIZATION": f"State{ends[1]}",
    }
    assert len(story.of("operation_refused")) == refused
    assert story.phase == "ready"
    _agreed_all_the_way(story)
    if refused:
        _nothing_after(story, "operation_refused")
    story.dispatcher.resume()
    assert story.run().end.reason == "goal_reached"


def test_after_a_reinit_it_can_be_completed_again_by_digitizing() -> None:
    made = sample("registration-digitization")
    edges = (edge.address for edge in made["REGISTRATION"].edges())
    avoid = [str(address) for address in edges if address.operation == "UsePrevRegister"]
    story = Story(made, LocalHost(made, "table"), automatic=False, avoid=avoid)
    story.ask(*(WORDS[word] for word in ("plan", "auto-digitize", "session-reinit")))
    story.dispatcher.resume()
    story.run()
    assert story.end.reason == "goal_reached"
    assert "DIGITIZATION/State0/ConfirmAllDigitized" in story.started


def test_register_whose_operation_throws_keeps_an_active_state() -> None:
    made = sample("registration-digitization")
    fault = Fault(Outcome.RAISED, writes={})
    host = FakeHost(made, faults={"REGISTRATION/State110/Registered": fault})
    story = Story(made, host, automatic=False)
    story.ask(*(WORDS[word] for word in ("plan", "auto-digitize", "register")))
    assert story.configuration == {"REGISTRATION": "State110", "DIGITIZATION": "State1"}
    assert story.phase == "ready"
    assert story.of("operation_risky")[0].address == "REGISTRATION/State110/Registered"
    host.faults.clear()
    assert story.ask(WORDS["register"]).configuration["REGISTRATION"] == "State111"


def test_register_that_throws_after_its_effect_is_not_believed() -> None:
    made = sample("registration-digitization")
    host = FakeHost(made, faults={"REGISTRATION/State110/Registered": Fault(Outcome.RAISED)})
    story = Story(made, host, automatic=False)
    story.ask(*(WORDS[word] for word in ("plan", "auto-digitize", "register")))
    assert story.phase == "fault_hold"
    assert story.configuration["REGISTRATION"] == "State110"
    assert "State111" in str(story.of("mismatch")[0].candidates)


def _agreed_all_the_way(story: Story) -> None:
    hierarchy = Hierarchy(story.blueprint)
    configuration = dict(story.of("run_started")[0].start)
    for event in story.of("committed"):
        configuration |= event.configuration
        assert disagreements(hierarchy, configuration) == ()
    assert configuration == story.configuration


def _nothing_after(story: Story, word: str) -> None:
    """A refusal comes before motion: nothing starts for it."""
    last = max(i for i, event in enumerate(story.events) if event.event == word)
    assert {event.event for event in story.events[last + 1 :]} <= {"fact_changed", "goal_reached"}
