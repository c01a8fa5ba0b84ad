"""Forecasts in a run: what is told, what differs, and what the levels do about it."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from smsl_studio import front
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.errors import RunRefused, UsageError
from smsl_studio.front.inputs import read
from smsl_studio.front.logs import verify_stream
from smsl_studio.front.request import RunRequest
from smsl_studio.front.runs import Run, open_request
from smsl_studio.front.script.lines import read_script
from smsl_studio.front.script.script import Script
from smsl_studio.front.twin import Twin
from smsl_studio.front.twin_process import TwinProcess
from smsl_studio.generate.code.blueprint_parts import refuse_what_is_not_generated
from smsl_studio.library.loading import discover
from smsl_studio.runlog.events import (
    Commanded,
    Committed,
    Event,
    ForecastTold,
    Held,
    OperationRefused,
    OperationStarted,
    RiskEstimated,
    TaskOpened,
)
from smsl_studio.runlog.regulation import AGREES, COMPARISONS, DIFFERS, FORECASTS, NONE
from smsl_studio.shipped import samples_dir
from tests.front.any_run import any_run
from tests.plugin_folder import blueprint_of, write_plugin
from tests.runlog.impossible import Story

SAMPLE = samples_dir() / "hanoi-2.json"
ODD = """
import os

def register(library):
    @library.world("odd", engine="table", settle=0.1)
    def build(world, blueprint, seed):
        return world

    @library.arrange("odd")
    def arrange(world, facts):
        world.set_facts(facts)

    @library.sensor("fact", fact="1", period=0.1)
    def fact(world):
        return world.fact("SB", 0)

    @library.operation("Go", timeout=5.0)
    def go(world):
        yield
        world.set_facts({("SB", 0): "b"})

    @library.operation("Stray", timeout=5.0)
    def stray(world):
        yield
        world.set_facts({("SB", 0): "c"})

    @library.operation("Die", timeout=5.0)
    def die(world):
        yield
        os._exit(3)
