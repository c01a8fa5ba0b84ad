"""Helpers that bring a run into a run state, and tell how a command was answered there."""

from __future__ import annotations

from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.errors import UsageError
from smsl_studio.host.protocol import Outcome
from smsl_studio.runlog.events import Commanded
from tests.dispatch.fake_host import FakeHost, Fault
from tests.dispatch.runs import Story, sample

FIRST = Address("SB1", "State_aaa", "Op_1c")
SECOND = Address("SB1", "State_caa", "Op_2b")
OTHER = Address("SB1", "State_aaa", "Op_1b")


class Trials(FakeHost):
    """A host with one fault and one sensor to be disturbed."""

    def disturb(self, target: str, kind: str, **parameters: float | str) -> tuple[str, ...]:
        if kind == "nonsense":
            raise UsageError(f"there is no disturbance {kind!r}")
        return super().disturb(target, kind, **parameters)

    def inject(self, fault: str, **parameters: float | str) -> None:
        if fault != "slip":
            raise UsageError(f"there is no fault {fault!r}")
        self.calls.append(f"inject {fault}")


def hanoi(**choices: Any) -> Story:
    """Three disks from peg a to c, attended; every operation takes five ticks."""
    made = choices.pop("blueprint", None) or sample("hanoi-corrected")
    host = Trials(made, **{"lasts": 5, "timeout": 60.0, **choices.pop("host", {})})
    choices.setdefault("attended", True)
    return Story(made, host, goals=choices.pop("goals", ["SB1/State_ccc"]), **choices)


def middle(**choices: Any) -> Story:
    """In the middle of the first operation."""
    story = hanoi(**choices).tick(3)
    assert story.dispatcher.status.running == FIRST
    return story


def between(**choices: Any) -> Story:
    """The first operation is committed, the second has not begun."""
    story = hanoi(**choices)
    while not story.commits:
        story.tick()
    assert (story.phase, story.dispatcher.status.carrying) == ("running", None)
    return story


def said(story: Story, word: str, *parameters: Any, ticks: int = 1, **named: Any) -> Commanded:
    """Say one command and take the tick that answers it."""
    getattr(story.dispatcher, word)(*parameters, **named)
    before = len(story.events)
    story.tick(ticks)
    answers = [one for one in story.events[before:] if isinstance(one, Commanded)]
    (answer,) = [one for one in answers if one.command == word]
    return answer


def host_of(story: Story) -> FakeHost:
    assert isinstance(story.host, FakeHost)
    return story.host


def calls(story: Story) -> list[str]:
    """What the host was asked to do."""
    return host_of(story).calls


def facts_of(story: Story) -> dict[FactKey, str | None]:
    """The facts on the host's table, to be moved by hand."""
    return host_of(story).facts


def ready() -> Story:
    return hanoi(automatic=False).tick()


def paused() -> Story:
    story = between()
    said(story, "pause")
    return story


def no_route() -> Story:
    story = hanoi(avoid=["SB1/State_aaa/Op_1b", "SB1/State_aaa/Op_1c"]).tick()
    assert story.phase == "no_route"
    return story


def taken_over() -> Story:
    story = middle()
    said(story, "take_over", by="Brandt")
    return story


def fault_hold() -> Story:
    """The first operation ended in a state that is another one's."""
    elsewhere = Fault(Outcome.RETURNED, writes={("SB1", 0): "b"})
    story = hanoi(host={"faults": {str(FIRST): elsewhere}}).run()
    assert story.phase == "fault_hold"
    return story


def stopped() -> Story:
    story = middle()
    said(story, "stop", by="Brandt")
    return story
