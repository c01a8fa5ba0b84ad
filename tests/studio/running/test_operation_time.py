"""Operations of the table world are shown for a time, and the events know nothing of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import pytest
from pytestqt.qtbot import QtBot

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.front.runs import open_run
from smsl_studio.runlog.events import Event, RunFinished
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.files import parse_text
from smsl_studio.studio.running import operation_time
from smsl_studio.studio.running.operation_time import OperationTime, ShownTime, shown_duration
from smsl_studio.studio.running.runner import FASTEST, Runner

SAMPLES = ("hanoi-corrected.json", "hfsm.json", "three-levels.json", "registration-failures.json",
           "registration-digitization.json")  # fmt: skip
FOR_EVER = 1e9


@dataclass
class Watching:
    """A run of a blueprint as the window makes it, and what it has told."""

    runner: Runner
    qtbot: QtBot
    events: list[Event] = field(default_factory=list)
    phase: str = ""

    def look(self) -> None:
        news = self.runner.take()
        if news is not None:
            self.events += news[0]
            self.phase = news[1].phase

    def until(self, so: Callable[[], bool]) -> None:
        def there() -> bool:
            self.look()
            return so()

        self.qtbot.waitUntil(there)

    def until_shown(self, operation: str) -> ShownTime:
        self.until(lambda: self._shows(operation))
        shown = self.runner.shown_time
        assert shown is not None
        return shown

    def _shows(self, operation: str) -> bool:
        shown = self.runner.shown_time
        return shown is not None and shown.address.operation == operation

    def until_over(self) -> list[str]:
        self.until(lambda: bool(self.events) and isinstance(self.events[-1], RunFinished))
        return [event.line() for event in self.events]

    def say(self, word: str, **said: object) -> None:
        self.runner.command(COMMANDS[word].command(**said))

    @property
    def words(self) -> list[str]:
        return [event.event for event in self.events]


Watch = Callable[[Blueprint, float], Watching]


@pytest.fixture
def watch(qtbot: QtBot) -> Iterator[Watch]:
    made: list[Runner] = []

    def start(blueprint: Blueprint, speed: float) -> Watching:
        runner = Runner(
            lambda: open_run(blueprint, host="process", attended=True),
            speed,
            time=OperationTime(blueprint),
        )
        made.append(runner)
        runner.start()
        return Watching(runner, qtbot)

    yield start
    for runner in made:
        runner.close()


@pytest.mark.parametrize("name", SAMPLES)
@pytest.mark.parametrize("speed", [40.0, FASTEST])
def test_a_watched_run_tells_what_a_headless_one_tells(
    name: str, speed: float, watch: Watch
) -> None:
    blueprint = smsl.read(samples_dir() / name)
    headless = [event.line() for event in smsl.run(blueprint).events]
    assert watch(blueprint, speed).until_over() == headless


HANOI = smsl.read(samples_dir() / "hanoi-corrected.json")


def test_an_operation_is_shown_until_its_time_is_over(
    watch: Watch, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(operation_time, "USUAL", FOR_EVER)
    watching = watch(HANOI, 1.0)
    shown = watching.until_shown("Op_1c")
    assert (shown.whole, shown.declared) == (FOR_EVER, False)
    assert "operation_ended" not in watching.words
    watching.runner.set_speed(FOR_EVER)
    watching.until_shown("Op_2b")
    watching.runner.set_speed(FASTEST * FOR_EVER)
    assert watching.until_over() == [event.line() for event in smsl.run(HANOI).events]


def test_a_stop_does_not_wait_for_the_time_of_the_operation(
    watch: Watch, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(operation_time, "USUAL", FOR_EVER)
    watching = watch(HANOI, 1.0)
    watching.until_shown("Op_1c")
    watching.say("stop", by="Ada")
    watching.until(lambda: watching.phase == "stopped")
    words = watching.words
    assert words[words.index("commanded") + 1] == "operation_ended"
    assert watching.events[words.index("stopped")].t == 0.0
    watching.until(lambda: watching.runner.shown_time is None)


def test_a_pause_holds_the_operation_and_its_time_goes_on_afterwards(
    watch: Watch, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(operation_time, "USUAL", FOR_EVER)
    watching = watch(HANOI, 1.0)
    watching.until_shown("Op_1c")
    watching.until(lambda: (watching.runner.shown_time or _never()).elapsed > 0)
    watching.say("pause")
    watching.until(lambda: watching.phase == "paused")
    held = watching.runner.shown_time
    assert held is not None
    assert held.elapsed > 0
    watching.say("resume")
    watching.until(lambda: (watching.runner.shown_time or _never()).elapsed > held.elapsed)
    assert "operation_ended" not in watching.words
    assert watching.events[-1].t == 0.0


def test_a_fault_comes_at_once_and_another_price_when_the_operation_has_ended(
    watch: Watch, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(operation_time, "USUAL", FOR_EVER)
    watching = watch(HANOI, 1.0)
    watching.until_shown("Op_1c")
    watching.say("set_cost", address=Address("SB1", "State_caa", "Op_2b"), cost=2.0)
    watching.runner.set_speed(0.5)
    watching.until(lambda: (watching.runner.shown_time or _never()).elapsed > 0.05)
    assert "commanded" not in watching.words
    watching.say("inject", fault="fail")
    watching.until(lambda: "operation_ended" in watching.words)
    told = [event.as_json() for event in watching.events if event.event == "commanded"]
    assert [one["command"] for one in told] == ["inject", "set_cost"]


def _never() -> ShownTime:
    return ShownTime(Address("SB1"), -1.0, 1.0, declared=False)


def test_the_declared_duration_counts_and_else_what_a_person_can_follow() -> None:
    text = """{"SB": {"_operations": {"slow": {"duration": 12.5}, "none": {"duration": 0}},
    "State_0": {"slow": "State_1", "none": "State_1", "plain": "State_1"}, "State_1": {}}}"""
    blueprint = read_blueprint(parse_text(text, "here.json"))
    found = [shown_duration(blueprint, Address("SB", "State_0", name))
             for name in ("slow", "none", "plain")]  # fmt: skip
    assert found == [(12.5, True), (0.0, True), (operation_time.USUAL, False)]
    assert ShownTime(Address("SB"), 0.0, 0.0, declared=True).share == 1.0
    assert ShownTime(Address("SB"), 3.0, 12.0, declared=True).words == "3.0 of 12.0 s"