"""
ROW = {"Go": "State_b", "Stray": "State_b", "Die": "State_b"}
TABLE: dict[str, Any] = {
    "SB": {
        "HEADER": {"INITIAL": "State_a", "ACTIVATING": "State_b", "NUM_FACTS": 1},
        "State_a": ROW,
        "State_b": {},
        "State_c": {},
    }
}


@pytest.fixture
def odd(tmp_path: Path) -> Callable[..., Run]:
    """Run in a world in which ``Stray`` leads elsewhere and ``Die`` kills its process."""
    write_plugin(tmp_path, "odd", ODD)

    def run(operation: str, forecast: str, script: Script | None = None, **more: Any) -> Run:
        left = tuple(f"SB/State_a/{name}" for name in ROW if name != operation)
        return front.run(
            blueprint_of(TABLE),
            "odd",
            avoid=left,
            forecast=forecast,
            script=script,
            plugin_paths=(tmp_path / "odd",),
            **more,
        )

    return run


def of(done: Run, kind: type[Event]) -> list[Any]:
    return [event for event in done.events if isinstance(event, kind)]


def made(done: Run) -> list[ForecastTold]:
    return [one for one in of(done, ForecastTold) if one.verdict in FORECASTS]


def compared(done: Run) -> list[ForecastTold]:
    return [one for one in of(done, ForecastTold) if one.verdict in COMPARISONS]


def script_of(folder: Path, act: dict[str, Any], blueprint: Blueprint) -> Script:
    file = folder / "script.jsonl"
    file.write_text(json.dumps(act))
    return read_script(file, blueprint)


def test_each_operation_has_a_forecast_before_and_a_comparison_after() -> None:
    done = front.run(read(SAMPLE), forecast="show")
    kinds = (ForecastTold, OperationStarted, Committed, ForecastTold)
    told = [type(event) for event in done.events if isinstance(event, kinds)]
    assert told == [*kinds] * 3
    assert [e.verdict for e in of(done, ForecastTold)] == ["agrees", "right"] * 3
    assert made(done)[0].facts == {"SB1/0": "b"}
    assert not any(e.reason for e in of(done, ForecastTold))


def test_without_its_own_events_the_trace_is_that_of_a_run_without_forecasts() -> None:
    without = front.run(read(SAMPLE))
    for level in ("show", "ask", "hold"):
        done = front.run(read(SAMPLE), forecast=level)
        assert tuple(e for e in done.events if not isinstance(e, ForecastTold)) == without.events


@pytest.mark.parametrize("host", ["local", "process"])
def test_a_fault_of_the_live_world_makes_the_forecast_wrong(host: str, tmp_path: Path) -> None:
    act = {"when": "SB1/State_ba", "do": "inject", "fault": "fail"}
    script = script_of(tmp_path, act, read(SAMPLE))
    done = front.run(read(SAMPLE), forecast="hold", script=script, host=host)
    (wrong,) = (e for e in compared(done) if e.verdict == "wrong")
    assert wrong.address == "SB1/State_ba/Op_2c"
    assert wrong.reason == "SB1/1 is a, not c"


def test_a_forecast_that_differs_is_told_asked_about_or_holds(odd: Callable[..., Run]) -> None:
    shown = odd("Stray", "show")
    (one,) = made(shown)
    assert (one.verdict, one.facts) == ("differs", {"SB/0": "c"})
    assert one.reason.startswith("SB/0 will be c, not b")
    assert of(shown, OperationStarted)
    assert [e.verdict for e in compared(shown)] == ["right"]
    asked = odd("Stray", "ask")
    assert (asked.reason, of(asked, OperationStarted)) == ("held", [])
    (command,) = of(asked, Commanded)
    assert (command.command, command.by) == ("ask", "forecast")
    held = odd("Stray", "hold")
    assert (held.reason, of(held, OperationStarted), of(held, Commanded)) == ("held", [], [])
    assert "the forecast differs: SB/0 will be c, not b" in of(held, Held)[0].reason
    assert odd("Go", "hold").reason == "goal_reached"


def test_a_world_that_dies_gives_no_forecast_and_the_run_goes_on_living(
    odd: Callable[..., Run],
) -> None:
    held = odd("Die", "hold", host="process")
    (one,) = made(held)
    assert (one.verdict, one.facts) == ("none", {})
    assert "process" in one.reason
    assert (held.reason, of(held, OperationStarted)) == ("held", [])


def test_a_person_who_asks_for_it_all_the_same_gets_it(
    odd: Callable[..., Run], tmp_path: Path
) -> None:
    act = {"at": 0, "do": "ask", "address": "SB/State_a/Stray"}
    script = script_of(tmp_path, act, blueprint_of(TABLE))
    done = odd("Go", "hold", script)
    assert not [e for e in of(done, OperationStarted) if e.address.endswith("Stray")]
    free = front.run(
        blueprint_of(TABLE),
        "odd",
        forecast="hold",
        script=script,
        plugin_paths=(tmp_path / "odd",),
    )
    assert made(free)[0].verdict == "differs"
    assert of(free, OperationStarted)[0].address == "SB/State_a/Stray"


def test_a_resume_after_the_hold_is_the_answer_of_a_person(tmp_path: Path) -> None:
    write_plugin(tmp_path, "odd", ODD)
    request = RunRequest(
        blueprint_of(TABLE),
        "odd",
        host="local",
        avoid=("SB/State_a/Go", "SB/State_a/Die"),
        attended=True,
        forecast="hold",
        plugin_paths=(tmp_path / "odd",),
    )
    dispatcher = open_request(request)
    try:
        events = [*dispatcher.open(), *_until(dispatcher, "fault_hold")]
        assert not any(isinstance(event, OperationStarted) for event in events)
        dispatcher.resume(by="Ada")
        events = list(_until(dispatcher, "fault_hold"))
        assert [e.address for e in events if isinstance(e, OperationStarted)] == [
            "SB/State_a/Stray"
        ]
    finally:
        dispatcher.close()


def _until(dispatcher: Dispatcher, phase: str) -> Iterator[Event]:
    for _ in range(200):
        yield from dispatcher.tick()
        if dispatcher.phase == phase or dispatcher.finished:
            return
    raise AssertionError(f"{phase} was expected, not {dispatcher.phase}: {dispatcher.standing}")


def test_what_a_person_carries_out_has_no_forecast_and_does_not_hold(tmp_path: Path) -> None:
    by_hand = {"_operations": {"Go": {"actor": "human"}}, "State_a": {"Go": "State_b"}}
    blueprint = blueprint_of({"SB": {**TABLE["SB"], **by_hand}})
    act = {"do": "answer", "kind": "operation", "option": "done", "at": 0.2}
    script = script_of(tmp_path, act, blueprint)
    done = front.run(blueprint, forecast="hold", script=script)
    (one,) = made(done)
    assert (one.verdict, one.reason) == ("none", "a person carries it out")
    assert of(done, OperationStarted)
    assert not compared(done)


def test_show_lets_everything_begin(odd: Callable[..., Run]) -> None:
    """What differs, and what has no forecast because its world dies, begins all the same."""
    for operation, verdict in (("Go", AGREES), ("Stray", DIFFERS), ("Die", NONE)):
        shown, without = odd(operation, "show", host="process"), odd(operation, "", host="process")
        assert [one.verdict for one in made(shown)][:1] == [verdict]
        assert not of(shown, Commanded)
        begun = [e.address for e in of(shown, OperationStarted)]
        assert begun == [e.address for e in of(without, OperationStarted)]
        assert begun[0] == f"SB/State_a/{operation}"
        assert shown.reason == without.reason


DECIDES = """
def register(library):
    @library.supervisor("seer", forecasts={forecasts})
    def seer(view):
        told = view.forecast
        verdict = "nothing" if told is None else told.verdict
        return ("veto" if verdict == "differs" else "approve"), f"it sees {{verdict}}"
"""


@pytest.mark.parametrize("forecasts", [True, False])
def test_a_supervisor_of_a_plugin_that_needs_forecasts_gets_them(
    odd: Callable[..., Run], tmp_path: Path, forecasts: bool
) -> None:
    """One that does not say so sees none, and the run makes none."""
    write_plugin(tmp_path, "seer", DECIDES.format(forecasts=forecasts))
    stray = {"SB": {**TABLE["SB"], "State_a": {"Stray": "State_b"}}}
    done = front.run(
        blueprint_of(stray),
        "odd",
        supervisor="seer",
        on_mismatch="adopt",
        plugin_paths=(tmp_path / "odd", tmp_path / "seer"),
    )
    assert [one.verdict for one in made(done)][:1] == (["differs"] if forecasts else [])
    vetoes = [(one.command, one.reason) for one in of(done, Commanded)]
    assert vetoes[:1] == ([("veto", "it sees differs")] if forecasts else [])
    assert bool(of(done, OperationStarted)) is not forecasts


def test_the_supervisor_forecast_vetoes_and_the_risk_counts_it(odd: Callable[..., Run]) -> None:
    done = odd("Stray", "", supervisor="forecast")
    (estimated,) = of(done, RiskEstimated)
    assert estimated.risk > 0.8
    assert any(reason.startswith("its forecast differs") for reason in estimated.reasons)
    assert [e.command for e in of(done, Commanded)] == ["veto"]
    assert of(done, OperationRefused)
    assert not of(done, OperationStarted)
    assert odd("Go", "", supervisor="forecast").reason == "goal_reached"
    with pytest.raises(UsageError, match="no answer 'no'"):
        odd("Go", "", supervisor="forecast:differs=no")


def test_rules_may_name_the_forecast(odd: Callable[..., Run], tmp_path: Path) -> None:
    rules = tmp_path / "rules.toml"
    rules.write_text('[[rule]]\nforecast = "differs"\nanswer = "veto"\nreason = "it strays"\n')
    done = odd("Stray", "show", supervisor=f"rules:file={rules}")
    assert [e.reason for e in of(done, Commanded)] == ["it strays"]
    assert odd("Go", "show", supervisor=f"rules:file={rules}").reason == "goal_reached"


def test_the_log_says_the_level_and_its_order_is_checked(tmp_path: Path) -> None:
    log = tmp_path / "run.jsonl"
    front.run(read(SAMPLE), forecast="ask", log=log)
    raw = log.read_bytes()
    assert json.loads(raw.splitlines()[0])["forecast"] == "ask"
    assert verify_stream(io.BytesIO(raw), "run.jsonl").doubt is None
    assert verify_stream(io.BytesIO(raw), "run.jsonl", read(SAMPLE)).doubt is None


def test_an_unknown_level_is_refused_with_the_names() -> None:
    with pytest.raises(UsageError, match="no level of forecasts 'holds'"):
        front.run(read(SAMPLE), forecast="holds")


def test_a_stop_in_the_middle_of_a_forecast_is_heeded() -> None:
    """At each moment at which a run asks whether it must stop."""
    looks = 0

    def stops_at(last: int) -> Run:
        nonlocal looks
        looks = 0

        def stop() -> bool:
            nonlocal looks
            looks += 1
            return looks >= last

        return front.run(read(SAMPLE), forecast="hold", stop_when=stop)

    assert stops_at(10_000).reason == "goal_reached"
    every = looks
    assert every > 12
    for last in range(1, every + 1):
        done = stops_at(last)
        assert done.reason == "stopped", last
        assert len(of(done, OperationStarted)) <= len(made(done)), last


def test_a_forecast_made_twice_is_the_same() -> None:
    twin = Twin(RunRequest(read(SAMPLE), host="local"))
    try:
        edge = Address("SB1", "State_aa", "Op_1b")
        found = twin.predict({"SB1": "State_aa"}, edge)
        again = twin.predict({"SB1": "State_aa"}, edge)
    finally:
        twin.close()
    assert found == again
    assert found.verdict == "agrees"


def leveled(
    operation: str, notes: dict[str, Any], levels: dict[str, str] | None = None
) -> Blueprint:
    """The small blueprint with annotations for one operation, and with levels."""
    branch = {**TABLE["SB"], "_operations": {operation: notes}}
    return blueprint_of({**({"_levels": levels} if levels else {}), "SB": branch})


def run_odd(folder: Path, blueprint: Blueprint, operation: str, **more: Any) -> Run:
    """Run it in the odd world, by one operation."""
    if not (folder / "odd").exists():
        write_plugin(folder, "odd", ODD)
    left = tuple(f"SB/State_a/{name}" for name in ROW if name != operation)
    return front.run(blueprint, "odd", avoid=left, plugin_paths=(folder / "odd",), **more)


@pytest.mark.parametrize("by", ["operation", "levels", "before"])
def test_a_blueprint_gives_its_operations_a_level(by: str, tmp_path: Path) -> None:
    notes = {"forecast": "hold"} if by == "operation" else {"title": "Stray"}
    blueprint = leveled("Stray", notes, {"forecast": "hold"} if by == "levels" else None)
    before = {"forecast": "hold"} if by == "before" else {}
    held = run_odd(tmp_path, blueprint, "Stray", levels=before)
    assert (held.reason, of(held, OperationStarted)) == ("held", [])
    assert [one.verdict for one in made(held)] == ["differs"]
    shown = run_odd(tmp_path, blueprint, "Stray", levels=before, forecast="show")
    assert shown.reason == "held", "no level of a run takes away what is demanded"
    done = run_odd(tmp_path, blueprint, "Go", levels=before)
    assert (done.reason, len(made(done))) == ("goal_reached", 0 if by == "operation" else 1)


def test_what_a_person_confirms_is_forecast_before_the_person_is_asked(tmp_path: Path) -> None:
    blueprint = leveled("Go", {"confirm": ["surgeon"], "forecast": "ask"})
    act = {"do": "answer", "kind": "confirm", "option": "confirm", "role": "surgeon"}
    script = script_of(tmp_path, act, blueprint)
    done = run_odd(tmp_path, blueprint, "Go", script=script)
    assert done.reason == "goal_reached"
    kinds = (ForecastTold, TaskOpened, OperationStarted, ForecastTold)
    told = [event for event in done.events if isinstance(event, kinds)]
    assert [type(event) for event in told] == [*kinds]
    assert [one.verdict for one in of(done, ForecastTold)] == ["agrees", "right"]
    alone = front.preview(blueprint, "SB/State_a/Go")
    assert alone.agrees, alone.sentence


def test_code_is_not_generated_for_what_asks_for_forecasts() -> None:
    refuse_what_is_not_generated(leveled("Go", {"title": "Go"}))
    with pytest.raises(RunRefused, match="asks for forecasts"):
        refuse_what_is_not_generated(leveled("Go", {"forecast": "show"}))


def test_a_twin_goes_on_along_the_route_until_it_differs() -> None:
    twin = Twin(RunRequest(read(SAMPLE), host="local"))
    route = [Address("SB1", state, name) for state, name in (
        ("State_aa", "Op_1b"), ("State_ba", "Op_2c"), ("State_bc", "Op_1c"),
    )]  # fmt: skip
    try:
        assert twin.onward(route[1]) is None, "nothing was forecast yet"
        assert twin.predict({"SB1": "State_aa"}, route[0]).verdict == "agrees"
        assert twin.onward(route[2]) is None, "it does not stand there"
        found = [twin.onward(edge) for edge in route[1:]]
        assert [one and one.after for one in found] == [
            {"SB1/0": "b", "SB1/1": "c"},
            {"SB1/0": "c", "SB1/1": "c"},
        ]
    finally:
        twin.close()


HARDWARE = """
from pathlib import Path

def register(library):
    @library.world("arm", engine="table", hardware=True)
    def build(world, blueprint, seed):
        Path(__file__).with_name("built").touch()
        return world
"""


@pytest.mark.parametrize("world", ["arm", "remote"])
@pytest.mark.parametrize("make", [Twin, TwinProcess])
@pytest.mark.parametrize("found", [False, True])
def test_what_is_real_is_never_tried(
    tmp_path: Path, world: str, make: type[Twin | TwinProcess], found: bool
) -> None:
    """Also if the plugins were found before, or the run is approved for hardware."""
    place = write_plugin(tmp_path, "arm", HARDWARE)
    request = RunRequest(blueprint_of(TABLE), world, plugin_paths=(place,))
    twin = make(request, discover([place]) if found else None)
    told = [twin.predict({"SB": "State_a"}, Address("SB", "State_a", "Go")) for _ in range(2)]
    twin.close()
    assert {one.verdict for one in told} == {"none"}
    assert all("cannot be tried beforehand" in one.reason for one in told)
    assert not (place / "built").exists()


CHANGES: tuple[tuple[dict[str, Any], str], ...] = (
    ({"verdict": "sure"}, "no forecast that says 'sure'"),
    ({"address": "SB1/State_aa"}, "no forecast that says"),
    ({"verdict": "right", "facts": {}, "reason": ""}, "a forecast that was not made"),
    ({"facts": {"SB1": "b"}}, "is about no fact"),
    ({"verdict": "none", "reason": "it broke"}, "which facts will change"),
    ({"reason": "it strays"}, "says 'agrees' and 'it strays'"),
    ({"verdict": "differs"}, "says 'differs' and 'no reason'"),
)


@pytest.mark.parametrize(("change", "words"), CHANGES)
def test_an_impossible_forecast_in_a_log_is_refused(
    tmp_path: Path, change: dict[str, Any], words: str
) -> None:
    log = tmp_path / "run.jsonl"
    front.run(read(SAMPLE), forecast="show", log=log)
    story = Story.of(log.read_bytes())
    first = next(one for one in story.events if one["event"] == "forecast")
    first.update(change)
    doubt = verify_stream(io.BytesIO(story.raw()), "run.jsonl").doubt
    assert doubt is not None
    assert words in str(doubt)


@pytest.mark.parametrize("number", range(12))
def test_any_run_is_the_same_with_forecasts_and_both_verifiers_believe_it(
    number: int, tmp_path: Path
) -> None:
    """With people, faults, take-overs and sub-SBs, as random scripts have them."""
    one, log = any_run(number), tmp_path / "run.jsonl"
    without = front.run(one.blueprint, script=one.script, **one.asked)
    done = front.run(one.blueprint, script=one.script, forecast="show", log=log, **one.asked)
    assert tuple(e for e in done.events if not isinstance(e, ForecastTold)) == without.events
    raw = log.read_bytes()
    assert verify_stream(io.BytesIO(raw), "run.jsonl").doubt is None
    assert verify_stream(io.BytesIO(raw), "run.jsonl", one.blueprint).doubt is None
